"""Rules on the path that the robot really takes, and what merging and stop bound cost in robot seconds."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from core.arrays import Floats, first_highest, first_lowest, first_place, stretches
from core.findings import TOLERANCE, Outcome, RuleMargin, SendCost, Severity, found
from core.motion.trajectory import Trajectory
from core.robot.model import RobotModel
from core.wire.executed_path import ExecutedPath, executed_path
from core.wire.robot_time import ARRIVAL_THRESHOLD, estimate_seconds, stop_time
from core.wire.waypoint_merging import WaypointPlan, cut_plan, plan_of_knots

BALANCE_SLACK = 0.0001
"""How far the centre of mass may be outside the standing feet on the path, m; the ramps' own share."""
GROUND_LIMIT = ARRIVAL_THRESHOLD
"""How far a standing foot may leave the plane of the others on the path, and a swing sink into it, m."""
RISE_LIMIT = 0.001
"""A swing that rises less on the path drags, m."""
TIME_SLACK = 1e-9
"""Times this near are one, s."""
SMALLER = (0.75, 0.5, 0.25, 0.0)
"""Parts of a merging tolerance that are tried as a remedy."""
USUAL_MERGE = ARRIVAL_THRESHOLD
"""Tolerance that is shown for comparison where nothing is merged, m."""
BOUNDS = (None, 1.0, 0.8)
"""Stop bounds of the table, s."""
SLACK_NOTE = (
    "Between waypoints the motors move in proportion, and the path is judged so. Each motor may stop up to "
    f"{ARRIVAL_THRESHOLD * 1000:.1f} mm from its waypoint; these figures leave that out."
)


@dataclass(frozen=True)
class _Worst:
    """The worst place of a rule: how far it stays from the limit, the move, the foot, and what happens.

    `is_sure` where nothing that is near the ground could help.
    """

    margin: float
    move: int
    foot: int | None
    words: str
    is_sure: bool = False


_Rule = Callable[[ExecutedPath], _Worst | None]


def check_path(model: RobotModel, trajectory: Trajectory, plan: WaypointPlan) -> list[Outcome]:
    """Balance, grounded feet and swings on the path that is really taken.

    A path on which the robot tips whatever bears is an error, and so is what merging breaks, with the remedy.
    What else every knot sent would break as well is the motion's own and a warning: where feet hand over to
    one another within a move the body may lean on those that touch first.

    Args:
        model: the robot; one with coupled motors is judged by `core.checks.coupling` alone.
        trajectory: the plan.
        plan: what is sent of it.
    """
    if model.is_coupled or plan.waypoints.count < 2:
        return []
    path, every = executed_path(model, plan), executed_path(model, _replanned(model, trajectory, plan, 0.0))
    return [_outcome(name, rule, path, every, (model, trajectory, plan)) for name, rule in _RULES.items()]


def send_costs(model: RobotModel, trajectory: Trajectory, plan: WaypointPlan) -> tuple[SendCost, ...]:
    """Robot seconds with and without merging, for each stop bound of the table and the chosen one."""
    bounds = sorted({*BOUNDS, plan.stop_bound}, key=lambda bound: -np.inf if bound is None else -bound)
    merge = plan.merge or USUAL_MERGE
    whole = [plan_of_knots(model, trajectory, plan.knots, tolerance) for tolerance in (merge, 0.0)]
    rows = []
    for bound in bounds:
        merged, every = ((way if bound is None else cut_plan(way, bound)).waypoints for way in whole)
        rows.append(
            SendCost(
                stop_bound=bound,
                merge=merge,
                merged_waypoints=merged.count,
                merged_seconds=round(estimate_seconds(merged), 1),
                every_waypoints=every.count,
                every_seconds=round(estimate_seconds(every), 1),
                stop_seconds=round(stop_time(merged if plan.merge else every), 2),
                is_chosen=bound == plan.stop_bound,
            )
        )
    return tuple(rows)


def _replanned(model: RobotModel, trajectory: Trajectory, plan: WaypointPlan, merge: float) -> WaypointPlan:
    return plan_of_knots(model, trajectory, plan.knots, merge, plan.stop_bound if merge else None)


def _outcome(
    name: str,
    rule: _Rule,
    path: ExecutedPath,
    every: ExecutedPath,
    asked: tuple[RobotModel, Trajectory, WaypointPlan],
) -> Outcome:
    worst = rule(path)
    if worst is None:
        return Outcome(RuleMargin(name, None, "m"))
    margin = RuleMargin(name, worst.margin if np.isfinite(worst.margin) else None, "m")
    slack = BALANCE_SLACK if rule is _balance else TOLERANCE
    if worst.margin >= -slack:
        return Outcome(margin)
    unmerged = rule(every)
    is_own = unmerged is not None and unmerged.margin < -slack
    _, trajectory, plan = asked
    times = plan.times[[worst.move - 1, worst.move]]
    place = f"Between waypoints {worst.move} and {worst.move + 1} ({times[0]:.1f} to {times[1]:.1f} s)"
    if is_own:
        way_out = (
            "The same with one waypoint a sample as well: change the motion, such as its timeline or margin."
        )
    else:
        fits = _fitting(rule, slack, asked)
        way_out = f"One waypoint a sample avoids this: merge within {fits * 1000:.2g} mm at most."
    severity = Severity.WARNING if is_own and not worst.is_sure else Severity.ERROR
    knot = min(int(np.searchsorted(trajectory.times, times[1] - TIME_SLACK)), plan.kept[worst.move])
    where = {"sample": knot, "foot": worst.foot, "time": float(times[1])}
    finding = found(name, severity, f"{place} {worst.words}.", way_out, margin.margin, 0.0, **where)
    return Outcome(margin, (finding,))


def _fitting(rule: _Rule, slack: float, asked: tuple[RobotModel, Trajectory, WaypointPlan]) -> float:
    """The largest smaller tolerance with which a rule holds, m."""
    model, trajectory, plan = asked
    for share in SMALLER:
        worst = rule(executed_path(model, _replanned(model, trajectory, plan, share * plan.merge)))
        if worst is None or worst.margin >= -slack:
            return share * plan.merge
    return 0.0


def _balance(path: ExecutedPath) -> _Worst | None:
    tips = bool((path.propped_margins < -BALANCE_SLACK).any())
    margins = path.propped_margins if tips else path.margins
    place = int(first_lowest(margins))
    value = float(margins.min())
    standing = ", ".join(str(foot + 1) for foot in np.nonzero(path.standing[place])[0])
    words = f"the centre of mass is {abs(value) * 1000:.2f} mm outside the support of feet {standing}"
    if not standing:
        words = "no foot stands"
    if not tips:
        return _Worst(value, int(path.moves[place]), None, words + " alone while feet hand over")
    words = f"the centre of mass is {abs(value) * 1000:.2f} mm outside every foot near the ground"
    return _Worst(value, int(path.moves[place]), None, words, is_sure=True)


def _ground(path: ExecutedPath) -> _Worst | None:
    gaps = np.where(path.standing, np.abs(np.nan_to_num(path.heights)), 0.0)
    place, foot = first_place(gaps)
    gap = float(gaps.max())
    words = (
        f"foot {foot + 1}, which should stand, is {gap * 1000:.2f} mm off the plane of the standing feet, "
        f"more than {GROUND_LIMIT * 1000:.1f} mm"
    )
    return _Worst(GROUND_LIMIT - gap, int(path.moves[place]), foot, words)


def _clearance(path: ExecutedPath) -> _Worst | None:
    """The swing that rises least, or that sinks deepest into the ground on its way."""
    found = []
    for foot in range(path.standing.shape[1]):
        for first, last in stretches(np.asarray(~path.standing[:, foot])):
            heights = path.heights[first : last + 1, foot]
            if not np.isnan(heights).all():
                found += _swing(heights, first, foot, path)
    if not found:
        return None
    return found[int(first_lowest(np.array([worst.margin for worst in found])))]


def _swing(heights: Floats, first: int, foot: int, path: ExecutedPath) -> list[_Worst]:
    top, low = first + int(first_highest(heights)), first + int(first_lowest(heights))
    rise, sink = float(np.nanmax(heights)), float(np.nanmin(heights))
    rises = f"foot {foot + 1} rises only {rise * 1000:.2f} mm, less than {RISE_LIMIT * 1000:.1f} mm"
    sinks = f"foot {foot + 1} is pressed {-sink * 1000:.2f} mm into the ground in its swing"
    return [
        _Worst(rise - RISE_LIMIT, int(path.moves[top]), foot, rises),
        _Worst(sink + GROUND_LIMIT, int(path.moves[low]), foot, sinks),
    ]


_RULES: dict[str, _Rule] = {
    "path_balance": _balance,
    "path_ground": _ground,
    "path_clearance": _clearance,
}
