"""From trajectories to waypoints, and which of them the path needs.

The firmware moves all motors along a straight line in motor space to each waypoint and stops there.
"""

import math

import numpy as np
from numpy.typing import NDArray

from core.arrays import SAME, Floats
from core.errors import InputError
from core.motion.trajectory import Trajectory
from core.robot.coupled_strokes import real_strokes
from core.robot.model import RobotModel
from core.wire.robot_time import largest_moves, least_stop_bound, longest_move
from core.wire.waypoints import Waypoints


def waypoints_from_trajectory(model: RobotModel, trajectory: Trajectory) -> Waypoints:
    """One waypoint a sample by inverse kinematics; of coupled motors the strokes that they make.

    Raises:
        UnreachableError: a foot lies outside the workspace.
    """
    return knots_of_strokes(model, trajectory, trajectory.strokes(model))


def knots_of_strokes(model: RobotModel, trajectory: Trajectory, strokes: Floats) -> Waypoints:
    """The same of strokes that are known already.

    Args:
        model: the robot.
        trajectory: says the times.
        strokes: (n, legs, 3) m.
    """
    steps = np.diff(trajectory.times)
    return Waypoints(real_strokes(model, strokes), np.concatenate([steps[:1], steps]))


def stays_near(rows: Floats, first: int, last: int, tolerance: float) -> bool:
    """Whether the knots between two lie near the straight way from one to the other, in their order.

    Args:
        rows: (n, motors) strokes of each knot, m.
        first: where the way begins.
        last: where it ends.
        tolerance: largest distance, of any motor, m.
    """
    start = rows[first]
    way = rows[last] - start
    inner = rows[first + 1 : last] - start
    length = float(np.linalg.norm(way))
    # A way that ends where it begins has no direction.
    direction = way / length if length > SAME else np.zeros_like(way)
    along = np.clip(inner @ direction, 0.0, length)
    in_order = bool((np.diff(along) >= -SAME).all())
    return in_order and float(np.abs(inner - along[:, None] * direction).max()) <= tolerance + SAME


def cut_parts(waypoints: Waypoints, bound: float) -> NDArray[np.int64]:
    """(count,) into how many equal parts the move to each waypoint is cut, so that a bound is kept.

    A robot may be the firmware's threshold off where a move begins. A part is longer than that threshold,
    below which nothing moves, and at most `SAME` longer than the bound allows (0.04 ms of deafness).

    Args:
        waypoints: whose moves are cut.
        bound: how long the robot may be deaf, s: a scan and the ramp after it.

    Raises:
        InputError: the bound is too short for parts that move.
    """
    least = least_stop_bound()
    if not (math.isfinite(bound) and bound >= least - 1e-9):
        raise InputError(
            f"The stop bound is {bound:g} s; it must be at least {least:.2f} s, or the moves that it leaves "
            "are too short for the firmware to carry out.",
            "--stop-bound",
        )
    moves = np.concatenate([[0.0], largest_moves(waypoints)])
    return np.maximum(1, np.ceil((moves - SAME) / longest_move(bound)).astype(np.int64))
