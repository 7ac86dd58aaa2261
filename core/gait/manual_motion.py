"""The world motion of a gait made by hand from a segment table."""

from dataclasses import dataclass

import numpy as np

from core.arrays import Bools, Floats
from core.errors import InputError
from core.gait.gait import Gait
from core.motion.trajectory import Trajectory, difference_velocities, quarter_turn
from core.robot.leg import foot_from_strokes
from core.robot.model import RobotModel


@dataclass(frozen=True, eq=False)
class ManualMotion:
    """The trajectory of a manual gait, and how far its feet slip.

    Args:
        trajectory: in the world frame.
        slip: (legs,) the longest way that each foot slides while it stands, m.
    """

    trajectory: Trajectory
    slip: Floats


def manual_motion(gait: Gait, model: RobotModel) -> ManualMotion:
    """Turns a segment table into a trajectory.

    The table says where feet are in the body's frame. The body moves so that the feet slip least in the
    sense of least squares, where a foot in the air asks for nothing: between samples it advances by
    −Σ Δfoot / legs over the feet that stand, which is a quarter of the step with each Zero segment. Its
    height comes from the deepest foot (thesis 2.3.2).

    Raises:
        InputError: the gait has no segment table.
    """
    if gait.segment_table is None:
        raise InputError(f"“{gait.name}” has no segment table; choose a gait made by hand.", "segment_table")
    table = gait.segment_table.repeated(gait.iterations)
    deepest = float(foot_from_strokes(model.leg, np.zeros(3))[2])
    displacement_1 = table.feet_displacements(np.array(gait.step[:2]), deepest)
    standing_1 = ~table.swing_samples().T
    shift = gait.quarter_turns * model.leg_count // 4
    displacement = np.roll(displacement_1 @ quarter_turn(gait.quarter_turns).T, shift, axis=1)
    standing = np.roll(standing_1, shift, axis=1)
    feet_robot = displacement + model.module_centres_robot
    plane = np.zeros((len(feet_robot), 3))
    plane[1:, :2] = np.cumsum(body_advances(feet_robot, standing), axis=0)
    plane[:, 2] = -feet_robot[:, :, 2].min(axis=1)
    feet_world = feet_robot + plane[:, None, :]
    times = np.asarray(np.arange(len(plane)) * gait.timeline.sample_time, dtype=np.float64)
    body = plane + [0.0, 0.0, model.com_height]
    trajectory = Trajectory(
        times=times,
        body_world=body,
        heading=np.zeros(len(times)),
        feet_world=feet_world,
        contact=standing,
        body_velocity=difference_velocities(times, body),
        feet_velocity=difference_velocities(times, feet_world),
    )
    return ManualMotion(trajectory, stance_slip(feet_world, standing))


def body_advances(feet_robot: Floats, standing: Bools) -> Floats:
    """How far a body of constant heading goes between samples: −Σ Δfoot / legs over the feet that stand.

    Args:
        feet_robot: (n, legs, 3) platform centres in the robot's axes, m.
        standing: (n, legs) true where a foot stands.

    Returns:
        (n − 1, 2) m.
    """
    both = standing[1:] & standing[:-1]
    moved = np.diff(feet_robot[:, :, :2], axis=0) * both[:, :, None]
    return np.asarray(-moved.sum(axis=1) / feet_robot.shape[1])


def stance_slip(feet_world: Floats, contact: Bools) -> Floats:
    """The longest horizontal way that each foot slides during one stance.

    Args:
        feet_world: (n, legs, 3) m.
        contact: (n, legs) true where a foot stands.

    Returns:
        (legs,) m.
    """
    both = contact[1:] & contact[:-1]
    moves = np.linalg.norm(np.diff(feet_world[:, :, :2], axis=0), axis=-1) * both
    longest = np.zeros(feet_world.shape[1])
    running = np.zeros(feet_world.shape[1])
    for standing, move in zip(both, moves, strict=True):
        running = np.where(standing, running + move, 0.0)
        longest = np.maximum(longest, running)
    return longest
