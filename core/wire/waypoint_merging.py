"""What is sent of a plan: its waypoints merged and cut before anybody judges or approves them.

The firmware moves all motors along a straight line in motor space to each waypoint and stops there, so that
every waypoint costs time and the path between two of them is known (docs/firmware.md, Times).
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from core.arrays import SAME, Bools, Floats, stretches
from core.errors import InputError
from core.motion.trajectory import Trajectory
from core.robot.coupled_strokes import heights_over_standing, real_strokes
from core.robot.kinematics import feet_in_robot
from core.robot.model import RobotModel
from core.wire.robot_time import ARRIVED, PUBLISHED, far_motors
from core.wire.waypoint_path import cut_parts, stays_near, waypoints_from_trajectory
from core.wire.waypoints import Waypoints

ON_GROUND = 0.00025
"""A foot no higher than this over the standing feet is on the ground, whatever its sample is called, m."""
SAME_SECONDS = 1e-5
"""If the times of two ways differ by less, the first one is taken, s; `SAME` changes a time by less than
1e-4 s."""
JUST_MOVES = math.nextafter(ARRIVED, 1.0)
"""Shortest distance to which the firmware moves, m."""
WIDEST_REACH = 120
"""Knots that one move replaces at most; a bound on the search."""


@dataclass(frozen=True, eq=False)
class WaypointPlan:
    """Exactly what is sent of a plan, and where in the plan each waypoint is.

    Args:
        knots: one waypoint a sample.
        waypoints: what is sent.
        kept: (count,) knot with which each waypoint's move ends, 0-based; of a cut move all its parts.
        times: (count,) the plan's time of each waypoint, s.
        contact: (count, legs) feet on the ground at each waypoint.
        standing: (count, legs) feet on the ground all along the move to each waypoint.
        merge: tolerance in motor space, m; 0 where every knot is sent.
        stop_bound: longest deafness, s; None where no move was cut.
    """

    knots: Waypoints
    waypoints: Waypoints
    kept: tuple[int, ...]
    times: Floats
    contact: Bools
    standing: Bools
    merge: float
    stop_bound: float | None

    @property
    def hold_ok(self) -> tuple[bool, ...]:
        """Whether a pause may end at each waypoint: every foot stands there that ever does."""
        walking = self.contact.any(axis=0)
        return tuple(bool(row.any() and row[walking].all()) for row in self.contact)


def grounded(model: RobotModel, trajectory: Trajectory, strokes: Floats) -> Bools:
    """(n, legs) feet on the ground: those that stand by the plan, and those that touch it in their swing."""
    heights = heights_over_standing(feet_in_robot(model, strokes), trajectory.contact)
    touching = np.nan_to_num(heights, nan=math.inf) <= ON_GROUND + SAME
    return np.asarray(trajectory.contact | touching)


def plan_waypoints(
    model: RobotModel, trajectory: Trajectory, merge: float = 0.0, stop_bound: float | None = None
) -> WaypointPlan:
    """Merges and cuts a motion's waypoints.

    Args:
        model: the robot.
        trajectory: the motion.
        merge: largest distance of a left-out waypoint from the path, of any motor, m; 0 leaves none out.
        stop_bound: how long the robot may be deaf, s; None for any time.

    Raises:
        UnreachableError: a foot lies outside the workspace.
        InputError: the tolerance or the bound is no usable number.
    """
    return plan_of_knots(model, trajectory, waypoints_from_trajectory(model, trajectory), merge, stop_bound)


def plan_of_knots(
    model: RobotModel,
    trajectory: Trajectory,
    knots: Waypoints,
    merge: float = 0.0,
    stop_bound: float | None = None,
) -> WaypointPlan:
    """The same of strokes that are known already (see `plan_waypoints`).

    Args:
        model: the robot.
        trajectory: says when each foot stands.
        knots: one waypoint a sample.
        merge: tolerance, m.
        stop_bound: s, or None.

    Raises:
        InputError: the tolerance or the bound is no usable number.
    """
    # Of strokes that shared motors cannot make, those that they make of them are sent.
    knots = replace(knots, strokes=real_strokes(model, knots.strokes))
    contact = grounded(model, trajectory, knots.strokes)
    kept = list(range(knots.count))
    if merge:
        kept = kept_knots(knots, contact, needed_knots(feet_in_robot(model, knots.strokes), contact), merge)
    whole = _selected(knots, trajectory.times, contact, kept, merge)
    return whole if stop_bound is None else cut_plan(whole, stop_bound)


def _selected(
    knots: Waypoints, times: Floats, contact: Bools, kept: Sequence[int], merge: float
) -> WaypointPlan:
    chosen = list(kept)
    clock = np.cumsum(knots.durations)
    durations = np.concatenate([knots.durations[:1], np.diff(clock[chosen])])
    standing = [contact[0], *(contact[a : b + 1].all(axis=0) for a, b in pairwise(chosen))]
    waypoints = knots if len(chosen) == knots.count else Waypoints(knots.strokes[chosen], durations)
    return WaypointPlan(
        knots, waypoints, tuple(chosen), times[chosen], contact[chosen], np.array(standing), merge, None
    )


def cut_plan(plan: WaypointPlan, bound: float) -> WaypointPlan:
    """Cuts moves into equal parts of more than the firmware's threshold, within a bound.

    Args:
        plan: of whole moves.
        bound: how long the robot may be deaf, s.

    Raises:
        InputError: the bound is too short for parts that move.
    """
    parts = cut_parts(plan.waypoints, bound)
    moves = np.repeat(np.arange(parts.size), parts)
    part = np.concatenate([np.arange(1, count + 1) for count in parts])
    share = part / parts[moves]
    before = np.maximum(moves - 1, 0)
    is_end = part == parts[moves]

    def between(values: Floats) -> Floats:
        ways = values[moves] - values[before]
        weight = share.reshape(-1, *(1,) * (values.ndim - 1))
        ends = is_end.reshape(weight.shape)
        return np.asarray(np.where(ends, values[moves], values[before] + weight * ways))

    waypoints = Waypoints(between(plan.waypoints.strokes), plan.waypoints.durations[moves] / parts[moves])
    contact = np.where(is_end[:, None], plan.contact[moves], plan.standing[moves])
    return replace(
        plan,
        waypoints=waypoints,
        kept=tuple(plan.kept[move] for move in moves),
        times=between(plan.times),
        contact=np.asarray(contact),
        standing=plan.standing[moves],
        stop_bound=bound,
    )


def needed_knots(feet_robot: Floats, contact: Bools) -> tuple[int, ...]:
    """Knots that no merging leaves out.

    Both ends; of each swing the last knot before it and the first after it, at which its foot stands; and
    a knot between them at which it is highest over the standing feet. So of every time in which all feet
    stand, the first and the last pose remain, where a pause may end.

    A foot is as high at every knot within `SAME` of the highest: at two knots where it rises and falls
    evenly, at all where it is held up. One of them is enough: the first where none is needed anyway.

    Args:
        feet_robot: (n, legs, 3) feet in the robot's frame, m.
        contact: (n, legs) feet on the ground.
    """
    last = len(contact) - 1
    heights = heights_over_standing(feet_robot, contact)
    needed = {0, last}
    tops = []
    for foot in range(contact.shape[1]):
        for first, end in stretches(np.asarray(~contact[:, foot])):
            needed |= {max(first - 1, 0), min(end + 1, last)}
            # Where too few feet stand to know a height, the foot counts as low.
            rises = np.nan_to_num(heights[first : end + 1, foot], nan=0.0)
            start, stop = stretches(np.asarray(rises >= rises.max() - SAME))[0]
            tops.append(range(first + start, first + stop + 1))
    needed |= {top[0] for top in tops if needed.isdisjoint(top)}
    return tuple(sorted(needed))


def kept_knots(knots: Waypoints, contact: Bools, needed: Sequence[int], tolerance: float) -> list[int]:
    """Which knots are sent: those that are needed, and between them as few as take the least time.

    A needed knot with the same feet on the ground and within the firmware's threshold of the one before it is
    the same pose to the firmware, which would not move to it, and is left out.

    Args:
        knots: one waypoint a sample.
        contact: (n, legs) feet on the ground.
        needed: knots that stay.
        tolerance: largest distance of a left-out knot from the path, of any motor, m.

    Raises:
        InputError: the tolerance is no usable number.
    """
    if not (math.isfinite(tolerance) and tolerance >= 0):
        raise InputError(f"The tolerance is {tolerance} m; it must be at least 0.", "--merge")
    rows = knots.strokes.reshape(knots.count, -1)
    kept = [needed[0]]
    for end in needed[1:]:
        same_feet = bool((contact[end] == contact[kept[-1]]).all())
        if end != needed[-1] and same_feet and _is_same(rows, kept[-1], end, tolerance):
            continue
        kept += _quickest(rows, kept[-1], end, tolerance)
    return kept


def _is_same(rows: Floats, first: int, last: int, tolerance: float) -> bool:
    """Whether every knot from one to another is within tolerance and threshold of the first."""
    farthest = float(np.abs(rows[first + 1 : last + 1] - rows[first]).max())
    return farthest <= min(tolerance + SAME, ARRIVED)


def _costs(moves: Floats) -> Floats:
    """(n,) what moves cost, s; one within the threshold is only put off and costs its share of a real one.

    Args:
        moves: (n, motors) distances, m.
    """
    distances = moves.max(axis=1)
    seconds = PUBLISHED.move_seconds(np.maximum(distances, JUST_MOVES), far_motors(moves))
    shares = np.minimum(distances / JUST_MOVES, 1.0)
    return np.asarray(PUBLISHED.arrived + shares * (seconds - PUBLISHED.arrived))


def _quickest(rows: Floats, first: int, last: int, tolerance: float) -> list[int]:
    """The knots after `first`, up to and with `last`, over which the robot is quickest (shortest path)."""
    count = last - first + 1
    best = [0.0] + [math.inf] * (count - 1)
    come_from = [0] * count
    for start in range(count - 1):
        beyond = start + 2
        while beyond < min(count, start + 1 + WIDEST_REACH) and stays_near(
            rows, first + start, first + beyond, tolerance
        ):
            beyond += 1
        moves = np.abs(rows[first + start + 1 : first + beyond] - rows[first + start])
        for end, seconds in enumerate(best[start] + _costs(moves), start + 1):
            if seconds < best[end] - SAME_SECONDS:
                best[end], come_from[end] = seconds, start
    way = [count - 1]
    while way[-1]:
        way.append(come_from[way[-1]])
    return [first + knot for knot in reversed(way[:-1])]
