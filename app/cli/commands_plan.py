"""`waypoints` and `check`."""

from argparse import ArgumentParser, Namespace
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

from app.cli.common.argument_types import add_robot, number
from app.cli.common.command import set_command
from app.cli.common.output import INFEASIBLE, NOT_FIT, note, show, show_file, verdict_lines, written_lines
from app.cli.common.within_stroke import OPTION, add_within_stroke, kept_within
from app.common.clipped import clipped_content
from app.export.trajectory_files import read_trajectory, require_unread
from app.export.way_files import checked_way, is_way_file, read_way_file, write_way
from app.gaits.verdict_views import verdict_view
from app.simulation.physics_check import checked_in_physics
from app.store.named_file import file_path
from core.arrays import Floats
from core.checks.beyond_range import beyond_range_plan
from core.checks.checked_plan import Beyond, CheckedPlan, checked_plan
from core.checks.rules import check_plan, check_waypoints
from core.findings import Verdict
from core.motion.trajectory import Trajectory
from core.motion.within_stroke import beyond_strokes, clipped_strokes
from core.robot.kinematics import UnreachableError
from core.robot.model import RobotModel, load_robot
from core.wire.robot_time import estimate_seconds, stop_time
from core.wire.waypoint_merging import WaypointPlan, plan_waypoints
from core.wire.waypoints import format_waypoint_csv

ROBOT = "deltawalker"


def waypoints_command(parser: ArgumentParser) -> None:
    """Makes the parser of `waypoints`."""
    set_command(parser, run_waypoints, "Motor waypoints of a trajectory.")
    add = parser.add_argument
    add("file", type=Path, help="trajectory CSV")
    add_robot(parser, "default deltawalker")
    add_way_options(parser)
    add_within_stroke(parser)
    add("-o", "--output", type=file_path, default=None, help="waypoint CSV to write")


def add_way_options(parser: ArgumentParser) -> None:
    """Adds the options of how waypoints are made of a trajectory."""
    add = parser.add_argument
    merge = "leave out waypoints this near the motors' straight way; 0.001 is the firmware's own tolerance"
    add("--merge", type=number(0.0, 0.02, "m"), default=None, metavar="M", help=merge)
    bound = "cut moves so that Stop is heard within this time, at least 0.77 s"
    add("--stop-bound", type=number(0.1, 60.0, "s"), default=None, metavar="S", help=bound)


def run_waypoints(options: Namespace) -> int:
    """Inverse kinematics of a trajectory file."""
    require_unread(options.output, options.file, has_companion=True)
    read = read_trajectory(options.file)
    for assumption in read.assumptions:
        note(assumption)
    model = load_robot(options.robot or read.robot or ROBOT)
    trajectory, clipped = kept_within(options, model, read.trajectory)
    way = plan_waypoints(model, trajectory, options.merge or 0.0, options.stop_bound)
    waypoints = way.waypoints
    if options.output is not None:
        write_way(options.output, model, trajectory, way, clipped, options.file.name)
    content = {
        "waypoints": waypoints.count,
        "hash": waypoints.content_hash,
        "estimated_seconds": estimate_seconds(waypoints),
        "stop_seconds": stop_time(waypoints),
        "clipped_mm": clipped_content(clipped),
        "assumptions": list(read.assumptions),
        "file": None if options.output is None else str(options.output),
    }
    if options.output is None and not options.json:
        show_file(format_waypoint_csv(waypoints))
        return 0
    lines = [
        f"{waypoints.count} waypoints, about {content['estimated_seconds']:.0f} s on the robot.",
        *written_lines(options.output, has_companion=True),
    ]
    show(options, content, lines)
    return 0


def check_command(parser: ArgumentParser) -> None:
    """Makes the parser of `check`."""
    set_command(parser, run_check, "Check a trajectory, waypoints or a gait.")
    parser.add_argument("file", type=Path, help="TRAJ.csv, WAY.csv or GAIT.json")
    add_robot(parser, "default the gait's own, else deltawalker")
    add_within_stroke(parser)


def run_check(options: Namespace) -> int:
    """The verdict on a trajectory, waypoint or gait file."""
    judged = _judged(options)
    content = {**verdict_view(judged.verdict), "clipped_mm": clipped_content(judged.clipped)}
    lines = verdict_lines(judged.verdict)
    if judged.refusal is None:
        show(options, content, lines)
        return 0 if judged.verdict.passed else NOT_FIT
    content |= {"error": judged.refusal.sentence, "where": judged.refusal.where}
    show(options, content, [judged.refusal.sentence, *lines])
    return INFEASIBLE


@dataclass(frozen=True, eq=False)
class _Judged:
    """The result of checking a file.

    Args:
        verdict: of every rule.
        clipped: how far each stroke was beyond its range before it was clipped, m; None where none was.
        refusal: why the motors cannot make the motion; None where they can.
    """

    verdict: Verdict
    clipped: Floats | None = None
    refusal: UnreachableError | None = None


def _judged(options: Namespace) -> _Judged:
    path: Path = options.file
    if is_way_file(path):
        return _judged_way(options)
    recorded: Floats | None = None
    sending: tuple[float, float | None] = (0.0, None)
    plan: Callable[..., CheckedPlan]
    if path.suffix == ".json":
        # Gait documents and solvers take half a second to load; the other files do without them.
        from app.cli.gait_motion import checked_gait
        from app.plans.plan import sending_of

        gait, trajectory, recorded = checked_gait(path, options.robot)
        model, sending, plan = load_robot(gait.robot), sending_of(gait), partial(checked_plan, gait)
    else:
        read = read_trajectory(path)
        for assumption in read.assumptions:
            note(assumption)
        trajectory = read.trajectory
        model, plan = load_robot(options.robot or read.robot or ROBOT), _plan_alone
    try:
        trajectory, clipped = kept_within(options, model, trajectory, recorded)
    except UnreachableError as refusal:
        whole = beyond_range_plan(model, trajectory)
        beyond = Beyond(unreached=whole.unreached)
        return _Judged(check_plan(plan(model, trajectory, whole.way, beyond=beyond)), refusal=refusal)
    way = plan_waypoints(model, trajectory, *sending)
    return _Judged(checked_in_physics(plan(model, trajectory, way, beyond=Beyond(clipped))), clipped)


def _plan_alone(
    model: RobotModel, trajectory: Trajectory, way: WaypointPlan, *, beyond: Beyond
) -> CheckedPlan:
    """A motion without a document."""
    return CheckedPlan(model, trajectory, way.waypoints, way=way, beyond=beyond)


def _judged_way(options: Namespace) -> _Judged:
    """Checks a waypoint file: by every rule if its companion has the motion."""
    path: Path = options.file
    way = read_way_file(path, options.robot)
    for assumption in way.assumptions:
        note(assumption)
    if way.motion is not None:
        return _Judged(checked_in_physics(checked_way(way.model, way.motion, way)), way.clipped)
    note(
        f"{path.name} has no companion with its motion: only what waypoints alone can show is checked "
        "(range, durations, time before Stop is heard, balance, distance of shoes). Footholds, "
        "swings and slip are not."
    )
    waypoints, clipped = way.waypoints, None
    if options.within_stroke is None:
        if beyond_strokes(way.model, waypoints.strokes).any():
            note(f"{OPTION} keeps strokes beyond the motors' range at its end.")
    else:
        kept = clipped_strokes(way.model, waypoints.strokes)
        waypoints, clipped = replace(waypoints, strokes=kept.strokes), kept.beyond
    return _Judged(check_waypoints(way.model, waypoints, Beyond(clipped)), clipped)
