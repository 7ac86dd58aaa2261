"""`fastest`."""

import json
import math
from argparse import ArgumentParser, Namespace
from collections.abc import Callable
from contextlib import closing, suppress
from dataclasses import dataclass, replace
from pathlib import Path

from app.cli.common.argument_types import add_robot, foot_order, free_or, number, turn_or_side, whole, zero_or
from app.cli.common.command import set_command
from app.cli.common.output import (
    INFEASIBLE,
    NOT_FIT,
    end_on_signals,
    note,
    show,
    written_lines,
)
from app.cli.common.progress import clear_line, rewrite_line
from app.cli.fastest_search import search_lines, show_progress
from app.cli.gait_options import gait_file, named_gait
from app.common.json import Json
from app.documents.gait_json import gait_content
from app.export.trajectory_files import require_unread
from app.export.way_files import write_pose_gait
from app.fastest.search import Searched, chosen_gait, search_content, searched
from app.store.named_file import file_path, form_of, write_named
from core.errors import InputError
from core.gait.gait import Gait, heading_step
from core.gait.poses import MOST_SWAY, POSE_LIMITS, Poses
from core.library.library import order_name
from core.library.new_gait import with_robot
from core.pose_gaits.gait_poses import USUAL_STEP, new_pose_gait, pose_problem, with_poses
from core.pose_gaits.pace import motion_words
from core.pose_gaits.pose_gait import PoseGait
from core.pose_gaits.pose_problem import MOST_CYCLES, POSE_BOUNDS, PoseBounds, PoseProblem
from core.pose_gaits.start_motion import TURN_GUESS
from core.robot.model import RobotModel, load_robot
from solver_jobs import FastestSearch, PoseGaitSolver, PoseProgress, PoseResult, SolveStatus

NO_TURN = 1e-6
"""A turn that is smaller is none, rad."""
TICK_SECONDS = 0.1
"""Between looks for Ctrl-C."""


@dataclass(frozen=True, eq=False)
class FastestWalk:
    """A gait in mid-walk and from the standard stance to rest.

    Args:
        name: of the gait that gave foot order and direction.
        cycle: one cycle in mid-walk.
        walk: all cycles, from the standard stance to rest.
    """

    name: str
    cycle: PoseResult
    walk: PoseResult

    @property
    def status(self) -> SolveStatus:
        """Solved where both are; else how the first one that is not ended."""
        results = (self.cycle, self.walk)
        return next((one.status for one in results if one.gait is None), SolveStatus.SOLVED)

    @property
    def explanation(self) -> tuple[str, ...]:
        """Why it is not solved."""
        return next((one.explanation for one in (self.cycle, self.walk) if one.gait is None), ())


_LIMIT_OPTIONS = {
    "margin": ("M", "m", "m that the body stays inside the support polygon, everywhere"),
    "clearance": ("M", "m", "m that a foot rises above the plane of the standing ones"),
    "stop_bound": ("S", "s", "s for which the robot hears no Stop at most"),
    "slip": ("M", "m", "m that a standing foot may leave its foothold within a move"),
    "shoe_distance": ("M", "m", "m between the middles of two feet at least"),
    "arm_distance": ("M", "m", "m between the arms of neighbouring legs at least; 0 where they may touch"),
}
"""Limits of a pose gait: how each is written, its unit, and what it means."""


def fastest_command(parser: ArgumentParser) -> None:
    """Makes the parser of `fastest`."""
    text = "The walk with the most millimetres a second of the robot's own time, as waypoints."
    set_command(parser, run_fastest, text)
    add = parser.add_argument
    text = (
        "walk (default), amble, s-gait, c-gait, rotate, another id that `footfall gaits` lists as optimised, "
        "drawn or poses, or a gait file: foot order and direction"
    )
    add("gait", nargs="?", default=None, help=text)
    add(
        "--order",
        type=foot_order,
        default=None,
        help="feet such as 3,2,4,1 at direction 1, instead of the gait's own",
    )
    text = "choose foot order, direction and overlaps too: try all that differ, print them, take the fastest"
    add("--search", action="store_true", help=text)
    text = "the same, and what other margins and stop bounds cost; a few minutes"
    add("--front", action="store_true", help=text)
    step = "m a cycle, free for the fastest, or 0 for a turn on the spot (default free)"
    add("--step", type=free_or(zero_or(number(0.0005, 0.2, "m"))), default=None, metavar="M|free", help=step)
    turn = "rad a cycle, to the left above 0; on the spot also left or right: as fast as possible (default 0)"
    add("--turn", type=turn_or_side, default=None, metavar="RAD|left|right", help=turn)
    text = (
        "how far the heading may differ from an even turn, rad (default 0): sway makes a gait faster, but "
        "soles pivot on the ground, which is not tested with flat shoes yet"
    )
    add("--sway", type=number(0.0, MOST_SWAY, "rad"), default=0.0, metavar="RAD", help=text)
    text = "from the standard stance to rest (default 1)"
    add("--cycles", type=whole(1, MOST_CYCLES), default=1, metavar="N", help=text)
    bounds = PoseBounds()
    for name, (factor, unit, text) in _LIMIT_OPTIONS.items():
        least, most = POSE_BOUNDS[name]
        words = f"{text} (default {getattr(bounds, name):g})"
        option = f"--{name.replace('_', '-')}"
        add(option, type=number(least, most, unit), default=getattr(bounds, name), metavar=factor, help=words)
    add("--direction", type=whole(1, 4), default=None, help="1 to 4 (default the gait's own)")
    add_robot(parser, "default the gait's own; with other legs in one of its orders")
    add("-o", "--output", type=file_path, default=None, help="WAY.csv with a companion, or GAIT.json")


def run_fastest(options: Namespace) -> int:
    """Finds the walk with the most millimetres a robot second, and writes its waypoints."""
    end_on_signals()
    form = None if options.output is None else form_of(options.output, (".csv", ".json"))
    if options.output is not None and form is None:
        raise InputError(
            f"{options.output} is neither a waypoint file nor a gait file; end its name in .csv or .json.",
            "-o",
        )
    require_unread(options.output, gait_file(options.gait), has_companion=form == ".csv")
    name, document = fastest_document(options)
    document, walk, found = fastest_walk(options, name, document)
    problem = pose_problem(document, load_robot(document.robot))
    written: Path | None = None
    if options.output is not None and walk.walk.gait is not None and walk.status is SolveStatus.SOLVED:
        if form == ".json":
            content = gait_content(with_poses(document, walk.walk.gait))
            write_named(options.output, json.dumps(content, ensure_ascii=False) + "\n")
        else:
            write_pose_gait(options.output, walk.walk.gait, _origin(walk))
        written = options.output
    if not problem.model.wired:
        note(f"The firmware timing of {problem.model.title} is not known. Times are as for the DeltaWalker.")
    content, lines = walk_content(walk, problem, written), _lines(walk, written)
    if found is not None:
        content |= {"search": search_content(found)}
        lines = [*search_lines(found), *lines]
    show(options, content, lines)
    return {SolveStatus.SOLVED: 0, SolveStatus.INFEASIBLE: INFEASIBLE}.get(walk.status, NOT_FIT)


def fastest_walk(options: Namespace, name: str, document: Gait) -> tuple[Gait, FastestWalk, Searched | None]:
    """The fastest walk of a document, or of all foot orders; the document without its poses, and the search.

    Args:
        options: whether to search, and over what.
        name: what the walk is called.
        document: what is asked.

    Raises:
        InputError: a search is to keep to one direction.
    """
    model, found = load_robot(document.robot), None
    if options.search or options.front:
        if options.direction is not None:
            raise InputError("The search chooses the direction too; leave out --direction.", "--direction")
        with closing(FastestSearch(niceness=0)) as search:
            problem = pose_problem(document, model)
            found = searched(search, problem, options.order, options.front, show_progress)
    with closing(PoseGaitSolver(niceness=0)) as solver:
        if found is None or not found.ranked:
            walk = _solved(solver, name, pose_problem(document, model))
        else:
            document, walk = _walk_of_search(solver, document, model, found)
    return document, walk, found


def fastest_document(options: Namespace, like: Gait | None = None) -> tuple[str, Gait]:
    """The document of the walk that the options ask for, without poses yet, and the name of its gait.

    Args:
        options: what is asked.
        like: a gait for foot order and direction; None for the one that the options name.

    Raises:
        InputError: there is no such gait, or what is asked does not fit together.
    """
    name = options.gait or _named_by(options.order)
    gait = named_gait(name) if like is None else like
    if gait.sequence:
        raise InputError(
            f"{name} is a sequence. Choose walk, amble, s-gait, c-gait or rotate, or give the foot order "
            "with --order.",
            "GAIT",
        )
    if options.robot is not None:
        gait = with_robot(gait, load_robot(options.robot), options.order)
    model = load_robot(gait.robot)
    order = gait.order if options.order is None else options.order
    _require_order(order, model.leg_count)
    step, is_free = _way(options, gait)
    asked = replace(
        gait, order=order, direction=options.direction or gait.direction, step=step, iterations=options.cycles
    ).with_options(margin=options.margin, clearance=options.clearance, stop_bound=options.stop_bound)
    limits = {limit: getattr(options, limit) for limit in POSE_LIMITS}
    poses = Poses(is_free, **limits, sway=options.sway)
    return name, new_pose_gait(f"{gait.name}, fastest", asked, poses, model)


def _way(options: Namespace, gait: Gait) -> tuple[tuple[float, float, float], bool]:
    """Step and turn a cycle that are asked, (dx, dy, yaw), and whether they are those of the fastest gait."""
    on_the_spot = options.step == 0.0 or (
        options.step is None and not any(gait.step[:2]) and gait.step[2] != 0.0
    )
    side = options.turn if isinstance(options.turn, str) else None
    turn = gait.step[2] if options.turn is None else options.turn
    if side is not None and not on_the_spot:
        raise InputError(
            f"--turn {side} is the fastest turn on the spot; add --step 0, or give the turn in rad a cycle.",
            "--turn",
        )
    if not on_the_spot:
        dx, dy, _ = heading_step(gait.orientation, USUAL_STEP if options.step is None else options.step)
        return (dx, dy, turn), options.step is None
    is_free = side is not None or (options.turn is None and turn != 0.0)
    if side is not None:
        turn = TURN_GUESS if side == "left" else -TURN_GUESS
    if turn == 0.0:
        raise InputError(
            "A turn on the spot (step 0) needs a turn; say how far with --turn: rad a cycle, left or right.",
            "--turn",
        )
    return (0.0, 0.0, turn), is_free


def _require_order(order: tuple[int, ...], legs: int) -> None:
    if sorted(order) != list(range(1, legs + 1)):
        raise InputError(
            f"--order is {','.join(map(str, order))}; it must name each foot 1 to {legs} once.", "--order"
        )


def _named_by(order: tuple[int, ...] | None) -> str:
    """The optimised gait whose feet step in this order, wherever it begins; else the walk."""
    return "walk" if order is None else order_name(order) or "walk"


def _solved(solver: PoseGaitSolver, name: str, problem: PoseProblem) -> FastestWalk:
    cycle = _waited(solver, replace(problem, cycles=None), "In mid-walk")
    if cycle.gait is None:
        return FastestWalk(name, cycle, cycle)
    return FastestWalk(name, cycle, _waited(solver, problem, "From stance to rest"))


def _walk_of_search(
    solver: PoseGaitSolver, document: Gait, model: RobotModel, found: Searched
) -> tuple[Gait, FastestWalk]:
    """The fastest choices in turn until one also walks from the standard stance to rest; else the fastest."""
    walks: list[tuple[Gait, FastestWalk]] = []
    for choice, tried in found.ranked:
        chosen = chosen_gait(document, choice, model)
        name = order_name(choice.order) or "-".join(map(str, choice.order))
        whole = _waited(solver, pose_problem(chosen, model), f"{name}, from stance to rest")
        walks.append((chosen, FastestWalk(name, tried.result, whole)))
        if whole.status is SolveStatus.SOLVED:
            return walks[-1]
        note(f"{name} has no walk from the standard stance to rest: {' '.join(whole.explanation)}")
    return walks[0]


def _waited(solver: PoseGaitSolver, problem: PoseProblem, what: str) -> PoseResult:
    """The result of one search; Ctrl-C and SIGTERM are heard meanwhile and end it."""
    search = solver.submit(problem, _progress(what))
    try:
        while True:
            with suppress(TimeoutError):
                return search.result(TICK_SECONDS)
    finally:
        clear_line()


def _progress(what: str) -> Callable[[PoseProgress], None]:
    """Shows the stages to a person at a terminal."""

    def tell(known: PoseProgress) -> None:
        pace = "" if known.speed is None else f", {motion_words(known.speed, known.turn_rate or 0.0)} so far"
        rewrite_line(f"{what}: {known.stage}{pace}")

    return tell


def walk_content(walk: FastestWalk, problem: PoseProblem, written: Path | None) -> Json:
    """A walk as JSON content, SI."""
    cycle, whole = walk.cycle.gait, walk.walk.gait
    checks = [result.check for result in (walk.cycle, walk.walk) if result.check is not None]
    solved = cycle is not None and whole is not None
    return {
        "status": walk.status.value,
        "optimal": walk.cycle.optimal and walk.walk.optimal,
        "gait": walk.name,
        "order": list(problem.order),
        "robot": problem.model.name,
        "step": None if cycle is None else cycle.step,
        "cycles": problem.all_cycles,
        "moves": problem.moves_a_cycle if cycle is None else cycle.problem.move_count,
        "robot_seconds": None if cycle is None else cycle.seconds,
        "speed": None if cycle is None else cycle.speed,
        "turn": None if cycle is None else cycle.turn,
        "turn_rate": None if cycle is None else cycle.turn_rate,
        "total_seconds": None if whole is None else whole.seconds,
        "total_distance": None if whole is None else whole.distance,
        "total_speed": None if whole is None else whole.speed,
        "margin": min(check.figures.margin for check in checks) if solved else None,
        "shoe_distance": min(check.figures.shoe_distance for check in checks) if solved else None,
        "arm_distance": min(check.figures.arm_distance for check in checks) if solved else None,
        "stop_seconds": max(check.figures.stop_seconds for check in checks) if solved else None,
        "solve_seconds": walk.cycle.solve_seconds + (0.0 if whole is None else walk.walk.solve_seconds),
        "explanation": list(walk.explanation),
        "waypoints": None if written is None else str(written),
    }


def _lines(walk: FastestWalk, written: Path | None) -> list[str]:
    cycle, whole, check = walk.cycle.gait, walk.walk.gait, walk.walk.check
    if cycle is None or whole is None or check is None or walk.status is not SolveStatus.SOLVED:
        return [f"No walk ({walk.status.value}).", *walk.explanation]
    cycles = whole.problem.all_cycles
    lines = [
        f"{walk.name}, feet {'-'.join(map(str, cycle.problem.order))}: "
        f"{motion_words(cycle.speed, cycle.turn_rate)} in mid-walk, {_distance(cycle.step, cycle.turn)} in "
        f"{cycle.problem.move_count} moves and {cycle.seconds:.1f} robot seconds a cycle.",
        f"From the standard stance to rest, {cycles} {'cycle' if cycles == 1 else 'cycles'}: "
        f"{_distance(whole.distance, whole.turn * cycles)} in {whole.seconds:.1f} s, "
        f"{motion_words(whole.speed, whole.turn_rate)}.",
        f"Checked along every move: margin {check.figures.margin * 1000:.1f} mm, feet at least "
        f"{check.figures.shoe_distance * 1000:.1f} mm and arms "
        f"{check.figures.arm_distance * 1000:.1f} mm apart, standing feet within "
        f"{check.figures.slip * 1000:.2f} mm; Stop takes effect within {check.figures.stop_seconds:.1f} s.",
    ]
    return [*lines, *written_lines(written, has_companion=written is not None and written.suffix != ".json")]


def _distance(way: float, turn: float) -> str:
    """How far a gait goes and turns, in words; m and rad."""
    parts = [f"{way * 1000:.1f} mm" if way else "", _degrees(turn) if abs(turn) > NO_TURN else ""]
    return " and ".join(filter(None, parts))


def _degrees(angle: float) -> str:
    """The size of an angle in words, and to which side it turns."""
    return f"{abs(math.degrees(angle)):.1f}° to the {'left' if angle > 0.0 else 'right'}"


def _origin(walk: FastestWalk) -> Json:
    gait = walk.walk.gait
    return {} if gait is None else {"made": "fastest", "gait": walk.name, **origin_of(gait)}


def origin_of(gait: PoseGait) -> Json:
    """What a pose gait was asked for, as JSON content, SI."""
    problem, bounds = gait.problem, gait.problem.bounds
    return {
        "order": list(problem.order),
        "heading": problem.heading,
        "step": gait.step,
        "turn": gait.turn,
        "sway": problem.sway,
        "cycles": problem.cycles,
        "margin": bounds.margin,
        "clearance": bounds.clearance,
        "slip": bounds.slip,
        "shoe_distance": bounds.shoe_distance,
        "arm_distance": bounds.arm_distance,
    }
