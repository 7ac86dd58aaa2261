"""The same pose gait, or the same reason, on every processor: the problem's numbers are off by rounding."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from core.arrays import SAME
from core.pose_gaits.pose_problem import PoseBounds, PoseProblem
from core.robot.model import load_robot
from core.wire.robot_time import estimate_seconds
from solver_jobs.pose_gaits.solve import solve_poses

OFF = 1.0 + 1e-12


@pytest.mark.heavy
@pytest.mark.parametrize(
    ("step", "cycles"),
    [
        pytest.param(0.014, None, id="in mid-walk"),
        pytest.param(0.010, 1, id="from stance to rest", marks=pytest.mark.heavy),
        pytest.param(0.060, None, id="too long a step", marks=pytest.mark.heavy),
    ],
)
def test_rounding_chooses_neither_poses_nor_reasons(step: float, cycles: int | None) -> None:
    model, bounds = load_robot("deltawalker"), PoseBounds(margin=0.006)
    problem = PoseProblem(model, (1, 2, 3, 4), 0.0, bounds=bounds, step=step, cycles=cycles)
    plain = solve_poses(problem)
    other = solve_poses(replace(problem, bounds=replace(bounds, margin=0.006 * OFF), step=step * OFF))
    assert other.status is plain.status
    assert other.explanation == plain.explanation
    assert (other.gait is None) == (plain.gait is None)
    if plain.gait is not None and other.gait is not None:
        assert np.abs(other.gait.strokes - plain.gait.strokes).max() < SAME
        seconds = estimate_seconds(plain.gait.waypoints)
        assert estimate_seconds(other.gait.waypoints) == pytest.approx(seconds, abs=1e-3)
