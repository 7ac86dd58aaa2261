"""Sends a jog to the robot: one message for each move, each confirmed like a waypoint."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from app.bridge.states import JogProgress
from core.arrays import Floats
from core.errors import InputError, StateError
from core.wire.messages import encode_waypoint, strokes_to_mm
from core.wire.robot_time import ramp_time

MOVED_MM = 0.5
"""A motor that stands further from where a jog was worked out was moved since, mm; half of what the firmware
itself takes for arrived."""


@dataclass(frozen=True)
class JogPlan:
    """A jog that a person previewed and released.

    Args:
        text: what is moved, for a person.
        start: (legs, 3) measured strokes that it was worked out from, m.
        way: (legs, 3) strokes after each move, m.
    """

    text: str
    start: Floats
    way: Sequence[Floats]


@dataclass(frozen=True)
class JogMove:
    """One message of a jog and where it leads, mm."""

    message: bytes
    target_mm: tuple[float, ...]


class Jog:
    """The moves of a jog and its progress; every message is encoded before the first is sent.

    Args:
        plan: what a person let go.
        measured_mm: where the motors stand now.
        by: who does it.

    Raises:
        InputError: there is no move, or a stroke cannot be sent.
        StateError: a motor stands elsewhere than where the jog was worked out.
    """

    def __init__(self, plan: JogPlan, measured_mm: tuple[float, ...], by: str) -> None:
        if not plan.way:
            raise InputError("A jog without a step moves nothing. Choose a step.", "steps")
        _require_in_place(plan.start.reshape(-1) * 1000.0, measured_mm)
        self._plan = plan
        self._by = by
        self._sent = 0
        self._reached = 0
        distances = np.abs(np.diff([plan.start, *plan.way], axis=0)).max(axis=(1, 2))
        self._largest = float(distances.max())
        self._moves = [
            JogMove(encode_waypoint(strokes, ramp_time(float(distance))), strokes_to_mm(strokes))
            for strokes, distance in zip(plan.way, distances, strict=True)
        ]

    @property
    def finished(self) -> bool:
        """Whether the last move was reached."""
        return self._reached == len(self._moves)

    @property
    def end_words(self) -> str:
        """The sentence at its end."""
        planned, made = len(self._plan.way), len(self._moves)
        return "Jog done." if made == planned else f"Jog ended early, after {made} of {planned} moves."

    @property
    def place(self) -> str:
        """Where it is, for a person."""
        return f"in move {self._sent} of {len(self._moves)} of a jog of {self._plan.text}"

    def next_move(self) -> JogMove:
        """Returns the next move and counts it as sent."""
        move = self._moves[self._sent]
        self._sent += 1
        return move

    def arrive(self) -> None:
        """Counts the move in flight as reached."""
        self._reached += 1

    def end_early(self) -> None:
        """Leaves out the moves that were not sent."""
        del self._moves[self._sent :]

    def progress(self) -> JogProgress:
        """The state of the jog, for display."""
        return JogProgress(self._plan.text, self._by, self._reached, len(self._moves), self._largest)


def _require_in_place(start_mm: Floats, measured_mm: tuple[float, ...]) -> None:
    away = float(np.abs(start_mm - np.array(measured_mm)).max())
    if away > MOVED_MM:
        raise StateError(
            f"A motor stands {away:.2f} mm from where it stood when this jog was planned (limit "
            f"{MOVED_MM:.2f} mm). "
            "Look at the target again, then move.",
            "steps",
        )
