"""Rows that keep the arms of neighbouring legs apart, where a motion brings them near each other.

An arm is a flat parallelogram, so two arms are apart by a distance where a plane between them leaves half of
it to the corners of either. A row for every two arms at every place would be ten times the program; so a
motion is found first, and the planes stand only where it brings two arms near each other.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np
from casadi import DM, SX, vertcat

from core.arrays import Floats
from core.pose_gaits.pose_gait import PoseGait
from core.pose_gaits.pose_problem import FRACTIONS
from core.pose_gaits.start_motion import MM
from core.robot.arms import arm_bars, nearest_points
from core.robot.leg import vertex_directions
from core.robot.model import RobotModel
from core.robot.shoes import neighbour_pairs
from solver_jobs.pose_gaits.turning import turned

NEAR = 0.002
"""Arms that are this much farther apart than asked get a row too: the next motion may bring them near, m."""


@dataclass(frozen=True)
class ArmPlace:
    """Two arms of neighbouring legs at a place of a move.

    Args:
        move: counted from 0.
        share: of the move, 0 at the pose with which it begins.
        legs: of the two arms, counted from 0.
        arms: by their motor in the leg, counted from 0.
    """

    move: int
    share: float
    legs: tuple[int, int]
    arms: tuple[int, int]


@dataclass(frozen=True)
class Plane:
    """Between two arms: n · p = c in the robot's frame, with n towards the first arm.

    Args:
        normal: (3,) n.
        offset: c, mm.
    """

    normal: tuple[float, float, float]
    offset: float


@dataclass(frozen=True, eq=False)
class ArmRows:
    """Arms that have to keep apart.

    Args:
        distance: room between the bars of two arms, m.
        planes: where, each with the plane between them from which the search starts.
    """

    distance: float
    planes: Mapping[ArmPlace, Plane]


NO_ARMS = ArmRows(0.0, MappingProxyType({}))


def near_arms(gait: PoseGait, distance: float) -> dict[ArmPlace, Plane]:
    """Arms that come near each other, and a plane half way between them.

    Args:
        gait: the motion.
        distance: room that is asked for, m.
    """
    model = gait.problem.model
    places = [(move, share) for move in range(gait.problem.move_count) for share in (0.0, *FRACTIONS)]
    strokes = [(1 - share) * gait.strokes[move] + share * gait.strokes[move + 1] for move, share in places]
    bars = arm_bars(model, np.array(strokes))
    found: dict[ArmPlace, Plane] = {}
    for one, other in neighbour_pairs(model.leg_count).tolist():
        for first in range(3):
            for second in range(3):
                nearest = nearest_points(bars[:, one, first, :, None], bars[:, other, second, None])
                gaps = nearest.distances.reshape(len(places), -1) - model.shape.rod_diameter
                closest = gaps.argmin(axis=1)
                for place in np.nonzero(gaps.min(axis=1) < distance + NEAR)[0].tolist():
                    bar = np.unravel_index(closest[place], nearest.distances.shape[1:])
                    plane = _half_way(nearest.first[place][bar], nearest.second[place][bar])
                    found[ArmPlace(*places[place], (one, other), (first, second))] = plane
    return found


def _half_way(first: Floats, second: Floats) -> Plane:
    """The plane in the middle of two points, m."""
    away = first - second
    normal = away / np.linalg.norm(away)
    middle = normal @ (first + second) / 2 * MM
    return Plane((float(normal[0]), float(normal[1]), float(normal[2])), float(middle))


def arm_corners(
    model: RobotModel, leg: int, arm: int, body: SX, foot: SX, stroke: SX, heading: SX | float
) -> Iterator[SX]:
    """The four corners of an arm in the robot's frame, (3,) mm each (numpy: `core.robot.arms.arm_bars`).

    Args:
        model: the robot.
        leg: counted from 0.
        arm: its motor, counted from 0.
        body: (3,) mm.
        foot: (3,) platform centre, mm.
        stroke: of the arm's motor, mm.
        heading: of the body, rad.
    """
    direction = vertex_directions()[arm]
    outwards = np.append(direction, 0.0) * MM
    across = np.array([-direction[1], direction[0], 0.0]) * model.shape.rod_spacing / 2 * MM
    rotation = model.R_robot_from_module[leg]
    centre = model.module_centres_robot[leg] * MM + rotation @ (model.leg.base_radius * outwards)
    knee = DM(centre) - vertcat(0.0, 0.0, stroke)
    foot_robot = vertcat(turned(foot[:2] - body[:2], -heading), foot[2] - body[2])
    vertex = foot_robot + DM(rotation @ (model.leg.platform_radius * outwards))
    for end in (knee, vertex):
        yield end - DM(rotation @ across)
        yield end + DM(rotation @ across)
