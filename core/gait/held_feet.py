"""Feet that are held up on purpose at the first or the last sample of a gait."""

from __future__ import annotations

from dataclasses import dataclass

from core.errors import InputError

LEAST_HEIGHT = 0.003
"""Feet are held at least this high, m: lower ones touch uneven ground."""


@dataclass(frozen=True)
class HeldFeet:
    """Which feet rest in the air at the ends of a gait, counted from 1.

    A held foot is under its module, as high as swings rise (`held_height`), and moves with the body. Held at
    both ends with a row that is all swing, its limb takes no steps at all.

    Args:
        start: feet held up at the first sample.
        end: feet held up at the last sample.
    """

    start: tuple[int, ...] = ()
    end: tuple[int, ...] = ()

    def __post_init__(self) -> None:
        for name in ("start", "end"):
            feet = tuple(sorted(getattr(self, name)))
            if len(set(feet)) < len(feet):
                raise InputError(f"held.{name} is {list(feet)}; it must name each foot once.", f"held.{name}")
            object.__setattr__(self, name, feet)

    @property
    def any(self) -> bool:
        """Whether a foot is held at all."""
        return bool(self.start or self.end)

    @property
    def both(self) -> tuple[int, ...]:
        """Feet held at both ends."""
        return tuple(foot for foot in self.start if foot in self.end)

    def turned(self, shift: int, legs: int) -> HeldFeet:
        """The same for feet that are handed on by so many places of a ring."""
        start, end = (tuple((f - 1 + shift) % legs + 1 for f in feet) for feet in (self.start, self.end))
        return HeldFeet(start, end)


def held_height(clearance: float) -> float:
    """How high feet are held where swings rise by a clearance, m."""
    return max(clearance, LEAST_HEIGHT)


def feet_words(feet: tuple[int, ...]) -> str:
    """Feet counted from 1, such as `feet 2, 3 and 5`."""
    *others, last = map(str, feet)
    return f"feet {', '.join(others)} and {last}" if others else f"foot {last}"


def held_sentence(held: HeldFeet) -> str:
    """Which feet are held, in a sentence; empty where none is."""
    both = held.both
    parts = [
        (both, "held up throughout"),
        (tuple(f for f in held.start if f not in both), "held up at the start"),
        (tuple(f for f in held.end if f not in both), "held up at the end"),
    ]
    words = [f"{feet_words(feet)} {'are' if len(feet) > 1 else 'is'} {what}" for feet, what in parts if feet]
    sentence = ", ".join(words)
    return f"{sentence[0].upper()}{sentence[1:]}." if sentence else ""
