"""From a recording to the motion in it, changed to fit the robot as its document says."""

from dataclasses import dataclass, replace

import numpy as np

from core.arrays import Floats
from core.errors import InputError
from core.gait.gait import Gait
from core.gait.recording import AS_RECORDED, Recording, RecordingFit, RecordingForm
from core.motion.contact_timeline import SAME_INTERVAL, ContactTimeline
from core.motion.trajectory import Trajectory
from core.motion.within_stroke import clipped_motion, clipped_words
from core.recorded.frame_offsets import raised_motion
from core.recorded.recorded_gait import robot_with
from core.recorded.waypoint_motion import motion_of_waypoints
from core.robot.model import RobotModel, load_robot
from core.wire.trajectory_csv import (
    TrajectoryFile,
    parse_trajectory_csv,
    standard_layout,
)
from core.wire.waypoints import read_waypoint_csv


@dataclass(frozen=True, eq=False)
class RecordedMotion:
    """The motion of a recording.

    Args:
        read: the file as read, with the motion as it is changed.
        clipped: (n, legs, 3) how far each stroke was beyond the motors' range and was clipped, m; None where
            strokes are left as they are.
    """

    read: TrajectoryFile
    clipped: Floats | None = None

    @property
    def trajectory(self) -> Trajectory:
        """The motion."""
        return self.read.trajectory


def recorded_motion(recording: Recording, model: RobotModel | None = None) -> RecordedMotion:
    """Reads the motion of a recording, and what had to be assumed.

    Args:
        recording: the file as it is kept.
        model: the robot of the motion; None for the first one with as many feet.

    Raises:
        InputError: the text cannot be read, is of a robot with another number of feet, or is too far beyond
            the motors' range to be clipped.
    """
    read = read_recording(recording, model)
    if recording.fit == AS_RECORDED:
        return RecordedMotion(read)
    fit, motion = recording.fit, read.trajectory
    raised = raised_motion(motion, fit.body, fit.feet) if fit.body or fit.feet else motion
    fitted = scaled_motion(raised, fit.scale)
    if fit.within_stroke is None:
        return RecordedMotion(replace(read, trajectory=fitted))
    clipped = clipped_motion(model or load_robot(robot_with(motion.leg_count)), fitted)
    return RecordedMotion(replace(read, trajectory=clipped.trajectory), clipped.clipped)


def fit_words(fit: RecordingFit, clipped: Floats | None) -> str:
    """How a recorded motion is changed, in words; nothing where it is as recorded."""
    raised = (
        f"{part} {abs(up) * 1000:.1f} mm {'higher' if up > 0 else 'lower'}"
        for part, up in (("body", fit.body), ("feet", fit.feet))
        if up
    )
    scaled = f"scaled to {fit.scale * 100:.0f} %" if fit.scale != 1.0 else ""
    cut = "" if clipped is None or not clipped.any() else f"strokes clipped {clipped_words(clipped)}"
    return ", ".join(filter(None, (*raised, scaled, cut)))


def scaled_motion(motion: Trajectory, scale: float) -> Trajectory:
    """The motion with the ways of body, feet and heading from the first sample on scaled.

    Args:
        motion: the motion.
        scale: 1 for the same motion.
    """
    if scale == 1.0:
        return motion

    def from_first(values: Floats) -> Floats:
        return np.asarray(values[0] + scale * (values - values[0]))

    speeds = (None if v is None else scale * v for v in (motion.body_velocity, motion.feet_velocity))
    return Trajectory(
        motion.times,
        from_first(motion.body_world),
        from_first(motion.heading),
        from_first(motion.feet_world),
        motion.contact,
        *speeds,
    )


def read_recording(recording: Recording, model: RobotModel | None = None) -> TrajectoryFile:
    """Reads the motion of a recording as it stands in the file, and what had to be assumed.

    Args:
        recording: the file as it is kept.
        model: the robot of the motion; None for the first one with as many feet.

    Raises:
        InputError: the text cannot be read, or is of a robot with another number of feet.
    """
    if recording.form is RecordingForm.TRAJECTORY:
        read = parse_trajectory_csv(recording.text, recording.file, recording.companion)
    else:
        read = _of_waypoints(recording, model)
    feet = read.trajectory.leg_count
    if model is not None and feet != model.leg_count:
        raise InputError(
            f"The recorded motion has {feet} feet; {model.name} has {model.leg_count}.", "recorded.text"
        )
    return read


def gait_motion(gait: Gait, recording: Recording, model: RobotModel) -> RecordedMotion:
    """The motion of a gait's recording with the document's timeline: at the last sample every foot stands.

    Raises:
        InputError: it cannot be read, or timeline or segment table say another motion.
    """
    motion = recorded_motion(recording, model)
    trajectory = motion.trajectory
    if gait.segment_table is not None or not _says(gait.timeline, trajectory):
        raise InputError(
            f"The timeline or segment table is not that of the recorded motion of {recording.file}. Import "
            "the file again, or take the recorded motion out of the document.",
            "recorded",
        )
    return replace(
        motion, read=replace(motion.read, trajectory=replace(trajectory, contact=gait.timeline.contact))
    )


def gait_trajectory(gait: Gait, recording: Recording, model: RobotModel) -> Trajectory:
    """The same alone (see `gait_motion`)."""
    return gait_motion(gait, recording, model).trajectory


def _says(timeline: ContactTimeline, trajectory: Trajectory) -> bool:
    """Whether a timeline says a motion's times and, up to the last sample, its contact."""
    return np.array_equal(trajectory.contact[:-1], timeline.contact[:-1]) and np.allclose(
        np.diff(trajectory.times), timeline.sample_time, rtol=2 * SAME_INTERVAL, atol=0.0
    )


def _of_waypoints(recording: Recording, model: RobotModel | None) -> TrajectoryFile:
    read = read_waypoint_csv(recording.text, recording.file)
    waypoints, legs = read.waypoints, read.waypoints.strokes.shape[1]
    if model is None or model.leg_count != legs:
        model = load_robot(robot_with(legs))
    motion = motion_of_waypoints(model, waypoints)
    # Times, heading and contact are all that can be known of the motion, and its companion may say them.
    layout = standard_layout(waypoints.count)
    return TrajectoryFile(motion.trajectory, (*read.notes, *motion.assumptions), layout, has_companion=True)
