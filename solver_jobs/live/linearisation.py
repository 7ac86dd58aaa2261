"""The linearisation: what the convex problem takes as known (footholds, heights, where feet may move).

With the vertical motion and the footholds given, balance, reach and speed are linear or discs in what is
left: the ground motion of the body and of the feet in the air. `free_heights.py` makes heights unknown too.
Millimetres and seconds throughout.
"""

from dataclasses import dataclass

import numpy as np

from core.arrays import Bools, Floats
from core.motion.contact_timeline import Swing
from core.motion.support_polygon import GRAVITY
from core.problem.footholds import way_shares
from core.problem.initial_guess import Indices, clearance_knot, closed_contact, problem_swings
from core.problem.motion_problem import Boundary, MotionProblem
from core.problem.swing_height import held_climb, rest_heights

MM = 1000.0
"""Millimetres in a metre."""

RAMP_SHARE = 0.8
"""Share of the body's speed limit that a change of height may use."""


@dataclass(frozen=True, eq=False)
class Linearisation:
    """The known part of a motion; point 0 is the body, points 1 to legs are the feet.

    Args:
        problem: what is asked.
        contact: (n, legs) stance; at the last knot of every foot that is not held up.
        swings: every swing.
        intervals: (n − 1,) s.
        height: (n, 1 + legs) z of every point, mm.
        climb: (n, 1 + legs) its speed, mm/s.
        index: (2, n, 1 + legs, 2) number of the unknown that holds a position (0) or velocity (1); −1 where
            it is known.
        known: (2, n, 1 + legs, 2) the value where it is known, else 0; mm, mm/s.
        size: number of unknowns.
        vertical: (2, n, 1 + legs) number of the unknown that holds a height (0) or climb (1), −1 where it is
            known; None where all are. `height` and `climb` are then where rows are made linear.
    """

    problem: MotionProblem
    contact: Bools
    swings: tuple[Swing, ...]
    intervals: Floats
    height: Floats
    climb: Floats
    index: Indices
    known: Floats
    size: int
    vertical: Indices | None = None

    @property
    def weight(self) -> Floats:
        """(n − 1,) vertical force that the ground gives in each interval, N·mm/m: kg·mm/s²."""
        model = self.problem.model
        masses = np.array([model.masses.body] + [model.masses.foot] * model.leg_count)
        lift = np.diff(self.climb, axis=0) @ masses / self.intervals
        return np.asarray(lift + masses.sum() * GRAVITY * MM)


def linearise(problem: MotionProblem, level: float | None = None) -> Linearisation:
    """Computes the known part of a motion.

    Args:
        problem: what is asked.
        level: height that the actuator plane takes between start and goal, m; None for the straight way.
    """
    contact, swings = closed_contact(problem), problem_swings(problem)
    height = np.zeros((problem.knot_count, 1 + problem.model.leg_count))
    climb = np.zeros_like(height)
    height[:, 0], climb[:, 0] = _body_height(problem, level)
    known = np.zeros((2, *height.shape, 2))
    free = np.zeros((2, *height.shape), dtype=np.bool_)
    shares = way_shares(problem, swings)
    for foot in range(problem.model.leg_count):
        own = [swing for swing in swings if swing.foot == foot]
        _lay_foot(problem, foot, own, shares[foot], known, free)
        for swing in own:
            _lift(problem, swing, height, climb)
    _lay_body(problem, known, free)
    index = np.full((2, *height.shape, 2), -1, dtype=np.intp)
    count = int(free.sum())
    # A knot after the other, so that unknowns that meet in a row stand close together.
    order = np.zeros((problem.knot_count, 2, 1 + problem.model.leg_count), dtype=np.intp)
    order[free.transpose(1, 0, 2)] = np.arange(count)
    for axis in (0, 1):
        index[..., axis] = np.where(free, 2 * order.transpose(1, 0, 2) + axis, -1)
    if problem.boundary is Boundary.PERIODIC:
        index[1, -1, 0] = index[1, 0, 0]
    known[np.broadcast_to(index >= 0, known.shape)] = 0.0
    return Linearisation(problem, contact, swings, problem.intervals, height, climb, index, known, 2 * count)


def speed_limits(linearisation: Linearisation) -> Floats:
    """(n, 1 + legs) speed limit of every point, mm/s."""
    limits = linearisation.problem.limits
    fastest = np.full(linearisation.height.shape, limits.foot_speed * MM)
    fastest[:, 0] = limits.body_speed * MM
    return fastest


def ranges(linearisation: Linearisation) -> tuple[Floats, Floats]:
    """What each unknown of a motion within its speed limits can be: the middle, and how far from it."""
    centre, reach = np.zeros(linearisation.size), np.zeros(linearisation.size)
    fastest = speed_limits(linearisation)
    parts = [(linearisation.index[..., axis], linearisation.known[0, ..., axis]) for axis in (0, 1)]
    if linearisation.vertical is not None:
        parts.append((linearisation.vertical, linearisation.height))
    for (position, velocity), known in parts:
        reach[velocity[velocity >= 0]] = fastest[velocity >= 0]
        for point in range(position.shape[1]):
            unknown = np.nonzero(position[:, point] >= 0)[0]
            anchors = np.nonzero(position[:, point] < 0)[0]
            if not len(anchors):
                # The body's height in a cycle.
                lowest, highest = linearisation.problem.limits.plane_height
                centre[position[:, point]] = known[:, point]
                reach[position[:, point]] = (highest - lowest) * MM
                continue
            away = np.abs(linearisation.problem.times[unknown, None] - linearisation.problem.times[anchors])
            nearest = away.argmin(axis=1)
            index = position[unknown, point]
            centre[index] = known[anchors[nearest], point]
            reach[index] = away.min(axis=1) * fastest[unknown, point]
    return centre, reach


def _lay_foot(
    problem: MotionProblem, foot: int, own: list[Swing], shares: Floats, known: Floats, free: Bools
) -> None:
    """Footholds of one foot, its way shared among its swings (`core.problem.footholds`); free in the air."""
    start, goal = (pose.feet_world[foot, :2] * MM for pose in (problem.start, problem.goal))
    known[0, :, 1 + foot] = start
    for share, swing in zip(shares[1:], own, strict=True):
        known[0, swing.last + 1 :, 1 + foot] = start + (goal - start) * share
        free[:, max(swing.first, 1) : swing.last + 1, 1 + foot] = True


def _lay_body(problem: MotionProblem, known: Floats, free: Bools) -> None:
    free[:, 1:-1, 0] = True
    known[0, 0, 0] = problem.start.body_world[:2] * MM
    known[0, -1, 0] = problem.goal.body_world[:2] * MM
    # A cycle's speed at both ends is one unknown.
    free[1, 0, 0] = problem.boundary is Boundary.PERIODIC


def _lift(problem: MotionProblem, swing: Swing, height: Floats, climb: Floats) -> None:
    """The swing's vertical motion: up and down evenly, at the clearance at its middle knot."""
    first = max(swing.first, 1)
    before, after = rest_heights(problem, swing)
    if before or after:
        _hold(problem, swing, (before, after), height[:, 1 + swing.foot], climb[:, 1 + swing.foot])
        return
    if first >= swing.last or problem.limits.clearance <= 0:
        return
    knots = np.arange(first, swing.last + 1)
    middle = clearance_knot(swing, problem.intervals)
    # With as many knots before it as after it the foot is at rest there, else it still rises.
    evenly = middle - first == swing.last - middle
    up, down = knots < middle if evenly else knots <= middle, knots > middle
    around = problem.intervals[first - 1 : swing.last + 1]
    shares = (around[1:] + around[:-1]) / 2
    speed = np.where(up, 1.0, np.where(down, -(up @ shares) / (down @ shares), 0.0))
    rise = _integrated(np.concatenate([[0.0], speed, [0.0]]), around)
    scale = problem.limits.clearance * MM / rise[middle - first + 1]
    climb[knots, 1 + swing.foot] = scale * speed
    height[knots, 1 + swing.foot] = scale * rise[1:-1]


def _hold(
    problem: MotionProblem, swing: Swing, rests: tuple[float, float], height: Floats, climb: Floats
) -> None:
    """The vertical motion of one foot, (n,), between rests of which one is in the air."""
    before, after = rests
    first = max(swing.first, 1)
    around = problem.intervals[first - 1 : swing.last + 1]
    speed = held_climb(after - before, around, problem.limits.foot_speed) * MM
    rise = _integrated(np.concatenate([[0.0], speed, [0.0]]), around)
    climb[first : swing.last + 1] = speed
    height[first - 1 : swing.last + 1] = before * MM + rise[:-1]
    height[swing.last + 1] = after * MM


def _integrated(speed: Floats, intervals: Floats) -> Floats:
    """Positions of a trapezoidal speed, from 0."""
    return np.append(0.0, np.cumsum(intervals * (speed[1:] + speed[:-1]) / 2))


def _body_height(problem: MotionProblem, level: float | None) -> tuple[Floats, Floats]:
    """Height of the centre of mass: the straight way, or up and down to a level as fast as is allowed."""
    start, goal = (pose.body_world[2] * MM for pose in (problem.start, problem.goal))
    count = problem.knot_count
    if level is None:
        speed = _ramp(problem, goal - start, slice(1, count - 1))
    else:
        between = (level + problem.model.com_height) * MM
        speed = _ramp(problem, between - start, _span(problem, between - start, first=True))
        speed = speed + _ramp(problem, goal - between, _span(problem, goal - between, first=False))
    return start + _integrated(speed, problem.intervals), speed


def _ramp(problem: MotionProblem, rise: float, span: slice) -> Floats:
    """(n,) speed within a span of knots that sums up to a rise, in a half sine."""
    speed = np.zeros(problem.knot_count)
    count = len(range(*span.indices(problem.knot_count)))
    if rise == 0.0 or count == 0:
        return speed
    speed[span] = np.sin(np.pi * np.arange(1, count + 1) / (count + 1))
    return np.asarray(speed * rise / _integrated(speed, problem.intervals)[-1])


def _span(problem: MotionProblem, rise: float, *, first: bool) -> slice:
    """Knots at the beginning or end that a rise takes at the allowed speed."""
    fastest = RAMP_SHARE * problem.limits.body_speed * MM
    needed = abs(rise) / (fastest * 2 / np.pi * float(problem.intervals.mean()))
    count = min(max(int(np.ceil(needed)), 3), (problem.knot_count - 2) // 2)
    return slice(1, 1 + count) if first else slice(problem.knot_count - 1 - count, problem.knot_count - 1)
