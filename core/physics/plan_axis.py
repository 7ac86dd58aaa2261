"""Simulated time on the plan's time axis, so that both can be looked at over each other."""

from __future__ import annotations

import numpy as np

from core.arrays import Floats
from core.physics.motion import SimulatedMotion
from core.physics.problem import SimulationProblem


def plan_times(problem: SimulationProblem, motion: SimulatedMotion) -> Floats:
    """(n,) the plan's time at each sample of a simulated run, s.

    Linear between arrivals: where waypoint k has been reached the plan's time of it stands, whatever the
    firmware took for the move. Before the first arrival the plan's time is that of the first waypoint. A move
    that broke off leads to the time of its waypoint, after the last one the time stands.

    Args:
        problem: that was simulated.
        motion: what came of it.
    """
    reached = len(motion.arrivals)
    robot, planned = motion.times[motion.arrivals], problem.times[:reached]
    if reached < problem.waypoints.count and motion.times[-1] > robot[-1]:
        robot = np.append(robot, motion.times[-1])
        planned = problem.times[: reached + 1]
    # Of waypoints that are reached at one sample, as within the firmware's threshold, the last one counts.
    last = np.append(np.diff(robot) > 0, True)
    return np.asarray(np.interp(motion.times, robot[last], planned[last]))
