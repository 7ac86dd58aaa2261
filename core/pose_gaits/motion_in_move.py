"""Body and feet of a pose gait within its moves, by forward kinematics from the strokes alone."""

from dataclasses import dataclass

import numpy as np

from core.arrays import Bools, Floats
from core.motion.support_polygon import stability_margins
from core.motion.trajectory import Trajectory
from core.pose_gaits.pose_gait import PoseGait
from core.problem.motion_problem import turned_about_z
from core.robot.arms import arm_gaps
from core.wire.waypoint_merging import robot_feet

SAMPLES = 41
"""Places along a move that are looked at, both ends included; an odd number, so that the middle is one."""
ARM_STRIDE = 2
"""Arms are looked at at every second of these places."""
SHOWN_SAMPLES = 8
"""Places of each move at which its motion is shown."""
HEADING_ROOM = np.radians(10.0)
"""Within a move the heading is looked for as far as this from an even turn between its two poses, rad."""
HEADING_ACCURACY = 1e-8


@dataclass(frozen=True)
class MotionInMove:
    """Body and feet along one move, as forward kinematics and the standing feet say.

    Args:
        shares: (n,) of the move.
        body: (n, 3) point of the body axis in the actuator plane, m.
        heading: (n,) rad.
        arms: (pairs,) least room between the arms of each two neighbouring legs, m.
        feet: (n, legs, 3) platform centres, m.
        margins: (n,) static stability margin, m.
        slips: (n, legs, 3) of each standing foot from its foothold, 0 for the others, m.
        heights: (n, legs) over the plane of the standing feet, m.
        standing: (legs,) feet that stand throughout.
    """

    shares: Floats
    body: Floats
    heading: Floats
    arms: Floats
    feet: Floats
    margins: Floats
    slips: Floats
    heights: Floats
    standing: Bools


def motion_in_move(gait: PoseGait, move: int, samples: int = SAMPLES) -> MotionInMove:
    """Body and feet along a move whose motors all go straight.

    The body is where the farthest of its standing feet is nearest to its foothold, axis by axis; where a gait
    turns or sways it is turned so that this distance is least.

    Args:
        gait: the gait.
        move: counted from 0.
        samples: places along it, both ends included.
    """
    problem = gait.problem
    standing = ~problem.moving[move]
    shares = np.linspace(0.0, 1.0, samples)
    mixed = np.array([(1 - s) * gait.strokes[move] + s * gait.strokes[move + 1] for s in shares])
    headings = (1 - shares) * gait.headings[move] + shares * gait.headings[move + 1]
    feet_robot = robot_feet(problem.model, mixed)
    if problem.is_turned:
        headings = _fitting_headings(feet_robot[:, standing], gait.feet[move][standing], headings)
    turned = np.array([turned_about_z(feet, angle) for feet, angle in zip(feet_robot, headings, strict=True)])
    asked = gait.feet[move][standing] - turned[:, standing]
    body = (asked.min(axis=1) + asked.max(axis=1)) / 2
    feet = turned + body[:, None]
    slips = np.where(standing[:, None], feet - gait.feet[move], 0.0)
    margins = stability_margins(body[:, :2], feet, np.tile(standing, (samples, 1)))
    arms = np.nan_to_num(arm_gaps(problem.model, mixed[::ARM_STRIDE]), nan=np.inf).min(axis=0)
    heights = heights_over_plane(feet, standing)
    return MotionInMove(shares, body, headings, arms, feet, margins, slips, heights, standing)


def _fitting_headings(feet_robot: Floats, footholds: Floats, near: Floats) -> Floats:
    """(n,) headings with which the farthest standing foot is nearest to its foothold, by golden section, rad.

    For small turns the distance is convex in the heading.

    Args:
        feet_robot: (n, standing, 3) in the body's frame, m.
        footholds: (standing, 3) m.
        near: (n,) headings about which to look, rad.
    """
    lower, upper = near - HEADING_ROOM, near + HEADING_ROOM
    golden = (np.sqrt(5.0) - 1.0) / 2.0
    while float((upper - lower).max()) > HEADING_ACCURACY:
        left, right = upper - golden * (upper - lower), lower + golden * (upper - lower)
        is_left = _farthest(feet_robot, footholds, left) < _farthest(feet_robot, footholds, right)
        lower, upper = np.where(is_left, lower, left), np.where(is_left, right, upper)
    return np.asarray((lower + upper) / 2.0)


def _farthest(feet_robot: Floats, footholds: Floats, headings: Floats) -> Floats:
    """(n,) horizontal distance of the farthest foot from its foothold, axis by axis, with the best body."""
    cosine, sine = np.cos(headings)[:, None], np.sin(headings)[:, None]
    x, y = feet_robot[..., 0], feet_robot[..., 1]
    away = footholds[:, :2] - np.stack([cosine * x - sine * y, sine * x + cosine * y], axis=-1)
    return np.asarray((away.max(axis=1) - away.min(axis=1)).max(axis=1) / 2.0)


def motion_along(gait: PoseGait, samples: int = SHOWN_SAMPLES) -> Trajectory:
    """The motion over the robot's time with places within each move, as its motors take it.

    Args:
        gait: the poses.
        samples: places of each move, its beginning left out.
    """
    own, times = gait.trajectory, [0.0]
    rows = [(own.body_world[0], own.heading[0], own.feet_world[0], own.contact[0])]
    height = np.array([0.0, 0.0, gait.problem.model.com_height])
    for move, seconds in enumerate(gait.move_seconds):
        motion = motion_in_move(gait, move, samples + 1)
        for place in range(1, samples + 1):
            times.append(float(own.times[move] + motion.shares[place] * seconds))
            is_end = place == samples
            contact = own.contact[move + 1] if is_end else motion.standing
            rows.append((motion.body[place] + height, motion.heading[place], motion.feet[place], contact))
    body, heading, feet, contact = (np.array(column) for column in zip(*rows, strict=True))
    return Trajectory(np.array(times), body, heading, feet, contact)


def least_arm_distance(gait: PoseGait) -> float:
    """Least room between the arms of neighbouring legs along all moves, m; below 0 they touch."""
    shares = np.linspace(0.0, 1.0, SAMPLES)[::ARM_STRIDE, None, None, None]
    mixed = (1 - shares) * gait.strokes[:-1] + shares * gait.strokes[1:]
    return float(np.nanmin(arm_gaps(gait.problem.model, mixed.reshape(-1, *gait.strokes.shape[1:]))))


def heights_over_plane(feet: Floats, standing: Bools) -> Floats:
    """(n, legs) heights of feet over the plane that fits the standing ones best, m."""
    corners = np.append(feet[:, standing, :2], np.ones((*feet[:, standing].shape[:2], 1)), axis=-1)
    everywhere = np.append(feet[..., :2], np.ones((*feet.shape[:2], 1)), axis=-1)
    planes = np.linalg.pinv(corners) @ feet[:, standing, 2:]
    return np.asarray(feet[..., 2] - (everywhere @ planes)[..., 0])
