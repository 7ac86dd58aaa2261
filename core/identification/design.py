"""A space-filling design: points that fill a box evenly, the same each time."""

from __future__ import annotations

import numpy as np

from core.arrays import Floats


def space_filling_points(count: int, axes: int) -> Floats:
    """Points of the additive recurrence x(k) = frac(1/2 + k / φ^j), which fill the unit box evenly.

    φ is the positive root of x^(axes + 1) = x + 1, the golden ratio where there is one axis. A larger count
    begins with the points of a smaller one. M. Roberts, "The unreasonable effectiveness of quasirandom
    sequences", 2018.

    Args:
        count: how many.
        axes: of the box.

    Returns:
        (count, axes) between 0 and 1.
    """
    ratio = 2.0
    for _ in range(40):
        ratio = (1.0 + ratio) ** (1.0 / (axes + 1))
    steps = ratio ** -np.arange(1.0, axes + 1.0)
    return np.asarray((0.5 + np.arange(1, count + 1)[:, None] * steps) % 1.0)
