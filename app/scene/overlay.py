"""What lies on the floor beside a plan: support polygon, traces of the balance points, swings, footholds."""

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from app.scene.poses import PoseBlob, node_names, pose_frames
from core.motion.balance import pressure_points
from core.motion.support_polygon import stability_margins
from core.motion.trajectory import Trajectory
from core.robot.model import RobotModel

FRAMES_A_SECOND = 20.0
"""Of a plan's poses; the page draws the poses between them."""

MOST_POSES = 60_000
"""Frames × nodes of a plan, 1.7 MB: what an edit of a long gait of many feet may ask for again and again."""


def overlay_table(
    model: RobotModel, trajectory: Trajectory, stops: ArrayLike | None = None
) -> dict[str, Any]:
    """What the page draws on the floor, as JSON values (s, m).

    Keys: floor (its height), times, com, cop (None where accelerations are unknown), feet, contact, margins,
    stops (numbers of the samples at which the robot stops, each of which gets a mark).

    Args:
        model: the robot.
        trajectory: in the world frame.
        stops: (n,) times at which the robot stops, s; None where no mark is wanted.
    """
    marked = [] if stops is None else np.abs(trajectory.times - np.asarray(stops)[:, None]).argmin(axis=1)
    pressure = pressure_points(model, trajectory)
    margins = stability_margins(trajectory.body_world[:, :2], trajectory.feet_world, trajectory.contact)
    finite = np.where(np.isfinite(margins), margins, -1.0)
    return {
        "floor": -model.sole_depth,
        "times": _rounded(trajectory.times),
        "com": _rounded(trajectory.body_world),
        "cop": None if pressure is None else _rounded(pressure),
        "feet": _rounded(trajectory.feet_world),
        "contact": trajectory.contact.tolist(),
        "margins": _rounded(finite),
        "stops": np.asarray(marked, int).tolist(),
    }


def plan_poses(model: RobotModel, trajectory: Trajectory, stops: ArrayLike | None = None) -> PoseBlob:
    """Everything that the preview needs of a plan: its poses with its overlay (see `pose_frames`).

    Args:
        model: the robot.
        trajectory: in the world frame.
        stops: see `overlay_table`.
    """
    blob = pose_frames(
        model,
        trajectory.times,
        trajectory.body_world,
        trajectory.heading,
        trajectory.feet_world,
        frames_a_second(model, trajectory),
    )
    return replace(blob, overlay=overlay_table(model, trajectory, stops))


def frames_a_second(model: RobotModel, trajectory: Trajectory) -> float:
    """How many frames of a plan are sent: fewer where it has many nodes and is long.

    Never fewer than its own samples; several a sample so that even samples have frames of their own.
    """
    span = float(trajectory.times[-1] - trajectory.times[0])
    most = MOST_POSES / len(node_names(model))
    if span * FRAMES_A_SECOND <= most:
        return FRAMES_A_SECOND
    samples = len(trajectory.times) - 1
    return samples * max(1, int(most / samples)) / span


def _rounded(values: ArrayLike) -> Any:
    # A micrometre is finer than any pixel, and the text stays short.
    return np.round(np.asarray(values), 6).tolist()
