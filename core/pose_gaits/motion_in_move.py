"""Body and feet of a pose gait within its moves, by forward kinematics from the strokes alone."""

from dataclasses import dataclass

import numpy as np

from core.arrays import Bools, Floats
from core.motion.support_polygon import stability_margins
from core.motion.trajectory import Trajectory
from core.pose_gaits.pose_gait import PoseGait
from core.robot.arms import least_arm_gaps
from core.robot.kinematics import feet_in_robot

SAMPLES = 41
"""Places along a move that are looked at, both ends included; an odd number, so that the middle is one."""
ARM_STRIDE = 2
"""Arms are looked at at every second of these places."""
SHOWN_SAMPLES = 8
"""Places of each move at which its motion is shown."""
HEADING_ROOM = np.radians(10.0)
"""Within a move the heading is looked for as far as this from an even turn between its two poses, rad."""
LEAST_AREA = 1e-6
"""Standing feet that span less than about this have no plane of their own, m²."""
HEADING_ACCURACY = 1e-6


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


def motions_in_moves(gait: PoseGait, samples: int = SAMPLES) -> list[MotionInMove]:
    """Body and feet along every move, in which all motors go straight.

    The body is where the farthest of its standing feet is nearest to its foothold, axis by axis; where a gait
    turns or sways it is turned so that this distance is least.

    Args:
        gait: the gait.
        samples: places along each move, both ends included.
    """
    problem, legs = gait.problem, gait.problem.model.leg_count
    standing = ~problem.moving
    shares = np.linspace(0.0, 1.0, samples)
    first, last = (1.0 - shares)[:, None, None], shares[:, None, None]
    mixed = first * gait.strokes[:-1, None] + last * gait.strokes[1:, None]
    headings = (1 - shares) * gait.headings[:-1, None] + shares * gait.headings[1:, None]
    feet_robot = feet_in_robot(problem.model, mixed.reshape(-1, legs, 3)).reshape(mixed.shape)
    if problem.is_turned:
        headings = _fitting_headings(feet_robot, gait.feet[:-1], standing, headings)
    turned = _turned(feet_robot, headings)
    asked = gait.feet[:-1, None] - turned
    stands = standing[:, None, :, None]
    least = np.where(stands, asked, np.inf).min(axis=2)
    body = (least + np.where(stands, asked, -np.inf).max(axis=2)) / 2
    feet = turned + body[:, :, None]
    slips = np.where(stands, feet - gait.feet[:-1, None], 0.0)
    contact = np.repeat(standing, samples, axis=0)
    margins = stability_margins(body[..., :2].reshape(-1, 2), feet.reshape(-1, legs, 3), contact)
    arms = least_arm_gaps(problem.model, mixed[:, ::ARM_STRIDE])
    return [
        MotionInMove(
            shares,
            body[move],
            headings[move],
            arms[move],
            feet[move],
            margins.reshape(len(standing), samples)[move],
            slips[move],
            heights_over_plane(feet[move], standing[move]),
            standing[move],
        )
        for move in range(len(standing))
    ]


def _turned(feet: Floats, headings: Floats) -> Floats:
    """(moves, n, legs, 3) feet turned about z by a heading at each place.

    Args:
        feet: (moves, n, legs, 3) m.
        headings: (moves, n) rad.
    """
    cosine, sine = np.cos(headings)[..., None], np.sin(headings)[..., None]
    x, y = feet[..., 0], feet[..., 1]
    return np.stack([cosine * x - sine * y, sine * x + cosine * y, feet[..., 2]], axis=-1)


def _fitting_headings(feet_robot: Floats, footholds: Floats, standing: Bools, near: Floats) -> Floats:
    """(moves, n) headings with which the farthest standing foot is nearest to its foothold, rad.

    By golden section: for small turns the distance is convex in the heading.

    Args:
        feet_robot: (moves, n, legs, 3) in the body's frame, m.
        footholds: (moves, legs, 3) m.
        standing: (moves, legs) feet that count.
        near: (moves, n) headings about which to look, rad.
    """

    def farthest(headings: Floats) -> Floats:
        """(moves, n) horizontal distance of the farthest foot from its foothold, with the best body, m."""
        away = footholds[:, None, :, :2] - _turned(feet_robot, headings)[..., :2]
        counts = standing[:, None, :, None]
        most = np.where(counts, away, -np.inf).max(axis=2)
        return np.asarray((most - np.where(counts, away, np.inf).min(axis=2)).max(axis=-1) / 2.0)

    golden = (np.sqrt(5.0) - 1.0) / 2.0
    lower, upper = near - HEADING_ROOM, near + HEADING_ROOM
    left, right = upper - golden * (upper - lower), lower + golden * (upper - lower)
    at_left, at_right = farthest(left), farthest(right)
    while float((upper - lower).max()) > HEADING_ACCURACY:
        is_left = at_left < at_right
        lower, upper = np.where(is_left, lower, left), np.where(is_left, right, upper)
        # Of the two places within, one is known from before.
        fresh = np.where(is_left, upper - golden * (upper - lower), lower + golden * (upper - lower))
        at_fresh = farthest(fresh)
        left, right = np.where(is_left, fresh, right), np.where(is_left, left, fresh)
        at_left, at_right = np.where(is_left, at_fresh, at_right), np.where(is_left, at_left, at_fresh)
    return np.asarray((lower + upper) / 2.0)


def motion_along(gait: PoseGait, samples: int = SHOWN_SAMPLES) -> Trajectory:
    """The motion over the robot's time with places within each move, as its motors take it.

    Args:
        gait: the poses.
        samples: places of each move, its beginning left out.
    """
    own, times = gait.trajectory, [0.0]
    rows = [(own.body_world[0], own.heading[0], own.feet_world[0], own.contact[0])]
    height = np.array([0.0, 0.0, gait.problem.model.com_height])
    motions = motions_in_moves(gait, samples + 1)
    for move, (motion, seconds) in enumerate(zip(motions, gait.move_seconds, strict=True)):
        for place in range(1, samples + 1):
            times.append(float(own.times[move] + motion.shares[place] * seconds))
            is_end = place == samples
            contact = own.contact[move + 1] if is_end else motion.standing
            rows.append((motion.body[place] + height, motion.heading[place], motion.feet[place], contact))
    body, heading, feet, contact = (np.array(column) for column in zip(*rows, strict=True))
    return Trajectory(np.array(times), body, heading, feet, contact)


def least_arm_distance(gait: PoseGait) -> float:
    """Least room between the arms of neighbouring legs along all moves, m; below 0 they touch."""
    shares = np.linspace(0.0, 1.0, SAMPLES)[::ARM_STRIDE, None, None]
    mixed = (1 - shares) * gait.strokes[:-1, None] + shares * gait.strokes[1:, None]
    return float(least_arm_gaps(gait.problem.model, mixed).min())


def heights_over_plane(feet: Floats, standing: Bools) -> Floats:
    """(n, legs) heights of feet over the plane that fits the standing ones best, m."""
    corners = np.append(feet[:, standing, :2], np.ones((*feet[:, standing].shape[:2], 1)), axis=-1)
    everywhere = np.append(feet[..., :2], np.ones((*feet.shape[:2], 1)), axis=-1)
    transposed = np.swapaxes(corners, 1, 2)
    square = transposed @ corners
    if (np.linalg.det(square) > LEAST_AREA**2).all():
        planes = np.linalg.solve(square, transposed @ feet[:, standing, 2:])
    else:  # fewer than three feet, or feet in a line: the least inclined plane
        planes = np.linalg.pinv(corners) @ feet[:, standing, 2:]
    return np.asarray(feet[..., 2] - (everywhere @ planes)[..., 0])
