"""The largest step, turn, margin or clearance of a gait, with everything else unchanged."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from enum import StrEnum

import numpy as np

from core.gait.gait import Gait, heading_step
from core.robot.model import RobotModel
from solver_jobs.remedies.remedy import step_length
from solver_jobs.remedies.trial import InterruptedSearchError, Trial


class Limit(StrEnum):
    """The number whose largest value is sought."""

    STEP = "step"
    TURN = "turn"
    MARGIN = "margin"
    CLEARANCE = "clearance"


_RANGES = {
    Limit.STEP: (0.001, 0.060, 1e-4),
    Limit.TURN: (np.radians(1.0), np.radians(90.0), np.radians(0.5)),
    Limit.MARGIN: (0.0, 0.030, 1e-4),
    Limit.CLEARANCE: (0.0005, 0.015, 1e-4),
}
"""Least and largest value that are tried, and the unit of the result, m and rad."""


def largest_value(gait: Gait, model: RobotModel, which: Limit, go_on: Callable[[], bool]) -> float | None:
    """The largest value of a number for which the live tier finds a motion, m or rad.

    Args:
        gait: a drawing; its own value of the number is ignored, except for the sign of a turn.
        model: its robot.
        which: the number.
        go_on: called before each trial; False ends the search.

    Returns:
        None if even the least value does not work, or the search was ended.
    """
    least, most, unit = _RANGES[which]
    trial = Trial(model, go_on)
    near = trial.best_margin(gait, most) if which is Limit.MARGIN else None
    try:
        return trial.largest(least, most, lambda value: _with(gait, which, value), unit, near)
    except InterruptedSearchError:
        return None


def _with(gait: Gait, which: Limit, value: float) -> Gait:
    dx, dy, yaw = gait.step
    match which:
        case Limit.STEP:
            length = step_length(gait)
            straight = heading_step(gait.orientation, value)
            along = (dx * value / length, dy * value / length) if length else straight[:2]
            return replace(gait, step=(*along, yaw))
        case Limit.TURN:
            return replace(gait, step=(dx, dy, float(np.copysign(value, yaw or 1.0))))
        case Limit.MARGIN:
            return gait.with_options(margin=value)
        case Limit.CLEARANCE:
            return gait.with_options(clearance=value)
