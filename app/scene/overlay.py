"""What lies on the floor beside a plan: support polygon, centre-of-mass trace, swings and footholds."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from app.scene.poses import PoseBlob, pose_frames
from core.robot import RobotModel
from core.support import stability_margins
from core.trajectory import Trajectory


def overlay_table(trajectory: Trajectory) -> dict[str, Any]:
    """What the page draws on the floor, as JSON values (s, m): times, com, feet, contact, margins."""
    margins = stability_margins(trajectory.body_world[:, :2], trajectory.feet_world, trajectory.contact)
    finite = np.where(np.isfinite(margins), margins, -1.0)
    return {
        "times": _rounded(trajectory.times),
        "com": _rounded(trajectory.body_world),
        "feet": _rounded(trajectory.feet_world),
        "contact": trajectory.contact.tolist(),
        "margins": _rounded(finite),
    }


def plan_poses(model: RobotModel, trajectory: Trajectory, fps: float = 20.0) -> PoseBlob:
    """Everything that the preview needs of a plan: its poses with its overlay (see `pose_frames`)."""
    blob = pose_frames(
        model, trajectory.times, trajectory.body_world, trajectory.heading, trajectory.feet_world, fps
    )
    return replace(blob, overlay=overlay_table(trajectory))


def _rounded(values: ArrayLike) -> Any:
    # A micrometre is finer than any pixel, and the text stays short.
    return np.round(np.asarray(values), 6).tolist()
