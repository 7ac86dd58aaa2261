"""Every form in which a gait or its plan leaves the studio."""

import json
from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum

from app.common.table_cell import safe_header
from app.documents.gait_json import gait_content
from app.export.gait_diagram import gait_diagram
from app.export.playback import playback_page
from app.export.png import png
from app.export.source import Exportable
from app.export.svg import svg
from app.export.trajectory_files import COMPANION_SUFFIX
from core.errors import FootfallError, InputError
from core.motion.phase_list import format_phases
from core.motion.trajectory_npz import MotionFile, format_npz
from core.robot.model import load_robot
from core.wire.trajectory_csv import bound_companion, format_companion, format_trajectory_csv
from core.wire.waypoints import format_waypoint_csv


class ExportFormat(StrEnum):
    """The forms by name."""

    JSON = "json"
    """The gait document."""
    CSV = "csv"
    """The trajectory in the lab's layout."""
    COMPANION = "companion"
    """What the trajectory CSV cannot say, bound to it by hash."""
    WAYPOINTS = "waypoints"
    """The motors' strokes."""
    NPZ = "npz"
    """The motion as NumPy arrays."""
    PHASES = "phases"
    """Contact flag and phase durations a foot."""
    SVG = "svg"
    """The gait diagram."""
    PNG = "png"
    """The gait diagram as a picture."""
    HTML = "html"
    """One page with 3D playback and the gait diagram."""


@dataclass(frozen=True)
class ExportedFile:
    """A file ready to be kept.

    Args:
        name: a file name that says what it is.
        media_type: content type.
        content: its bytes.
    """

    name: str
    media_type: str
    content: bytes


def _json(source: Exportable) -> bytes:
    return (json.dumps(gait_content(source.need_gait()), indent=2, ensure_ascii=False) + "\n").encode()


def _csv(source: Exportable) -> bytes:
    motion = source.need_motion()
    if motion.recording is not None:
        return safe_header(motion.recording.text).encode()
    return safe_header(format_trajectory_csv(motion.trajectory, motion.layout)).encode()


def _companion(source: Exportable) -> bytes:
    motion = source.need_motion()
    if not motion.is_stated:
        raise InputError(
            f"{source.stem} came without a companion: its times, heading and contact were only assumed, and "
            "are not written down as if they were known.",
            "companion",
        )
    text = _csv(source).decode()
    recording = motion.recording
    if recording is None or recording.companion is None:
        return format_companion(motion.trajectory, text).encode()
    same = recording.text == text
    return (recording.companion if same else bound_companion(recording.companion, text)).encode()


def _waypoints(source: Exportable) -> bytes:
    waypoints = source.need_motion().waypoints
    if isinstance(waypoints, FootfallError):
        raise InputError(f"This motion has no waypoints: {waypoints.sentence}", waypoints.where)
    return format_waypoint_csv(waypoints).encode()


def _npz(source: Exportable) -> bytes:
    motion = source.need_motion()
    if isinstance(source.gait, FootfallError):
        name = source.stem
        feet = tuple(str(foot + 1) for foot in range(motion.trajectory.leg_count))
    else:
        name, feet = source.gait.name, source.gait.roles
    return format_npz(MotionFile(motion.trajectory, motion.strokes, name, feet))


def _phases(source: Exportable) -> bytes:
    return format_phases(source.need_gait().timeline).encode()


def _svg(source: Exportable) -> bytes:
    gait = source.need_gait()
    return svg(gait_diagram(gait, load_robot(gait.robot))).encode()


def _png(source: Exportable) -> bytes:
    gait = source.need_gait()
    return png(gait_diagram(gait, load_robot(gait.robot)))


def _html(source: Exportable) -> bytes:
    return playback_page(source.need_gait(), source.need_motion()).encode()


_JSON_TYPE, _CSV_TYPE = "application/json", "text/csv; charset=utf-8"
_FORMS: dict[ExportFormat, tuple[str, str, Callable[[Exportable], bytes]]] = {
    ExportFormat.JSON: (".gait.json", _JSON_TYPE, _json),
    ExportFormat.CSV: (".csv", _CSV_TYPE, _csv),
    ExportFormat.COMPANION: (COMPANION_SUFFIX, _JSON_TYPE, _companion),
    ExportFormat.WAYPOINTS: (".waypoints.csv", _CSV_TYPE, _waypoints),
    ExportFormat.NPZ: (".npz", "application/octet-stream", _npz),
    ExportFormat.PHASES: (".phases.json", _JSON_TYPE, _phases),
    ExportFormat.SVG: (".svg", "image/svg+xml", _svg),
    ExportFormat.PNG: (".png", "image/png", _png),
    ExportFormat.HTML: (".html", "text/html; charset=utf-8", _html),
}

NEED_NO_MOTION = frozenset({ExportFormat.JSON, ExportFormat.PHASES, ExportFormat.SVG, ExportFormat.PNG})
"""Forms of the document alone."""


def export(source: Exportable, form: ExportFormat) -> ExportedFile:
    """Writes a gait or its motion in one form.

    Raises:
        FootfallError: there is no such form of it, and why.
    """
    suffix, media_type, write = _FORMS[form]
    return ExportedFile(source.stem + suffix, media_type, write(source))
