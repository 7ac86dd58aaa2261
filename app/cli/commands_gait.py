"""`gaits`, `manual` and `optimise`."""

import json
import os
import shlex
from argparse import ArgumentParser, Namespace
from dataclasses import replace
from itertools import groupby
from operator import itemgetter
from pathlib import Path

from app.cli.common.argument_types import add_robot, number, whole
from app.cli.common.command import set_command
from app.cli.common.output import end_on_signals, note, show, written_lines
from app.cli.gait_options import SOLVERS, Method, add_gait_options, asked_gait, gait_file
from app.common.json import Json
from app.documents.gait_json import gait_schema, sent_hash
from app.export.trajectory_files import require_unread, write_trajectory
from app.gaits.views import times_view
from app.plans.verified_result import VerifiedResult, verify
from app.store.gait_files import GaitFiles, default_data_folder
from app.store.named_file import file_path
from app.store.tables.times_store import read_times
from core.errors import InputError
from core.gait.gait import Gait, heading_step, motion_problem
from core.gait.manual_motion import manual_motion
from core.gait.motion_source import motion_source
from core.gait.options import LEAST_PHASE_KNOTS, MOST_PHASE_KNOTS
from core.library.library import library, manual_entry
from core.library.new_gait import with_robot
from core.library.robot_times import RobotTimes, library_times
from core.pose_gaits.pace import motion_words
from core.robot.model import load_robot
from solver_jobs import SolveStatus, find_remedies

SAVED_GROUP = "Saved"
"""Group of the gaits that a person has saved."""

EXIT_OF_STATUS = {
    SolveStatus.SOLVED: 0,
    SolveStatus.INFEASIBLE: 3,
    SolveStatus.FAILED: 4,
    SolveStatus.CANCELLED: 130,
}


def gaits_command(parser: ArgumentParser) -> None:
    """Makes the parser of `gaits`."""
    set_command(parser, run_gaits, "List built-in and saved gaits.")
    add = parser.add_argument
    add("--data", type=Path, default=None, help="data folder")
    add("--schema", action="store_true", help="print the JSON Schema of the gait document instead")


def run_gaits(options: Namespace) -> int:
    """Lists gaits, or prints the document's schema."""
    if options.schema:
        schema = gait_schema()
        show(options, schema, json.dumps(schema, indent=2, ensure_ascii=False).split("\n"))
        return 0
    data: Path = options.data or default_data_folder()
    content = [
        _listed(entry.id, entry.gait, "built-in", library_times().get(entry.id), entry.group.value)
        for entry in library().values()
    ]
    known = read_times(data)
    for gait_id, gait in _saved(data):
        sent, times = known.get(gait_id, (None, None))
        content.append(
            _listed(gait_id, gait, "saved", times if sent == sent_hash(gait) else None, SAVED_GROUP)
        )
    lines: list[str] = []
    for group, listed in groupby(content, key=itemgetter("group")):
        lines += [f"{group}:", *(_line(gait) for gait in listed)]
    show(options, {"gaits": content}, lines)
    return 0


def _listed(gait_id: str, gait: Gait, kind: str, times: RobotTimes | None, group: str) -> Json:
    return {
        "id": gait_id,
        "name": gait.name,
        "robot": gait.robot,
        "orientation": gait.orientation.value,
        "order": list(gait.order),
        "kind": kind,
        "made": motion_source(gait).value,
        **times_view(times),
        "group": group,
    }


def _line(listed: Json) -> str:
    order = "-".join(map(str, listed["order"]))
    seconds, speed, turn_rate = listed["robot_seconds"], listed["speed"], listed["turn_rate"]
    lasts = "" if seconds is None else f"{seconds:.1f} s"
    goes = motion_words(speed, turn_rate) if speed or turn_rate else ""
    return (
        f"  {listed['id']:<18} {listed['name']:<28} {listed['robot']:<12} {listed['orientation']:<4} "
        f"{listed['made']:<10} {listed['kind']:<9} {lasts:>8} {goes:>10}  {order}"
    )


def _saved(data: Path) -> list[tuple[str, Gait]]:
    """Saved gaits; listing makes no folder, and a damaged file is said and left out."""
    rows: list[tuple[str, Gait]] = []
    if not os.path.exists(data):  # or nobody may look
        return rows
    files = GaitFiles(data)
    for gait_id in files.ids():
        try:
            rows.append((gait_id, files.read(gait_id)))
        except InputError as error:
            note(error.sentence)
    return rows


def manual_command(parser: ArgumentParser) -> None:
    """Makes the parser of `manual`."""
    set_command(parser, run_manual, "Trajectory of a gait made by hand.")
    add = parser.add_argument
    add("gait", help="walk, amble or s-gait")
    add("--version", type=whole(0, 9), default=0, help="0, 1 or 2 (default 0)")
    add("--step", type=number(0.0, 0.2, "m"), default=0.010, help="m (default 0.010)")
    add("--direction", type=whole(1, 4), default=1)
    add("--iterations", type=whole(1, 20), default=1)
    add("--segment-samples", type=whole(LEAST_PHASE_KNOTS, MOST_PHASE_KNOTS), default=5)
    add_robot(parser, "default deltawalker")
    add("-o", "--output", type=file_path, default=None, help="trajectory CSV to write")


def run_manual(options: Namespace) -> int:
    """Writes the trajectory of a published manual gait."""
    entry = manual_entry(options.gait, options.version)
    gait, table = entry.gait, entry.gait.segment_table
    if table is None:
        raise InputError(f"{options.gait} has no segment table.", "GAIT")
    table = replace(table, samples_per_segment=options.segment_samples)
    implied = table.repeated(options.iterations).turned(options.direction - 1)
    gait = replace(
        gait,
        step=heading_step(gait.orientation, options.step),
        direction=options.direction,
        iterations=options.iterations,
        segment_table=table,
        timeline=implied.timeline(gait.timeline.sample_time),
    )
    model = load_robot(gait.robot if options.robot is None else options.robot)
    gait = with_robot(gait, model)
    motion = manual_motion(gait, model)
    motion.trajectory.strokes(model)
    if options.output is not None:
        write_trajectory(options.output, motion.trajectory, model.name)
    knots = motion.trajectory.knot_count
    content = {
        "gait": options.gait,
        "version": options.version,
        "knots": knots,
        "knot_time": gait.timeline.sample_time,
        "travel": motion.trajectory.body_world[-1, :2].tolist(),
        "slip": motion.slip.tolist(),
        "robot": model.name,
        "trajectory": _path(options.output),
    }
    slips = ", ".join(f"{s * 1000:.1f}" for s in motion.slip)
    lines = [
        f"{gait.name}: {knots} samples, {motion.trajectory.times[-1]:.1f} s.",
        f"Standing feet slide up to {slips} mm (feet 1 to {model.leg_count}).",
        *written_lines(options.output, has_companion=True),
    ]
    show(options, content, lines)
    return 0


def _path(path: Path | None) -> str | None:
    return None if path is None else str(path)


def optimise(gait: Gait, method: Method = Method.NLP) -> VerifiedResult:
    """Solves a gait in this process and holds the result to the independent checker."""
    problem = motion_problem(gait, load_robot(gait.robot))
    return verify(problem, SOLVERS[method](problem))


def optimise_command(parser: ArgumentParser) -> None:
    """Makes the parser of `optimise`."""
    set_command(parser, run_optimise, "Optimised trajectory of a gait.")
    add_gait_options(parser)
    text = "take the Nth of what would help, where the gait has no motion"
    parser.add_argument("--remedy", type=whole(1, 4), metavar="N", default=None, help=text)


def run_optimise(options: Namespace) -> int:
    """Optimises a gait and writes its trajectory."""
    end_on_signals()
    require_unread(options.output, gait_file(options.gait), has_companion=True)
    gait = asked_gait(options)
    if options.remedy is not None:
        gait = _mended(gait, options.remedy)
    verified = optimise(gait, options.method)
    helps = _remedies(gait, options.words) if verified.status is SolveStatus.INFEASIBLE else []
    output = options.output if verified.has_motion else None
    if output is not None:
        write_trajectory(output, verified.trajectory, gait.robot)
    content: Json = {
        "gait": options.gait,
        "method": options.method.value,
        "knots": gait.timeline.sample_count,
        "knot_time": gait.timeline.sample_time,
        "robot": gait.robot,
        **verified.content,
        "evidence": None if verified.result.evidence is None else verified.result.evidence.value,
        "trajectory": _path(output),
        "remedies": helps,
    }
    lines = _optimise_lines(content) + _remedy_lines(helps) + written_lines(output, has_companion=True)
    show(options, content, lines)
    return EXIT_OF_STATUS[verified.status]


def _mended(gait: Gait, number: int) -> Gait:
    """The gait with one of the changes that make it walk, counted from 1.

    Raises:
        InputError: there are not so many.
    """
    found = find_remedies(gait, load_robot(gait.robot)).remedies
    if number > len(found):
        count = f"{len(found)} remedies" if len(found) != 1 else "one remedy"
        raise InputError(f"There is no remedy {number}; the gait has {count}.", "--remedy")
    note(f"{found[number - 1].label}: {found[number - 1].sentence}")
    return found[number - 1].gait


def _remedies(gait: Gait, words: list[str]) -> list[Json]:
    """What would help, each as a command that takes it."""
    asked = [word for word in without_option(words, "--remedy") if word != "--json"]
    return [
        {
            "kind": remedy.kind.value,
            "label": remedy.label,
            "sentence": remedy.sentence,
            "caution": remedy.caution,
            "command": shlex.join(["footfall", *asked, "--remedy", str(number)]),
        }
        for number, remedy in enumerate(find_remedies(gait, load_robot(gait.robot)).remedies, 1)
    ]


def without_option(words: list[str], name: str) -> list[str]:
    """The words of a command line without an option and its value, however often they stand there."""
    kept: list[str] = []
    left = iter(words)
    for word in left:
        if word == name:
            next(left, None)
        elif not word.startswith(f"{name}="):
            kept.append(word)
    return kept


def _remedy_lines(remedies: list[Json]) -> list[str]:
    if not remedies:
        return []
    lines = ["What would help, best first:"]
    for remedy in remedies:
        caution = f" {remedy['caution']}" if remedy["caution"] else ""
        lines += [f"  {remedy['label']}. {remedy['sentence']}{caution}", f"    {remedy['command']}"]
    return lines


def _optimise_lines(content: Json) -> list[str]:
    margins = [content["min_margin"], content["min_cop_margin"]]
    shown = ["–" if margin is None else f"{margin * 1000:.2f} mm" for margin in margins]
    lines = [
        f"{content['gait']}: {content['status']}{_iterations(content)}, "
        f"{content['solve_seconds'] * 1000:.0f} ms (build {content['build_seconds'] * 1000:.0f} ms), "
        f"{content['knots']} samples.",
        f"Largest violation found by the checker: {content['max_violation'] or 0.0:.1e}.",
        f"Smallest stability margin {shown[0]}, of the centre of pressure {shown[1]}.",
    ]
    return [*lines, *content["explanation"]]


def _iterations(content: Json) -> str:
    return f" in {content['iterations']} iterations" if content["iterations"] else ""
