"""Motors that share an actuator: strokes h follow actuator positions u by h = C·u (thesis 2.1.2).

Actuators are fewer than motors, so that wanted strokes are met in the sense of least squares only. Every
function is pure and works over any leading axes, the motors of all legs last in wire order.
"""

from collections.abc import Sequence

import numpy as np

from core.arrays import Floats
from core.errors import InputError


def coupling_matrix(shared: Sequence[Sequence[int]], motors: int, where: str = "coupling") -> Floats:
    """C of h = C·u for groups of motors that move as one.

    Actuators stand in the order of their first motors; a motor that no group names has one of its own.

    Args:
        shared: groups of motors, numbered in wire order from 1.
        motors: number of motors of the robot.
        where: what is read, for messages.

    Returns:
        (motors, actuators) of 0 and 1; the identity where nothing is shared.

    Raises:
        InputError: a number that is no motor, a motor that is named twice, or a group of fewer than two.
    """
    group_of: dict[int, tuple[int, ...]] = {motor: (motor,) for motor in range(1, motors + 1)}
    named: set[int] = set()
    for group in shared:
        if len(group) < 2:
            raise InputError(f"{where}: the group {list(group)} shares nothing; name two motors.", where)
        for motor in group:
            if motor not in group_of:
                raise InputError(f"{where}: there is no motor {motor}; the last is {motors}.", where)
            if motor in named:
                raise InputError(f"{where}: motor {motor} is named twice; it has one actuator.", where)
            named.add(motor)
            group_of[motor] = tuple(group)
    actuators = list(dict.fromkeys(frozenset(group_of[motor]) for motor in range(1, motors + 1)))
    matrix = np.array([[motor in group for group in actuators] for motor in range(1, motors + 1)], np.float64)
    matrix.setflags(write=False)
    return matrix


def actuator_positions(coupling: Floats, strokes: Floats) -> Floats:
    """Least squares in inverse kinematics' place for coupled motors, u = argmin |C·u − h|.

    Args:
        coupling: C, (motors, actuators) of full column rank.
        strokes: (..., motors) wanted strokes h, m.

    Returns:
        (..., actuators) m; the mean of each group where C says which motors move as one.
    """
    return np.asarray(strokes @ np.linalg.pinv(coupling).T)


def motor_strokes(coupling: Floats, positions: Floats) -> Floats:
    """Strokes h = C·u of the motors: (..., actuators) positions to (..., motors), m."""
    return np.asarray(positions @ coupling.T)
