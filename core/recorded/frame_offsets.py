"""Recorded motions whose heights are not in this program's frame, and the motions put into it.

Here z = 0 is the platform height of a standing foot and the body's position is its centre of mass. Other
programs give the height of the actuator plane, `com_height` lower, or heights from which the `sole_depth` of
foot and shoe was subtracted, or that are measured from the floor.
"""

from dataclasses import dataclass, replace

import numpy as np

from core.arrays import Floats
from core.gait.options import GaitOptions
from core.motion.trajectory import Trajectory
from core.robot.kinematics import free_strokes
from core.robot.model import RobotModel
from core.wire.trajectory_csv import standing_feet

SAME_HEIGHT = 0.005
"""Feet whose standing height differs by less from what a frame explains are taken to be in it, m."""
MOST_EXCESS = 0.002
"""Mean over all motors and samples by which strokes may exceed their limits in the right frame, m.

Published recordings exceed them by up to 5 mm where a foot is lifted, on average by less than 0.2 mm; with
bodies 18 mm too low or too high it is more than 3 mm.
"""


MOST_ASIDE = 0.004
"""A motion that begins further above or below the standard stance is not explained by a frame, m."""


@dataclass(frozen=True)
class FrameOffsets:
    """What brings a recorded motion's heights into this program's frame.

    Args:
        body: to be added to the body's heights, m.
        feet: to be added to the feet's heights, m.
        sentence: what is off by how much, and the probable reason, for a person.
    """

    body: float
    feet: float
    sentence: str


@dataclass(frozen=True)
class _Frame:
    """Heights in multiples of `com_height` and `sole_depth` above where they belong."""

    plane: int
    sole: int

    def height(self, model: RobotModel) -> float:
        return self.plane * model.com_height + self.sole * model.sole_depth

    @property
    def reasons(self) -> str:
        reasons = (_PLANE_REASONS[self.plane], _SOLE_REASONS[self.sole])
        return " and ".join(reason for reason in reasons if reason)


_PLANE_REASONS = {
    -1: "given for the actuator plane instead of the centre of mass",
    0: "",
    1: "raised twice from the actuator plane to the centre of mass",
}
_SOLE_REASONS = {
    -1: "reduced by the depth of the sole",
    0: "",
    1: "measured from the floor instead of the platform of a standing foot",
}
_FEET_FRAMES = (_Frame(0, 0), _Frame(0, -1), _Frame(0, 1))
_BODY_FRAMES = (*_FEET_FRAMES, _Frame(-1, 0), _Frame(1, 0))


def frame_offsets(model: RobotModel, trajectory: Trajectory) -> FrameOffsets | None:
    """Recognises a recorded motion whose heights are in another frame.

    The lowest foot of most samples stands, so its height gives the feet's frame. The body's frame is one
    in which the strokes keep to their limits on average; of two such (`com_height` and `sole_depth` differ
    by a few mm only) the one in which the motion begins nearest to the standard stance.

    Args:
        model: the robot.
        trajectory: the motion as it was read.

    Returns:
        The offsets, or None where the heights are right or no known frame explains them.

    Raises:
        InputError: the trajectory has another number of feet than the robot.
    """
    trajectory.require_feet_of(model)
    lowest = float(np.median(trajectory.feet_world[..., 2].min(axis=1)))
    feet = min(_FEET_FRAMES, key=lambda frame: abs(lowest - frame.height(model)))
    if abs(lowest - feet.height(model)) > SAME_HEIGHT:
        return None
    grounded = _raised(trajectory, 0.0, -feet.height(model))
    if feet.sole == 0 and _mean_excess(model, grounded) <= MOST_EXCESS:
        return None
    body = _body_frame(model, grounded, feet)
    if body is None:
        return None
    offsets = (-body.height(model), -feet.height(model))
    return FrameOffsets(*offsets, _sentence(body, feet, offsets))


def raised_motion(trajectory: Trajectory, body: float, feet: float) -> Trajectory:
    """The motion with its heights raised, such as into this program's frame.

    Where feet are raised and none stood in some sample, as happens when contact was derived from heights in
    another frame, contact is derived anew.

    Args:
        trajectory: the motion.
        body: added to the body's heights, m.
        feet: added to the heights of the feet, m.
    """
    raised = _raised(trajectory, body, feet)
    if not feet or trajectory.contact.any(axis=1).all():
        return raised
    return replace(raised, contact=standing_feet(raised.feet_world))


def _body_frame(model: RobotModel, grounded: Trajectory, feet: _Frame) -> _Frame | None:
    """The frame of the body's heights; None where no frame explains them.

    Args:
        model: the robot.
        grounded: the motion with its feet in their right frame.
        feet: the frame in which the feet were given.
    """
    stance = GaitOptions.plane_height + model.com_height
    frames = [frame for frame in _BODY_FRAMES if feet.sole * frame.sole >= 0]
    possible = [
        frame
        for frame in (*frames, _Frame(-1, feet.sole))
        if _mean_excess(model, _raised(grounded, -frame.height(model), 0.0)) <= MOST_EXCESS
    ]
    start = float(grounded.body_world[0, 2])

    def aside(frame: _Frame) -> float:
        return abs(start - frame.height(model) - stance)

    return min((frame for frame in possible if aside(frame) <= MOST_ASIDE), key=aside, default=None)


def _mean_excess(model: RobotModel, trajectory: Trajectory) -> float:
    """Mean over samples and motors of how far strokes exceed their limits, m.

    An excess counts at most the motor's travel, which is also that of a foot that no rod reaches.
    """
    strokes = free_strokes(model, trajectory.feet_world, trajectory.pose(model))
    excess = np.maximum(model.stroke.lower - strokes, strokes - model.stroke.upper)
    travel = model.stroke.travel
    return float(np.clip(np.nan_to_num(excess, nan=travel), 0.0, travel).mean())


def _raised(trajectory: Trajectory, body: float, feet: float) -> Trajectory:
    """The motion with heights raised by so many m."""
    return replace(
        trajectory,
        body_world=trajectory.body_world + _upwards(body),
        feet_world=trajectory.feet_world + _upwards(feet),
        contact_forces=None,
    )


def _upwards(height: float) -> Floats:
    return np.array([0.0, 0.0, height])


def _sentence(body: _Frame, feet: _Frame, offsets: tuple[float, float]) -> str:
    """What is off, by how much and probably why."""
    if body == feet:
        return f"All heights are {_off(offsets[0])}; they are probably {body.reasons}."
    parts = []
    for name, frame, offset in (("body", body, offsets[0]), ("feet", feet, offsets[1])):
        if frame.reasons:
            parts.append(f"The heights of the {name} are {_off(offset)}; they are probably {frame.reasons}.")
    return " ".join(parts)


def _off(offset: float) -> str:
    return f"{abs(offset) * 1000:.0f} mm too {'low' if offset > 0 else 'high'}"
