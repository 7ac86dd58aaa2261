"""What physics is asked of a gait for the robot's clock; a cycle in mid-walk is walked several times."""

import numpy as np

from core.arrays import Floats
from core.motion.trajectory import Trajectory
from core.physics.masses import default_physics
from core.physics.problem import SimulationProblem
from core.pose_gaits.pose_gait import PoseGait
from core.problem.motion_problem import turned_about_z
from core.wire.waypoint_merging import plan_of_knots
from core.wire.waypoints import Waypoints

PHYSICS_CYCLES = 2
"""Cycles in mid-walk that physics walks: one from the stance of the first pose, and one that follows it."""


def pose_gait_problem(gait: PoseGait) -> SimulationProblem:
    """A simulation of exactly the poses that would be sent, with the robot's usual parameters.

    Args:
        gait: from stance to rest, walked once; or one cycle in mid-walk, which is repeated from its own first
            pose, at which all feet stand.
    """
    times = PHYSICS_CYCLES if gait.problem.cycles is None else 1
    trajectory, waypoints = repeated(gait, times)
    model = gait.problem.model
    way = plan_of_knots(model, trajectory, waypoints)
    physics = default_physics(model)
    return SimulationProblem(model, way.waypoints, trajectory, way.times, way.contact, way.standing, physics)


def repeated(gait: PoseGait, times: int) -> tuple[Trajectory, Waypoints]:
    """A gait in mid-walk run through several times: its motion, and its waypoints.

    Args:
        gait: one cycle.
        times: how often.
    """
    motion = gait.trajectory
    turn = float(motion.heading[-1] - motion.heading[0])

    def joined(rows: Floats, offset: Floats | float = 0.0) -> Floats:
        parts = [rows[1:] + number * offset for number in range(times)]
        return np.concatenate([rows[:1], *parts])

    def moved_on(places: Floats) -> Floats:
        """Places in the world, each cycle where the one before it has taken the body."""
        first, last = motion.body_world[0], motion.body_world[-1]
        parts = [places]
        for _ in range(times - 1):
            parts.append(turned_about_z(parts[-1] - first, turn) + last)
        return np.concatenate([places[:1], *(part[1:] for part in parts)])

    strokes = joined(gait.strokes)
    seconds = np.append(gait.waypoints.durations[:1], np.tile(gait.waypoints.durations[1:], times))
    trajectory = Trajectory(
        joined(motion.times, float(motion.times[-1])),
        moved_on(motion.body_world),
        joined(motion.heading, turn),
        moved_on(motion.feet_world),
        np.concatenate([motion.contact[:1], *[motion.contact[1:]] * times]),
    )
    return trajectory, Waypoints(strokes, seconds)
