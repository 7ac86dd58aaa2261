"""Strokes of a robot with coupled motors: those that its actuators can make, and the feet that follow.

Wanted strokes h are met in the sense of least squares, h′ = C·u with u = argmin |C·u − h| (thesis 2.1.2), and
the feet go where forward kinematics of h′ puts them. A robot with an actuator for every motor does what is
wanted, to the last bit.
"""

import numpy as np

from core.arrays import Bools, Floats
from core.robot.coupling import actuator_positions, motor_strokes
from core.robot.kinematics import BodyPose, free_strokes, walker_feet
from core.robot.model import RobotModel

FLAT = 1e-6
"""Standing feet whose spread across a line is below this part of that along it say nothing of a plane."""


def real_strokes(model: RobotModel, strokes: Floats) -> Floats:
    """The strokes that the robot makes where others are wanted.

    Args:
        model: the robot.
        strokes: (..., legs, 3) wanted, m; nan where no rod is long enough.

    Returns:
        (..., legs, 3) m; nan where an actuator's motors are wanted nowhere.
    """
    if not model.is_coupled:
        return strokes
    flat = strokes.reshape(*strokes.shape[:-2], model.motor_count)
    made = motor_strokes(model.coupling, actuator_positions(model.coupling, flat))
    return np.asarray(made.reshape(strokes.shape))


def real_feet(model: RobotModel, feet_world: Floats, pose: BodyPose) -> Floats:
    """Where the feet go while the body keeps its pose.

    Args:
        model: the robot.
        feet_world: (..., legs, 3) wanted platform centres, m.
        pose: the robot's frame.

    Returns:
        (..., legs, 3) m; as wanted where a foot is out of every rod's reach, since nothing is known then.
    """
    if not model.is_coupled:
        return feet_world
    wanted = free_strokes(model, feet_world, pose)
    found = walker_feet(model, real_strokes(model, wanted), pose)
    return np.where(np.isfinite(found), found, feet_world)


def heights_over_standing(feet: Floats, contact: Bools) -> Floats:
    """Height of each foot over the plane on which the standing feet rest.

    The plane z = a + b·x + c·y fits the standing feet best (least squares; exactly, where three stand), since
    a robot leans as they say.

    Args:
        feet: (n, legs, 3) m.
        contact: (n, legs) true where a foot stands.

    Returns:
        (n, legs) m; nan where fewer than three feet stand, or all of them in a line.
    """
    weight = contact.astype(np.float64)
    count = np.maximum(weight.sum(axis=1), 1.0)
    middle = (weight[..., None] * feet).sum(axis=1) / count[:, None]
    away = feet - middle[:, None]
    spread = np.einsum("nl,nli,nlj->nij", weight, away[..., :2], away[..., :2])
    rise = np.einsum("nl,nli,nl->ni", weight, away[..., :2], away[..., 2])
    widths = np.linalg.eigvalsh(spread)
    stands = (contact.sum(axis=1) >= 3) & (widths[:, 0] > FLAT * widths[:, 1])
    solvable = np.where(stands[:, None, None], spread, np.eye(2))
    slope = np.linalg.solve(solvable, rise[..., None])[..., 0]
    height = away[..., 2] - np.einsum("nli,ni->nl", away[..., :2], slope)
    return np.where(stands[:, None], height, np.nan)
