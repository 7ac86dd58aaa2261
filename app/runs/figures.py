"""The figures of a run, as JSON content."""

from typing import Any

import numpy as np

from app.common.json import Json, finite
from core.arrays import Floats
from core.runs.analysis import run_errors
from core.runs.pose import RanPlan
from core.runs.reading import RunSeries

FIGURES_VERSION = 2
"""Figures that another version computed are computed again."""


def run_figures(plan: RanPlan, series: RunSeries) -> Json:
    """Times, s, and errors, mm, of a run (see `core.runs.analysis`).

    Args:
        plan: what it was to do.
        series: what it measured.
    """
    errors = run_errors(plan, series)
    largest = errors.motor_largest
    worst = int(largest.argmax()) if errors.arrived else None
    return {
        "version": FIGURES_VERSION,
        "arrived": errors.arrived,
        "largest_mm": None if worst is None else mm_content(largest)[worst],
        "largest_motor": worst,
        "motor_mean_mm": mm_content(errors.motor_mean),
        "motor_largest_mm": mm_content(largest),
        "motor_waypoint": errors.motor_waypoint.tolist(),
        "foot_mean_mm": mm_content(errors.foot_mean),
        "foot_largest_mm": mm_content(errors.foot_largest),
        "foot_path_mm": mm_content(errors.foot_path),
        "body_largest_mm": finite(errors.body_largest * 1000.0),
        "seconds": finite(errors.seconds),
        "estimate": finite(errors.estimate),
        "start_seconds": finite(errors.start_seconds),
    }


def mm_content(values: Floats) -> list[Any]:
    """Lengths in m as JSON content in mm, null where one is not known."""
    return rounded_content(values * 1000.0, 4)


def rounded_content(values: Floats, digits: int) -> list[Any]:
    """Numbers as JSON content, null where one is not known."""
    content: list[Any] = finite(np.round(values, digits).tolist())
    return content
