"""Where a foot that is out of reach could be: the outline of its reach on the ground, to be drawn."""

import numpy as np

from core.arrays import Floats
from core.motion.trajectory import Trajectory
from core.problem.motion_problem import CYLINDER, MotionProblem, Workspace, turned_about_z
from core.robot.kinematics import actuator_plane_pose
from core.robot.leg import vertex_directions
from solver_jobs import Lack

REACH = "workspace"
"""The checker's name of the family."""
CORNERS = 24
"""Of each drawn outline."""


def reach_rings(problem: MotionProblem, trajectory: Trajectory, lack: Lack) -> list[list[list[float]]] | None:
    """Outlines of a foot's reach at its height, one a knot of the phase that lacks reach.

    Args:
        problem: what was asked.
        trajectory: the nearest motion.
        lack: what it misses.

    Returns:
        (knots, corners, 2) in the world, m; None where the lack is not about one foot's reach.
    """
    if lack.family != REACH or len(lack.feet) != 1:
        return None
    knots = range(lack.first, min(lack.last, trajectory.knot_count - 1) + 1)
    rings = [_ring(problem, trajectory, knot, lack.feet[0]) for knot in knots]
    return [np.round(ring, 5).tolist() for ring in rings]


def _ring(problem: MotionProblem, trajectory: Trajectory, knot: int, foot: int) -> Floats:
    model = problem.model
    heading = trajectory.heading[knot : knot + 1]
    pose = actuator_plane_pose(model, trajectory.body_world[knot : knot + 1], heading)
    origin = pose.position_world[0]
    below = float(trajectory.feet_world[knot, foot, 2] - origin[2])
    ring = np.zeros((CORNERS, 3))
    ring[:, :2] = _outline(problem, below)
    in_robot = ring @ model.R_robot_from_module[foot].T + model.module_centres_robot[foot]
    return np.asarray((turned_about_z(in_robot, float(heading[0])) + origin)[:, :2])


def _outline(problem: MotionProblem, below: float) -> Floats:
    """(corners, 2) in the module's frame: the cylinder, or where no motor would retract too far.

    The second is inside three discs (x − c_i)² ≤ l² − (z + upper)² round the base vertices c_i.
    """
    angles = 2 * np.pi * np.arange(CORNERS) / CORNERS
    rays = np.stack([np.cos(angles), np.sin(angles)], axis=-1)
    if problem.limits.workspace is Workspace.CYLINDER:
        return np.asarray(CYLINDER.radius * rays)
    leg = problem.model.leg
    radius_squared = leg.link_length**2 - (below + problem.model.stroke.upper) ** 2
    along = rays @ (leg.reach_radius * vertex_directions()).T
    beyond = np.maximum(radius_squared - leg.reach_radius**2 + along**2, 0.0)
    return np.asarray(np.maximum((along + np.sqrt(beyond)).min(axis=-1), 0.0)[:, None] * rays)
