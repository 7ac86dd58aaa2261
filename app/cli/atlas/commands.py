"""`atlas run`, `atlas front`, `atlas export` and `atlas open`."""

import json
import math
import os
from argparse import Namespace
from contextlib import closing
from pathlib import Path

from app.atlas.atlas_file import AtlasFile
from app.atlas.dask_engine import DaskEngine
from app.atlas.export import export_atlas, table_row
from app.atlas.front import UNITS, atlas_front, value_of
from app.atlas.included import included_or
from app.atlas.opening import OpenedGait, opened_gait, opened_point
from app.atlas.run import Engine, LocalEngine, Progress, run_atlas
from app.cli.atlas.physics import gait_content as physics_of_gait
from app.cli.atlas.physics import gait_lines, run_lines, simulate_chosen
from app.cli.common.output import INFEASIBLE, NOT_FIT, duration, end_on_signals, note, show, written_lines
from app.cli.common.progress import end_line, rewrite_line
from app.common.json import Json
from app.common.signals import Interrupted
from app.documents.gait_json import gait_content
from app.export.trajectory_files import require_unread
from app.store.named_file import form_of, is_plain, write_named
from app.store.plain_file import read_plain_file
from core.atlas.row import AtlasRow, RowStatus
from core.atlas.space import AtlasSpace, default_space, space_from_toml
from core.errors import InputError
from core.pose_gaits.pose_gait import PoseGait
from solver_jobs import PoseProgress

MOST_SPACE = 1_000_000
"""Bytes of a space file."""


def run_atlas_run(options: Namespace) -> int:
    """Evaluates the gaits of a space, and goes on with a file that has some of them."""
    end_on_signals()
    space = atlas_space(options.robot, options.space, options.seed)
    if options.output.suffix != ".sqlite":
        raise InputError(f"{options.output} must end in .sqlite; an atlas is one SQLite file.", "-o")
    if not is_plain(options.output):
        raise InputError(f"{options.output} must be a plain file; an atlas is read and written often.", "-o")
    engine = _engine(options)
    with closing(AtlasFile(options.output, space)) as atlas:
        try:
            progress = run_atlas(atlas, options.count, engine, _show_progress)
            end_line()
            counts, digest = atlas.counts(), atlas.hash
            physics = simulate_chosen(options, atlas, _workers(options))
        except (KeyboardInterrupt, Interrupted):
            end_line()
            note(_kept(atlas))
            raise
    content = {
        "atlas": str(options.output),
        "evaluated": progress.evaluated,
        "seconds": progress.seconds,
        **{status.value: counts[status] for status in RowStatus},
        "hash": digest,
        "robot": space.robot,
        "space_hash": space.hash,
        "physics": physics,
    }
    total = sum(counts.values())
    rate = f", {progress.evaluated / progress.seconds:.0f} a second" if progress.evaluated else ""
    lines = [
        f"{options.output} has {total:,} gaits: {counts[RowStatus.SOLVED]:,} solved, "
        f"{counts[RowStatus.INFEASIBLE]:,} infeasible, {counts[RowStatus.FAILED]:,} failed.",
        f"{progress.evaluated:,} were evaluated in {progress.seconds:.1f} s{rate}.",
        f"Hash of the results: {digest}",
        *run_lines(physics),
        f"footfall atlas front {options.output} shows the best of them.",
    ]
    show(options, content, lines)
    return 0


def atlas_space(robot: str | None, path: Path | None, seed: int | None) -> AtlasSpace:
    """The space that options ask for: a file's, or the default of a robot.

    Args:
        robot: its name; None for that of the file, or the DeltaWalker.
        path: a TOML file, or None for the default space.
        seed: of the draw; None for that of the space.

    Raises:
        InputError: the file is no space, or is of another robot.
    """
    if path is None:
        space = default_space(robot or "deltawalker")
    else:
        try:
            text = read_plain_file(path, MOST_SPACE)
        except FileNotFoundError as error:
            raise InputError(f"There is no file {path}. Give an existing space file.", "--space") from error
        space = space_from_toml(text, str(path))
        if robot is not None and robot != space.robot:
            raise InputError(
                f"{path} is a space of {space.robot}, and --robot is {robot}. Leave --robot out, or change "
                "the file.",
                "--robot",
            )
    return space.drawn_by(seed)


def run_atlas_front(options: Namespace) -> int:
    """Prints the gaits of an atlas that no other one beats."""
    with closing(AtlasFile(included_or(options.atlas))) as atlas:
        found = atlas_front(atlas, options.x, options.y, ("--x", "--y"))
        count = atlas.counts()[RowStatus.SOLVED]
    content = {"x": options.x, "y": options.y, "front": [table_row(*entry) for entry in found]}
    lines = [f"{len(found)} of {count:,} solved gaits are on the front:"]
    for row, parameters in found:
        values = ", ".join(_words(row, parameters, key) for key in (options.y, options.x))
        order = parameters["order"].replace(",", "-")
        x, y = parameters["step_x"], parameters["step_y"]
        way = f"step {math.hypot(x, y) * 1000:.1f} mm at {math.degrees(math.atan2(y, x)):.0f}°"
        turn = f", turn {math.degrees(parameters['turn']):.0f}°" if parameters["turn"] else ""
        lines.append(f"  {row.number:>7}  {values}  (order {order}, {way}{turn})")
    lines.append(f"footfall atlas open {options.atlas} ID -o gait.json makes one a gait file.")
    show(options, content, lines)
    return 0 if found else INFEASIBLE


def run_atlas_export(options: Namespace) -> int:
    """Writes an atlas as CSV, as Parquet, or as a page with its map."""
    require_unread(options.output, options.atlas)
    with closing(AtlasFile(included_or(options.atlas))) as atlas:
        count = export_atlas(atlas, options.output)
    content = {"gaits": count, "file": str(options.output)}
    show(options, content, [f"Wrote {count:,} gaits to {options.output}."])
    return 0


def run_atlas_open(options: Namespace) -> int:
    """Solves a gait of an atlas again, says whether the answer differs, and writes it as a gait file."""
    end_on_signals()
    if options.output is not None and form_of(options.output, (".json",)) is None:
        raise InputError(f"{options.output} must end in .json; it becomes a gait file.", "-o")
    require_unread(options.output, options.atlas)
    with closing(AtlasFile(included_or(options.atlas))) as atlas:
        if options.output is None:
            opened = opened_point(atlas, options.id)
        else:
            opened = opened_gait(atlas, options.id, _show_search)
        physics = atlas.physics().get(options.id)
    if opened.document is not None:
        text = json.dumps(gait_content(opened.document), ensure_ascii=False)
        write_named(options.output, text + "\n")
    content = {**_opened_content(opened, options.output), "physics": physics_of_gait(physics)}
    show(options, content, _opened_lines(opened, options.output) + gait_lines(physics))
    return 0 if opened.agrees else NOT_FIT


def _opened_content(opened: OpenedGait, output: Path | None) -> Json:
    walk = opened.walk
    return {
        "id": opened.stored.number,
        "agrees": opened.agrees,
        "difference": opened.difference,
        "stored": table_row(opened.stored, {}),
        "solved_again": table_row(opened.row, {}),
        "parameters": opened.parameters,
        "gait": None if output is None else str(output),
        "from_stance": None if walk is None or walk.gait is None else walk.gait.speed,
    }


def _opened_lines(opened: OpenedGait, output: Path | None) -> list[str]:
    row = opened.row
    lines = [f"Gait {row.number} is {row.status.value}."]
    if row.status is RowStatus.SOLVED:
        speed = f"{row.speed * 1000:.2f} mm/s" + (
            f", {math.degrees(row.turn_rate):.2f}°/s" if row.turn_rate else ""
        )
        lines = [
            f"Gait {row.number}: {speed}, {row.seconds:.1f} s a cycle, least margin "
            f"{row.least_margin * 1000:.1f} mm, confirmed by the check."
        ]
    else:
        lines.append(row.reason)
    lines.append(opened.difference or "The answer is the one of the atlas.")
    walk = opened.walk
    if output is not None:
        lines += written_lines(output)
        if walk is not None and walk.gait is not None:
            lines.append(_from_stance_words(opened, walk.gait))
        elif walk is not None:
            lines.append(
                "No motion from the standard stance to rest was found for it. " + " ".join(walk.explanation)
            )
    return lines


def _from_stance_words(opened: OpenedGait, walk: PoseGait) -> str:
    """How fast the gait is from the standard stance to rest, and with which step if that is another one."""
    asked = math.hypot(opened.parameters["step_x"], opened.parameters["step_y"])
    words = f"From the standard stance to rest it makes {walk.speed * 1000:.2f} mm/s"
    if abs(walk.step - asked) < 1e-6:
        return f"{words}."
    return (
        f"{words} with a step of {walk.step * 1000:.1f} mm: {asked * 1000:.1f} mm is too long for the way "
        "from and to the stance."
    )


def _kept(atlas: AtlasFile) -> str:
    """Says how many gaits the file keeps after an interruption, and how to go on."""
    gaits, simulated = sum(atlas.counts().values()), len(atlas.physics())
    physics = f", {simulated:,} of them with physics" if simulated else ""
    return f"{atlas.path} keeps the {gaits:,} gaits that it has{physics}. The same command goes on there."


def _workers(options: Namespace) -> int:
    return options.workers or max(os.cpu_count() or 1, 1)


def _engine(options: Namespace) -> Engine:
    workers = _workers(options)
    return LocalEngine(workers) if options.dask is None else DaskEngine(options.dask, workers)


def _words(row: AtlasRow, parameters: Json, key: str) -> str:
    unit, factor = UNITS.get(key, ("", 1.0))
    return f"{key} {value_of(row, parameters, key) * factor:.3g} {unit}".rstrip()


def _show_progress(progress: Progress) -> None:
    left = progress.seconds_left
    words = "" if left is None else f", {duration(left)} left"
    rewrite_line(f"{progress.done:,} of {progress.count:,} gaits, {progress.solved:,} solved{words}")


def _show_search(progress: PoseProgress) -> bool:
    rewrite_line(progress.stage)
    return True
