"""Where body and feet were by measured strokes, with the plan's standing feet on the ground."""

from dataclasses import dataclass

import numpy as np

from core.arrays import Bools, Floats, interpolated
from core.motion.trajectory import Trajectory
from core.robot.kinematics import BodyPose, feet_in_world, walker_feet
from core.robot.leg import foot_from_strokes
from core.robot.model import RobotModel
from core.wire.waypoints import Waypoints


@dataclass(frozen=True, eq=False)
class RanPlan:
    """What a run was to do.

    Args:
        model: the robot.
        waypoints: what was approved.
        times: (count,) the plan's time of each waypoint, s.
        trajectory: the motion that they were made from.
    """

    model: RobotModel
    waypoints: Waypoints
    times: Floats
    trajectory: Trajectory


@dataclass(frozen=True, eq=False)
class MeasuredMotion:
    """Where body and feet were by the measured strokes.

    Args:
        pose: (n,) the robot's frame.
        feet_world: (n, legs, 3) m.
    """

    pose: BodyPose
    feet_world: Floats


def measured_motion(plan: RanPlan, strokes: Floats, times: Floats, before: Floats) -> MeasuredMotion:
    """Body and feet by forward kinematics, with the plan's standing feet on the ground.

    Args:
        plan: where the feet stand.
        strokes: (n, legs, 3) measured, m.
        times: (n,) the plan's time of each, s.
        before: (n,) the plan's time since which a foot must have stood to count, s.

    Returns:
        Body and feet; with one standing foot the heading is the plan's, with none the whole pose.
    """
    model, trajectory = plan.model, plan.trajectory
    feet_robot = walker_feet(model, strokes, BodyPose(np.zeros((len(times), 3)), np.zeros(len(times))))
    standing = standing_feet(trajectory, times) & standing_feet(trajectory, before)
    planned = planned_feet(trajectory, times)
    pose = _fitted(feet_robot, planned, standing, planned_pose(plan, times))
    return MeasuredMotion(pose, feet_in_world(model, foot_from_strokes(model.leg, strokes), pose))


def planned_feet(trajectory: Trajectory, times: Floats) -> Floats:
    """(n, legs, 3) the plan's feet at some times, straight between its knots, m."""
    return interpolated(times, trajectory.times, trajectory.feet_world)


def planned_pose(plan: RanPlan, times: Floats) -> BodyPose:
    """The plan's pose of the robot's frame at some times, straight between its knots."""
    pose, knots = plan.trajectory.pose(plan.model), plan.trajectory.times
    return BodyPose(
        interpolated(times, knots, pose.position_world), np.interp(times, knots, np.unwrap(pose.heading))
    )


def standing_feet(trajectory: Trajectory, times: Floats) -> Bools:
    """(n, legs) feet that stand at the knots on both sides of some times."""
    last = len(trajectory.times) - 1
    low = np.searchsorted(trajectory.times, times + 1e-6, side="right") - 1
    high = np.searchsorted(trajectory.times, times - 1e-6, side="left")
    contact = trajectory.contact
    return np.asarray(contact[np.clip(low, 0, last)] & contact[np.clip(high, 0, last)])


def _fitted(feet_robot: Floats, planned: Floats, standing: Bools, pose: BodyPose) -> BodyPose:
    """The level pose that brings standing feet closest to their places (least squares; Kabsch about z).

    Args:
        feet_robot: (n, legs, 3) measured feet in the robot's frame, m.
        planned: (n, legs, 3) where they stand in the world, m.
        standing: (n, legs) which of them count.
        pose: the plan's, for what too few standing feet leave open.
    """
    count = standing.sum(axis=1)
    weights = standing[..., None] / np.maximum(count, 1)[:, None, None]
    middle_robot, middle_world = (weights * feet_robot).sum(axis=1), (weights * planned).sum(axis=1)
    a, b = feet_robot - middle_robot[:, None], planned - middle_world[:, None]
    cross = (standing * (a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0])).sum(axis=1)
    along = (standing * (a[..., 0] * b[..., 0] + a[..., 1] * b[..., 1])).sum(axis=1)
    heading = np.where(count >= 2, np.arctan2(cross, along), pose.heading)
    cosine, sine = np.cos(heading), np.sin(heading)
    turned = np.stack(
        [
            cosine * middle_robot[:, 0] - sine * middle_robot[:, 1],
            sine * middle_robot[:, 0] + cosine * middle_robot[:, 1],
            middle_robot[:, 2],
        ],
        axis=-1,
    )
    position = np.where(count[:, None] >= 1, middle_world - turned, pose.position_world)
    return BodyPose(position, heading)
