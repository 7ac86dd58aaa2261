"""What keeps a recorded motion that does not fit the robot: several choices, each with what it changes."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from core.errors import InputError
from core.gait.gait import Gait
from core.gait.recording import (
    AS_RECORDED,
    LEAST_SCALE,
    MOST_RAISED,
    Recording,
    RecordingFit,
    WithinStroke,
)
from core.motion.trajectory import Trajectory
from core.motion.within_stroke import beyond_range, clipped_words
from core.recorded.frame_offsets import FrameOffsets, frame_offsets
from core.recorded.recorded_gait import gait_of_motion
from core.recorded.recorded_motion import recorded_motion, scaled_motion
from core.robot.kinematics import free_strokes
from core.robot.model import RobotModel, load_robot

RAISED_BY = 0.0001
"""The body is raised by whole multiples of this, m."""
SCALED_BY = 0.01
"""Motions are scaled to whole multiples of this."""


@dataclass(frozen=True)
class FitChoice:
    """A recorded gait that was changed so that the robot can do it.

    Args:
        label: what is done, in a few words.
        sentence: what it changes.
        gait: the changed gait.
        caution: what it leaves to be done; empty where nothing is.
        kind: what kind of change it is.
    """

    label: str
    sentence: str
    gait: Gait
    caution: str = ""
    kind: str = "recorded"


def refitted(gait: Gait, fit: RecordingFit) -> Gait:
    """A recorded gait whose motion is changed in another way; words and sending stay.

    Args:
        gait: with a recorded motion.
        fit: how the motion is changed now.

    Raises:
        InputError: the gait has no recorded motion, or the motion cannot be changed so.
    """
    if gait.recorded is None:
        raise InputError(f"“{gait.name}” has no recorded motion.", "recorded")
    model, recording = load_robot(gait.robot), replace(gait.recorded, fit=fit)
    found = gait_of_motion(recorded_motion(recording, model).trajectory, gait.name, gait.robot).gait
    sending = found.with_options(merge=gait.options.merge, stop_bound=gait.options.stop_bound)
    return replace(sending, notes=gait.notes, provenance=gait.provenance, recorded=recording)


def fit_choices(gait: Gait, recording: Recording) -> Iterator[FitChoice]:
    """What makes a recorded motion fit the robot, the least change first; each works by itself.

    Heights in another frame come first of all, in range or not, as long as nothing was chosen yet.

    Args:
        gait: the gait.
        recording: its recorded motion.

    Raises:
        InputError: the recording cannot be read.
    """
    model = load_robot(gait.robot)
    free = replace(recording, fit=replace(recording.fit, within_stroke=None))
    motion = recorded_motion(free, model).trajectory
    offsets = frame_offsets(model, motion) if recording.fit == AS_RECORDED else None
    if offsets is not None:
        yield _in_own_frame(gait, recording, model, offsets)
    if not beyond_range(model, motion).any():
        return
    yield from _clipped(gait, recording, model)
    yield from _raised(gait, recording, model, motion)
    yield from _scaled(gait, recording, model, motion)


def _in_own_frame(gait: Gait, recording: Recording, model: RobotModel, offsets: FrameOffsets) -> FitChoice:
    fit = RecordingFit(body=offsets.body, feet=offsets.feet)
    sentence = (
        f"{offsets.sentence} The motion stays as recorded; only its heights are counted from elsewhere."
    )
    motion = recorded_motion(replace(recording, fit=fit), model).trajectory
    is_left = bool(beyond_range(model, motion).any())
    caution = "It is still beyond the motors' range then. What keeps it within comes next." if is_left else ""
    return FitChoice("Correct the heights", sentence, refitted(gait, fit), caution)


def _clipped(gait: Gait, recording: Recording, model: RobotModel) -> Iterator[FitChoice]:
    fit = replace(recording.fit, within_stroke=WithinStroke.CLIP)
    if fit == recording.fit:
        return
    try:
        motion = recorded_motion(replace(recording, fit=fit), model)
        changed = refitted(gait, fit)
    except InputError:
        return
    if motion.clipped is None:
        return
    stands = bool((motion.clipped.any(axis=-1) & motion.trajectory.contact).any())
    feet = "Feet, standing ones among them," if stands else "Feet in the air"
    sentence = (
        f"Strokes beyond the range go to its end, {clipped_words(motion.clipped)}. {feet} are a little off "
        "there; the body and all other feet go as recorded. The published program did the same."
    )
    yield FitChoice("Keep within the motors' range", sentence, changed)


def _raised(gait: Gait, recording: Recording, model: RobotModel, motion: Trajectory) -> Iterator[FitChoice]:
    """Where the body is raised by so much, every stroke grows by as much."""
    strokes = free_strokes(model, motion.feet_world, motion.pose(model))
    if np.isnan(strokes).any():
        return
    least, most = model.stroke.lower - float(strokes.min()), model.stroke.upper - float(strokes.max())
    steps = math.ceil(least / RAISED_BY) if least > 0 else math.floor(most / RAISED_BY)
    by = steps * RAISED_BY
    raised = recording.fit.body + by
    if not least <= by <= most or abs(raised) > MOST_RAISED:
        return
    how, where = ("Raise", "higher") if by > 0 else ("Lower", "lower")
    sentence = (
        f"The body is {abs(by) * 1000:.1f} mm {where} all the time. Footholds, swings, travel and times stay "
        "as recorded."
    )
    label = f"{how} the body by {abs(by) * 1000:.1f} mm"
    yield FitChoice(label, sentence, refitted(gait, replace(recording.fit, body=raised)))


def _scaled(gait: Gait, recording: Recording, model: RobotModel, motion: Trajectory) -> Iterator[FitChoice]:
    for share in np.arange(1.0 - SCALED_BY, LEAST_SCALE, -SCALED_BY).tolist():
        scale = recording.fit.scale * share
        if scale < LEAST_SCALE:
            return
        moved = scaled_motion(motion, share)
        if not beyond_range(model, moved).any():
            sentence = f"Body and feet go {share * 100:.0f} % of their ways: {_scaled_words(motion, moved)}."
            changed = refitted(gait, replace(recording.fit, scale=scale))
            yield FitChoice(f"Scale the motion to {share * 100:.0f} %", sentence, changed)
            return


def _scaled_words(before: Trajectory, after: Trajectory) -> str:
    """How much less far the body goes and the feet rise."""
    rises = [float(np.ptp(motion.feet_world[..., 2])) * 1000 for motion in (before, after)]
    travels = [
        float(np.linalg.norm(motion.body_world[-1, :2] - motion.body_world[0, :2])) * 1000
        for motion in (before, after)
    ]
    goes = f"the travel is {travels[1]:.1f} instead of {travels[0]:.1f} mm, and " if travels[0] else ""
    return f"{goes}feet rise up to {rises[1]:.1f} instead of {rises[0]:.1f} mm"
