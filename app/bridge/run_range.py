"""The range of approved waypoints that a run sends: its first pose, and how often it repeats."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from core.errors import InputError
from core.wire.messages import THRESHOLD_MM, name_motor
from core.wire.waypoints import Waypoints

MOST_ITERATIONS = 100
"""Iterations of one run."""


@dataclass(frozen=True)
class RunRange:
    """A run's choice among the approved waypoints.

    Args:
        first: waypoint to begin with, 0-based; the later iterations begin at the first of all.
        iterations: how many times the last waypoint is reached.
    """

    first: int = 0
    iterations: int = 1

    def order(self, count: int) -> tuple[int, ...]:
        """Waypoints in the order in which they are sent, 0-based.

        Args:
            count: number of approved waypoints.
        """
        return (*range(self.first, count), *list(range(count)) * (self.iterations - 1))

    def require_fit(self, waypoints: Waypoints, hold_ok: Sequence[bool]) -> None:
        """Refuses a beginning with a foot in the air, and repeating what does not end as it begins.

        Args:
            waypoints: the approved ones.
            hold_ok: for each whether all feet are down there.

        Raises:
            InputError: the sentence says what would do.
        """
        if not 0 <= self.first < waypoints.count:
            raise InputError(
                f"There is no waypoint {self.first + 1}; there are {waypoints.count}. Choose one of them.",
                "from",
            )
        if self.first > 0 and not hold_ok[self.first]:
            raise InputError(_feet_up(self.first, hold_ok), "from")
        if not 1 <= self.iterations <= MOST_ITERATIONS:
            raise InputError(
                f"{self.iterations} iterations cannot be sent; choose 1 to {MOST_ITERATIONS}.", "iterations"
            )
        if self.iterations > 1 and (reason := why_not_repeated(waypoints)) is not None:
            raise InputError(reason, "iterations")


WHOLE = RunRange()
"""Every waypoint once."""


def why_not_repeated(waypoints: Waypoints) -> str | None:
    """Why a gait cannot be repeated, or None if its motors end where they began.

    Strokes are those of the robot's own frame, so the way that the body went does not count.

    Args:
        waypoints: the approved ones.
    """
    apart_mm = np.abs(waypoints.strokes_mm[-1] - waypoints.strokes_mm[0])
    motor = int(apart_mm.argmax())
    if apart_mm[motor] <= THRESHOLD_MM:
        return None
    return (
        f"The gait does not end as it begins: {name_motor(motor)} ends {apart_mm[motor]:.2f} mm from its "
        f"start (limit {THRESHOLD_MM:.2f} mm). Run it once, or let the gait end in its first pose."
    )


def beginnings(hold_ok: Sequence[bool]) -> list[int]:
    """Waypoints from which a run may begin, 0-based: the first, and those with all feet down.

    Args:
        hold_ok: for each whether all feet are down there.
    """
    return [i for i, down in enumerate(hold_ok) if down or i == 0]


def _feet_up(first: int, hold_ok: Sequence[bool]) -> str:
    places = beginnings(hold_ok)
    near = {max(i for i in places if i < first), *(i for i in places if i > first)}
    nearest = sorted(near)[:2]
    named = " or ".join(str(i + 1) for i in nearest)
    return (
        f"At waypoint {first + 1} a foot is in the air, so a run cannot begin there. "
        f"Begin at waypoint {named}, the nearest with all feet down."
    )
