"""`export` and `import`."""

import json
import os
from argparse import ArgumentParser, Namespace
from dataclasses import replace
from functools import partial
from pathlib import Path

from app.cli.commands_gait import optimise
from app.cli.common.argument_types import number, one_of, words_of
from app.cli.common.command import set_command
from app.cli.common.output import end_on_signals, note, show, show_file, written_lines
from app.cli.common.within_stroke import add_within_stroke, require_within
from app.cli.gait_motion import poses_of
from app.cli.gait_options import Method
from app.common.clipped import clipped_content
from app.documents.gait_json import gait_content, parse_gait
from app.documents.trajectory_json import trajectory_content
from app.export.formats import NEED_NO_MOTION, ExportedFile, ExportFormat, export
from app.export.import_gait import gait_of_recording, read_gait
from app.export.source import Exportable, exportable_file, exportable_plan, recording_of_npz
from app.export.trajectory_files import (
    companion_path,
    finds_companion,
    read_text,
    read_whole_text,
    require_unread,
    write_with_companion,
)
from app.plans.make_plan import make_plan
from app.plans.plan import Plan
from app.plans.sequence_plan import sequence_plan
from app.store.gait_files import GaitFiles, default_data_folder
from app.store.named_file import file_path, is_plain, write_named
from core.arrays import Floats
from core.errors import InputError
from core.gait.gait import Gait
from core.gait.recording import RecordingFit
from core.library.library import library
from core.pose_gaits.gait_poses import with_poses
from core.recorded.recorded_gait import DescribedGait
from core.recorded.recorded_motion import gait_motion
from core.robot.kinematics import UnreachableError
from core.robot.model import load_robot
from solver_jobs import SolveStatus, solve_live

_RECORDED = (".csv", ".npz")
"""Endings of files that hold a motion."""
_TEXT = frozenset(ExportFormat) - {ExportFormat.NPZ, ExportFormat.PNG}
"""Forms that may be printed."""


def export_command(parser: ArgumentParser) -> None:
    """Makes the parser of `export`."""
    set_command(parser, run_export, "Write a gait or a recorded motion in another form.")
    add = parser.add_argument
    add("source", help="a gait's id, GAIT.json, TRAJ.csv or MOTION.npz")
    add("--format", type=one_of(ExportFormat), metavar=words_of(ExportFormat), required=True)
    add(
        "--method",
        type=one_of(Method),
        metavar=words_of(Method),
        default=Method.NLP,
        help="what makes the plan of a gait, as for optimise (default nlp)",
    )
    add("--data", type=Path, default=None, help="data folder")
    add("-o", "--output", type=file_path, default=None, help="file to write")


def run_export(options: Namespace) -> int:
    """Writes a gait or a recorded motion in another form."""
    end_on_signals()
    form: ExportFormat = options.format
    path = Path(options.source)
    require_unread(options.output, path if path.suffix else None, has_companion=form is ExportFormat.CSV)
    source = _source(options)
    file = export(source, form)
    output: Path | None = options.output
    if output is None and (options.json or form not in _TEXT):
        raise InputError(f"{form} goes into a file; name it with -o, such as -o {file.name}.", "-o")
    if output is None:
        show_file(file.content.decode())
        return 0
    has_companion = form is ExportFormat.CSV and source.need_motion().is_stated
    if has_companion:
        write_with_companion(output, file.content, export(source, ExportFormat.COMPANION).content)
    else:
        write_named(output, file.content)
    _tell(options, file, output, has_companion=has_companion)
    return 0


def _tell(options: Namespace, file: ExportedFile, output: Path, *, has_companion: bool) -> None:
    beside = [companion_path(output)] if has_companion and is_plain(output) else []
    content = {
        "format": options.format.value,
        "media_type": file.media_type,
        "bytes": len(file.content),
        "files": [str(path) for path in (*beside, output)],
    }
    lines = [f"Wrote {path}." for path in beside]
    show(options, content, lines + written_lines(output, has_companion=has_companion))


def _source(options: Namespace) -> Exportable:
    """A recorded motion, a gait file, a built-in gait, or a saved one."""
    path = Path(options.source)
    if path.suffix in _RECORDED:
        recorded, assumptions = exportable_file(path)
        for assumption in assumptions:
            note(assumption)
        return recorded
    stem, gait = stored_gait(options.source, options.data)
    if options.format in NEED_NO_MOTION:
        return Exportable(stem, gait, InputError("This form needs no motion.", "plan"))
    plan = planned_gait(gait, options.method)
    note(plan.note)
    return exportable_plan(stem, gait, plan)


def stored_gait(source: str, folder: Path | None) -> tuple[str, Gait]:
    """A gait file, a saved gait or one that comes with the program, and what its files are called.

    Args:
        source: path or id.
        folder: the data folder; None for the usual one.

    Raises:
        InputError: there is none, or it cannot be read.
    """
    path = Path(source)
    if path.suffix == ".json":
        return path.name.split(".")[0] or path.stem, parse_gait(read_text(path), path.name)
    data = folder or default_data_folder()
    if os.path.exists(data) and GaitFiles.is_id(source):
        files = GaitFiles(data)
        if files.saved_at(source) is not None:
            return source, files.read(source)
    entry = library().get(source)
    if entry is None:
        raise InputError(
            f"There is no gait “{source}”: give a name that `footfall gaits` lists, a gait file "
            "(.json) or a trajectory (.csv).",
            "SOURCE",
        )
    return entry.id, entry.gait


def planned_gait(gait: Gait, method: Method) -> Plan:
    """The plan of any gait, made now; only what the checker confirms is a motion."""
    plan_single = partial(_plan, method=method)
    return sequence_plan(gait, plan_single, solve_live) if gait.sequence else plan_single(gait)


def _plan(gait: Gait, method: Method) -> Plan:
    result = None
    if gait.poses is not None:
        gait = with_poses(gait, poses_of(gait))
    elif gait.segment_table is None and gait.recorded is None and method is Method.NLP:
        verified = optimise(gait)
        if verified.has_motion:
            result = {**verified.content, "trajectory": trajectory_content(verified.trajectory)}
        if verified.status is not SolveStatus.SOLVED:
            note(" ".join(verified.explanation) or "The optimiser found no motion.")
    return make_plan(gait, result, solve_live)


def import_command(parser: ArgumentParser) -> None:
    """Makes the parser of `import`."""
    set_command(parser, run_import, "Make a gait of another program's file.")
    add = parser.add_argument
    add("file", type=Path, help="TRAJ.csv, WAY.csv, MOTION.npz, PHASES.json or GAIT.json")
    add("--name", default=None, help="of the gait; the file's where left out")
    add("--robot", default=None, help="robot of the motion (default the first one with as many feet)")
    add_within_stroke(parser)
    add("--sample-time", type=number(0.001, 60.0, "s"), default=None, help="of a phase list, s")
    add("-o", "--output", type=file_path, default=None, help="gait file to write")


def run_import(options: Namespace) -> int:
    """Makes a gait document from a trajectory, waypoints, a phase list or another gait document."""
    require_unread(options.output, options.file)
    described = imported_gait(options)
    content = gait_content(described.gait)
    for remark in described.remarks:
        note(remark)
    clipped, text = _clipped(described.gait), json.dumps(content, indent=2, ensure_ascii=False) + "\n"
    if options.output is None and not options.json:
        show_file(text)
        return 0
    if options.output is not None:
        write_named(options.output, text)
    file = None if options.output is None else str(options.output)
    show(
        options,
        {
            "gait": content,
            "remarks": list(described.remarks),
            "clipped_mm": clipped_content(clipped),
            "file": file,
        },
        written_lines(options.output),
    )
    return 0


def _clipped(gait: Gait) -> Floats | None:
    """How far each recorded stroke was clipped, m; says how a motion beyond the motors' range can be kept."""
    if gait.recorded is None:
        return None
    model = load_robot(gait.robot)
    motion = gait_motion(gait, gait.recorded, model)
    try:
        require_within(model, motion.trajectory)
    except UnreachableError as refusal:
        note(refusal.sentence)
    return motion.clipped


def imported_gait(options: Namespace) -> DescribedGait:
    """The gait of another program's file.

    Raises:
        InputError: the file cannot be read.
    """
    path: Path = options.file
    name = options.name or path.name.split(".")[0] or path.stem
    fit = RecordingFit(within_stroke=options.within_stroke)
    if path.suffix == ".npz" and options.sample_time is None:
        return gait_of_recording(replace(recording_of_npz(path), fit=fit), name, options.robot)
    companion = companion_path(path)
    return read_gait(
        read_whole_text(path),
        path.name,
        name=options.name if path.suffix == ".json" else name,
        companion=read_whole_text(companion) if path.suffix == ".csv" and finds_companion(path) else None,
        sample_time=options.sample_time,
        robot=options.robot,
        fit=fit,
    )
