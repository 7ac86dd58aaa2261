"""Random waypoints one move length apart: of all motors, of one leg, or of the body over standing feet."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from core.arrays import Bools, Floats
from core.robot.kinematics import actuator_plane_pose, feet_in_robot, free_strokes
from core.robot.model import load_robot
from core.wire.messages import HIGHEST_MM, LOWEST_MM, MOTORS

LOWEST, HIGHEST = LOWEST_MM / 1000.0, HIGHEST_MM / 1000.0
LEG_MOTORS = 3
HOME_BODY = (0.0, 0.0, 0.0705)
"""Centre of mass over the middle of the feet, m."""
TRIES = 60
LENGTH_ERROR = 0.01
"""A move's length may differ by this share from the wanted one."""

NextWaypoint = Callable[[Floats, float, np.random.Generator], Floats | None]
"""The next waypoint from here, or None where no move of that length is in range."""


def random_waypoints(kind: str, length: float, count: int, seed: int = 0) -> Floats:
    """(n, 12) waypoints with `count` moves of one length, m; from dead ends a longer move leads back.

    Args:
        kind: of the moves, one of `KINDS`.
        length: largest distance of any motor in a move, m.
        count: how many moves.
        seed: of the random numbers.
    """
    dice = np.random.default_rng(seed)
    home = body_strokes(np.array(HOME_BODY)) if kind == "body" else np.full(MOTORS, LOWEST)
    rows, made = [home], 0
    while made < count:
        following = KINDS[kind](rows[-1], length, dice)
        made += following is not None
        rows.append(home if following is None else following)
    return np.array(rows)


def is_length(moves: Floats, length: float) -> Bools:
    """(n,) whether the largest distance of each move is the wanted one.

    Args:
        moves: (n, motors) distances, m.
        length: the wanted one, m.
    """
    return np.asarray(np.abs(moves.max(axis=1) - length) <= LENGTH_ERROR * length)


def body_strokes(com: Floats) -> Floats:
    """(12,) strokes with every foot at its home and the centre of mass at a place, m; nan where none are."""
    model = load_robot("deltawalker")
    pose = actuator_plane_pose(model, com, np.array(0.0))
    return free_strokes(model, model.module_centres_robot, pose).ravel()


def _all_motors(here: Floats, length: float, dice: np.random.Generator) -> Floats | None:
    return _moved(here, np.arange(MOTORS), length, dice)


def _one_leg(here: Floats, length: float, dice: np.random.Generator) -> Floats | None:
    first = LEG_MOTORS * int(dice.integers(MOTORS // LEG_MOTORS))
    return _moved(here, np.arange(first, first + LEG_MOTORS), length, dice)


def _moved(
    here: Floats, motors: NDArray[np.int64], length: float, dice: np.random.Generator
) -> Floats | None:
    """Some motors go by up to a length either way, one by all of it; those without room turn round."""
    way = np.zeros(MOTORS)
    way[motors] = dice.uniform(-length, length, len(motors))
    farthest = dice.choice(motors)
    way[farthest] = dice.choice([-length, length])
    way[~_in_range(here + way)] *= -1.0
    way[~_in_range(here + way)] = 0.0
    return None if way[farthest] == 0.0 else here + way


def _in_range(strokes: Floats) -> Bools:
    return np.asarray((strokes >= LOWEST) & (strokes <= HIGHEST))


def _body(here: Floats, length: float, dice: np.random.Generator) -> Floats | None:
    """The body goes in a random direction, so far that the farthest motor goes by the length."""
    start = _body_place(here)
    for _ in range(TRIES):
        direction = dice.normal(size=3)
        direction[2] *= 0.5
        size = length / float(np.linalg.norm(direction))
        for _ in range(6):
            there = body_strokes(start + size * direction)
            size *= length / max(float(np.abs(there - here).max()), 1e-6)
            if not np.isfinite(size):
                break
        if _in_range(there).all() and is_length(np.abs(there - here)[None], length)[0]:
            return there
    return None


def _body_place(strokes: Floats) -> Floats:
    """(3,) centre of mass over feet at their homes, m (inverse of `body_strokes`)."""
    model = load_robot("deltawalker")
    feet = feet_in_robot(model, strokes.reshape(1, -1, LEG_MOTORS))[0]
    return np.asarray((model.module_centres_robot - feet).mean(axis=0) + [0.0, 0.0, model.com_height])


KINDS: dict[str, NextWaypoint] = {"all motors": _all_motors, "one leg": _one_leg, "body": _body}
"""Kinds of moves."""
