"""`frontier`."""

import time
from argparse import ArgumentParser, Namespace

import numpy as np

from app.cli.common.command import set_command
from app.cli.common.output import INFEASIBLE, end_on_signals, show, written_lines
from app.cli.gait_options import Method, add_gait_options, asked_gait, gait_file, returns_anew
from app.common.json import Json
from app.export.trajectory_files import require_unread, write_trajectory
from core.checks.made_plan import RULE
from core.errors import InputError
from core.gait.gait import Gait, drawn_timeline
from core.robot.model import load_robot
from solver_jobs import Frontier, FrontierSearch


def frontier_command(parser: ArgumentParser) -> None:
    """Makes the parser of `frontier`."""
    text = "Largest step of a gait, and what limits it; --step and --goal say only which way."
    set_command(parser, run_frontier, text)
    add_gait_options(parser)
    parser.add_argument("--free-phases", action="store_true", help="phases may also be longer")


def run_frontier(options: Namespace) -> int:
    """Finds how far a gait gets in an iteration, and what limits it."""
    end_on_signals()
    require_unread(options.output, gait_file(options.gait), has_companion=True)
    gait = asked_gait(options)
    begin = time.perf_counter()
    frontier = frontier_search(gait, options).run()
    seconds = time.perf_counter() - begin
    output = options.output if frontier.motion is not None else None
    if output is not None and frontier.motion is not None:
        write_trajectory(output, frontier.motion, gait.robot)
    content = {
        **frontier_content(options.gait, frontier),
        "seconds": seconds,
        "trajectory": None if output is None else str(output),
    }
    show(options, content, [*_lines(content), *written_lines(output, has_companion=True)])
    return 0 if frontier.reach > 0 else INFEASIBLE


def frontier_search(gait: Gait, options: Namespace) -> FrontierSearch:
    """The search, with the heights free unless one is given.

    Raises:
        InputError: phases are to be free that somebody has drawn by hand.
    """
    if options.free_phases and gait.timeline != drawn_timeline(gait):
        raise InputError(
            "The gait's timeline was edited by hand, so its phases cannot be lengthened. Leave out "
            "--free-phases, or give --order to draw the timeline anew.",
            "--free-phases",
        )
    given = options.plane_height is not None or options.end_plane_height is not None
    return FrontierSearch(
        gait,
        load_robot(gait.robot),
        **({"heights": ()} if given else {}),
        free_phases=options.free_phases,
        free_return=returns_anew(gait, options),
        exact=options.method is Method.NLP,
    )


def frontier_content(name: str, frontier: Frontier) -> Json:
    """A frontier as JSON content, SI; `name` is the gait's."""
    gait = frontier.gait
    step, yaw = ("max_step", "live_step"), ("max_yaw", "live_yaw")
    found, absent = (yaw, step) if frontier.turns else (step, yaw)
    return {
        "gait": name,
        **dict(zip(found, (frontier.reach, frontier.live_reach), strict=True)),
        **dict.fromkeys(absent),
        "limited_by": list(frontier.limited_by),
        "confirmed": frontier.confirmed,
        "plane_height": gait.options.plane_height,
        "phase_knots": gait.options.phase_knots,
        "closing_knots": gait.options.closing_knots,
        "knots": gait.timeline.sample_count,
        "workspace": gait.options.workspace.value,
        "margin": gait.options.margin,
        "explanation": list(frontier.explanation),
    }


def _lines(content: Json) -> list[str]:
    turns = content["max_yaw"] is not None
    reach, live = (
        (_degrees(content["max_yaw"]), _degrees(content["live_yaw"]))
        if turns
        else (_mm(content["max_step"]), _mm(content["live_step"]))
    )
    name = "turn" if turns else "step"
    if not content["max_yaw" if turns else "max_step"]:
        verdict = "confirmed" if RULE in content["limited_by"] else "possible"
        return [f"{content['gait']}: no {name} is {verdict}.", *content["explanation"]]
    said = (
        f"confirmed by the exact optimiser; {live} by the live one"
        if content["confirmed"]
        else "by the live optimiser"
    )
    return [
        f"{content['gait']}: the largest {name} is {reach} an iteration ({said}).",
        f"Actuator plane at {_mm(content['plane_height'])} at start and goal, phases of "
        f"{content['phase_knots']} samples, workspace {content['workspace']}, "
        f"margin {_mm(content['margin'])}.",
        *_limits(content),
    ]


def _limits(content: Json) -> list[str]:
    if not content["limited_by"]:
        return ["The live optimiser does not name what limits it."]
    families = ", ".join(content["limited_by"]).replace("_", " ")
    return [f"A little further it is limited by {families}:", *(f"  {s}" for s in content["explanation"])]


def _mm(value: float) -> str:
    return f"{value * 1000:.1f} mm"


def _degrees(value: float) -> str:
    return f"{np.degrees(value):.1f}°"
