"""Plans from gaits and waypoints for scripts: optimised, for the robot's clock, or as they are given."""

from __future__ import annotations

from argparse import Namespace
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from app.cli.commands_fastest import fastest_document, fastest_walk, walk_content
from app.cli.commands_files import planned_gait
from app.cli.commands_frontier import frontier_content, frontier_search
from app.cli.commands_gait import optimise as solve
from app.cli.gait_options import Method, gait_with_options, named_gait
from app.documents.trajectory_json import trajectory_content
from app.export.way_files import is_way_file, read_way_file
from app.gaits.live_plans import is_drawing
from app.plans.make_plan import make_plan
from app.plans.plan import Plan as Made
from app.plans.plan import PlanSource, sending_of
from app.scripting.arrays import array_of
from app.scripting.gaits import Gait, gait
from app.scripting.options import command_options
from app.scripting.plans import Plan
from app.scripting.robots import Robot
from core.arrays import Floats
from core.checks.made_plan import other_motion_words
from core.errors import CheckError, InputError
from core.gait.gait import Gait as Document
from core.gait.recording import AS_RECORDED, RecordingFit
from core.motion.trajectory import Trajectory
from core.motion.within_stroke import clipped_motion
from core.pose_gaits.gait_poses import pose_problem, with_poses
from core.recorded.waypoint_motion import motion_of_waypoints
from core.robot.model import load_robot
from core.wire.robot_time import move_estimates
from core.wire.waypoint_merging import plan_of_knots, plan_waypoints
from core.wire.waypoints import Waypoints
from solver_jobs import SolveStatus, solve_live

LEAST_SECONDS = 0.1
"""Planned time of a row of strokes that is no move for the robot, s."""


def optimise(source: str | Path | Gait, **options: Any) -> Plan:
    """The optimised motion of a gait, believed only through the independent checker.

    Args:
        source: `walk`, `amble`, `s-gait`, `c-gait` or `rotate`, a gait file, or a gait.
        options: those of `footfall optimise`, in SI: step (m an iteration), goal, yaw (rad), margin (m),
            clearance (m), iterations, method (`nlp` or `live`) and others.

    Returns:
        The plan; `status` is `solved`, `infeasible` or `failed`, and `explanation` says why.

    Raises:
        InputError: there is no such gait or option, or a value does not fit.

    Example:
        >>> import footfall as ff
        >>> plan = ff.optimise("walk", step=0.010, margin=0.006, method="live")
        >>> plan.status, plan.waypoints.shape[1:]
        ('solved', (4, 3))
    """
    document, asked = drawn_document("optimise", source, ("remedy",), options)
    return _optimised(Gait(document), asked.method, asked.gait)


def drawn_document(
    command: str, source: str | Path | Gait, without: tuple[str, ...], options: dict[str, Any]
) -> tuple[Document, Namespace]:
    """A gait that a solver can be asked for, with what is changed of it, and the options of its command.

    Raises:
        InputError: it is made by hand, for the robot's clock, or a sequence.
    """
    name = source.name if isinstance(source, Gait) else str(source)
    asked = command_options(command, [name], without, **options)
    document = source.document if isinstance(source, Gait) else named_gait(name)
    if not is_drawing(replace(document, recorded=None)) or document.sequence:
        raise InputError(
            f"“{document.name}” is made by hand, for the robot's clock, or a sequence; there is nothing to "
            "optimise. footfall.plan(…) gives its plan.",
            "source",
        )
    return gait_with_options(replace(document, recorded=None), asked), asked


def _optimised(of: Gait, method: Method, name: str) -> Plan:
    verified = solve(of.document, method)
    figures = {
        "gait": name,
        "method": method.value,
        "knots": of.document.timeline.sample_count,
        "knot_time": of.sample_time,
        "robot": of.robot,
        **verified.content,
    }
    if not verified.has_motion:
        robot = Robot(load_robot(of.robot))
        return Plan(verified.status.value, robot, of, tuple(verified.explanation), figures)
    result = {**verified.content, "trajectory": trajectory_content(verified.trajectory)}
    return _of_made(of, make_plan(of.document, result, solve_live), verified.status.value, figures)


def _of_made(of: Gait, made: Made, status: str, figures: dict[str, Any]) -> Plan:
    robot = Robot(made.model)
    if made.trajectory is None or made.is_draft:
        why = made.note if made.refusal is None else made.refusal.sentence
        return Plan(_failure(made).value, robot, of, (why,), figures)
    told: tuple[str, ...] = ()
    if made.made is not None and not made.makes_planned:
        told = (other_motion_words(made.made),)
        status = SolveStatus.FAILED.value if status == SolveStatus.SOLVED.value else status
    if made.refusal is not None:
        told = (made.refusal.sentence,)
    return Plan(status, robot, of, told, figures, made.trajectory, made.way, made.clipped)


def _failure(made: Made) -> SolveStatus:
    """Whether a plan without a motion is proven to have none, or nothing was found."""
    if isinstance(made.refusal, InputError):
        raise made.refusal
    if made.live is not None:
        return made.live.status
    return SolveStatus.FAILED if isinstance(made.refusal, CheckError) else SolveStatus.INFEASIBLE


def fastest(source: str | Path | Gait | None = None, **options: Any) -> Plan:
    """The walk with the most millimetres a robot second under the firmware's law of time.

    Args:
        source: a gait as for `footfall.optimise`, for foot order and direction; None for the walk, or for
            the one whose order is given.
        options: those of `footfall fastest`, in SI: order, step (m a cycle or `free`), cycles, margin (m),
            stop_bound (s), turn (rad a cycle, `left` or `right`), search and others.

    Returns:
        The plan from the standard stance to rest; its `figures` describe the cycle in mid-walk.

    Raises:
        InputError: there is no such gait or option, or a value does not fit.

    Example:
        >>> import footfall as ff
        >>> plan = ff.fastest("c-gait", step=0.010)
        >>> plan.status, plan.figures["speed"] > 0.0005
        ('solved', True)
    """
    of = source if isinstance(source, Gait) else None
    words = [] if source is None else [of.name if of is not None else str(source)]
    asked = command_options("fastest", words, ("front",), **options)
    name, document = fastest_document(asked, None if of is None else of.document)
    document, walk, _ = fastest_walk(asked, name, document)
    model = load_robot(document.robot)
    figures = walk_content(walk, pose_problem(document, model), None)
    found = walk.walk.gait
    if found is None or walk.status is not SolveStatus.SOLVED:
        return Plan(walk.status.value, Robot(model), Gait(document), tuple(walk.explanation), figures)
    document = with_poses(document, found)
    return _of_made(Gait(document), make_plan(document, None, solve_live), walk.status.value, figures)


def frontier(source: str | Path | Gait, **options: Any) -> dict[str, Any]:
    """The largest step of a gait that has a motion, and what limits it.

    Args:
        source: a gait as for `footfall.optimise`.
        options: those of `footfall frontier`, in SI; step and goal say only which way.

    Returns:
        What `footfall frontier --json` prints: `max_step` in m an iteration (`max_yaw` in rad for a turn),
        `limited_by`, and the height and phases at which it was found.

    Raises:
        InputError: there is no such gait or option, or a value does not fit.

    Example:
        >>> import footfall as ff
        >>> ff.frontier("walk", method="live")["max_step"] > 0.01
        True
    """
    document, asked = drawn_document("frontier", source, (), options)
    return frontier_content(asked.gait, frontier_search(document, asked).run())


def plan(
    source: str | Path | Gait | Plan | ArrayLike,
    *,
    method: str = "nlp",
    robot: str | None = None,
    within_stroke: str | None = None,
) -> Plan:
    """The plan of anything: a gait, a table, a sequence, a recorded motion, a file, or strokes of your own.

    Args:
        source: a gait as for `footfall.gait`, a waypoint file, a plan, or an array (lines, legs, 3) of
            strokes in m.
        method: what makes the motion of a drawn gait: `nlp` or `live`.
        robot: of waypoints without a companion, and of an array (the DeltaWalker where None).
        within_stroke: `clip` keeps strokes beyond the motors' range at its end; None refuses them.

    Returns:
        The plan; `status` is `given` where nothing had to be solved.

    Raises:
        InputError: there is no such gait, a file cannot be read, or an array has another shape.

    Example:
        >>> import footfall as ff
        >>> import numpy as np
        >>> strokes = np.full((5, 4, 3), 0.0055)
        >>> ff.plan(strokes).waypoints.shape
        (5, 4, 3)
    """
    fit = RecordingFit(
        within_stroke=command_options("check", [""], within_stroke=within_stroke).within_stroke
    )
    if isinstance(source, Plan):
        if robot is not None or method != Method.NLP:
            raise InputError("A plan is made already; robot and method are for gaits.", "source")
        return source if fit == AS_RECORDED else _clipped(source)
    if not isinstance(source, str | Path | Gait):
        given = _of_strokes(array_of(source, _shape(robot), "strokes", "m"), robot)
        return given if fit == AS_RECORDED else _clipped(given)
    if not isinstance(source, Gait) and Path(source).suffix == ".csv" and is_way_file(Path(source)):
        read = read_way_file(Path(source), robot)
        given = _of_waypoints(Robot(read.model), read.waypoints, read.motion)
        return given if fit == AS_RECORDED else _clipped(given)
    of = gait(source)
    if robot is not None:
        of = of.changed(robot=robot)
    chosen = Method(command_options("optimise", [of.name], method=method).method)
    if is_drawing(of.document) and not of.document.sequence:
        return _optimised(of, chosen, of.id or of.name)
    made = planned_gait(of.document, chosen)
    is_given = made.source in (PlanSource.MANUAL, PlanSource.RECORDED)
    planned = _of_made(of, made, "given" if is_given else SolveStatus.SOLVED.value, {})
    return planned if fit == AS_RECORDED else _clipped(planned)


def _clipped(of: Plan) -> Plan:
    """The plan with strokes beyond the motors' range at its end.

    Raises:
        InputError: it is too far beyond the range.
    """
    kept = clipped_motion(of.robot.model, of.need_motion())
    if not kept.clipped.any():
        return of
    sending = (0.0, None) if of.gait is None else sending_of(of.gait.document)
    way = plan_waypoints(of.robot.model, kept.trajectory, *sending)
    return replace(of, trajectory=kept.trajectory, way=way, clipped=kept.clipped, explanation=())


def _shape(robot: str | None) -> tuple[int, int]:
    return load_robot(robot or "deltawalker").leg_count, 3


def _of_strokes(strokes: Floats, robot: str | None) -> Plan:
    rows = strokes.reshape(-1, *strokes.shape[-2:])
    return _of_waypoints(Robot(load_robot(robot or "deltawalker")), _timed(rows), None)


def _timed(rows: Floats) -> Waypoints:
    """Strokes as waypoints, each planned for as long as the robot takes."""
    still = Waypoints(rows, np.zeros(len(rows)))
    return replace(still, durations=np.maximum(move_estimates(still), LEAST_SECONDS))


def _of_waypoints(robot: Robot, waypoints: Waypoints, motion: Trajectory | None) -> Plan:
    """Waypoints with their motion: a companion's, else what forward kinematics finds."""
    trajectory = motion or motion_of_waypoints(robot.model, waypoints).trajectory
    way = plan_of_knots(robot.model, trajectory, waypoints)
    return replace(Plan("given", robot), trajectory=trajectory, way=way)
