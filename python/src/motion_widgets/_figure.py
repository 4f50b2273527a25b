"""Base class of the figures."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import anywidget
import traitlets as t


class Figure(anywidget.AnyWidget):
    """Figure on a page, with a trait for each of its settings.

    A trait that was not given is None until the figure is shown. From then on, each trait has the value of the figure,
    also after a change by the user. Setting a trait to None restores the opening value.
    """

    _settings: frozenset[str] = frozenset()
    _esm = Path(__file__).parent / "anywidget.js"

    stats = t.Dict(
        default_value=None,
        allow_none=True,
        read_only=True,
        help="Statistics that the figure shows; None for undefined ones.",
    ).tag(sync=True)
    error = t.Unicode("", read_only=True, help="Message if the figure refused the last change; else empty.").tag(sync=True)

    # Number of changes by Python since the figure was created.
    _asked = t.Int(0).tag(sync=True)
    # Latest report of the figure. It contains the settings that the figure shows, and the number of changes by Python that the figure has
    # received.
    _shown = t.Dict({"heard": 0, "settings": {}}).tag(sync=True)

    def __init_subclass__(cls) -> None:
        super().__init_subclass__()
        settings = {name: trait for name, trait in vars(cls).items() if isinstance(trait, t.TraitType) and not trait.read_only}
        cls._settings |= settings.keys()
        for trait in settings.values():
            trait.tag(sync=True)

    def __init__(self, **settings: Any) -> None:
        unknown_names = sorted(set(settings) - set(self.trait_names()))
        if unknown_names:
            raise TypeError(f"{unknown_names[0]} is no setting of {type(self).__name__}; it has {', '.join(sorted(self._settings))}")
        # Sequence number of the latest change that Python made to each setting.
        self._asked_at: dict[str, int] = {}
        # Settings of the figure's report while `set_state` copies them to the traits; otherwise empty.
        self._reported: dict[str, Any] = {}
        super().__init__(**settings)

    def notify_change(self, change: Any) -> None:
        """Counts a change by Python, and sends the number with it."""
        name = change["name"]
        if name not in self._settings or (name in self._reported and self._reported[name] == change["new"]):
            super().notify_change(change)
            return
        with self.hold_sync():
            self._asked += 1
            self._asked_at[name] = self._asked
            super().notify_change(change)

    def set_state(self, sync_data: dict[str, Any]) -> None:
        """Applies the settings that the figure has changed, except those that Python has changed since.

        All settings in ``_shown`` are of one moment. The single traits in ``sync_data`` may be of different moments. Only the latter are
        set, because a page takes an echo of a trait that it did not send for a change by Python.
        """
        report = sync_data.get("_shown", {"heard": 0, "settings": {}})
        self._reported = {name: value for name, value in report["settings"].items() if self._asked_at.get(name, 0) <= report["heard"]}
        applied_names = [name for name in sync_data if name not in self._settings or name in self._reported]
        try:
            super().set_state({name: self._reported.get(name, sync_data[name]) for name in applied_names})
        finally:
            self._reported = {}
