"""Forward and inverse kinematics of a body that carries a ring of linear-delta legs.

Every function is pure and works over any leading axes: time first, then leg, then axis or actuator
(thesis 2.3.2 and 2.3.3).
"""

from dataclasses import dataclass
from typing import Self

import numpy as np

from core.arrays import Bools, Floats
from core.errors import InfeasibleError
from core.robot.leg import foot_from_strokes, strokes_from_foot
from core.robot.model import RobotModel, StrokeLimits
from core.robot.nearest_reachable import nearest_reachable

REMEDY = "Shorten the step or change the body's height."
"""What helps where a foot cannot go where it was asked."""


class UnreachableError(InfeasibleError):
    """A foot cannot go where it was asked.

    Args:
        sentence: which foot and sample, how far outside, and what to do.
        foot: index of the foot, 0-based.
        sample: index of the sample, 0-based (0 where there is no time axis).
        nearest_module: (3,) nearest reachable point in the module's frame, m.
        distance: how far that is from the target, m.
    """

    def __init__(
        self, sentence: str, foot: int, sample: int, nearest_module: Floats, distance: float
    ) -> None:
        super().__init__(sentence, f"foot {foot + 1}, sample {sample + 1}")
        self.foot = foot
        self.sample = sample
        self.nearest_module = nearest_module
        self.distance = distance

    def with_remedy(self, remedy: str) -> Self:
        """The same refusal with another way out."""
        words = self.sentence.removesuffix(REMEDY).rstrip()
        return type(self)(f"{words} {remedy}", self.foot, self.sample, self.nearest_module, self.distance)


@dataclass(frozen=True, eq=False)
class BodyPose:
    """Where the robot's frame is in the world.

    Args:
        position_world: (..., 3) the point of the body axis in the actuator plane, m.
        heading: (...) turn about z, rad.
    """

    position_world: Floats
    heading: Floats


def actuator_plane_pose(model: RobotModel, com_world: Floats, heading: Floats) -> BodyPose:
    """The robot's frame under a centre of mass: lower by the model's `com_height`.

    Args:
        model: the robot.
        com_world: (..., 3) centre of mass, m, z from the platform of a standing foot.
        heading: (...) rad.
    """
    lowered = np.array(com_world, dtype=np.float64)
    lowered[..., 2] -= model.com_height
    return BodyPose(lowered, np.asarray(heading, dtype=np.float64))


def _heading_rotation(heading: Floats) -> Floats:
    cosine, sine = np.cos(heading), np.sin(heading)
    zero, one = np.zeros_like(cosine), np.ones_like(cosine)
    rows = [[cosine, -sine, zero], [sine, cosine, zero], [zero, zero, one]]
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)


def feet_in_modules(model: RobotModel, feet_world: Floats, pose: BodyPose) -> Floats:
    """World positions of the feet in their own modules' frames.

    Args:
        model: the robot.
        feet_world: (..., legs, 3) platform centres, m.
        pose: the robot's frame, leading axes as in `feet_world`.

    Returns:
        (..., legs, 3) m.
    """
    relative = feet_world - pose.position_world[..., None, :]
    feet_robot = np.einsum("...ji,...lj->...li", _heading_rotation(pose.heading), relative)
    from_centre = feet_robot - model.module_centres_robot
    return np.asarray(np.einsum("lji,...lj->...li", model.R_robot_from_module, from_centre))


def feet_in_world(model: RobotModel, feet_module: Floats, pose: BodyPose) -> Floats:
    """Inverse of `feet_in_modules`."""
    turned = np.einsum("lij,...lj->...li", model.R_robot_from_module, feet_module)
    feet_robot = turned + model.module_centres_robot
    rotated = np.einsum("...ij,...lj->...li", _heading_rotation(pose.heading), feet_robot)
    return np.asarray(rotated + pose.position_world[..., None, :])


def free_strokes(model: RobotModel, feet_world: Floats, pose: BodyPose) -> Floats:
    """Strokes that put the feet somewhere, limits left aside (see `walker_strokes`).

    Args:
        model: the robot.
        feet_world: (..., legs, 3) platform centres, m.
        pose: the robot's frame.

    Returns:
        (..., legs, 3) m; nan where no rod is that long.
    """
    return strokes_from_foot(model.leg, feet_in_modules(model, feet_world, pose))


def walker_strokes(model: RobotModel, feet_world: Floats, pose: BodyPose) -> Floats:
    """Inverse kinematics of the whole walker.

    Args:
        model: the robot.
        feet_world: (..., legs, 3) platform centres, m.
        pose: the robot's frame.

    Returns:
        (..., legs, 3) strokes within the model's limits, m.

    Raises:
        UnreachableError: a foot lies outside the workspace; it names the first one and the nearest point.
    """
    feet_module = feet_in_modules(model, feet_world, pose)
    strokes = strokes_from_foot(model.leg, feet_module)
    outside = np.asarray(~_within(strokes, model.stroke).all(axis=-1))
    if outside.any():
        _raise_unreachable(model, feet_module, feet_world, outside)
    return strokes


def walker_feet(model: RobotModel, strokes: Floats, pose: BodyPose) -> Floats:
    """Forward kinematics of the whole walker: (..., legs, 3) strokes to platform centres in the world, m."""
    return feet_in_world(model, foot_from_strokes(model.leg, strokes), pose)


def feet_in_robot(model: RobotModel, strokes: Floats) -> Floats:
    """The same in the robot's frame, (..., legs, 3) m."""
    feet_module = foot_from_strokes(model.leg, strokes)
    turned = np.einsum("lij,...lj->...li", model.R_robot_from_module, feet_module)
    return np.asarray(turned + model.module_centres_robot)


def _within(strokes: Floats, limits: StrokeLimits, tolerance: float = 1e-9) -> Bools:
    # nan compares false: a rod that is too short is outside.
    return (strokes >= limits.lower - tolerance) & (strokes <= limits.upper + tolerance)


def _raise_unreachable(model: RobotModel, feet_module: Floats, feet_world: Floats, outside: Bools) -> None:
    first = tuple(int(i) for i in np.argwhere(outside)[0])
    foot, sample = first[-1], first[0] if len(first) > 1 else 0
    target = feet_module[first]
    nearest = nearest_reachable(model, target)
    distance = float(np.linalg.norm(nearest - target))
    x, y, _ = feet_world[first]
    raise UnreachableError(
        f"Foot {foot + 1} cannot reach ({x:.3f}, {y:.3f}) m at sample {sample + 1}: {distance * 1000:.1f} mm "
        f"outside its workspace. {REMEDY}",
        foot,
        sample,
        nearest,
        distance,
    )
