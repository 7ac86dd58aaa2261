"""What may vary in a space of gaits: each key with its bounds, and how its values are written."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

from core.errors import InputError
from core.pose_gaits.pose_problem import MOST_TURN, POSE_BOUNDS
from core.problem.motion_problem import PLANE_HEIGHTS
from core.text.documents import as_written
from core.text.numbers import plain_whole, shortened

CHOICES = "choices"
MOST_CHOICES = 1_000
"""Choices of a key."""
FINEST = 1e-6
"""Least size of a step in m, or of a turn in rad, that is not 0."""
MOST_MOVES = 2
"""Into so many parts each move is divided at most."""
ROBOT = "robot."
"""How keys for numbers of the robot begin."""


@dataclass(frozen=True)
class Axis:
    """What one key takes: any number of a range, or one of some choices.

    Args:
        low: least number of a range; None for choices.
        high: largest number of a range.
        choices: values; empty for a range.
    """

    low: float | None = None
    high: float = 0.0
    choices: tuple[Any, ...] = ()

    @property
    def varies(self) -> bool:
        """Whether there is more than one value."""
        return self.low is not None or len(self.choices) > 1

    @property
    def ends(self) -> tuple[Any, ...]:
        """The least and the largest number of a range or of choices."""
        return (min(self.choices), max(self.choices)) if self.low is None else (self.low, self.high)

    def value(self, place: float) -> Any:
        """The value at a place from 0 up to, not including, 1."""
        if self.low is not None:
            return self.low + place * (self.high - self.low)
        return self.choices[min(int(place * len(self.choices)), len(self.choices) - 1)]

    def content(self) -> Any:
        """As JSON content."""
        return [self.low, self.high] if self.low is not None else {CHOICES: list(self.choices)}


@dataclass(frozen=True)
class Key:
    """A key of `[vary]`.

    Args:
        name: of the key.
        read: one value as it is written; raises ValueError or TypeError.
        words: what a value has to be, for a sentence.
        is_number: whether it may be a range.
        least: smallest number.
        most: largest number.
        finest: least size of a number that is not 0.
    """

    name: str
    read: Callable[[Any], Any]
    words: str
    is_number: bool = False
    least: float = -math.inf
    most: float = math.inf
    finest: float = 0.0

    def axis(self, written: Any) -> Axis:
        """The axis of what a file has for this key.

        Two numbers are a range, other lists are choices. Two choices of a number are written as
        `{choices = [0.001, 0.002]}`, and one value by itself.

        Raises:
            InputError: it is empty, or a value does not fit.
        """
        values = written.get(CHOICES) if isinstance(written, Mapping) else written
        is_range = self.is_number and not isinstance(written, Mapping) and _is_pair(values)
        if isinstance(written, Mapping) and set(written) != {CHOICES}:
            keys = shortened(", ".join(map(str, written))) or "an empty table"
            raise InputError(
                f"{self.name} has {keys}. Write a range of two numbers, or {{choices = [A, B]}}.", self.name
            )
        listed = list(values) if isinstance(values, Sequence) and not isinstance(values, str) else [values]
        if not listed:
            raise InputError(
                f"{self.name} has no value. Write a range of two numbers, or a list of choices.", self.name
            )
        if len(listed) > MOST_CHOICES:
            raise InputError(
                f"{self.name} has {len(listed):,} choices; at most {MOST_CHOICES:,} are taken. Write "
                f"{'a range of two numbers' if self.is_number else 'fewer'}.",
                self.name,
            )
        if is_range:
            low, high = (self._value(value) for value in listed)
            if not low < high:
                raise InputError(
                    f"The range of {self.name} is empty: {low:g} to {high:g}. Write the smaller number "
                    f"first, or {{choices = [{low:g}, {high:g}]}} for two choices.",
                    self.name,
                )
            return Axis(low, high)
        return Axis(choices=tuple(dict.fromkeys(self._value(value) for value in listed)))

    def _value(self, written: Any) -> Any:
        try:
            value = self.read(written)
        except (OverflowError, TypeError, ValueError) as error:
            raise self._refusal(written) from error
        if self.is_number and not self.least <= value <= self.most:
            raise InputError(
                f"{self.name} is {value:g}; it must lie between {self.least:.4g} and {self.most:.4g}.",
                self.name,
            )
        if self.is_number and 0.0 < abs(value) < self.finest:
            raise InputError(
                f"{self.name} is {value:g}; it must be 0, or at least {self.finest:g} in size.", self.name
            )
        return value

    def _refusal(self, written: Any) -> InputError:
        return InputError(f"{self.name} is {as_written(written)}; it must be {self.words}.", self.name)


def _is_pair(values: Any) -> bool:
    return isinstance(values, Sequence) and not isinstance(values, str) and len(values) == 2


def _number(written: Any) -> float:
    if isinstance(written, bool) or not isinstance(written, int | float) or not math.isfinite(written):
        raise TypeError(type(written))
    return float(written)


def _whole(written: Any) -> int:
    if isinstance(written, bool) or not isinstance(written, int):
        raise ValueError(written)
    return written


def _truth(written: Any) -> bool:
    if not isinstance(written, bool):
        raise ValueError(written)
    return written


def _feet(written: Any) -> tuple[int, ...]:
    """Feet as "3,2,4,1", as a list, or a foot by itself; "" for none."""
    if isinstance(written, int):
        return (_whole(written),)
    parts = [part for part in written.split(",") if part.strip()] if isinstance(written, str) else written
    return tuple(_whole(plain_whole(part) if isinstance(part, str) else part) for part in parts)


def _order(written: Any) -> tuple[int, ...] | str:
    return "all" if written == "all" else _feet(written)


def _parts(written: Any) -> int:
    if not 1 <= _whole(written) <= MOST_MOVES:
        raise ValueError(written)
    return int(written)


def _limits(name: str) -> tuple[float, float]:
    return POSE_BOUNDS[name]


def _number_key(name: str, unit: str, least: float, most: float, finest: float = 0.0) -> Key:
    return Key(name, _number, f"a number of {unit}", True, least, most, finest)


KEYS: Mapping[str, Key] = MappingProxyType(
    {
        key.name: key
        for key in (
            Key("order", _order, 'a foot order such as "3,2,4,1", or "all"'),
            Key("overlap", _truth, "true or false"),
            Key("moves", _parts, "1, or 2 where each move is divided"),
            _number_key("step_x", "m", -0.2, 0.2, FINEST),
            _number_key("step_y", "m", -0.2, 0.2, FINEST),
            _number_key("turn", "rad", -MOST_TURN, MOST_TURN, FINEST),
            _number_key("height", "m", *PLANE_HEIGHTS),
            _number_key("clearance", "m", *_limits("clearance")),
            _number_key("margin", "m", *_limits("margin")),
            _number_key("stop_bound", "s", *_limits("stop_bound")),
            Key("lost", _feet, 'limbs such as "2" or "2,5", or "" for none'),
        )
    }
)
"""Every key that may vary, but for the robot's numbers, in the order of the draw."""


def robot_key(name: str) -> Key:
    """The key of a number of the robot's parameters file, such as `robot.leg.link_length`."""
    return Key(name, _number, "a number, in the units of the robot's parameters file", True)
