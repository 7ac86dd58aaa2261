"""What would be sent of a motion that leaves the motors' range, so that every other rule can look at it."""

from dataclasses import dataclass

import numpy as np

from core.arrays import Bools
from core.motion.trajectory import Trajectory
from core.robot.kinematics import feet_in_modules, free_strokes
from core.robot.leg import strokes_from_foot
from core.robot.model import RobotModel
from core.robot.nearest_reachable import nearest_reachable
from core.wire.waypoint_merging import WaypointPlan, plan_of_knots
from core.wire.waypoint_path import knots_of_strokes


@dataclass(frozen=True, eq=False)
class BeyondRange:
    """A motion beyond the motors' range as it would be sent; it never is.

    Args:
        way: its waypoints, with the strokes that the motion needs.
        unreached: (n, legs) feet for which no rod is long enough; `way` has the nearest place instead.
    """

    way: WaypointPlan
    unreached: Bools


def beyond_range_plan(model: RobotModel, trajectory: Trajectory) -> BeyondRange:
    """One waypoint a sample, whatever the motors' range; nothing is merged or cut.

    Args:
        model: the robot.
        trajectory: the motion.

    Raises:
        InputError: the robot has another number of feet.
    """
    trajectory.require_feet_of(model)
    pose = trajectory.pose(model)
    strokes = free_strokes(model, trajectory.feet_world, pose)
    unreached = np.asarray(np.isnan(strokes).any(axis=-1))
    feet = feet_in_modules(model, trajectory.feet_world, pose)
    for sample, foot in zip(*np.nonzero(unreached), strict=True):
        strokes[sample, foot] = strokes_from_foot(model.leg, nearest_reachable(model, feet[sample, foot]))
    knots = knots_of_strokes(model, trajectory, strokes)
    return BeyondRange(plan_of_knots(model, trajectory, knots), unreached)
