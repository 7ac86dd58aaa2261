"""Poses of everything that moves, for a whole plan at once; the browser plays them by its own clock.

Layout of the bytes, little-endian: a 4-byte unsigned length of the header; the header, JSON in UTF-8, padded
with spaces so that what follows starts at a multiple of 4; then frames × nodes × 7 float32: quaternion w, x,
y, z, then x, y, z in m, of each node in the world. Header keys: `format` ("footfall-poses"), `version` (1),
`robot`, `nodes` (names), `frames` (count), `start` and `step` (s), and `overlay` where there is one.
"""

import json
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from core.arrays import Floats
from core.errors import InputError
from core.robot.closed_chain import BODY, TWINS, foot_link, knee_link, knee_yaws, rod_angles, rod_link
from core.robot.coupled_strokes import real_feet
from core.robot.kinematics import actuator_plane_pose, feet_in_modules
from core.robot.leg import strokes_from_foot, vertex_directions
from core.robot.model import RobotModel

ROBOT_ROOT = "/robot"
"""Scene path under which every link's node stands."""

COM_NODE = "/overlay/com"
"""Scene path of the marker on the floor under the centre of mass."""

FLOOR_GAP = 0.0004
"""How far above the floor the flat marks lie, m, so that they don't flicker."""

_HEADER_ALIGNMENT = 4


@dataclass(frozen=True, eq=False)
class PoseBlob:
    """Poses of all nodes at evenly spaced times.

    Args:
        robot: the robot's name.
        names: scene path of each node.
        times: (frames,) s.
        frames: (frames, nodes, 7) quaternion wxyz and position xyz in the world, m.
        overlay: what lies on the floor, as JSON values, or None.
    """

    robot: str
    names: tuple[str, ...]
    times: Floats
    frames: NDArray[np.float32]
    overlay: dict[str, Any] | None = None

    def to_bytes(self) -> bytes:
        """The binary that goes to the browser once a plan (layout: see the module)."""
        step = float(self.times[1] - self.times[0]) if len(self.times) > 1 else 0.0
        header = {
            "format": "footfall-poses",
            "version": 1,
            "robot": self.robot,
            "nodes": list(self.names),
            "frames": len(self.times),
            "start": float(self.times[0]),
            "step": step,
            "overlay": self.overlay,
        }
        text = json.dumps(header, separators=(",", ":"), allow_nan=False).encode()
        text += b" " * (-len(text) % _HEADER_ALIGNMENT)
        return len(text).to_bytes(4, "little") + text + self.frames.astype("<f4").tobytes()


def node_names(model: RobotModel) -> tuple[str, ...]:
    """Scene paths of the moving nodes in the order of a blob: body, knees, rods, feet, mark of the mass."""
    legs = range(model.leg_count)
    links = [BODY]
    links += [knee_link(leg, motor) for leg in legs for motor in range(3)]
    links += [rod_link(leg, motor, twin) for leg in legs for motor in range(3) for twin in TWINS]
    links += [foot_link(leg) for leg in legs]
    return (*(f"{ROBOT_ROOT}/{link}" for link in links), COM_NODE)


def pose_frames(
    model: RobotModel,
    times: Floats,
    com_world: Floats,
    heading: Floats,
    feet_world: Floats,
    fps: float = 20.0,
) -> PoseBlob:
    """Poses of all nodes, linear between knots; the chains are closed at every frame.

    A foot out of its rods' reach is drawn with the motors run out and a visible gap.

    Args:
        model: the robot.
        times: (n,) s, increasing.
        com_world: (n, 3) centre of mass, m.
        heading: (n,) rad.
        feet_world: (n, legs, 3) platform centres, m.
        fps: least number of frames a second of the plan.

    Raises:
        InputError: the arrays don't fit each other or the robot.
    """
    n = len(times)
    if not (len(com_world) == len(heading) == len(feet_world) == n and n >= 1):
        raise InputError(
            f"{n} times for {len(com_world)} body and {len(feet_world)} foot positions; give one each.",
            "times",
        )
    if feet_world.shape[1:] != (model.leg_count, 3):
        raise InputError(f"{feet_world.shape[1]} feet for a robot of {model.leg_count} legs.", "feet_world")
    wanted = _even_times(np.asarray(times, dtype=np.float64), fps)
    flat = np.concatenate([com_world, heading[:, None], feet_world.reshape(n, -1)], axis=1)
    values = _interpolated(wanted, times, flat)
    com, turn = values[:, :3], values[:, 3]
    feet = values[:, 4:].reshape(-1, model.leg_count, 3)
    frames = _frames(model, com, turn, feet)
    return PoseBlob(model.name, node_names(model), wanted, frames)


def _even_times(times: Floats, fps: float) -> Floats:
    count = max(int(np.ceil((times[-1] - times[0]) * fps - 1e-9)), 0) + 1
    return np.asarray(np.linspace(times[0], times[-1], count))


def _interpolated(wanted: Floats, times: Floats, values: Floats) -> Floats:
    if len(times) == 1:
        return values
    after = np.clip(np.searchsorted(times, wanted, side="right"), 1, len(times) - 1)
    part = ((wanted - times[after - 1]) / (times[after] - times[after - 1]))[:, None]
    return np.asarray(values[after - 1] * (1 - part) + values[after] * part)


def _frames(model: RobotModel, com: Floats, heading: Floats, feet: Floats) -> NDArray[np.float32]:
    pose = actuator_plane_pose(model, com, heading)
    feet = real_feet(model, feet, pose)
    feet_module = feet_in_modules(model, feet, pose)
    exact = strokes_from_foot(model.leg, feet_module)
    strokes = np.where(np.isnan(exact), model.stroke.travel, exact)
    angles = rod_angles(model.leg, strokes, feet_module)
    count, legs = len(com), model.leg_count
    arms = 3 * legs
    frames = np.zeros((count, 2 + 3 * arms + legs, 7))
    body, knees = frames[:, 0], frames[:, 1 : 1 + arms]
    rods = frames[:, 1 + arms : 1 + 3 * arms].reshape(count, arms, 2, 7)
    foot_frames, mark = frames[:, 1 + 3 * arms : -1], frames[:, -1]

    yaw_of_leg = heading[:, None] + model.azimuths - np.pi / 2
    yaw_of_knee = (yaw_of_leg[:, :, None] + knee_yaws()).reshape(count, arms)
    body[:, :4], body[:, 4:] = _yaw_quaternion(heading), pose.position_world
    knees[..., :4] = _yaw_quaternion(yaw_of_knee)
    knees[..., 4:] = _knee_positions(model, yaw_of_leg, heading, strokes, pose.position_world)
    tilt = _rod_quaternion(yaw_of_knee, angles.reshape(count, arms, 2))
    across = np.stack([-np.sin(yaw_of_knee), np.cos(yaw_of_knee), np.zeros_like(yaw_of_knee)], axis=-1)
    for twin, side in enumerate((-0.5, 0.5)):
        rods[:, :, twin, :4] = tilt
        rods[:, :, twin, 4:] = knees[..., 4:] + side * model.shape.rod_spacing * across
    frames[:, 1 + arms : 1 + 3 * arms] = rods.reshape(count, 2 * arms, 7)
    foot_frames[..., :4], foot_frames[..., 4:] = _yaw_quaternion(yaw_of_leg), feet
    mark[:, 0], mark[:, 4:6], mark[:, 6] = 1.0, com[:, :2], -model.sole_depth + 3 * FLOOR_GAP
    return frames.astype(np.float32)


def _knee_positions(
    model: RobotModel, yaw_of_leg: Floats, heading: Floats, strokes: Floats, origin: Floats
) -> Floats:
    count, legs = yaw_of_leg.shape
    azimuth = heading[:, None] + model.azimuths
    centre = model.radius * np.stack([np.cos(azimuth), np.sin(azimuth)], axis=-1)
    cosine, sine = np.cos(yaw_of_leg)[..., None], np.sin(yaw_of_leg)[..., None]
    out = model.leg.base_radius * vertex_directions()
    x = cosine * out[:, 0] - sine * out[:, 1] + centre[..., 0:1] + origin[:, None, 0:1]
    y = sine * out[:, 0] + cosine * out[:, 1] + centre[..., 1:2] + origin[:, None, 1:2]
    z = origin[:, None, 2:3] - strokes
    return np.stack([x, y, z], axis=-1).reshape(count, 3 * legs, 3)


def _yaw_quaternion(yaw: Floats) -> Floats:
    zero = np.zeros_like(yaw)
    return np.stack([np.cos(yaw / 2), zero, zero, np.sin(yaw / 2)], axis=-1)


def _rod_quaternion(yaw: Floats, angles: Floats) -> Floats:
    """Quaternion of R_z(yaw) R_y(lean) R_x(sway)."""
    cz, sz = np.cos(yaw / 2), np.sin(yaw / 2)
    cy, sy = np.cos(angles[..., 0] / 2), np.sin(angles[..., 0] / 2)
    cx, sx = np.cos(angles[..., 1] / 2), np.sin(angles[..., 1] / 2)
    return np.stack(
        [
            cz * cy * cx + sz * sy * sx,
            cz * cy * sx - sz * sy * cx,
            cz * sy * cx + sz * cy * sx,
            sz * cy * cx - cz * sy * sx,
        ],
        axis=-1,
    )
