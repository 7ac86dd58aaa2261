"""Rules on balance: the ground point of the motion stays inside the support polygon."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from core.arrays import Bools, Floats, first_lowest, stretches
from core.checks.checked_plan import CheckedPlan
from core.findings import TOLERANCE, Outcome, RuleMargin, Severity, found
from core.motion.balance import BALANCE_RESERVE, STANDING_DEPTH, balance_margins
from core.motion.support_polygon import stability_margins
from core.robot.kinematics import feet_in_robot
from core.robot.model import RobotModel
from core.wire.waypoints import Waypoints

STROKE_BALANCE_SLACK = 0.0005
"""From strokes alone balance is known to this much, since which feet stand is itself a guess, m."""
KEEP_THREE = "Keep three feet down."


@dataclass(frozen=True)
class _GroundPoint:
    """The name of the point that balance is judged by, and how far outside the polygon it may be, m."""

    point: str
    slack: float


def check_balance(plan: CheckedPlan) -> Outcome:
    """The ground point stays inside the support polygon.

    It is the centre of pressure (docs/sources.md) where the velocities of a motion fit its positions, and
    otherwise the centre of mass (static stability margin).
    """
    t = plan.trajectory
    margins, what = balance_margins(plan.model, t)
    return _balance_outcome(margins, t.times, t.contact, _GroundPoint(what, TOLERANCE), plan.asked.margin)


def _balance_outcome(
    margins: Floats, times: Floats, contact: Bools, judged: _GroundPoint, asked: float = 0.0
) -> Outcome:
    """Findings on every stretch with too small a margin, and the smallest one.

    Args:
        margins: (n,) distance to the polygon's edge, m.
        times: (n,) s.
        contact: (n, legs) feet that stand.
        judged: the point's name, and how far outside it may be.
        asked: the margin that the document asks for, m.
    """
    reserve = max(BALANCE_RESERVE, asked)
    findings = []
    for first, last in _unbalanced_stretches(np.asarray(margins < reserve - TOLERANCE), contact):
        worst = first + int(first_lowest(margins[first : last + 1]))
        span = f"({times[first]:.1f} to {times[last]:.1f} s)"
        place = {"sample": worst, "time": float(times[worst])}
        if not np.isfinite(margins[worst]):
            words = f"At {times[worst]:.1f} s no foot stands {span}: the robot falls."
            findings.append(found("balance", Severity.ERROR, words, KEEP_THREE, None, 0.0, **place))
            continue
        value = float(margins[first : last + 1].min())
        tips = value < -judged.slack
        short = f"less than the {asked * 1000:.1f} mm that the gait asks for"
        outcome = (
            "the robot tips" if tips else short if value >= BALANCE_RESERVE else "there is hardly any reserve"
        )
        where, remedy = _support_words(value, [str(foot + 1) for foot in np.nonzero(contact[worst])[0]])
        words = f"At {times[worst]:.1f} s the {judged.point} is {where} {span}: {outcome}."
        severity, limit = (Severity.ERROR, 0.0) if tips else (Severity.WARNING, reserve)
        findings.append(found("balance", severity, words, remedy, value, limit, **place))
    smallest = float(margins.min())
    known = smallest if np.isfinite(smallest) else None
    return Outcome(RuleMargin("balance", known, "m"), tuple(findings))


def _unbalanced_stretches(low: Bools, contact: Bools) -> list[tuple[int, int]]:
    """Runs of too small a margin; while fewer than three feet stand, one for each set of standing feet."""
    few = contact.sum(axis=1) < 3
    others = (contact[1:] != contact[:-1]).any(axis=1)
    cuts = np.nonzero(others & (few[1:] | few[:-1]))[0] + 1
    starts = [0, *cuts.tolist()]
    pieces = zip(starts, np.split(low, cuts), strict=True)
    return [(start + first, start + last) for start, piece in pieces for first, last in stretches(piece)]


def _support_words(value: float, standing: Sequence[str]) -> tuple[str, str]:
    """Where a point is by the feet that stand, and what to do."""
    distance = f"{abs(value) * 1000:.2f} mm"
    if len(standing) == 1:
        return f"{distance} from foot {standing[0]}, which stands alone", KEEP_THREE
    if len(standing) == 2:
        words = f"{distance} from the line between feet {' and '.join(standing)}, which stand alone"
        return words, KEEP_THREE
    side = "outside" if value < -TOLERANCE else "inside"
    words = f"{distance} {side} the edge of the support polygon of feet {', '.join(standing)}"
    return words, "Shift the body before the step, or ask the optimiser for a stability margin."


def check_standing_balance(model: RobotModel, waypoints: Waypoints) -> Outcome:
    """The centre of mass over the deepest feet, of strokes alone by forward kinematics."""
    feet_robot = feet_in_robot(model, waypoints.strokes)
    height = feet_robot[..., 2] - feet_robot[..., 2].min(axis=1, keepdims=True)
    standing = np.asarray(height <= STANDING_DEPTH)
    margins = stability_margins(np.zeros((waypoints.count, 2)), feet_robot, standing)
    times = np.cumsum(waypoints.durations) - waypoints.durations[0]
    return _balance_outcome(margins, times, standing, _GroundPoint("centre of mass", STROKE_BALANCE_SLACK))
