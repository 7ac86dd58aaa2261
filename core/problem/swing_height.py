"""Swing height: how a foot comes up to where it is held in the air, or down from there."""

import numpy as np

from core.arrays import SAME, Floats
from core.motion.contact_timeline import Swing
from core.problem.motion_problem import MotionProblem

SPEED_SHARE = 0.5
"""Share of a foot's speed limit that it rises or sinks with; the rest is left for its way."""

FEWEST_KNOTS = 3
"""It takes at least so many knots, where its swing has them."""


def rest_heights(problem: MotionProblem, swing: Swing) -> tuple[float, float]:
    """How high a foot is held before and after a swing, m; 0 where it stands.

    Args:
        problem: what is asked.
        swing: one of `core.problem.initial_guess.problem_swings`, which end before the last knot.
    """
    foot, last = swing.foot, problem.knot_count - 2
    before = problem.start.feet_world[foot, 2] if swing.first == 0 and problem.held_start[foot] else 0.0
    after = problem.goal.feet_world[foot, 2] if swing.last == last and problem.held_end[foot] else 0.0
    return float(before), float(after)


def is_held(problem: MotionProblem, swing: Swing) -> bool:
    """Whether a foot is held up before or after a swing, so that no clearance is asked of it."""
    return max(rest_heights(problem, swing)) > 0.0


def held_climb(rise: float, around: Floats, foot_speed: float) -> Floats:
    """Vertical speed of a foot between two rests of unequal height: it rises at once, or sinks at last.

    Args:
        rise: from the rest before to the one after, m; negative downwards.
        around: (knots + 1,) intervals from the rest before to the one after, s.
        foot_speed: limit of the foot's speed, m/s.

    Returns:
        (knots,) m/s, whose trapezoids add up to the rise.
    """
    shares = (around[1:] + around[:-1]) / 2
    speed = np.zeros(len(shares))
    span = _moving(rise, shares, foot_speed)
    speed[span] = rise / shares[span].sum()
    return speed


def _moving(rise: float, shares: Floats, foot_speed: float) -> slice:
    """The knots of a swing at which its foot rises or sinks: its first ones, or its last."""
    ordered = shares if rise > 0 else shares[::-1]
    way = np.cumsum(ordered) * foot_speed * SPEED_SHARE
    # Even knots and a round height often end the way exactly at a knot.
    count = min(max(int(np.searchsorted(way, abs(rise) - SAME)) + 1, FEWEST_KNOTS), len(shares))
    return slice(0, count) if rise > 0 else slice(len(shares) - count, len(shares))


def held_knots(problem: MotionProblem, swing: Swing) -> tuple[range, float]:
    """Knots of a swing at which a foot that is held at an end is as high as it is held, and how high, m.

    Up to where it sinks, from where it has risen, or all of them where it is held at both ends.
    """
    before, after = rest_heights(problem, swing)
    first = max(swing.first, 1)
    if before and after:
        return range(first, swing.last + 1), min(before, after)
    around = problem.intervals[first - 1 : swing.last + 1]
    span = _moving(after - before, (around[1:] + around[:-1]) / 2, problem.limits.foot_speed)
    knots = range(first, first + span.start) if before else range(first + span.stop, swing.last + 1)
    return knots, max(before, after)
