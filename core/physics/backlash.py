"""Backlash between a motor and what it moves."""

import numpy as np

from core.arrays import Floats


def with_backlash(strokes: Floats, backlash: float) -> Floats:
    """Where knees are whose motors have play, the play operator of hysteresis.

    y(k) = min(max(y(k − 1), x(k) − b / 2), x(k) + b / 2): the knee stays until its motor has crossed the
    play.

    Args:
        strokes: (n, motors) of the motors; the knees begin in the middle of their play, m.
        backlash: b, m.

    Returns:
        (n, motors) m.
    """
    if backlash == 0.0:
        return strokes
    knees = np.empty_like(strokes)
    knees[0] = strokes[0]
    low, high = strokes - backlash / 2, strokes + backlash / 2
    for row in range(1, len(strokes)):
        np.clip(knees[row - 1], low[row], high[row], out=knees[row])
    return knees
