"""From a file of another form to a gait document."""

from dataclasses import replace

from app.common.json import Json
from app.documents.gait_json import FORMAT, gait_from_content, require_bytes, require_size
from app.export.trajectory_files import require_world_frame
from core.errors import InputError
from core.gait.gait import MOST_NAME
from core.gait.recording import AS_RECORDED, Recording, RecordingFit, RecordingForm
from core.motion.phase_list import PHASES_FORMAT, parse_phases
from core.recorded.recorded_gait import DescribedGait, gait_of_motion, gait_of_timeline
from core.recorded.recorded_motion import fit_words, recorded_motion
from core.robot.model import load_robot
from core.text.decoding import MARK, without_mark
from core.text.documents import json_content
from core.text.json_size import require_few_values
from core.wire.waypoints import is_waypoint_text

NAMELESS = "Imported gait"
NO_FILE = "body"
"""What a request's body is called that came without a file's name."""
_KEPT = {
    RecordingForm.TRAJECTORY: "The motion of {file} is kept as it stands and is this gait's motion; an edit "
    "of timeline, step or options sets it aside.",
    RecordingForm.WAYPOINTS: "The waypoints of {file} are kept as they stand and make this gait's motion; an "
    "edit of timeline, step or options sets them aside.",
}


def read_gait(
    text: str,
    where: str,
    *,
    name: str | None = None,
    companion: str | None = None,
    sample_time: float | None = None,
    robot: str | None = None,
    fit: RecordingFit = AS_RECORDED,
) -> DescribedGait:
    """Reads a gait document, a phase list, a trajectory CSV or a waypoint CSV.

    Args:
        text: the file's text.
        where: the file's name, for messages.
        name: of the gait; the document's own, or else made from the file's name, where None.
        companion: text of a trajectory's companion, where there is one.
        sample_time: of a phase list, s; the list's own where None.
        robot: the robot of a trajectory or of waypoints; None for the first one with as many feet.
        fit: how the motion of a trajectory or of waypoints is changed to fit the robot.

    Raises:
        InputError: naming line, column, field, foot or phase of what is wrong.
    """
    if text.lstrip(f"{MARK} \t\r\n").startswith("{"):
        for field, is_chosen in (("robot", robot is not None), ("within_stroke", fit != AS_RECORDED)):
            if is_chosen:
                raise InputError(
                    f"{field} is chosen for trajectories and waypoints only; this is neither.", field
                )
        return _from_json(without_mark(text), where, name, sample_time)
    if sample_time is not None:
        raise InputError("A sample time is chosen for phase lists only; this is none.", "sample_time")
    form = RecordingForm.WAYPOINTS if is_waypoint_text(text) else RecordingForm.TRAJECTORY
    # Beside waypoints a companion says what is found from the strokes here.
    own = companion if form is RecordingForm.TRAJECTORY else None
    recording = Recording(where, form, text, own, fit=fit)
    return gait_of_recording(recording, name or _name_of(where), robot)


def gait_of_recording(recording: Recording, name: str, robot: str | None = None) -> DescribedGait:
    """The document of a recorded motion, which holds the motion itself; remarks are in its notes too.

    Args:
        recording: the file.
        name: of the gait.
        robot: the robot of the motion; None for the first one with as many feet.

    Raises:
        InputError: the file cannot be read, is too large, has uneven intervals, or no robot here has so many
            feet.
    """
    require_bytes(len((recording.text + (recording.companion or "")).encode()), recording.file)
    motion = recorded_motion(recording, None if robot is None else load_robot(robot))
    read = motion.read
    if recording.form is RecordingForm.TRAJECTORY:
        require_world_frame(read.trajectory, recording.file)
    described = gait_of_motion(read.trajectory, name, robot)
    assumed = (*recording.assumed, *read.assumptions)
    changed = fit_words(recording.fit, motion.clipped)
    remarks = (
        _KEPT[recording.form].format(file=recording.file),
        *((f"It is changed to fit the robot: {changed}.",) if changed else ()),
        *described.remarks,
        *assumed,
    )
    as_it_is = described.gait.with_options(merge=0.0, stop_bound=None)
    gait = replace(as_it_is, notes=" ".join(remarks), recorded=replace(recording, assumed=assumed))
    require_size(gait, recording.file)
    return DescribedGait(gait, remarks)


def _name_of(file: str) -> str:
    """A gait's name from a file's, without its endings."""
    stem = file.split(".")[0].strip()
    return NAMELESS if stem in ("", NO_FILE) else stem[:MOST_NAME]


def _from_json(text: str, where: str, name: str | None, sample_time: float | None) -> DescribedGait:
    require_few_values(text, where)
    content: Json = json_content(text, where)
    kind = content.get("format")
    if kind == PHASES_FORMAT:
        return gait_of_timeline(parse_phases(text, sample_time, where), name or _name_of(where))
    if kind == FORMAT:
        if sample_time is not None:
            raise InputError("A sample time is chosen for phase lists only; this is none.", "sample_time")
        gait = gait_from_content(content, where)
        require_size(gait, where)
        return DescribedGait(gait if name is None else replace(gait, name=name), ())
    raise InputError(
        f'{where} has the format {kind!r}; a gait document has "{FORMAT}", a phase list "{PHASES_FORMAT}".',
        f"{where}.format",
    )
