"""What is exported: a gait, and the motion that it amounts to."""

from dataclasses import dataclass, replace
from pathlib import Path

from app.export.trajectory_files import read_motion_npz, read_trajectory
from app.plans.plan import Plan, PlanSource
from core.arrays import Floats
from core.errors import FootfallError, InputError
from core.gait.gait import Gait
from core.gait.recording import AS_RECORDED, Recording, RecordingForm
from core.motion.trajectory import Trajectory
from core.recorded.recorded_gait import gait_of_motion, robot_with
from core.recorded.recorded_motion import recorded_motion
from core.robot.coupled_strokes import real_strokes
from core.robot.kinematics import free_strokes
from core.robot.model import RobotModel, load_robot
from core.wire.trajectory_csv import (
    CsvLayout,
    TrajectoryFile,
    format_companion,
    format_trajectory_csv,
    standard_layout,
)
from core.wire.waypoint_path import waypoints_from_trajectory
from core.wire.waypoints import Waypoints


@dataclass(frozen=True, eq=False)
class Motion:
    """A motion that may be exported.

    Args:
        model: the robot.
        trajectory: in the world frame.
        waypoints: what would be sent, or why there are none.
        note: a sentence on how it came about.
        layout: of the file that it was read from; None where it was computed.
        is_stated: whether times, heading and contact are known, not assumed in reading a file.
        recording: the trajectory file itself, where the gait keeps it and its motion is that of the file: it
            is written again as it was.
    """

    model: RobotModel
    trajectory: Trajectory
    waypoints: Waypoints | FootfallError
    note: str
    layout: CsvLayout | None = None
    is_stated: bool = True
    recording: Recording | None = None

    @property
    def strokes(self) -> Floats:
        """(n, legs, 3) strokes that the robot makes, limits left aside, m; nan where no rod is that long."""
        t = self.trajectory
        return real_strokes(self.model, free_strokes(self.model, t.feet_world, t.pose(self.model)))


@dataclass(frozen=True, eq=False)
class Exportable:
    """A gait and its motion; each may be missing, with the sentence that says why.

    Args:
        stem: of the files that are written.
        gait: the document, or why there is none.
        motion: or why there is none.
    """

    stem: str
    gait: Gait | FootfallError
    motion: Motion | FootfallError

    def need_gait(self) -> Gait:
        """The document.

        Raises:
            FootfallError: there is none.
        """
        if isinstance(self.gait, FootfallError):
            raise self.gait
        return self.gait

    def need_motion(self) -> Motion:
        """The motion.

        Raises:
            FootfallError: there is none.
        """
        if isinstance(self.motion, FootfallError):
            raise self.motion
        return self.motion


def exportable_plan(stem: str, gait: Gait, plan: Plan) -> Exportable:
    """A gait with its plan; a drawing that breaks what is asked is no motion to export."""
    motion = _motion_of(plan)
    recording = gait.recorded if plan.source is PlanSource.RECORDED else None
    if isinstance(motion, Motion) and recording is not None and recording.form is RecordingForm.TRAJECTORY:
        read = recorded_motion(recording, plan.model).read
        own_file = recording if recording.fit == AS_RECORDED and read.is_usual else None
        layout = None if read.is_usual else read.layout
        motion = replace(motion, recording=own_file, is_stated=read.has_companion, layout=layout)
    return Exportable(stem, gait, motion)


def _motion_of(plan: Plan) -> Motion | FootfallError:
    if plan.trajectory is None or plan.is_draft:
        reason = plan.note if plan.refusal is None else plan.refusal.sentence
        return InputError(f"This gait has no motion to export: {reason}", "plan")
    waypoints = plan.waypoints or plan.refusal or InputError("There are no waypoints.", "plan")
    return Motion(plan.model, plan.trajectory, waypoints, plan.note)


def read_recorded(path: Path) -> TrajectoryFile:
    """The motion of a trajectory CSV or an NPZ.

    Raises:
        InputError: the file is malformed.
    """
    if path.suffix != ".npz":
        return read_trajectory(path)
    trajectory = read_motion_npz(path).trajectory
    return TrajectoryFile(trajectory, (), standard_layout(trajectory.knot_count), has_companion=True)


def recording_of_npz(path: Path) -> Recording:
    """An NPZ's motion as a trajectory CSV with its companion, which say everything but contact forces.

    Raises:
        InputError: the file is malformed.
    """
    trajectory = read_motion_npz(path).trajectory
    text = format_trajectory_csv(trajectory)
    said = (
        "The arrays are kept to the last bit as a trajectory CSV and its companion, without contact forces."
    )
    companion = format_companion(trajectory, text)
    return Recording(path.name, RecordingForm.TRAJECTORY, text, companion, (said,))


def exportable_file(path: Path) -> tuple[Exportable, tuple[str, ...]]:
    """A recorded motion as it stands in a trajectory CSV or an NPZ, and what reading it assumed.

    Raises:
        InputError: the file is malformed, or no robot here has so many feet.
    """
    read = read_recorded(path)
    model = load_robot(robot_with(read.trajectory.leg_count))
    gait: Gait | FootfallError
    try:
        gait = gait_of_motion(read.trajectory, path.stem).gait
    except InputError as refusal:
        gait = refusal
    waypoints: Waypoints | FootfallError
    try:
        waypoints = waypoints_from_trajectory(model, read.trajectory)
    except FootfallError as refusal:
        waypoints = refusal
    note = f"The motion of the file {path.name} as it stands."
    motion = Motion(model, read.trajectory, waypoints, note, read.layout, read.has_companion)
    return Exportable(path.stem, gait, motion), read.assumptions
