"""`simulate`."""

from argparse import ArgumentParser, Namespace
from collections.abc import Callable, Sequence
from contextlib import closing
from dataclasses import asdict
from pathlib import Path

import numpy as np

from app.cli.commands_plan import ROBOT, add_way_options
from app.cli.common.argument_types import add_robot, one_of, whole, words_of
from app.cli.common.command import set_command
from app.cli.common.output import NOT_FIT, end_on_signals, note, show, tally
from app.cli.common.progress import rewrite_line
from app.cli.common.within_stroke import add_within_stroke, kept_within
from app.cli.gait_motion import checked_gait
from app.common.clipped import clipped_content
from app.common.json import Json
from app.common.signals import Interrupted
from app.export.trajectory_files import read_trajectory
from app.export.way_files import is_way_file, read_way_file
from app.learning.parameter_sets import ParameterSets
from app.plans.plan import sending_of
from app.simulation.problem import report_figures, way_problem
from app.simulation.view import variations_content
from app.store.database import DATABASE, Database
from app.store.gait_files import default_data_folder
from core.arrays import Floats
from core.errors import InputError
from core.findings import Finding, Severity
from core.gait.gait import Gait
from core.motion.trajectory import Trajectory
from core.physics.findings import physics_outcomes
from core.physics.masses import physics_for
from core.physics.metrics import report
from core.physics.motion import SimulatedMotion
from core.physics.parameters import PhysicsSet, physics_sets
from core.physics.problem import Rig, SimulationProblem
from core.physics.report import SimulationReport
from core.physics.variations import MOST_VARIATIONS, VariedRun
from core.recorded.waypoint_motion import motion_of_waypoints
from core.robot.model import RobotModel, load_robot
from core.wire.waypoint_merging import plan_waypoints
from solver_jobs import simulate, simulate_variations


def simulate_command(parser: ArgumentParser) -> None:
    """Makes the parser of `simulate`."""
    text = "Run waypoints, or those of a trajectory or a gait, in a physics model."
    set_command(parser, run_simulate, text)
    add = parser.add_argument
    add("file", type=Path, help="TRAJ.csv, WAY.csv or GAIT.json")
    add_robot(parser, "default the gait's own, else deltawalker")
    add_way_options(parser)
    add_within_stroke(parser)
    text = f"parameters: {', '.join(physics_sets())}, or a learned set (default the robot's usual one)"
    add("--physics", default=None, metavar="SET", help=text)
    add("--data", type=Path, default=None, help="data folder, where learned sets are kept")
    add("--rig", type=one_of(Rig), metavar=words_of(Rig), default=Rig.WALKING)
    text = "try so many seeded variations of the parameters as well"
    add("--variations", type=whole(0, MOST_VARIATIONS), default=0, metavar="N", help=text)
    add("--seed", type=whole(0, 2**31), default=0, help="of the variations (default 0)")


def run_simulate(options: Namespace) -> int:
    """Physics of exactly the waypoints that would be sent of a trajectory or gait file."""
    end_on_signals()
    problem, clipped = _problem(options)
    motion = _simulated(problem)
    figures = report(problem, motion)
    findings = tuple(found for one in physics_outcomes(figures, problem) for found in one.findings)
    runs: Sequence[VariedRun] = ()
    if options.variations:
        tell = _progress("Variations")
        runs = simulate_variations(problem, options.variations, options.seed, tell)
    passed = all(found.severity is not Severity.ERROR for found in findings)
    content = simulation_content(problem, figures, findings, runs, options.seed)
    content["clipped_mm"] = clipped_content(clipped)
    show(options, content, _lines(problem, figures, findings, runs))
    return 0 if passed else NOT_FIT


def simulation_content(
    problem: SimulationProblem,
    figures: SimulationReport,
    findings: Sequence[Finding],
    runs: Sequence[VariedRun],
    seed: int,
) -> Json:
    """A simulation as JSON content, SI."""
    return {
        **report_figures(figures),
        "passed": all(found.severity is not Severity.ERROR for found in findings),
        "findings": [asdict(found) for found in findings],
        "robot": problem.model.name,
        "physics": problem.physics.name,
        "rig": problem.rig.value,
        "waypoints": problem.waypoints.count,
        "hash": problem.waypoints.content_hash,
        "variations": {"seed": seed, **variations_content(runs)} if runs else None,
    }


def _simulated(problem: SimulationProblem) -> SimulatedMotion:
    """The run; an interrupt that comes while the engine is being loaded is one too."""
    try:
        return simulate(problem, _progress("Simulated"))
    except ImportError as error:
        cause: BaseException | None = error
        while cause is not None:
            if isinstance(cause, KeyboardInterrupt | Interrupted):
                raise Interrupted from error
            cause = cause.__cause__
        raise


def _problem(options: Namespace) -> tuple[SimulationProblem, Floats | None]:
    """The problem for the physics, and how far each of its strokes was clipped, m."""
    model, trajectory, gait, recorded = _input(options)
    trajectory, clipped = kept_within(options, model, trajectory, recorded)
    merge, bound = (0.0, None) if gait is None else sending_of(gait)
    merge = merge if options.merge is None else options.merge
    bound = bound if options.stop_bound is None else options.stop_bound
    way = plan_waypoints(model, trajectory, merge, bound)
    return way_problem(model, trajectory, way, physics_set(options, model), options.rig), clipped


def physics_set(options: Namespace, model: RobotModel) -> PhysicsSet:
    """A set of the program, or one that was learned and is kept in the data folder.

    Raises:
        InputError: there is none of that name.
    """
    if options.physics is None or options.physics in physics_sets():
        return physics_for(model, options.physics)
    path = (options.data or default_data_folder()).expanduser() / DATABASE
    if not path.is_file():
        raise InputError(
            f"There is no physics set “{options.physics}”: choose one of {', '.join(physics_sets())}, or "
            "name with --data the folder where learned ones are kept.",
            "--physics",
        )
    with closing(Database(path)) as database:
        return ParameterSets(database).chosen(model, options.physics)


def _input(options: Namespace) -> tuple[RobotModel, Trajectory, Gait | None, Floats | None]:
    """Robot, motion, and of a gait file the document and how far its recorded strokes were clipped, m."""
    path: Path = options.file
    if is_way_file(path):
        return *_motion_of_waypoints(path, options.robot), None, None
    if path.suffix != ".json":
        read = read_trajectory(path)
        for assumption in read.assumptions:
            note(assumption)
        return load_robot(options.robot or read.robot or ROBOT), read.trajectory, None, None
    gait, trajectory, clipped = checked_gait(path, options.robot)
    return load_robot(gait.robot), trajectory, gait, clipped


def _motion_of_waypoints(path: Path, robot: str | None) -> tuple[RobotModel, Trajectory]:
    """Robot and motion of a waypoint file: its companion's, else what forward kinematics finds."""
    way = read_way_file(path, robot)
    for assumption in way.assumptions:
        note(assumption)
    if way.motion is not None:
        return way.model, way.motion
    found = motion_of_waypoints(way.model, way.waypoints)
    for assumption in found.assumptions:
        note(assumption)
    return way.model, found.trajectory


def _progress(what: str) -> Callable[[float], bool]:
    """Shows how far it is to a person at a terminal; never asks for an end."""

    def tell(share: float) -> bool:
        rewrite_line(f"{what} {share * 100:3.0f} %", is_last=share >= 1)
        return True

    return tell


def _lines(
    problem: SimulationProblem,
    figures: SimulationReport,
    findings: Sequence[Finding],
    runs: Sequence[VariedRun],
) -> list[str]:
    """The report for people."""
    feet = figures.feet_error
    margin = "–" if figures.min_margin is None else f"{figures.min_margin * 1000:.1f} mm"
    lines = [
        _outcome(problem, figures, findings),
        f"{problem.waypoints.count} waypoints, {figures.arrival_times[-1]:.1f} s of the robot, "
        f"{figures.realtime_factor:.1f} × real time; {problem.physics.title}, {problem.rig.value}.",
        f"  mean error   body {figures.body_error * 1000:.1f} mm, feet {_mm(feet)} mm "
        f"(mean {figures.feet_mean_error * 1000:.1f} mm)",
        f"  way          {_way_words(figures)}",
        f"  turn         {_turn_words(figures)}",
        f"  largest tilt {np.degrees(figures.max_tilt):.1f}° at {figures.max_tilt_time:.1f} s",
        f"  least margin {margin}",
        f"  slip         {_mm(figures.slip)} mm (feet 1 to {len(feet)})",
        f"  motors       {figures.motor_error.max() * 1000:.2f} mm behind their ramps at most, at their "
        f"force's limit {figures.saturation.max() * 100:.0f} % of the time at most",
        f"  rods         {figures.loop_error * 1000:.3f} mm off their length at most",
    ]
    lines += [f"  {found.severity.value}: {found.rule}: {found.sentence}" for found in findings]
    return lines + _variation_lines(runs)


def _share_words(made: float, asked: float, unit: str) -> str:
    return f"{made:.1f} of {asked:.1f} {unit} ({made / asked * 100:.0f} %)"


def _way_words(figures: SimulationReport) -> str:
    way = figures.way
    if not way.asked:
        return f"none is asked; the robot ends {way.gap * 1000:.1f} mm from the plan's end"
    made = _share_words(way.made * 1000, way.asked * 1000, "mm")
    return f"{made}; the robot ends {way.gap * 1000:.1f} mm from the plan's end"


def _turn_words(figures: SimulationReport) -> str:
    way = figures.way
    if not way.asked_turn:
        return f"{np.degrees(figures.heading):.1f} of {np.degrees(figures.planned_heading):.1f}°"
    return _share_words(np.degrees(way.made_turn), np.degrees(way.asked_turn), "°")


def _outcome(problem: SimulationProblem, figures: SimulationReport, findings: Sequence[Finding]) -> str:
    if figures.fell:
        return f"Falls over at {figures.fell_time:.1f} s."
    errors = sum(found.severity is Severity.ERROR for found in findings)
    warnings = len(findings) - errors
    fit = "Walks" if problem.rig is Rig.WALKING else "Done"
    return f"{'Not fit' if errors else fit}: {tally(errors, warnings)}."


def _variation_lines(runs: Sequence[VariedRun]) -> list[str]:
    if not runs:
        return []
    content = variations_content(runs)
    others = [
        f"    {'falls' if run.fell else 'ends early' if run.ended_early else 'tips'}: {run.variation.words}"
        for run in runs
        if not run.walks
    ]
    walk = len(runs) - len(others)
    return [f"  variations   {walk} of {len(runs)} walk ({content['share'] * 100:.0f} %)", *others]


def _mm(values: Floats) -> str:
    return ", ".join(f"{value * 1000:.1f}" for value in values)
