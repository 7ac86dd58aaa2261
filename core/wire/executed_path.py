"""The executed path: between waypoints every motor moves in proportion."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from core.arrays import Bools, Floats
from core.motion.support_polygon import stability_margins
from core.robot.coupled_strokes import heights_over_standing
from core.robot.kinematics import feet_in_robot
from core.robot.model import RobotModel
from core.wire.waypoint_merging import WaypointPlan

STEPS = 8
"""Places that are looked at a move, its end included."""
NEAR = 0.001
"""A foot that touches down or lifts is near the ground up to this height over the standing ones, m."""


@dataclass(frozen=True, eq=False)
class ExecutedPath:
    """Where the feet are along the path, in order.

    Args:
        moves: (m,) waypoint to which the robot is under way.
        standing: (m, legs) feet on the ground.
        heights: (m, legs) of each foot over the standing ones, m; nan where fewer than three stand.
        margins: (m,) distance of the centre of mass to the support polygon's edge, m.
        propped_margins: (m,) the same where feet that touch down or lift within a move bear too as long as
            they are near the ground, so that the body may lean on them, m.
    """

    moves: NDArray[np.int64]
    standing: Bools
    heights: Floats
    margins: Floats
    propped_margins: Floats


def along_moves(strokes: Floats) -> tuple[NDArray[np.int64], Floats]:
    """Strokes along the moves between waypoints, which are straight in motor space.

    Args:
        strokes: (count, legs, 3) of each waypoint, m.

    Returns:
        (m,) waypoint to which the robot is under way, 0 at the first one, and (m, legs, 3) the strokes
        there, m; `STEPS` a move after the first waypoint.
    """
    shares = np.arange(1, STEPS + 1) / STEPS
    ways = strokes[:-1, None] + shares[:, None, None] * (strokes[1:] - strokes[:-1])[:, None]
    moves = np.append(0, np.repeat(np.arange(1, len(strokes)), STEPS))
    return moves, np.concatenate([strokes[:1], ways.reshape(-1, *strokes.shape[1:])])


def executed_path(model: RobotModel, plan: WaypointPlan) -> ExecutedPath:
    """Follows the moves of a plan by forward kinematics.

    The motors share one ramp, so each move is straight in motor space (docs/firmware.md, Times). Feet,
    and the centre of mass over the robot's middle, are taken in the robot's frame; the robot is level but
    for what its standing feet say. It may stand still anywhere, so balance is that of the centre of
    mass; the ramps' 15 mm/s² move the centre of pressure by 0.1 mm.

    Args:
        model: a robot whose motors are free of each other.
        plan: at least two waypoints.
    """
    every, ways = along_moves(plan.waypoints.strokes)
    moves, feet = every[1:], feet_in_robot(model, ways[1:])
    at_end = np.arange(1, len(moves) + 1) % STEPS == 0
    standing = np.asarray(np.where(at_end[:, None], plan.contact[moves], plan.standing[moves]))
    middle = np.zeros((len(moves), 2))
    heights = heights_over_standing(feet, standing)
    hands_over = plan.contact[moves - 1] | plan.contact[moves]
    propped = standing | (hands_over & ~(heights > NEAR))
    return ExecutedPath(
        moves=moves,
        standing=standing,
        heights=heights,
        margins=stability_margins(middle, feet, standing),
        propped_margins=stability_margins(middle, feet, propped),
    )
