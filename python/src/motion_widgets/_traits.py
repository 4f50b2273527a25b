"""Traits for the settings of a figure. ``None`` stands for the value that the figure opens with."""

from __future__ import annotations

import numbers
from collections.abc import Iterable, Mapping
from typing import Any, Optional, Union

import traitlets as t

RealNumber = Union[float, int]


class Number(t.Float[Optional[float], Optional[RealNumber]]):
    """Number in a range. Numbers of NumPy are accepted too."""

    def __init__(self, min: float, max: float) -> None:
        super().__init__(None, allow_none=True, min=min, max=max)  # type: ignore[misc]

    def validate(self, obj: Any, value: Any) -> float:
        return self.validate_part(self.name, value)

    def validate_part(self, name: str, value: Any) -> float:
        """Returns a valid value of this trait, or of a part of another trait whose name is ``name``."""
        is_number = isinstance(value, numbers.Real) and not isinstance(value, bool)
        if not is_number or not self.min <= value <= self.max:
            raise t.TraitError(f"{name} is {value!r}; allowed is a number from {self.min:.15g} to {self.max:.15g}")
        return float(value)


class Whole(t.Int[Optional[int], Optional[RealNumber]]):
    """Whole number in a range. The float 1e6 is accepted too."""

    def __init__(self, min: int, max: Optional[int] = None) -> None:
        super().__init__(None, allow_none=True, min=min, max=max)  # type: ignore[misc]

    def validate(self, obj: Any, value: Any) -> int:
        is_whole = isinstance(value, numbers.Real) and not isinstance(value, bool) and value % 1 == 0
        if not is_whole or value < self.min or (self.max is not None and value > self.max):
            upper_limit = "" if self.max is None else f" to {self.max}"
            raise t.TraitError(f"{self.name} is {value!r}; allowed is a whole number from {self.min}{upper_limit}")
        return int(value)


class Word(t.Enum[Optional[str]]):
    """One of several words. A word that consists of digits may be given as an integer."""

    def __init__(self, *words: str) -> None:
        super().__init__(words, None, allow_none=True)

    def validate(self, obj: Any, value: Any) -> str:
        return self.validate_part(self.name, str(value) if isinstance(value, int) else value)

    def validate_part(self, name: str, value: Any) -> str:
        """Returns a valid value of this trait, or of a part of another trait whose name is ``name``."""
        if value not in self.values:
            raise t.TraitError(f"{name} is {value!r}; allowed is one of {', '.join(self.values)}")
        return value


class Sequence(t.List[Any]):
    """List of numbers or words. Arrays of NumPy are accepted too."""

    _cast_types = (Iterable,)

    def __init__(self, trait: Union[Number, Word]) -> None:
        super().__init__(trait, None, allow_none=True)

    def validate_elements(self, obj: Any, value: Any) -> Any:
        return [self._trait.validate_part(f"{self.name}[{i}]", item) for i, item in enumerate(value)]


class Group(t.Dict):  # type: ignore[type-arg]
    """Dict of named numbers. All of the names are required."""

    def __init__(self, **parts: Number) -> None:
        super().__init__(default_value=None, allow_none=True)
        self.parts = parts

    def validate_elements(self, obj: Any, value: Mapping[str, Any]) -> dict[str, float]:
        if set(value) != set(self.parts):
            raise t.TraitError(f"{self.name} has {', '.join(map(repr, value)) or 'nothing'}; it needs {', '.join(map(repr, self.parts))}")
        return {name: part.validate_part(f"{self.name}[{name!r}]", value[name]) for name, part in self.parts.items()}
