"""`gaits`, `manual` and `optimise`."""

from __future__ import annotations

from argparse import Namespace
from dataclasses import replace
from pathlib import Path
from typing import Any

from app.cli.report import end_on_sigterm, note, show
from app.documents import parse_gait
from app.judgement import Judgement, judge
from app.store.files import GaitFiles, default_data_folder
from app.trajectory_files import read_text, write_trajectory
from core.errors import InputError
from core.gait import Gait, GaitOptions, heading_step, motion_problem
from core.library import library, manual_entry, optimised_entry
from core.manual import manual_motion
from core.robot import load_robot
from core.timeline import timeline_from_order
from solver_jobs import SolveStatus, solve_motion

EXIT_OF_STATUS = {
    SolveStatus.SOLVED: 0,
    SolveStatus.INFEASIBLE: 3,
    SolveStatus.FAILED: 4,
    SolveStatus.CANCELLED: 130,
}


def run_gaits(options: Namespace) -> int:
    """Lists gaits."""
    rows = [(entry.id, entry.gait, "built-in") for entry in library().values()]
    rows += _saved(options.data or default_data_folder())
    content = [
        {
            "id": gait_id,
            "name": gait.name,
            "orientation": gait.orientation.value,
            "order": list(gait.order),
            "kind": kind,
            "made": "optimised" if gait.segment_table is None else "manual",
        }
        for gait_id, gait, kind in rows
    ]
    lines = [
        f"{c['id']:<20} {c['name']:<26} {c['orientation']:<4} "
        f"{'-'.join(map(str, c['order'])):<10} {c['made']:<10} {c['kind']}"
        for c in content
    ]
    show(options, {"gaits": content}, lines)
    return 0


def _saved(data: Path) -> list[tuple[str, Gait, str]]:
    """Saved gaits; listing makes no folder, and a damaged file is said and left out."""
    rows: list[tuple[str, Gait, str]] = []
    if not data.exists():
        return rows
    files = GaitFiles(data)
    for gait_id in files.ids():
        try:
            rows.append((gait_id, files.read(gait_id), "saved"))
        except InputError as error:
            note(error.sentence)
    return rows


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
    model = load_robot(gait.robot)
    motion = manual_motion(gait, model)
    motion.trajectory.strokes(model)
    if options.output is not None:
        write_trajectory(options.output, motion.trajectory)
    knots = motion.trajectory.knot_count
    content = {
        "gait": options.gait,
        "version": options.version,
        "knots": knots,
        "knot_time": gait.timeline.sample_time,
        "travel": motion.trajectory.body_world[-1, :2].tolist(),
        "slip": motion.slip.tolist(),
        "trajectory": _path(options.output),
    }
    slips = ", ".join(f"{s * 1000:.1f}" for s in motion.slip)
    lines = [
        f"{gait.name}: {knots} knots, {motion.trajectory.times[-1]:.1f} s.",
        f"Standing feet slide up to {slips} mm (feet 1 to {model.leg_count}).",
        *_written(options.output),
    ]
    show(options, content, lines)
    return 0


def _path(path: Path | None) -> str | None:
    return None if path is None else str(path)


def _written(path: Path | None) -> list[str]:
    return [] if path is None else [f"Wrote {path}."]


def gait_to_optimise(name: str) -> Gait:
    """A built-in gait with the command's own defaults, or one from a file with its options.

    Raises:
        InputError: there is neither, or the gait is made by hand.
    """
    path = Path(name)
    if name in library() or (path.suffix != ".json" and not path.exists()):
        return replace(optimised_entry(name).gait, options=GaitOptions())
    gait = parse_gait(read_text(path), path.name)
    if gait.segment_table is not None:
        raise InputError(
            f"{path.name} is made by hand from a segment table; there is nothing to optimise.", name
        )
    return gait


def _with_options(gait: Gait, options: Namespace) -> Gait:
    """The gait with everything that the command line changes; its timeline is drawn anew where it must be."""
    names = ("clearance", "margin", "body_speed", "workspace", "cost", "phase_knots", "closing_knots")
    given = {name: getattr(options, name) for name in names if getattr(options, name) is not None}
    asked: GaitOptions = replace(gait.options, **given)
    direction = options.direction or gait.direction
    iterations = options.iterations or gait.iterations
    order = options.order or gait.order
    step = gait.step
    if options.step is not None:
        step = (*heading_step(gait.orientation, options.step)[:2], step[2])
    if options.goal is not None:
        step = (options.goal[0] / iterations, options.goal[1] / iterations, step[2])
    sample_time = options.knot_time or gait.timeline.sample_time
    timeline = replace(gait.timeline, sample_time=sample_time)
    if any(getattr(options, n) is not None for n in ("order", "iterations", "phase_knots", "closing_knots")):
        timeline = timeline_from_order(
            timeline.leg_count,
            order,
            phase_knots=asked.phase_knots,
            closing_knots=asked.closing_knots,
            iterations=iterations,
            sample_time=sample_time,
        ).turned(direction - 1)
    elif direction != gait.direction:
        timeline = timeline.turned(direction - gait.direction)
    return replace(
        gait,
        direction=direction,
        iterations=iterations,
        order=order,
        step=(step[0], step[1], step[2] if options.yaw is None else options.yaw),
        timeline=timeline,
        options=asked,
    )


def optimise(gait: Gait) -> Judgement:
    """Solves a gait in this process and holds the result to the independent checker."""
    problem = motion_problem(gait, load_robot(gait.robot))
    return judge(problem, solve_motion(problem))


def run_optimise(options: Namespace) -> int:
    """Optimises a gait and writes its trajectory."""
    end_on_sigterm()
    gait = _with_options(gait_to_optimise(options.gait), options)
    judged = optimise(gait)
    output = options.output if judged.status is SolveStatus.SOLVED else None
    if output is not None:
        write_trajectory(output, judged.trajectory)
    content: dict[str, Any] = {
        "gait": options.gait,
        "method": options.method,
        "knots": gait.timeline.sample_count,
        "knot_time": gait.timeline.sample_time,
        **judged.content,
        "trajectory": _path(output),
    }
    show(options, content, [*_optimise_lines(content), *_written(output)])
    return EXIT_OF_STATUS[judged.status]


def _optimise_lines(content: dict[str, Any]) -> list[str]:
    margins = [content["min_margin"], content["min_cop_margin"]]
    shown = ["–" if margin is None else f"{margin * 1000:.2f} mm" for margin in margins]
    lines = [
        f"{content['gait']}: {content['status']} in {content['iterations']} iterations, "
        f"{content['solve_seconds'] * 1000:.0f} ms (build {content['build_seconds'] * 1000:.0f} ms), "
        f"{content['knots']} knots.",
        f"Largest violation found by the checker: {content['max_violation'] or 0.0:.1e}.",
        f"Smallest stability margin {shown[0]}, of the centre of pressure {shown[1]}.",
    ]
    return [*lines, *content["explanation"]]
