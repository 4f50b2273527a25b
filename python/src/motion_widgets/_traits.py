"""Traits of a figure: each knows what is allowed, and says so where it refuses.

``None`` stands for what the figure opens with.
"""

from __future__ import annotations

import math
import numbers
from collections.abc import Iterable, Mapping
from typing import Any, Optional, TypeVar, Union

import traitlets as t

G = TypeVar("G")
S = TypeVar("S")
Real = Union[float, int]


def _printed(number: float) -> str:
    return str(int(number)) if number == int(number) else str(number)


class Setting(t.TraitType[G, S]):
    """Something that a figure shows and Python sets."""

    default_value: Any = None
    allow_none = True

    allowed = ""

    def __init__(self) -> None:
        super().__init__(allow_none=True)
        self.tag(sync=True)

    def validate(self, obj: Any, value: Any) -> Any:
        """Takes a value as the figure has it, or raises a TraitError that says what is allowed."""
        try:
            return self.taken(value)
        except (TypeError, ValueError, OverflowError):
            raise t.TraitError(f"{self.name} is {value!r}; allowed is {self.allowed}, or None") from None

    def taken(self, value: Any) -> Any:
        """The value as the figure has it; raises where it is none."""
        raise NotImplementedError


class Number(Setting[Optional[float], Optional[Real]]):
    """A finite number of a range."""

    def __init__(self, least: float, most: float) -> None:
        self.least, self.most = least, most
        self.allowed = f"a number from {_printed(least)} to {_printed(most)}"
        super().__init__()

    def taken(self, value: Any) -> float:
        if isinstance(value, bool) or not isinstance(value, numbers.Real):
            raise TypeError
        number = float(value)
        if not (math.isfinite(number) and self.least <= number <= self.most):
            raise ValueError
        return number


class Whole(Setting[Optional[int], Optional[Real]]):
    """A whole number of a range; 1e6 is one."""

    def __init__(self, least: int, most: Optional[int] = None) -> None:
        self.least, self.most = least, most
        self.allowed = f"a whole number from {least}" + ("" if most is None else f" to {most}")
        super().__init__()

    def taken(self, value: Any) -> int:
        if isinstance(value, bool) or not isinstance(value, numbers.Real):
            raise TypeError
        number = int(value)
        if number != value or number < self.least or (self.most is not None and number > self.most):
            raise ValueError
        return number


class Truth(Setting[Optional[bool], Optional[bool]]):
    """True or False."""

    allowed = "True or False"

    def taken(self, value: Any) -> bool:
        if value is True or value is False:
            return value
        raise TypeError


class Word(Setting[Optional[str], Union[str, int, None]]):
    """One of some words."""

    def __init__(self, *words: str) -> None:
        self.words = words
        self.allowed = " or ".join(repr(word) for word in words)
        super().__init__()

    def taken(self, value: Any) -> str:
        # The words of some are figures.
        word = str(value) if isinstance(value, int) else value
        if word not in self.words:
            raise ValueError
        return word


class Words(Setting[Optional[list[str]], Optional[Iterable[str]]]):
    """Some of some words."""

    def __init__(self, *words: str) -> None:
        self.words = words
        self.allowed = f"a list of {', '.join(repr(word) for word in words)}"
        super().__init__()

    def taken(self, value: Any) -> list[str]:
        words = value.split() if isinstance(value, str) else list(value)
        if any(word not in self.words for word in words):
            raise ValueError
        return [word for word in self.words if word in words]


class Text(Setting[Optional[str], Optional[str]]):
    """Any text."""

    allowed = "a text"

    def taken(self, value: Any) -> str:
        if isinstance(value, str):
            return value
        raise TypeError


class Numbers(Setting[Optional[list[float]], Optional[Iterable[Real]]]):
    """A list of numbers, each of a range; an array of NumPy is one. How many there are, the figure knows."""

    def __init__(self, least: float, most: float) -> None:
        self.each = Number(least, most)
        self.allowed = f"a list of numbers, each from {_printed(least)} to {_printed(most)}"
        super().__init__()

    def taken(self, value: Any) -> list[float]:
        if isinstance(value, (str, Mapping)):
            raise TypeError
        return [self.each.taken(number) for number in value]


class Group(Setting[Optional[dict[str, float]], Optional[Mapping[str, Real]]]):
    """Numbers by their names, all of them."""

    def __init__(self, fields: dict[str, Number]) -> None:
        self.fields = fields
        each = ", ".join(f"{name!r}: {field.allowed}" for name, field in fields.items())
        self.allowed = f"a dict of {each}"
        super().__init__()

    def taken(self, value: Any) -> dict[str, float]:
        if not isinstance(value, Mapping) or set(value) != set(self.fields):
            raise TypeError
        return {name: field.taken(value[name]) for name, field in self.fields.items()}


class Data(Setting[Optional[dict[str, Any]], Optional[Mapping[str, Any]]]):
    """Plain data of a form that the figure knows."""

    allowed = "a dict"

    def taken(self, value: Any) -> dict[str, Any]:
        if not isinstance(value, Mapping):
            raise TypeError
        return dict(value)
