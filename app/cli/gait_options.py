"""From the words of the command line to the gait that is asked, and to the method that solves it."""

import math
from argparse import ArgumentParser, Namespace
from collections.abc import Callable
from dataclasses import replace
from enum import StrEnum
from pathlib import Path

import numpy as np

from app.cli.common.argument_types import add_robot, foot_order, number, one_of, pair, whole, words_of
from app.documents.gait_json import parse_gait
from app.export.trajectory_files import read_text
from app.store.named_file import file_path
from core.errors import InputError
from core.gait.gait import Gait, drawn_timeline, heading_step, with_iterations, with_return
from core.gait.options import LEAST_PHASE_KNOTS, MOST_CLOSING_KNOTS, MOST_PHASE_KNOTS, GaitOptions
from core.gait.step import MAX_STEP
from core.library.library import library, optimised_entry
from core.library.new_gait import with_robot
from core.motion.heading_profile import HeadingProfile
from core.problem.motion_problem import Boundary, Cost, MotionProblem, Workspace
from core.robot.model import load_robot
from solver_jobs import MotionResult, solve_exact, solve_live


class Method(StrEnum):
    """Which tier gives the answer."""

    LIVE = "live"
    NLP = "nlp"


SOLVERS: dict[Method, Callable[[MotionProblem], MotionResult]] = {
    Method.LIVE: solve_live,
    Method.NLP: solve_exact,
}
"""How each method solves a problem in this process."""

_OPTIONS = (
    "clearance",
    "margin",
    "body_speed",
    "foot_speed",
    "plane_height",
    "end_plane_height",
    "workspace",
    "cost",
    "phase_knots",
    "closing_knots",
    "friction",
    "motor_speed",
    "motor_acceleration",
    "boundary",
)
"""Options of the command line that are options of the gait."""

_REDRAW = ("order", "phase_knots", "closing_knots")
"""Options of the command line that draw the timeline anew."""


def add_gait_options(parser: ArgumentParser) -> None:
    """A gait and everything that can be asked of it; what is left out stays as the gait has it."""
    add = parser.add_argument
    add(
        "gait",
        help="walk, amble, s-gait, c-gait, rotate, another id that `footfall gaits` lists as optimised or "
        "drawn, or a gait file",
    )
    add_robot(parser, "default the gait's own; with other legs it is drawn anew")
    travel = parser.add_mutually_exclusive_group()
    travel.add_argument("--step", type=number(0.0, MAX_STEP, "m"), default=None, help="m an iteration")
    travel.add_argument(
        "--goal", type=pair, default=None, metavar="X,Y", help="total travel at direction 1, m"
    )
    add("--yaw", type=number(-math.pi, math.pi, "rad"), default=None, help="rad an iteration")
    add("--direction", type=whole(1, 4), default=None)
    add("--order", type=foot_order, default=None, help="feet such as 3,2,4,1")
    add("--iterations", type=whole(1, 20), default=None)
    phase, closing = whole(LEAST_PHASE_KNOTS, MOST_PHASE_KNOTS), whole(0, MOST_CLOSING_KNOTS)
    add("--phase-knots", type=phase, default=None, help="samples of each stance phase and of each swing")
    add("--closing-knots", type=closing, default=None, help="samples of stance after the last swing")
    add("--knot-time", type=number(0.01, 10.0, "s"), default=None, help="s between samples (default 0.4)")
    _limit_options(parser)
    add("--boundary", type=one_of(Boundary), metavar=words_of(Boundary), default=None)
    text = "what is minimised (default goal, of a gait file its own)"
    add("--cost", type=one_of(Cost), metavar=words_of(Cost), default=None, help=text)
    add(
        "--method",
        type=one_of(Method),
        metavar=words_of(Method),
        default=Method.NLP,
        help="live: convex, given footholds and heights; nlp: exact (default)",
    )
    add("-o", "--output", type=file_path, default=None, help="trajectory CSV to write")


def _limit_options(parser: ArgumentParser) -> None:
    """What a motion keeps."""
    add = parser.add_argument
    add("--clearance", type=number(0.0, 0.02, "m"), default=None, help="m that a swing rises (default 0.003)")
    add(
        "--margin",
        type=number(0.0, 0.05, "m"),
        default=None,
        help="m that the centre of pressure stays inside the support polygon (default the robot's own)",
    )
    add("--body-speed", type=number(0.0005, 1.0, "m/s"), default=None, help="m/s (default 0.015)")
    add("--foot-speed", type=number(0.0005, 1.0, "m/s"), default=None, help="m/s (default 0.015)")
    height = number(0.03, 0.1, "m")
    add("--plane-height", type=height, default=None, help="actuator plane at the start, m")
    add("--end-plane-height", type=height, default=None, help="and at the goal, m")
    add("--workspace", type=one_of(Workspace), metavar=words_of(Workspace), default=None)
    add("--friction", type=number(0.01, 10.0, ""), default=None, help="coefficient")
    add(
        "--motor-speed",
        type=number(0.0005, 1.0, "m/s"),
        default=None,
        help="limit of every motor, m/s (default none)",
    )
    add(
        "--motor-acceleration",
        type=number(0.0005, 10.0, "m/s²"),
        default=None,
        help="limit of every motor, m/s² (default none)",
    )


def asked_gait(options: Namespace) -> Gait:
    """The gait that a command line names, with everything that it changes.

    Raises:
        InputError: there is no such gait, it is made by hand, or what is asked does not fit together.
    """
    return gait_with_options(named_gait(options.gait), options)


def gait_with_options(gait: Gait, options: Namespace) -> Gait:
    """A gait with everything that a command line changes of it.

    Raises:
        InputError: what is asked does not fit together.
    """
    if options.robot is not None:
        model = load_robot(options.robot)
        gait = with_robot(gait, model, options.order)
        if options.gait in library():
            gait = gait.with_options(margin=model.margin)
    return _with_options(gait, options)


def named_gait(name: str) -> Gait:
    """A built-in gait with the command's own defaults, or one from a file with its options."""
    path = gait_file(name)
    if path is None:
        gait = optimised_entry(name).gait
        return gait.with_options(margin=load_robot(gait.robot).margin, cost=GaitOptions.cost)
    gait = parse_gait(read_text(path), path.name)
    if gait.segment_table is not None:
        raise InputError(
            f"{path.name} is made by hand from a segment table; there is nothing to optimise.", name
        )
    return gait


def gait_file(name: str | None) -> Path | None:
    """The file that a gait is read from; None for a built-in one."""
    if name is None or name in library():
        return None
    path = Path(name)
    return path if path.suffix == ".json" or path.exists() else None


def _with_options(gait: Gait, options: Namespace) -> Gait:
    """The gait with its options changed; its timeline is drawn anew where it must be."""
    given = {name: getattr(options, name) for name in _OPTIONS if getattr(options, name) is not None}
    direction = options.direction or gait.direction
    timeline = replace(gait.timeline, sample_time=options.knot_time or gait.timeline.sample_time)
    changed = replace(
        gait,
        direction=direction,
        order=options.order or gait.order,
        step=_step(gait, options),
        timeline=timeline.turned(direction - gait.direction),
        held=gait.held.turned((direction - gait.direction) * timeline.leg_count // 4, timeline.leg_count),
        options=replace(gait.options, **given),
    )
    _require_straight(changed)
    if returns_anew(gait, options):
        changed = with_return(changed, load_robot(gait.robot))
    if any(getattr(options, name) is not None for name in _REDRAW):
        changed = replace(changed, iterations=options.iterations or gait.iterations)
        return replace(changed, timeline=drawn_timeline(changed))
    return changed if options.iterations is None else with_iterations(changed, options.iterations)


def _require_straight(gait: Gait) -> None:
    """A cycle goes on as it began, so it cannot turn."""
    if gait.options.boundary is Boundary.PERIODIC and gait.step[2] != 0.0:
        degrees = float(np.degrees(gait.step[2]))
        raise InputError(
            f"The gait turns by {degrees:.1f}° an iteration, and a periodic motion must end with the heading "
            "that it began with. Leave out --yaw, or use --boundary rest.",
            "--boundary",
        )


def _step(gait: Gait, options: Namespace) -> tuple[float, float, float]:
    dx, dy, yaw = gait.step
    if options.step is not None:
        dx, dy, _ = heading_step(gait.orientation, options.step)
    if options.goal is not None:
        iterations = options.iterations or gait.iterations
        dx, dy = (part / iterations for part in options.goal)
    return dx, dy, yaw if options.yaw is None else options.yaw


def returns_anew(gait: Gait, options: Namespace) -> bool:
    """Whether the closing stance is as long as the turn back takes: nobody has set it, on file or here."""
    if gait.options.turning is not HeadingProfile.RETURN or options.closing_knots is not None:
        return False
    return gait.timeline == with_return(gait, load_robot(gait.robot)).timeline
