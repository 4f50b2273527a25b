"""Traits for the settings of a figure. ``None`` stands for the value that the figure opens with."""

from __future__ import annotations

import numbers
from collections.abc import Iterable, Mapping
from typing import Any, Optional, Union

import traitlets as t

Real = Union[float, int]


class Number(t.Float[Optional[float], Optional[Real]]):
    """Number in a range, also one of NumPy."""

    def __init__(self, min: float, max: float) -> None:
        super().__init__(None, allow_none=True, min=min, max=max)  # type: ignore[misc]

    def validate(self, obj: Any, value: Any) -> float:
        return self.part(self.name, value)

    def part(self, name: str, value: Any) -> float:
        """Returns a value of this trait, or of a part of another one; ``name`` is that of the part."""
        is_number = isinstance(value, numbers.Real) and not isinstance(value, bool)
        if not is_number or not self.min <= value <= self.max:
            raise t.TraitError(f"{name} is {value!r}; allowed is a number from {self.min:.15g} to {self.max:.15g}")
        return float(value)


class Whole(t.Int[Optional[int], Optional[Real]]):
    """Whole number in a range. 1e6 is one."""

    def __init__(self, min: int, max: Optional[int] = None) -> None:
        super().__init__(None, allow_none=True, min=min, max=max)  # type: ignore[misc]

    def validate(self, obj: Any, value: Any) -> int:
        is_whole = isinstance(value, numbers.Real) and not isinstance(value, bool) and value % 1 == 0
        if not is_whole or value < self.min or (self.max is not None and value > self.max):
            end = "" if self.max is None else f" to {self.max}"
            raise t.TraitError(f"{self.name} is {value!r}; allowed is a whole number from {self.min}{end}")
        return int(value)


class Word(t.Enum[Optional[str]]):
    """One of some words. Words of digits may be given as integers."""

    def __init__(self, *words: str) -> None:
        super().__init__(words, None, allow_none=True)

    def validate(self, obj: Any, value: Any) -> str:
        return self.part(self.name, str(value) if isinstance(value, int) else value)

    def part(self, name: str, value: Any) -> str:
        """Returns a value of this trait, or of a part of another one; ``name`` is that of the part."""
        if value not in self.values:
            raise t.TraitError(f"{name} is {value!r}; allowed is one of {', '.join(self.values)}")
        return value


class Sequence(t.List[Any]):
    """List of numbers or words, also from an array of NumPy."""

    _cast_types = (Iterable,)

    def __init__(self, trait: Union[Number, Word]) -> None:
        super().__init__(trait, None, allow_none=True)

    def validate_elements(self, obj: Any, value: Any) -> Any:
        return [self._trait.part(f"{self.name}[{i}]", each) for i, each in enumerate(value)]


class Group(t.Dict):  # type: ignore[type-arg]
    """Numbers by name; a figure takes all of them."""

    def __init__(self, **parts: Number) -> None:
        super().__init__(default_value=None, allow_none=True)
        self.parts = parts

    def validate_elements(self, obj: Any, value: Mapping[str, Any]) -> dict[str, float]:
        if set(value) != set(self.parts):
            raise t.TraitError(f"{self.name} has {', '.join(map(repr, value)) or 'nothing'}; it needs {', '.join(map(repr, self.parts))}")
        return {name: part.part(f"{self.name}[{name!r}]", value[name]) for name, part in self.parts.items()}
