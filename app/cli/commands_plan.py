"""`waypoints` and `check`."""

import sys
from argparse import ArgumentParser, Namespace
from pathlib import Path

from app.cli.common.argument_types import add_robot, number
from app.cli.common.command import set_command
from app.cli.common.output import NOT_FIT, note, show, verdict_lines, write
from app.export.trajectory_files import read_trajectory, write_waypoints
from app.export.way_files import is_way_file, read_way_file
from app.gaits.verdict_views import verdict_view
from app.simulation.physics_check import checked_in_physics
from core.checks.checked_plan import CheckedPlan
from core.checks.rules import check_waypoints
from core.findings import Verdict
from core.robot.model import load_robot
from core.wire.robot_time import estimate_seconds, stop_time
from core.wire.waypoint_merging import plan_of_knots, plan_waypoints
from core.wire.waypoints import format_waypoint_csv

ROBOT = "deltawalker"


def waypoints_command(parser: ArgumentParser) -> None:
    """Makes the parser of `waypoints`."""
    set_command(parser, run_waypoints, "Motor waypoints of a trajectory.")
    add = parser.add_argument
    add("file", type=Path, help="trajectory CSV")
    add_robot(parser, "default deltawalker")
    add_way_options(parser)
    add("-o", "--output", type=Path, default=None, help="waypoint CSV to write")


def add_way_options(parser: ArgumentParser) -> None:
    """Adds the options of how waypoints are made of a trajectory."""
    add = parser.add_argument
    merge = "leave out waypoints this near the motors' straight way; 0.001 is the firmware's own tolerance"
    add("--merge", type=number(0.0, 0.02, "m"), default=None, metavar="M", help=merge)
    bound = "cut moves so that Stop is heard within this time, at least 0.77 s"
    add("--stop-bound", type=number(0.1, 60.0, "s"), default=None, metavar="S", help=bound)


def run_waypoints(options: Namespace) -> int:
    """Inverse kinematics of a trajectory file."""
    read = read_trajectory(options.file)
    for assumption in read.assumptions:
        note(assumption)
    model = load_robot(options.robot or read.robot or ROBOT)
    waypoints = plan_waypoints(model, read.trajectory, options.merge or 0.0, options.stop_bound).waypoints
    if options.output is not None:
        write_waypoints(options.output, waypoints)
    content = {
        "waypoints": waypoints.count,
        "hash": waypoints.content_hash,
        "estimated_seconds": estimate_seconds(waypoints),
        "stop_seconds": stop_time(waypoints),
        "assumptions": list(read.assumptions),
        "file": None if options.output is None else str(options.output),
    }
    if options.output is None and not options.json:
        write(sys.stdout, format_waypoint_csv(waypoints))
        return 0
    lines = [
        f"{waypoints.count} waypoints, about {content['estimated_seconds']:.0f} s on the robot.",
        f"Wrote {options.output}.",
    ]
    show(options, content, lines)
    return 0


def check_command(parser: ArgumentParser) -> None:
    """Makes the parser of `check`."""
    set_command(parser, run_check, "Check a trajectory, waypoints or a gait.")
    parser.add_argument("file", type=Path, help="TRAJ.csv, WAY.csv or GAIT.json")
    add_robot(parser, "default the gait's own, else deltawalker")


def run_check(options: Namespace) -> int:
    """The verdict on a trajectory, waypoint or gait file."""
    path: Path = options.file
    if is_way_file(path):
        verdict = _way_verdict(path, options.robot)
    elif path.suffix == ".json":
        # Gait documents and solvers take half a second to load; the other files do without them.
        from app.cli.gait_motion import gait_verdict

        verdict = gait_verdict(path, options.robot)
    else:
        read = read_trajectory(path)
        for assumption in read.assumptions:
            note(assumption)
        model = load_robot(options.robot or read.robot or ROBOT)
        way = plan_waypoints(model, read.trajectory)
        verdict = checked_in_physics(CheckedPlan(model, read.trajectory, way.waypoints, way=way))
    show(options, verdict_view(verdict), verdict_lines(verdict))
    return 0 if verdict.passed else NOT_FIT


def _way_verdict(path: Path, robot: str | None) -> Verdict:
    """The verdict on a waypoint file: by every rule where its companion has the motion."""
    way = read_way_file(path, robot)
    for assumption in way.assumptions:
        note(assumption)
    if way.motion is None:
        note(
            f"{path.name} has no companion with its motion: only what waypoints alone can show is checked "
            "(range, durations, time before Stop is heard, balance, distance of shoes). Footholds, "
            "swings and slip are not."
        )
        return check_waypoints(way.model, way.waypoints)
    sent = plan_of_knots(way.model, way.motion, way.waypoints)
    return checked_in_physics(CheckedPlan(way.model, way.motion, sent.waypoints, way=sent))
