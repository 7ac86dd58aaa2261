"""The result of one gait of an atlas, its figures, and the hash over many."""

import hashlib
import math
from collections.abc import Iterable
from dataclasses import dataclass
from enum import StrEnum

FIGURES = (
    "seconds",
    "speed",
    "turn_rate",
    "least_margin",
    "body_move",
    "stroke_use",
    "stop_seconds",
)
"""Figures of a row, in the order in which the hash takes them."""
DECIMALS = 6
"""Figures are rounded to so many decimals, SI."""
ACCURACY = 1e-4
"""Share of itself by which a figure may differ when its gait is searched again, as on another processor."""


class RowStatus(StrEnum):
    """What came of a gait."""

    SOLVED = "solved"
    """The independent checker confirms its motion."""
    INFEASIBLE = "infeasible"
    """No motion was found; this is the result of a search, not a proof."""
    FAILED = "failed"
    """A motion was found that the checker does not confirm, or the solver did not end."""


@dataclass(frozen=True)
class AtlasRow:
    """What came of one gait, SI; figures are nan where there is no motion.

    Args:
        number: of the gait in its space.
        status: what came of it.
        reason: the limits that prevent it, or what the checker does not confirm; "" where it is solved.
        seconds: robot seconds of a cycle in mid-walk, or of an iteration of a drawn gait.
        speed: travel a robot second, m/s.
        turn_rate: turn a robot second, rad/s.
        least_margin: least static stability margin, m; of a drawn gait the dynamic one.
        body_move: largest way of the body from one waypoint to the next, m.
        stroke_use: share of the motors' range that is used, 0 to 1.
        stop_seconds: longest time until a stop takes effect, s.
    """

    number: int
    status: RowStatus
    reason: str = ""
    seconds: float = math.nan
    speed: float = math.nan
    turn_rate: float = math.nan
    least_margin: float = math.nan
    body_move: float = math.nan
    stroke_use: float = math.nan
    stop_seconds: float = math.nan

    @property
    def figures(self) -> tuple[float, ...]:
        """Its figures, rounded, in the order of `FIGURES`."""
        return tuple(round(getattr(self, name), DECIMALS) + 0.0 for name in FIGURES)

    def agrees_with(self, other: "AtlasRow") -> bool:
        """Whether both have the same status, and figures as near as a search is accurate."""
        if self.status is not other.status:
            return False
        return all(
            (math.isnan(one) and math.isnan(two))
            or math.isclose(one, two, rel_tol=ACCURACY, abs_tol=1.5 * 10.0**-DECIMALS)
            for one, two in zip(self.figures, other.figures, strict=True)
        )


def results_hash(rows: Iterable[AtlasRow]) -> str:
    """SHA-256 over rows in the order of their numbers.

    Args:
        rows: in that order.
    """
    digest = hashlib.sha256()
    for row in rows:
        figures = ",".join(f"{value:.{DECIMALS}f}" for value in row.figures)
        digest.update(f"{row.number},{row.status.value},{figures}\n".encode())
    return digest.hexdigest()
