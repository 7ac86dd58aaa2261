"""Motions that leave the motors' range, and what keeps them within it."""

from dataclasses import dataclass, replace

import numpy as np

from core.arrays import Floats
from core.errors import InputError
from core.motion.trajectory import Trajectory, difference_velocities
from core.robot.kinematics import free_strokes, walker_feet
from core.robot.model import RobotModel

MOST_CLIPPED = 0.005
"""A stroke that is further beyond its range is not clipped: the motion would be another one, m."""
NOT_CLIPPED = 1e-9
"""Strokes this near their range are within it, m."""


@dataclass(frozen=True, eq=False)
class ClippedMotion:
    """A motion whose strokes were kept within the motors' range.

    Args:
        trajectory: its feet are where the clipped strokes put them; the body is as it was.
        clipped: (n, legs, 3) how far each stroke was beyond its range, m.
    """

    trajectory: Trajectory
    clipped: Floats


@dataclass(frozen=True)
class ClippedPlace:
    """How far a foot's strokes were clipped at a sample.

    Args:
        sample: 0-based.
        foot: 0-based.
        by: the largest of its three motors, m.
    """

    sample: int
    foot: int
    by: float


def clipped_motion(model: RobotModel, trajectory: Trajectory) -> ClippedMotion:
    """Keeps every stroke within the motors' range; the feet go along.

    Args:
        model: the robot.
        trajectory: the motion.

    Raises:
        InputError: the robot has another number of feet, a stroke is more than `MOST_CLIPPED` beyond its
            range, or no rod is long enough for a foot.
    """
    trajectory.require_feet_of(model)
    pose = trajectory.pose(model)
    kept = clipped_strokes(model, free_strokes(model, trajectory.feet_world, pose))
    if not kept.beyond.any():
        return ClippedMotion(trajectory, kept.beyond)
    is_moved = np.any(kept.beyond > 0, axis=-1, keepdims=True)
    feet = np.where(is_moved, walker_feet(model, kept.strokes, pose), trajectory.feet_world)
    speeds = None
    if trajectory.feet_velocity is not None:
        speeds = difference_velocities(trajectory.times, feet)
    moved = replace(trajectory, feet_world=feet, feet_velocity=speeds, contact_forces=None)
    return ClippedMotion(moved, kept.beyond)


@dataclass(frozen=True, eq=False)
class ClippedStrokes:
    """Strokes that were kept within the motors' range.

    Args:
        strokes: (n, legs, 3) within it, m.
        beyond: (n, legs, 3) how far each was beyond it, m.
    """

    strokes: Floats
    beyond: Floats


def clipped_strokes(model: RobotModel, strokes: Floats) -> ClippedStrokes:
    """Keeps every stroke within the motors' range.

    Args:
        model: the robot.
        strokes: (n, legs, 3) m; nan where no rod is long enough.

    Raises:
        InputError: a stroke is more than `MOST_CLIPPED` beyond its range, or no rod is long enough.
    """
    beyond = beyond_strokes(model, strokes)
    _require_small(beyond)
    return ClippedStrokes(np.clip(strokes, model.stroke.lower, model.stroke.upper), beyond)


def beyond_range(model: RobotModel, trajectory: Trajectory) -> Floats:
    """(n, legs, 3) how far each stroke is beyond the motors' range, m; inf where no rod is long enough."""
    return beyond_strokes(model, free_strokes(model, trajectory.feet_world, trajectory.pose(model)))


def beyond_strokes(model: RobotModel, wanted: Floats) -> Floats:
    """(n, legs, 3) how far wanted strokes are beyond the range, m; inf where no rod is long enough (nan)."""
    beyond = np.maximum(model.stroke.lower - wanted, wanted - model.stroke.upper)
    return np.where(np.isnan(beyond), np.inf, np.where(beyond > NOT_CLIPPED, beyond, 0.0))


def clipped_places(clipped: Floats) -> list[ClippedPlace]:
    """Where strokes were clipped, in the order of samples and feet."""
    by_foot: Floats = clipped.max(axis=-1)
    samples, feet = np.nonzero(by_foot)
    return [
        ClippedPlace(sample, foot, float(by_foot[sample, foot]))
        for sample, foot in zip(samples.tolist(), feet.tolist(), strict=True)
    ]


def clipped_words(clipped: Floats) -> str:
    """By how much at most, where, and at how many samples."""
    places = clipped_places(clipped)
    if not places:
        return "by nothing"
    worst = max(places, key=lambda place: place.by)
    samples = len({place.sample for place in places})
    return (
        f"by up to {worst.by * 1000:.2f} mm (foot {worst.foot + 1}, sample {worst.sample + 1}), at {samples} "
        f"of {len(clipped)} samples"
    )


def _require_small(beyond: Floats) -> None:
    """Raises where a stroke is too far beyond its range to be clipped."""
    sample, foot, motor = (int(index) for index in np.unravel_index(np.argmax(beyond), beyond.shape))
    most = float(beyond[sample, foot, motor])
    if most <= MOST_CLIPPED:
        return
    place = f"Foot {foot + 1}, sample {sample + 1}"
    what = (
        f"motor {motor + 1} would be clipped by {most * 1000:.1f} mm; at most {MOST_CLIPPED * 1000:.0f} mm "
        "are clipped, for beyond that it is another motion."
        if np.isfinite(most)
        else "no rod is long enough, so that its strokes cannot be clipped."
    )
    raise InputError(
        f"{place}: {what} Make the motion smaller, or raise or lower the body.",
        f"foot {foot + 1}, sample {sample + 1}",
    )
