"""The Pareto front of gaits over speed, stability margin and stop bound."""

from collections.abc import Sequence
from dataclasses import dataclass

from core.pose_gaits.pace import pace_rank

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

    @property
    def goods(self) -> tuple[float, float, float]:
        """Objectives; larger is better."""
        return self.margin, -self.stop_bound, -pace_rank(self.pace)

    def dominates(self, other: "FrontPoint") -> bool:
        """Whether it is at least as good in everything, and better in something."""
        mine, theirs = self.goods, other.goods
        return mine != theirs and all(a >= b for a, b in zip(mine, theirs, strict=True))


def front(points: Sequence[FrontPoint]) -> list[int]:
    """Places of the points that no other one dominates, the fastest first."""
    goods = [point.goods for point in points]
    best = [
        place
        for place, point in enumerate(points)
        if not any(other.dominates(point) for other in points) and goods[place] not in goods[:place]
    ]
    return sorted(best, key=lambda place: pace_rank(points[place].pace))
