"""The simulated robot as a ghost that leans and sinks as physics has it, and what its feet do to the ground.

A ghost of a plan keeps level. Here the chains are closed in the body's own frame, in which a delta's feet are
level whatever the body does, and the body's pose is laid over them.
"""

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.scene.ghost import ghost_blob
from app.scene.poses import PoseBlob
from core.arrays import Floats, interpolated
from core.motion.trajectory import Trajectory
from core.physics.metrics import rotations
from core.robot.model import RobotModel

FRAMES_A_SECOND = 20.0
"""Least number of the ghost's frames; the page draws the poses between them."""


def simulated_blob(model: RobotModel, motion: dict[str, Any]) -> PoseBlob:
    """Poses of a simulated robot's parts, with their lines, contacts and slip marks as `overlay`.

    Args:
        model: the robot.
        motion: `times` (n,) on the plan's axis, s; `body` (n, 3) m; `attitude` (n, 4) quaternion w, x, y, z;
            `feet` (n, legs, 3) m; `contact` (n, legs); `slips`, each with its `way`, two points, m.

    Returns:
        The blob; `overlay["contacts"]` has a string of 0 and 1 a frame, foot 1 first, and
        `overlay["slips"]` (k, 2, 3) lines on the floor, m.
    """
    times = np.array(motion["times"])
    grows = np.append(True, times[1:] > np.maximum.accumulate(times)[:-1])
    times = times[grows]
    body, attitude = np.array(motion["body"])[grows], np.array(motion["attitude"])[grows]
    feet, contact = np.array(motion["feet"])[grows], np.array(motion["contact"])[grows]
    rotation = rotations(attitude)
    origin = body - model.com_height * rotation[:, :, 2]
    feet_body = np.einsum("nji,nlj->nli", rotation, feet - origin[:, None])
    blob = _in_body(model, times, feet_body, contact)
    after = np.clip(np.searchsorted(times, blob.times, side="right"), 1, len(times) - 1)
    at = interpolated(blob.times, times, origin)
    frames = _placed(blob.frames, at, _mixed(blob.times, times, attitude, after))
    nearest = np.where(blob.times - times[after - 1] < times[after] - blob.times, after - 1, after)
    floor = np.array([0.0, 0.0, -model.sole_depth])
    overlay = {
        **(blob.overlay or {}),
        "sole": model.sole_depth,
        "contacts": ["".join("1" if carries else "0" for carries in row) for row in contact[nearest]],
        "slips": [(np.array(slip["way"]) * [1, 1, 0] + floor).round(5).tolist() for slip in motion["slips"]],
    }
    return replace(blob, frames=frames, overlay=overlay)


def _in_body(model: RobotModel, times: Floats, feet_body: Floats, contact: NDArray[np.bool_]) -> PoseBlob:
    """Poses of all parts in the body's own frame; simulated feet are where they are, coupled or not."""
    level = np.tile([0.0, 0.0, model.com_height], (len(times), 1))
    motion = Trajectory(times, level, np.zeros(len(times)), feet_body, contact)
    return ghost_blob(replace(model, coupling=np.eye(model.motor_count)), motion, FRAMES_A_SECOND)


def _mixed(wanted: Floats, times: Floats, attitude: Floats, after: NDArray[np.int64]) -> Floats:
    """(k, 4) attitudes between samples: linear, normed, by the shorter way."""
    low, high = attitude[after - 1], attitude[after]
    high = high * np.where((low * high).sum(axis=-1, keepdims=True) < 0, -1.0, 1.0)
    part = ((wanted - times[after - 1]) / (times[after] - times[after - 1]))[:, None]
    mixed = low * (1 - part) + high * part
    return np.asarray(mixed / np.linalg.norm(mixed, axis=-1, keepdims=True))


def _placed(frames: NDArray[np.float32], origin: Floats, attitude: Floats) -> NDArray[np.float32]:
    """(k, nodes, 7) poses in the body's frame, carried to the world by its pose."""
    rotation = rotations(attitude)
    placed = np.empty_like(frames)
    placed[..., 4:] = np.einsum("kij,knj->kni", rotation, frames[..., 4:]) + origin[:, None]
    w, x, y, z = np.moveaxis(frames[..., :4], -1, 0)
    a, b, c, d = np.moveaxis(attitude[:, None], -1, 0)
    placed[..., 0] = a * w - b * x - c * y - d * z
    placed[..., 1] = a * x + b * w + c * z - d * y
    placed[..., 2] = a * y - b * z + c * w + d * x
    placed[..., 3] = a * z + b * y - c * x + d * w
    return placed
