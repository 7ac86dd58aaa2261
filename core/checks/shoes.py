"""The rule on shoes: those of two feet never overlap, at the knots and on the way between waypoints."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from core.arrays import Floats, first_lowest
from core.checks.checked_plan import CheckedPlan, knot_place
from core.findings import TOLERANCE, Finding, Outcome, RuleMargin, Severity, found
from core.robot.kinematics import feet_in_robot
from core.robot.model import RobotModel
from core.robot.shoes import SHOE_GAP, foot_distances, foot_pairs
from core.wire.executed_path import along_moves
from core.wire.waypoints import Waypoints

MOVE_APART = "Shorten the step, or move the footholds apart."
MERGE_LESS = "Merge less: at the samples themselves these feet are further apart."


@dataclass(frozen=True)
class _Nearest:
    """Where two feet come nearest to each other.

    Args:
        distance: of their middles over the ground, m.
        where: in words.
        place: sample and time of the finding.
        remedy: the way out.
    """

    distance: float
    where: str
    place: dict[str, Any]
    remedy: str


def check_shoes(plan: CheckedPlan) -> list[Outcome]:
    """No two shoes overlap; nothing for a robot without shoes.

    A pair of feet is judged at every knot of the plan and along every move between the waypoints that are
    sent, and its finding is where it comes nearest.
    """
    diameter = plan.model.shoe_diameter
    if diameter is None:
        return []
    if plan.model.is_coupled:
        return check_shoes_of_waypoints(plan.model, plan.waypoints)
    knots = foot_distances(plan.trajectory.feet_world)
    moves, on_way = _distances_on_way(plan.model, plan.waypoints)
    nearest = []
    for pair in range(knots.shape[1]):
        sample = int(first_lowest(knots[:, pair]))
        at_knot = float(knots[sample, pair])
        worst = int(first_lowest(on_way[:, pair]))
        if float(on_way[worst, pair]) >= at_knot - TOLERANCE:
            place = knot_place(plan, sample)
            where = f"At sample {sample + 1} ({place['time']:.1f} s)"
            nearest.append(_Nearest(at_knot, where, place, MOVE_APART))
            continue
        is_broken = at_knot < diameter + SHOE_GAP - TOLERANCE
        remedy = MOVE_APART if is_broken or plan.way is None or not plan.way.merge else MERGE_LESS
        move = int(moves[worst])
        place = knot_place(plan, move if plan.way is None else plan.way.kept[move])
        nearest.append(_Nearest(float(on_way[worst, pair]), _move_words(move), place, remedy))
    return [_outcome(plan.model, diameter, nearest)]


def check_shoes_of_waypoints(model: RobotModel, waypoints: Waypoints) -> list[Outcome]:
    """The same by forward kinematics of strokes alone; nothing for a robot without shoes."""
    diameter = model.shoe_diameter
    if diameter is None:
        return []
    moves, on_way = _distances_on_way(model, waypoints)
    nearest = []
    for pair in range(on_way.shape[1]):
        worst = int(first_lowest(on_way[:, pair]))
        move = int(moves[worst])
        place = {"sample": move}
        nearest.append(_Nearest(float(on_way[worst, pair]), _move_words(move), place, MOVE_APART))
    return [_outcome(model, diameter, nearest)]


def _distances_on_way(model: RobotModel, waypoints: Waypoints) -> tuple[NDArray[np.int64], Floats]:
    """(m,) waypoint to which the robot is under way, 0 at the first, and (m, pairs) distances there, m."""
    moves, ways = along_moves(waypoints.strokes)
    distances = foot_distances(feet_in_robot(model, ways))
    return moves, np.where(np.isfinite(distances), distances, np.inf)


def _move_words(move: int) -> str:
    return f"Between waypoints {move} and {move + 1}" if move else "At waypoint 1"


def _outcome(model: RobotModel, diameter: float, nearest: list[_Nearest]) -> Outcome:
    smallest = min(one.distance for one in nearest)
    known = smallest - diameter if np.isfinite(smallest) else None
    findings = [
        _finding(diameter, feet, one)
        for feet, one in zip(foot_pairs(model.leg_count).tolist(), nearest, strict=True)
        if one.distance < diameter + SHOE_GAP - TOLERANCE
    ]
    return Outcome(RuleMargin("shoe_distance", known, "m"), tuple(findings))


def _finding(diameter: float, feet: list[int], nearest: _Nearest) -> Finding:
    overlaps = nearest.distance < diameter - TOLERANCE
    names = f"feet {feet[0] + 1} and {feet[1] + 1}"
    apart = f"their middles are {nearest.distance * 1000:.1f} mm apart"
    if overlaps:
        words = (
            f"{nearest.where} the shoes of {names} overlap: {apart}, and a shoe is {diameter * 1000:.1f} mm "
            "across."
        )
        severity, limit = Severity.ERROR, diameter
    else:
        words = (
            f"{nearest.where} the shoes of {names} come within {SHOE_GAP * 1000:.0f} mm of each other: "
            f"{apart}, and a shoe is {diameter * 1000:.1f} mm across."
        )
        severity, limit = Severity.WARNING, diameter + SHOE_GAP
    return found(
        "shoe_distance",
        severity,
        words,
        nearest.remedy,
        nearest.distance,
        limit,
        foot=feet[0],
        **nearest.place,
    )
