"""Moves over time: what the board does in each message of the published walk and of the fastest walk."""

import json
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from app.bench.common.measure import Row
from app.bench.robot.moves_picture import moves_picture
from app.bench.robot.timed_board import TimedBoard, TimedMessage
from app.bench.robot.walk import as_published, published_path
from app.bench.robot.walked_moves import DECIMALS, Move, WalkedMoves, walks_content
from app.export.svg import svg
from app.export.trajectory_files import read_trajectory
from app.store.named_file import write_named
from core.arrays import Bools, Floats
from core.errors import CheckError, InputError
from core.gait.gait import heading_angle
from core.library.library import library
from core.pose_gaits.pose_problem import PoseProblem
from core.robot.model import load_robot
from solver_jobs import solve_poses

ROBOT, GAIT = "deltawalker", "walk"
"""Robot, foot order and direction of both walks."""
CYCLES_BEFORE = 1
"""Cycles in mid-walk that the board walks before the one that is shown."""


def bench_moves(reference: Path | None = None, report: Path | None = None) -> list[Row]:
    """Lets the board walk the published walk and the fastest one, and says where their seconds go.

    Args:
        reference: folder with the published data; without it the fastest walk alone is walked.
        report: SVG picture to write, with what it shows as JSON beside it; None for neither.

    Raises:
        InputError: there is a picture to write, and it cannot be (see `require_picture`); or the published
            walk is not in the folder.
    """
    if report is not None:
        require_picture(report, reference)
    walks = (fastest_walk(),) if reference is None else (published_walk(reference), fastest_walk())
    if report is not None:
        data = json.dumps(walks_content(walks)) + "\n"
        write_named(report, moves_svg(walks), report.with_suffix(".json"), data)
    return [_row(walk) for walk in walks]


def require_picture(report: Path, reference: Path | None) -> None:
    """Makes sure that the picture can be drawn and written.

    Raises:
        InputError: its name does not fit, its folder is not there, or no published data is named.
    """
    if report.suffix != ".svg":
        raise InputError(f"{report} is no picture; end its name in .svg.", "--report")
    if not report.parent.is_dir():
        raise InputError(f"{report.parent} is no folder; name a file in one that exists.", "--report")
    if reference is None:
        raise InputError(
            "The picture shows the published walk too; name the published data's folder after --reference.",
            "--reference",
        )


def moves_svg(walks: tuple[WalkedMoves, ...]) -> str:
    """The picture of walks as SVG."""
    return svg(moves_picture(walks, load_robot(ROBOT).colours), "moves")


def published_walk(reference: Path) -> WalkedMoves:
    """The published 10 mm walk, one waypoint a sample; the first message finds the robot in its place.

    Args:
        reference: folder with the published data.

    Raises:
        InputError: the walk is not there.
    """
    model = load_robot(ROBOT)
    read = read_trajectory(published_path(reference)).trajectory
    strokes = as_published(model, read).strokes
    board = TimedBoard(strokes[0])
    timed = [board.timed(row) for row in strokes]
    again = [0, *range(len(strokes))]
    moves = _moves(timed, read.contact[again], read.body_world[again])
    way = float(np.linalg.norm(read.body_world[-1, :2] - read.body_world[0, :2]))
    return WalkedMoves("Published walk", _mm(way), moves)


def fastest_walk() -> WalkedMoves:
    """One cycle of the fastest walk in mid-walk, with the limits that hold without options."""
    gait = library()[GAIT].gait
    result = solve_poses(PoseProblem(load_robot(ROBOT), gait.order, heading_angle(gait.orientation)))
    if result.gait is None:
        raise CheckError(f"There is no fastest walk: {' '.join(result.explanation)}", "moves")
    found = result.gait
    board = TimedBoard(found.strokes[0])
    cycle = [*found.strokes[1:]] * (CYCLES_BEFORE + 1)
    timed = [board.timed(row) for row in cycle][CYCLES_BEFORE * found.problem.move_count :]
    moves = _moves(timed, found.trajectory.contact, found.trajectory.body_world)
    return WalkedMoves("Fastest walk, in mid-walk", _mm(found.step), moves)


def _moves(timed: Sequence[TimedMessage], contact: Bools, bodies: Floats) -> tuple[Move, ...]:
    """The messages with the feet and the body that they move.

    A message whose motors are all near enough to its waypoint moves nothing; the next one that moves them
    makes up for it.

    Args:
        timed: the messages.
        contact: (messages + 1, legs) which feet stand before the first message and after each one.
        bodies: (messages + 1, 3) the same of the body, m.
    """
    moves: list[Move] = []
    here = 0
    for number, message in enumerate(timed):
        there = number + 1
        swings = ~contact[here : there + 1].all(axis=0)
        feet = tuple(int(foot) + 1 for foot in np.nonzero(swings)[0])
        way = float(np.linalg.norm(bodies[there, :2] - bodies[here, :2]))
        ramps = tuple((round(begin, DECIMALS), round(end, DECIMALS)) for begin, end in message.ramps)
        moves.append(Move(round(message.seconds, DECIMALS), ramps, feet, _mm(way) if ramps else 0.0))
        here = there if ramps else here
    return tuple(moves)


def _row(walk: WalkedMoves) -> Row:
    count = len(walk.moves)
    return {
        "walk": walk.name,
        "way_mm": walk.way,
        "messages": count,
        "without_ramp": walk.with_ramps(0),
        "one_ramp": walk.with_ramps(1),
        "two_ramps": walk.with_ramps(2),
        "seconds": round(walk.seconds, 2),
        "in_ramps_s": round(walk.ramp_seconds, 2),
        "motors_still_s": round(walk.seconds - walk.ramp_seconds, 2),
        "mm_a_message": round(walk.way / count, 2),
        "mm_s": round(walk.way / walk.seconds, 2),
    }


def _mm(metres: float) -> float:
    return round(metres * 1000.0, 2)
