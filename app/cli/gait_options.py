"""From the words of the command line to the gait that is asked, and to the method that solves it."""

from argparse import Namespace
from collections.abc import Callable
from dataclasses import replace
from enum import StrEnum
from pathlib import Path

import numpy as np

from app.documents.gait_json import parse_gait
from app.export.trajectory_files import read_text
from core.errors import InputError
from core.gait.gait import Gait, drawn_timeline, heading_step, with_iterations, with_return
from core.gait.options import GaitOptions
from core.library.library import library, optimised_entry
from core.library.new_gait import with_robot
from core.motion.heading_profile import HeadingProfile
from core.problem.motion_problem import Boundary, MotionProblem
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
    path = Path(name)
    if name in library() or (path.suffix != ".json" and not path.exists()):
        gait = optimised_entry(name).gait
        return gait.with_options(margin=load_robot(gait.robot).margin, cost=GaitOptions.cost)
    gait = parse_gait(read_text(path), path.name)
    if gait.segment_table is not None:
        raise InputError(
            f"{path.name} is made by hand from a segment table; there is nothing to optimise.", name
        )
    return gait


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
