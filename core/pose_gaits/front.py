"""The Pareto front of gaits over speed, stability margin and stop bound."""

from collections.abc import Sequence
from dataclasses import dataclass

MARGINS = (0.003, 0.006, 0.008, 0.010)
"""Stability margins of a front, m."""
STOP_BOUNDS = (1.0, 1.2, 1.5, 2.0)
"""Stop bounds of a front, s."""


@dataclass(frozen=True)
class FrontPoint:
    """Speed, margin and stop bound of a gait.

    Args:
        margin: its stability margin, m.
        stop_bound: longest time until the robot hears a stop, s.
        pace: its speed, m/s, or on the spot its turn, rad/s.
    """

    margin: float
    stop_bound: float
    pace: float

    def dominates(self, other: "FrontPoint") -> bool:
        """Whether it is at least as good in everything, and better in something."""
        mine, theirs = (
            (self.margin, -self.stop_bound, self.pace),
            (other.margin, -other.stop_bound, other.pace),
        )
        return mine != theirs and all(a >= b for a, b in zip(mine, theirs, strict=True))


def front(points: Sequence[FrontPoint]) -> list[int]:
    """Places of the points that no other one dominates, the fastest first."""
    best = [
        place
        for place, point in enumerate(points)
        if not any(other.dominates(point) for other in points) and point not in points[:place]
    ]
    return sorted(best, key=lambda place: -points[place].pace)
