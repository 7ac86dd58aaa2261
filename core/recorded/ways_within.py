"""Ways to keep a recorded motion that leaves the motors' range, each with what it changes."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from core.errors import InputError
from core.gait.gait import Gait
from core.gait.recording import LEAST_SCALE, MOST_RAISED, Recording, RecordingFit, WithinStroke
from core.motion.trajectory import Trajectory
from core.motion.within_stroke import beyond_range, clipped_words
from core.recorded.frame_offsets import FrameOffsets, frame_offsets
from core.recorded.recorded_gait import gait_of_motion
from core.recorded.recorded_motion import recorded_motion
from core.robot.model import RobotModel, load_robot

RAISED_BY = 0.0001
"""The body is raised by whole multiples of this, m."""
SCALED_BY = 0.01
"""Motions are scaled to whole multiples of this."""


@dataclass(frozen=True)
class WayWithin:
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


def ways_within(gait: Gait, recording: Recording) -> Iterator[WayWithin]:
    """What keeps a recorded motion within the motors' range, the least change first; each works by itself.

    Heights in another frame come first of all, in range or not.

    Args:
        gait: the gait.
        recording: its recorded motion.
    """
    model = load_robot(gait.robot)
    motion = recorded_motion(replace(recording, fit=replace(recording.fit, within_stroke=None)), model)
    offsets = frame_offsets(model, motion.trajectory)
    if offsets is not None:
        yield _in_own_frame(gait, recording, model, offsets)
    yield from _clipped(gait, recording, model)
    if beyond_range(model, motion.trajectory).any():
        if offsets is None:
            yield from _raised(gait, recording, model, motion.trajectory)
        yield from _scaled(gait, recording, model, motion.trajectory)


def _in_own_frame(gait: Gait, recording: Recording, model: RobotModel, offsets: FrameOffsets) -> WayWithin:
    fit = recording.fit
    changed = replace(fit, body=fit.body + offsets.body, feet=fit.feet + offsets.feet)
    label = "Correct the heights"
    sentence = (
        f"{offsets.sentence} The motion stays as recorded; only its heights are counted from elsewhere."
    )
    motion = recorded_motion(replace(recording, fit=changed), model).trajectory
    is_left = bool(beyond_range(model, motion).any())
    caution = "It is still beyond the motors' range then. What keeps it within comes next." if is_left else ""
    return WayWithin(label, sentence, refitted(gait, changed), caution)


def _clipped(gait: Gait, recording: Recording, model: RobotModel) -> Iterator[WayWithin]:
    fit = replace(recording.fit, within_stroke=WithinStroke.CLIP)
    try:
        motion = recorded_motion(replace(recording, fit=fit), model)
        changed = refitted(gait, fit)
    except InputError:
        return
    if motion.clipped is None or not motion.clipped.any():
        return
    stands = bool((motion.clipped.any(axis=-1) & motion.trajectory.contact).any())
    feet = "Feet, standing ones among them," if stands else "Feet in the air"
    sentence = (
        f"Strokes beyond the range go to its end, {clipped_words(motion.clipped)}. {feet} are a little off "
        "there; the body and all other feet go as recorded. The published program did the same."
    )
    yield WayWithin("Keep within the motors' range", sentence, changed)


def _raised(gait: Gait, recording: Recording, model: RobotModel, motion: Trajectory) -> Iterator[WayWithin]:
    up = np.array([0.0, 0.0, 1.0])
    steps = np.arange(1, round(MOST_RAISED / RAISED_BY) + 1)
    for by in (step * sign * RAISED_BY for step in steps for sign in (1, -1)):
        raised = float(recording.fit.body + by)
        if abs(raised) > MOST_RAISED:
            continue
        moved = replace(motion, body_world=motion.body_world + by * up)
        if not beyond_range(model, moved).any():
            how = "Raise" if by > 0 else "Lower"
            where = "higher" if by > 0 else "lower"
            sentence = (
                f"The body is {abs(by) * 1000:.1f} mm {where} all the time. Footholds, swings, travel and "
                "times stay as recorded."
            )
            label = f"{how} the body by {abs(by) * 1000:.1f} mm"
            yield WayWithin(label, sentence, refitted(gait, replace(recording.fit, body=raised)))
            return


def _scaled(gait: Gait, recording: Recording, model: RobotModel, motion: Trajectory) -> Iterator[WayWithin]:
    for share in np.arange(1.0 - SCALED_BY, LEAST_SCALE, -SCALED_BY).tolist():
        fit = replace(recording.fit, scale=recording.fit.scale * share)
        if fit.scale < LEAST_SCALE:
            return
        moved = recorded_motion(replace(recording, fit=replace(fit, within_stroke=None)), model).trajectory
        if not beyond_range(model, moved).any():
            rises = [float(np.ptp(m.feet_world[..., 2])) * 1000 for m in (motion, moved)]
            ways = [
                float(np.linalg.norm(np.diff(m.body_world[[0, -1], :2], axis=0))) for m in (motion, moved)
            ]
            goes = f"the travel is {ways[1] * 1000:.1f} instead of {ways[0] * 1000:.1f} mm, and "
            sentence = (
                f"Body and feet go {share * 100:.0f} % of their ways: {goes if ways[0] else ''}feet rise "
                f"up to {rises[1]:.1f} instead of {rises[0]:.1f} mm."
            )
            yield WayWithin(f"Scale the motion to {share * 100:.0f} %", sentence, refitted(gait, fit))
            return
