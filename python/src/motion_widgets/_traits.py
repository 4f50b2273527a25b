"""Traits for the settings of a figure. ``None`` stands for the value that the figure opens with."""

from __future__ import annotations

import numbers
from collections.abc import Iterable
from typing import Any, Optional, Union

import traitlets as t

Real = Union[float, int]


class Number(t.Float[Optional[float], Optional[Real]]):
    """Number in a range, also one of NumPy."""

    def __init__(self, min: float, max: float) -> None:
        super().__init__(None, allow_none=True, min=min, max=max)  # type: ignore[misc]

    def validate(self, obj: Any, value: Any) -> Optional[float]:
        if isinstance(value, bool) or not isinstance(value, numbers.Real) or value != value:
            self.error(obj, value)
        return super().validate(obj, float(value))


class Whole(t.Int[Optional[int], Optional[Real]]):
    """Whole number in a range. 1e6 is one."""

    def __init__(self, min: int, max: Optional[int] = None) -> None:
        super().__init__(None, allow_none=True, min=min, max=max)  # type: ignore[misc]

    def validate(self, obj: Any, value: Any) -> Optional[int]:
        if isinstance(value, bool) or not isinstance(value, numbers.Real) or value % 1 != 0:
            self.error(obj, value)
        return super().validate(obj, int(float(value)))


class Word(t.Enum[Optional[str]]):
    """One of some words. Words of digits may be given as integers."""

    def __init__(self, *words: str) -> None:
        super().__init__(words, None, allow_none=True)

    def validate(self, obj: Any, value: Any) -> Optional[str]:
        return super().validate(obj, str(value) if isinstance(value, int) else value)


class Sequence(t.List[Any]):
    """List of values of one trait, also from an array of NumPy."""

    _cast_types = (Iterable,)

    def __init__(self, trait: t.TraitType[Any, Any]) -> None:
        super().__init__(trait, None, allow_none=True)
