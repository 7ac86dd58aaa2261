"""`waypoints` and `check`."""

import sys
from argparse import ArgumentParser, Namespace
from functools import partial
from pathlib import Path

from app.cli.commands_gait import optimise
from app.cli.common.argument_types import add_robot, number
from app.cli.common.command import set_command
from app.cli.common.output import NOT_FIT, note, show, verdict_lines, write
from app.documents.gait_json import parse_gait
from app.export.trajectory_files import read_text, read_trajectory, write_waypoints
from app.export.way_files import is_way_file, read_way_file
from app.gaits.views import verdict_view
from app.plans.sequence_plan import steps_between
from core.checks.checked_plan import CheckedPlan, checked_plan
from core.checks.rules import check_plan, check_waypoints
from core.errors import CheckError, FootfallError, InfeasibleError
from core.findings import Verdict
from core.gait.gait import Gait, SequencePart
from core.gait.manual_motion import manual_motion
from core.library.new_gait import with_robot
from core.library.sequence import chain_runs, part_name, require_own, run_of
from core.motion.trajectory import Trajectory
from core.pose_gaits.gait_poses import found_gait, pose_problem
from core.pose_gaits.pose_check import check_poses
from core.pose_gaits.pose_gait import PoseGait
from core.recorded.recorded_motion import gait_trajectory
from core.robot.model import RobotModel, load_robot
from core.wire.robot_time import estimate_seconds, stop_time
from core.wire.waypoint_merging import plan_of_knots, plan_waypoints
from core.wire.waypoints import format_waypoint_csv
from solver_jobs import SolveStatus, solve_live, solve_poses

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
        gait = parse_gait(read_text(path), path.name)
        if options.robot is not None:
            gait = with_robot(gait, load_robot(options.robot))
        verdict = _verdict(load_robot(gait.robot), trajectory_of(gait), gait)
    else:
        read = read_trajectory(path)
        for assumption in read.assumptions:
            note(assumption)
        verdict = _verdict(load_robot(options.robot or read.robot or ROBOT), read.trajectory, None)
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
    return check_plan(CheckedPlan(way.model, way.motion, sent.waypoints, way=sent))


def _verdict(model: RobotModel, trajectory: Trajectory, gait: Gait | None) -> Verdict:
    if gait is None:
        way = plan_waypoints(model, trajectory)
        return check_plan(CheckedPlan(model, trajectory, way.waypoints, way=way))
    way = plan_waypoints(model, trajectory, *sending_of(gait))
    return check_plan(checked_plan(gait, model, trajectory, way))


def sending_of(gait: Gait) -> tuple[float, float | None]:
    """Tolerance, m, and stop bound, s, by which waypoints are merged and cut; poses stay as they are."""
    return (0.0, None) if gait.poses is not None else (gait.options.merge, gait.options.stop_bound)


def trajectory_of(gait: Gait) -> Trajectory:
    """Recorded, by hand table, or solved now and confirmed; of a sequence those of its parts, chained.

    Raises:
        InputError: the recorded motion is not that of the document.
        InfeasibleError: there is no motion.
        CheckError: the optimiser found none that the checker confirms.
    """
    if gait.sequence:
        motions = [_part_trajectory(index, part) for index, part in enumerate(gait.sequence)]
        whole = chain_runs(gait, load_robot(gait.robot), motions, partial(steps_between, solve_live))
        require_own(gait, whole)
        return whole.trajectory
    if gait.poses is not None:
        return poses_of(gait).trajectory
    if gait.recorded is not None:
        return gait_trajectory(gait, gait.recorded, load_robot(gait.robot))
    if gait.segment_table is not None:
        return manual_motion(gait, load_robot(gait.robot)).trajectory
    verified = optimise(gait)
    if verified.status is SolveStatus.SOLVED:
        return verified.trajectory
    sentence = " ".join(verified.explanation) or "The optimiser found no motion."
    if verified.status is SolveStatus.INFEASIBLE:
        raise InfeasibleError(sentence, gait.name)
    raise CheckError(sentence, gait.name)


def poses_of(gait: Gait) -> PoseGait:
    """The poses that the document has for what it asks; where it has none they are searched for now.

    Raises:
        InfeasibleError: none were found.
        CheckError: the search gave no poses that the checker confirms.
    """
    model = load_robot(gait.robot)
    found = found_gait(gait, model)
    if found is not None and check_poses(found).confirmed:
        return found
    is_bare = gait.poses is None or gait.poses.found is None
    why = "has no poses yet" if is_bare else "has changed since its poses were found"
    note(f"“{gait.name}” {why}. The poses are searched for now.")
    result = solve_poses(pose_problem(gait, model))
    if result.gait is not None:
        return result.gait
    sentence = " ".join(result.explanation)
    kind = InfeasibleError if result.status is SolveStatus.INFEASIBLE else CheckError
    raise kind(sentence, gait.name)


def _part_trajectory(index: int, part: SequencePart) -> Trajectory:
    """The motion of a part with all its iterations; a refusal says which part it is about.

    Raises:
        InfeasibleError: there is no motion.
        CheckError: no motion was confirmed, or the part makes none.
    """
    try:
        return trajectory_of(run_of(part).gait)
    except FootfallError as refusal:
        sentence = f"{part_name(index, part)}, has no motion: {refusal.sentence}"
        kind = InfeasibleError if isinstance(refusal, InfeasibleError) else CheckError
        raise kind(sentence, "sequence") from refusal
