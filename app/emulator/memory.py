"""The emulated robot's memory for waypoints: room for one, then other variables (firmware.md, hazard 7)."""

from collections.abc import Sequence
from dataclasses import dataclass

from core.wire.messages import MOTORS


@dataclass(frozen=True)
class Layout:
    """Where a compiler puts the variables, counted in single-precision numbers from the duration on.

    Read off the recordings of messages with three and seven waypoints; what lies between is never looked at.

    Args:
        strokes: the first waypoint's strokes; those of the others are meant to follow.
        errors: errors of the last scan.
        readings: last readings; None if no recording reaches them.
        zeros: what is zero whenever it is looked at: the speeds of motors that stand, and what follows.
        survived: most waypoints of one message that the program survives.
    """

    strokes: int
    errors: int
    readings: int | None
    zeros: range
    survived: int


ARM = Layout(strokes=1, errors=13, readings=25, zeros=range(37, 73), survived=6)
"""The board's processor: nothing between the variables."""

X86 = Layout(strokes=2, errors=18, readings=None, zeros=range(0), survived=9)
"""A personal computer, on which the sketch was recorded too: variables begin at multiples of 32 bytes."""


class Memory:
    """Numbers one after the other, written and looked at without any bounds, as the sketch does.

    Args:
        layout: where the variables are.
    """

    def __init__(self, layout: Layout) -> None:
        self._layout = layout
        self._numbers: dict[int, float] = {}

    def store(self, index: int, duration: float, strokes_mm: Sequence[float]) -> None:
        """Writes a waypoint, the duration first."""
        self._numbers[index] = duration
        self._write(self._layout.strokes + MOTORS * index, strokes_mm)

    def note_error(self, motor: int, error_mm: float) -> None:
        """Writes the error of one motor."""
        self._numbers[self._layout.errors + motor] = error_mm

    def note_readings(self, readings_mm: Sequence[float]) -> None:
        """Writes the readings of all motors."""
        if self._layout.readings is not None:
            self._write(self._layout.readings, readings_mm)

    def wanted_mm(self, index: int) -> list[float]:
        """What is taken for the strokes of a waypoint."""
        start = self._layout.strokes + MOTORS * index
        return [self._number(at) for at in range(start, start + MOTORS)]

    def _write(self, start: int, numbers: Sequence[float]) -> None:
        self._numbers.update(enumerate(numbers, start))

    def _number(self, at: int) -> float:
        return 0.0 if at in self._layout.zeros else self._numbers.get(at, 0.0)
