"""Shapes of stored values, by which damage is told from content."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from core.arrays import FARTHEST
from core.text.documents import json_content

LAST_MOMENT = 253_402_300_799.0
"""The end of the year 9999, s since the epoch: the last time that a date can be made of."""
LARGEST = 2**53
"""A larger whole number is no count."""


class ShapeError(ValueError):
    """A value that has not its shape.

    Args:
        place: path of keys to the value; empty for the whole.
        fault: the rest of a sentence that begins with the place.
    """

    def __init__(self, place: str, fault: str) -> None:
        super().__init__(f"{place or 'it'} {fault}")
        self.place, self.fault = place, fault


Shape = Callable[[Any, str], Any]
"""Gives back the value at a place as it is used; raises `ShapeError` where the value has another shape."""


def text(value: Any, place: str) -> str:
    """A text without a NUL or half a character."""
    if not isinstance(value, str):
        raise ShapeError(place, "is no text")
    if "\0" in value or any("\ud800" <= sign <= "\udfff" for sign in value):
        raise ShapeError(place, "is a text that was damaged")
    return value


def text_or_nothing(value: Any, place: str) -> str:
    """A text that nothing depends on; nothing where it is none."""
    try:
        return text(value, place)
    except ShapeError:
        return ""


def truth(value: Any, place: str) -> bool:
    """True or false."""
    if not isinstance(value, bool):
        raise ShapeError(place, "is neither true nor false")
    return value


def data(value: Any, place: str) -> bytes:
    """Bytes."""
    if not isinstance(value, bytes):
        raise ShapeError(place, "has no bytes")
    return value


def anything(value: Any, place: str) -> Any:
    """Any value."""
    del place
    return value


@dataclass(frozen=True)
class Number:
    """A finite number.

    Args:
        least: smallest value.
        most: largest value.
        is_whole: whether it is a whole number.
    """

    least: float = -math.inf
    most: float = math.inf
    is_whole: bool = False

    def __call__(self, value: Any, place: str) -> float | int:
        """The number."""
        kinds = int if self.is_whole else int | float
        if isinstance(value, bool) or not isinstance(value, kinds):
            raise ShapeError(place, "is no whole number" if self.is_whole else "is no number")
        if not math.isfinite(value) if isinstance(value, float) else abs(value) > LARGEST:
            raise ShapeError(place, "is no finite number")
        if not self.least <= value <= self.most:
            bound = f"below {self.least:g}" if value < self.least else f"above {self.most:g}"
            raise ShapeError(place, f"is {bound}")
        return value


NUMBER = Number()
POSITIVE = Number(least=1e-9)
COUNT = Number(least=0, is_whole=True)
WHOLE = Number(is_whole=True)
MOMENT = Number(0.0, LAST_MOMENT)
"""A time, s since the epoch."""


@dataclass(frozen=True)
class OneOf:
    """One of some texts."""

    texts: tuple[str, ...]

    def __call__(self, value: Any, place: str) -> str:
        """The text."""
        if value not in self.texts:
            raise ShapeError(place, f"is none of {', '.join(self.texts)}")
        return text(value, place)


@dataclass(frozen=True)
class Maybe:
    """A value that may be None; a key that may be missing."""

    shape: Shape

    def __call__(self, value: Any, place: str) -> Any:
        """The value, or None."""
        return None if value is None else self.shape(value, place)


@dataclass(frozen=True)
class ListOf:
    """A list of equal shapes.

    Args:
        shape: of each entry.
        length: of the list; None for any.
    """

    shape: Shape
    length: int | None = None

    def __call__(self, value: Any, place: str) -> list[Any]:
        """The list."""
        if not isinstance(value, list):
            raise ShapeError(place, "is no list")
        if self.length is not None and len(value) != self.length:
            raise ShapeError(place, f"has {len(value)} entries, not {self.length}")
        return [self.shape(entry, f"{place}[{at}]") for at, entry in enumerate(value)]


@dataclass(frozen=True)
class Numbers:
    """Nested lists of finite numbers as they come from an array.

    Args:
        depth: how many levels of lists.
        ending: lengths of the innermost lists, of which there is at least one and whose numbers are at most
            `FARTHEST`; empty for any.
    """

    depth: int
    ending: tuple[int, ...] = ()

    def __call__(self, value: Any, place: str) -> list[Any]:
        """The lists."""
        if not isinstance(value, list):
            raise ShapeError(place, "is no list")
        try:
            array = np.array(value)
        except (ValueError, OverflowError):
            raise ShapeError(place, "has lists that differ in length") from None
        if value and (array.ndim != self.depth or array.dtype.kind not in "biuf"):
            raise ShapeError(place, "has other values than numbers")
        if not np.isfinite(array.astype(np.float64)).all():
            raise ShapeError(place, "has numbers that are not finite")
        if self.ending:
            if not value or array.shape[-len(self.ending) :] != self.ending:
                raise ShapeError(place, f"has no lists of {' times '.join(map(str, self.ending))} numbers")
            if np.abs(array).max() > FARTHEST:
                raise ShapeError(place, f"has numbers beyond {FARTHEST:g}")
        return value


@dataclass(frozen=True)
class Mapped:
    """Texts to values of one shape."""

    shape: Shape = anything

    def __call__(self, value: Any, place: str) -> dict[str, Any]:
        """The object."""
        if not isinstance(value, dict):
            raise ShapeError(place, "is no object")
        return {key: self.shape(entry, _under(place, key)) for key, entry in value.items()}


@dataclass(frozen=True)
class Fields:
    """An object with known keys; it may have others, which stay.

    Args:
        shapes: of the values, by key. Where one is a `Maybe`, its key may be missing.
    """

    shapes: Mapping[str, Shape] = field(default_factory=dict)

    def __call__(self, value: Any, place: str) -> dict[str, Any]:
        """The object."""
        if not isinstance(value, dict):
            raise ShapeError(place, "is no object")
        for key, shape in self.shapes.items():
            if key in value:
                shape(value[key], _under(place, key))
            elif not isinstance(shape, Maybe):
                raise ShapeError(_under(place, key), "is missing")
        return value


@dataclass(frozen=True)
class Stored:
    """JSON text of a value."""

    shape: Shape

    def __call__(self, value: Any, place: str) -> Any:
        """The value, read.

        Raises:
            InputError: the text is no JSON.
        """
        content = json_content(text(value, place), place)
        if "\\u" in value:
            _require_whole_texts(content, place)
        return self.shape(content, place)


def _require_whole_texts(content: Any, place: str) -> None:
    """Escapes of JSON can hold half a character, which no answer can carry."""
    if isinstance(content, dict):
        for key, entry in content.items():
            text(key, place)
            _require_whole_texts(entry, _under(place, key))
    elif isinstance(content, list):
        for entry in content:
            _require_whole_texts(entry, place)
    elif isinstance(content, str):
        text(content, place)


def _under(place: str, key: str) -> str:
    return f"{place}.{key}" if place else key
