"""A robot of lines: another version of a gait, drawn quietly beside the one that is looked at."""

from dataclasses import replace

import numpy as np

from app.scene.poses import ROBOT_ROOT, PoseBlob, pose_frames
from core.arrays import Floats
from core.motion.trajectory import Trajectory
from core.robot.closed_chain import BODY, foot_link, rod_link
from core.robot.leg import vertex_directions
from core.robot.model import RobotModel

FRAMES_A_SECOND = 10.0
"""Least number of a ghost's frames; the page draws the poses between them."""

ROUND_CORNERS = 8
"""Of a foot's outline; lines are dear where there is no GPU."""


def ghost_blob(model: RobotModel, trajectory: Trajectory, fps: float = FRAMES_A_SECOND) -> PoseBlob:
    """Poses of the body, an arm's rod for each motor, and the feet, with their lines as `overlay["lines"]`.

    Args:
        model: the robot.
        trajectory: what it does.
        fps: least number of frames a second.

    Returns:
        The blob; lines are (pieces, 2, 3) a node, in the node's frame, m, as JSON values.
    """
    blob = pose_frames(
        model,
        trajectory.times,
        trajectory.body_world,
        trajectory.heading,
        trajectory.feet_world,
        fps,
    )
    lines = part_lines(model)
    # One line in the middle stands for the two rods of an arm, which lie the same way beside each other.
    first = [blob.names.index(name) for name in lines]
    last = [blob.names.index(_twin(name)) for name in lines]
    frames = np.asarray((blob.frames[:, first] + blob.frames[:, last]) / 2, dtype=np.float32)
    drawn = [np.round(pieces, 5).tolist() for pieces in lines.values()]
    return replace(blob, names=tuple(lines), frames=frames, overlay={"lines": drawn})


def _twin(name: str) -> str:
    """Scene path of a rod's twin; of every other part its own."""
    return f"{name.removesuffix('a')}b" if "_rod" in name else name


def part_lines(model: RobotModel) -> dict[str, Floats]:
    """(pieces, 2, 3) lines of each part by its scene path, in the part's own frame, m."""
    legs = range(model.leg_count)
    rod = np.array([[[0.0, 0.0, 0.0], [0.0, 0.0, -model.leg.link_length]]])
    foot = _foot(model)
    parts = {BODY: _body(model)}
    parts |= {rod_link(leg, motor, "a"): rod for leg in legs for motor in range(3)}
    parts |= {foot_link(leg): foot for leg in legs}
    return {f"{ROBOT_ROOT}/{link}": lines for link, lines in parts.items()}


def _body(model: RobotModel) -> Floats:
    """Both plates' outlines, and a post where each motor stands."""
    shape, sides = model.shape, 2 * model.leg_count
    corner = shape.plate_across / 2 / np.cos(np.pi / sides)
    heights = (shape.lower_plate_height, shape.upper_plate_height)
    plates = [_ring(corner, height, sides, np.pi / sides) for height in heights]
    base = np.zeros((3, 3))
    base[:, :2] = model.leg.base_radius * vertex_directions()
    motors = (
        base @ model.R_robot_from_module.transpose(0, 2, 1) + model.module_centres_robot[:, None]
    ).reshape(-1, 3)
    posts = np.stack([motors, motors + np.array([0.0, 0.0, heights[1]])], axis=1)
    return np.concatenate([*plates, posts])


def _foot(model: RobotModel) -> Floats:
    """The sole's outline, and the stem up to the platform."""
    radius = model.shape.foot_diameter / 2
    sole = np.array([0.0, 0.0, -model.sole_depth])
    stem = np.array([[[x, 0.0, 0.0], [x, 0.0, sole[2]]] for x in (-radius, radius)])
    return np.concatenate([_ring(radius, float(sole[2]), ROUND_CORNERS), stem])


def _ring(radius: float, height: float, corners: int, first: float = 0.0) -> Floats:
    angles = first + 2 * np.pi * np.arange(corners) / corners
    points = np.stack([radius * np.cos(angles), radius * np.sin(angles), np.full(corners, height)], axis=-1)
    return np.stack([points, np.roll(points, -1, axis=0)], axis=1)
