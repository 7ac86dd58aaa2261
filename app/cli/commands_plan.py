"""`waypoints`, `check` and `bench`."""

from __future__ import annotations

import sys
from argparse import Namespace
from pathlib import Path
from typing import Any

from app.bench import BENCHMARKS, conditions
from app.cli.commands_gait import optimise
from app.cli.report import note, show, verdict_lines
from app.documents import parse_gait
from app.trajectory_files import read_text, read_trajectory, write_waypoints
from app.views import verdict_view
from core.checks import CheckedPlan, check_plan
from core.errors import CheckError, InfeasibleError, InputError
from core.findings import Verdict
from core.gait import Gait
from core.manual import manual_motion
from core.robot import load_robot
from core.trajectory import Trajectory
from core.waypoint_path import cut_moves, estimate_seconds, merge_waypoints, waypoints_from_trajectory
from core.waypoints import format_waypoint_csv
from core.wire_timing import stop_delay
from solver_jobs import SolveStatus

NOT_FIT = 4
ROBOT = "deltawalker"


def run_waypoints(options: Namespace) -> int:
    """Inverse kinematics of a trajectory file."""
    read = read_trajectory(options.file)
    for assumption in read.assumptions:
        note(assumption)
    waypoints = waypoints_from_trajectory(load_robot(ROBOT), read.trajectory)
    if options.merge is not None:
        waypoints = merge_waypoints(waypoints, options.merge)
    if options.stop_bound is not None:
        waypoints = cut_moves(waypoints, options.stop_bound)
    if options.output is not None:
        write_waypoints(options.output, waypoints)
    content = {
        "waypoints": waypoints.count,
        "hash": waypoints.content_hash,
        "estimated_seconds": estimate_seconds(waypoints),
        "stop_seconds": stop_delay(waypoints),
        "assumptions": list(read.assumptions),
        "file": None if options.output is None else str(options.output),
    }
    if options.output is None and not options.json:
        sys.stdout.write(format_waypoint_csv(waypoints))
        return 0
    lines = [
        f"{waypoints.count} waypoints, about {content['estimated_seconds']:.0f} s on the robot.",
        f"Wrote {options.output}.",
    ]
    show(options, content, lines)
    return 0


def run_check(options: Namespace) -> int:
    """The verdict on a trajectory or gait file."""
    path: Path = options.file
    if path.suffix == ".json":
        gait = parse_gait(read_text(path), path.name)
        verdict = _verdict(_trajectory_of(gait), gait)
    else:
        read = read_trajectory(path)
        for assumption in read.assumptions:
            note(assumption)
        verdict = _verdict(read.trajectory, None)
    show(options, verdict_view(verdict), verdict_lines(verdict))
    return 0 if verdict.passed else NOT_FIT


def _verdict(trajectory: Trajectory, gait: Gait | None) -> Verdict:
    model = load_robot(ROBOT if gait is None else gait.robot)
    waypoints = waypoints_from_trajectory(model, trajectory)
    travel = None if gait is None else gait.step_world * gait.iterations
    return check_plan(CheckedPlan(model, trajectory, waypoints, travel))


def _trajectory_of(gait: Gait) -> Trajectory:
    """By hand table, or solved now and confirmed.

    Raises:
        InfeasibleError: there is no motion.
        CheckError: the optimiser found none that the checker confirms.
    """
    if gait.segment_table is not None:
        return manual_motion(gait, load_robot(gait.robot)).trajectory
    judged = optimise(gait)
    if judged.status is SolveStatus.SOLVED:
        return judged.trajectory
    sentence = " ".join(judged.explanation) or "The optimiser found no motion."
    if judged.status is SolveStatus.INFEASIBLE:
        raise InfeasibleError(sentence, gait.name)
    raise CheckError(sentence, gait.name)


def run_bench(options: Namespace) -> int:
    """Runs benchmarks and prints their conditions."""
    unknown = [name for name in options.names if name not in BENCHMARKS]
    if unknown:
        raise InputError(f"There is no benchmark “{unknown[0]}”; choose of {', '.join(BENCHMARKS)}.", "NAME")
    results = {name: BENCHMARKS[name]() for name in options.names or BENCHMARKS}
    where = conditions()
    lines = [", ".join(f"{key}: {value}" for key, value in where.items())]
    for name, rows in results.items():
        lines += ["", name, *_table(rows)]
    show(options, {"conditions": where, "results": results}, lines)
    return 0


def _table(rows: list[dict[str, Any]]) -> list[str]:
    """Rows for people: a header and aligned columns."""
    header = list(rows[0])
    cells = [header, *([str(row[key]) for key in header] for row in rows)]
    widths = [max(len(line[column]) for line in cells) for column in range(len(header))]
    return [
        "  " + "  ".join(text.rjust(width) for text, width in zip(line, widths, strict=True))
        for line in cells
    ]
