"""Shoes take room: how far apart feet are, and how far apart they have to stay.

A shoe is as tall as it stands over the floor (`sole_depth`), more than a foot rises in a swing. So two shoes
keep clear of each other where their middles are far enough apart over the ground, whatever their heights.
"""

import numpy as np
from numpy.typing import NDArray

from core.arrays import Floats
from core.robot.model import RobotModel

SHOE_GAP = 0.003
"""Room between two shoes below which the check warns, and that optimised motions keep, m."""


def least_distance(model: RobotModel) -> float | None:
    """Distance of two feet's middles that leaves `SHOE_GAP` between their shoes, m; None without shoes."""
    return None if model.shoe_diameter is None else model.shoe_diameter + SHOE_GAP


def foot_pairs(legs: int) -> NDArray[np.intp]:
    """(pairs, 2) every two feet, 0-based."""
    return np.stack(np.triu_indices(legs, 1), axis=-1)


def neighbour_pairs(legs: int) -> NDArray[np.intp]:
    """(pairs, 2) feet that follow each other round the ring, 0-based."""
    first = np.arange(legs if legs > 2 else legs - 1)
    return np.stack([first, (first + 1) % legs], axis=-1)


def foot_distances(feet: Floats) -> Floats:
    """Distance over the ground of every two feet, |p_xy − q_xy|.

    Args:
        feet: (..., legs, 3) m, in any frame whose z is up.

    Returns:
        (..., pairs) m, in the order of `foot_pairs`.
    """
    first, second = foot_pairs(feet.shape[-2]).T
    return np.asarray(np.linalg.norm(feet[..., first, :2] - feet[..., second, :2], axis=-1))
