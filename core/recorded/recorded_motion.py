"""From a recording to the motion in it."""

from dataclasses import replace

import numpy as np

from core.errors import InputError
from core.gait.gait import Gait
from core.gait.recording import Recording, RecordingForm
from core.motion.contact_timeline import SAME_INTERVAL, ContactTimeline
from core.motion.trajectory import Trajectory
from core.recorded.recorded_gait import robot_with
from core.recorded.waypoint_motion import motion_of_waypoints
from core.robot.model import RobotModel, load_robot
from core.wire.trajectory_csv import TrajectoryFile, parse_trajectory_csv, standard_layout
from core.wire.waypoints import parse_waypoint_csv, waypoint_legs


def recorded_motion(recording: Recording, model: RobotModel | None = None) -> TrajectoryFile:
    """Reads the motion of a recording, and what had to be assumed.

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


def gait_trajectory(gait: Gait, recording: Recording, model: RobotModel) -> Trajectory:
    """The motion of a gait's recording with the document's timeline: at the last sample every foot stands.

    Raises:
        InputError: it cannot be read, or timeline or segment table say another motion.
    """
    trajectory = recorded_motion(recording, model).trajectory
    if gait.segment_table is not None or not _says(gait.timeline, trajectory):
        raise InputError(
            f"The timeline or segment table is not that of the recorded motion of {recording.file}. Import "
            "the file again, or take the recorded motion out of the document.",
            "recorded",
        )
    return replace(trajectory, contact=gait.timeline.contact)


def _says(timeline: ContactTimeline, trajectory: Trajectory) -> bool:
    """Whether a timeline says a motion's times and, up to the last sample, its contact."""
    return np.array_equal(trajectory.contact[:-1], timeline.contact[:-1]) and np.allclose(
        np.diff(trajectory.times), timeline.sample_time, rtol=2 * SAME_INTERVAL, atol=0.0
    )


def _of_waypoints(recording: Recording, model: RobotModel | None) -> TrajectoryFile:
    legs = waypoint_legs(recording.text, recording.file)
    waypoints = parse_waypoint_csv(recording.text, legs, recording.file)
    if model is None or model.leg_count != legs:
        model = load_robot(robot_with(legs))
    motion = motion_of_waypoints(model, waypoints)
    # Times, heading and contact are all that can be known of the motion, and its companion may say them.
    layout = standard_layout(waypoints.count)
    return TrajectoryFile(motion.trajectory, motion.assumptions, layout, has_companion=True)
