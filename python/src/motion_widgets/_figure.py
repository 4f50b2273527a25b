"""What every figure is in Python."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import anywidget
import traitlets as t

from ._traits import Setting


class Figure(anywidget.AnyWidget):
    """A figure on a page, and what Python knows of it.

    A trait that was not given is None until the figure is on the page; from then on each says what the figure shows,
    whoever has changed it. None given later is what the figure opens with.
    """

    _esm = Path(__file__).parent / "anywidget.js"

    stats = t.Dict(
        default_value=None,
        allow_none=True,
        read_only=True,
        help="The statistics that the figure shows; None where there is none, or no number.",
    ).tag(sync=True)
    error = t.Unicode(
        "", read_only=True, help="Why the figure refused the last change, in a sentence; empty where it did not."
    ).tag(sync=True)

    # Number of requests by Python, and the settings shown by the figure with the number of requests it had heard then.
    _asked = t.Int(0).tag(sync=True)
    _shown = t.Dict({"heard": 0, "settings": {}}).tag(sync=True)

    def __init__(self, **settings: Any) -> None:
        strangers = sorted(set(settings) - set(self.trait_names()))
        if strangers:
            known = ", ".join(name for name, trait in self.traits().items() if isinstance(trait, Setting))
            raise TypeError(f"{strangers[0]} is no setting of {type(self).__name__}; it has {known}")
        # By name.
        self._asked_at: dict[str, int] = {}
        self._told: dict[str, Any] = {}
        super().__init__(**settings)

    def notify_change(self, change: Any) -> None:
        """Counts what Python asks for, and sends the number with it."""
        name = change["name"]
        if not _is_setting(self, name) or (name in self._told and self._told[name] == change["new"]):
            super().notify_change(change)
            return
        with self.hold_sync():
            self._asked += 1
            self._asked_at[name] = self._asked
            super().notify_change(change)

    def set_state(self, sync_data: dict[str, Any]) -> None:
        """Takes what the figure tells, but for what Python has asked for since: the figure is about to hear of that.

        Settings come all at once, in ``_shown``. One by one they may be of different moments.
        """
        shown = sync_data.get("_shown", {"heard": 0, "settings": {}})
        self._told = {name: value for name, value in shown["settings"].items() if self._asked_at.get(name, 0) <= shown["heard"]}
        others = {name: value for name, value in sync_data.items() if not _is_setting(self, name)}
        try:
            super().set_state({**others, **self._told})
        finally:
            self._told = {}


def _is_setting(figure: Figure, name: str) -> bool:
    return isinstance(getattr(type(figure), name, None), Setting)
