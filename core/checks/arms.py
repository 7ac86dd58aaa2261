"""The rule on arms: those of neighbouring legs keep clear of each other, at waypoints and between them.

It warns, and there is no error: by the same drawing the published walk of 25 mm has arms 0.7 mm in one
another, and it went on the real robot, whose arms are soft.
"""

import numpy as np
from numpy.typing import NDArray

from core.arrays import SAME, Floats, first_lowest
from core.checks.checked_plan import CheckedPlan, knot_place
from core.findings import TOLERANCE, Finding, Outcome, RuleMargin, Severity, found
from core.robot.arms import ARM_GAP, arm_gaps
from core.robot.leg import foot_from_strokes
from core.robot.model import RobotModel
from core.robot.shoes import neighbour_pairs
from core.wire.executed_path import STEPS
from core.wire.waypoints import Waypoints

BEND = 1.2
"""How much longer than straight the way of a bar's end is taken to be at most."""
REMEDY = "Shorten the step, or keep these feet further apart."


def check_arms(plan: CheckedPlan) -> list[Outcome]:
    """The arms of neighbouring legs keep clear; nothing where motors share actuators."""
    if plan.model.is_coupled:
        return []
    kept = range(plan.waypoints.count) if plan.way is None else plan.way.kept
    gaps, moves = _least_gaps(plan.model, plan.waypoints.strokes)
    places = [knot_place(plan, kept[move]) for move in moves.tolist()]
    return [_outcome(plan.model, gaps, moves, places)]


def check_arms_of_waypoints(model: RobotModel, waypoints: Waypoints) -> list[Outcome]:
    """The same of strokes alone."""
    if model.is_coupled:
        return []
    gaps, moves = _least_gaps(model, waypoints.strokes)
    return [_outcome(model, gaps, moves, [{"sample": move} for move in moves.tolist()])]


def least_arm_gap(model: RobotModel, waypoints: Waypoints) -> tuple[tuple[int, int], float] | None:
    """The two neighbouring legs whose arms come nearest to each other, 0-based, and the room between them, m.

    Args:
        model: the robot.
        waypoints: what would be sent; what lies between them counts too.

    Returns:
        None where motors share actuators, or where no arm can be placed.
    """
    if model.is_coupled:
        return None
    gaps, _ = _least_gaps(model, waypoints.strokes)
    nearest = int(first_lowest(gaps))
    if not np.isfinite(gaps[nearest]):
        return None
    first, second = sorted(neighbour_pairs(model.leg_count)[nearest].tolist())
    return (first, second), float(gaps[nearest])


def _least_gaps(model: RobotModel, strokes: Floats) -> tuple[Floats, NDArray[np.int64]]:
    """Least room of each pair of neighbours, m, and the waypoint to which the robot is under way there.

    Between two waypoints a pair is followed only where its bars move far enough to come within `ARM_GAP`.
    """
    at = np.nan_to_num(arm_gaps(model, strokes), nan=np.inf)
    least, moves = at.min(axis=0), first_lowest(at, axis=0)
    feet = foot_from_strokes(model.leg, strokes)
    ways = np.linalg.norm(np.diff(feet, axis=0), axis=-1)
    ways = np.maximum(np.nan_to_num(ways), np.abs(np.diff(strokes, axis=0)).max(axis=-1))
    first, second = neighbour_pairs(model.leg_count).T
    reach = BEND * (ways[:, first] + ways[:, second]) / 2
    doubtful = np.nonzero((np.minimum(at[1:], at[:-1]) - reach < ARM_GAP).any(axis=1))[0]
    for share in np.arange(1, STEPS) / STEPS:
        between = strokes[doubtful] + share * (strokes[doubtful + 1] - strokes[doubtful])
        if len(between):
            gaps = np.nan_to_num(arm_gaps(model, between), nan=np.inf)
            place = first_lowest(gaps, axis=0)
            lowest = gaps.min(axis=0)
            moves = np.where(lowest < least - SAME, doubtful[place] + 1, moves)
            least = np.minimum(least, lowest)
    return least, moves.astype(np.int64)


def _outcome(
    model: RobotModel, gaps: Floats, moves: NDArray[np.int64], places: list[dict[str, int | float]]
) -> Outcome:
    smallest = float(gaps.min())
    pairs = neighbour_pairs(model.leg_count).tolist()
    findings = [
        _finding(sorted(legs), float(gap), int(move), place)
        for legs, gap, move, place in zip(pairs, gaps, moves, places, strict=True)
        if gap < ARM_GAP - TOLERANCE
    ]
    margin = RuleMargin("arm_distance", smallest if np.isfinite(smallest) else None, "m")
    return Outcome(margin, tuple(findings))


def _finding(legs: list[int], gap: float, move: int, place: dict[str, int | float]) -> Finding:
    names = f"legs {legs[0] + 1} and {legs[1] + 1}"
    where = f"On the way to waypoint {move + 1}" if move else "At waypoint 1"
    if gap < -TOLERANCE:
        words = (
            f"{where} the arms of {names} touch: drawn as stiff bars, they are {-gap * 1000:.1f} mm in one "
            "another."
        )
    else:
        words = (
            f"{where} the arms of {names} come within {gap * 1000:.1f} mm of each other, less than "
            f"{ARM_GAP * 1000:g} mm."
        )
    return found("arm_distance", Severity.WARNING, words, REMEDY, gap, ARM_GAP, foot=legs[0], **place)
