"""The benchmark of the fastest walks: a row has board and physics, and a mid-walk cycle repeats itself."""

from __future__ import annotations

import numpy as np
import pytest

from app.bench.physics.fastest import FastCase, bench_walks
from app.bench.solvers.fastest_times import solve_times
from core.physics.pose_gait_problem import repeated
from core.pose_gaits.pose_problem import PoseProblem
from core.robot.model import load_robot
from solver_jobs import solve_poses


@pytest.mark.heavy
def test_a_row_in_mid_walk_and_one_from_rest() -> None:
    cases = (FastCase("c-gait"), FastCase("c-gait", 1, 0.010, varied=True))
    middle, rest = bench_walks(cases, variations=2)
    assert (middle["status"], middle["cycles"], middle["moves"]) == ("solved", "mid-walk", 8)
    assert middle["board_mm_s"] == pytest.approx(middle["law_mm_s"], rel=0.06)
    assert middle["board_mm_s"] >= 2.9
    assert middle["physics_way_%"] > 97.0
    assert middle["nominal_s"] < middle["published_s"] < middle["slow_s"]
    assert rest["way_mm"] == pytest.approx(10.0)
    assert rest["variations"] == "2 of 2 walk"


@pytest.mark.soak
def test_times_are_told_apart_by_answer() -> None:
    solved, no, *_ = solve_times(mid_walk=3, from_rest=0, seed=4)
    assert (solved["answer"], no["answer"]) == ("solved", "no")
    assert solved["problems"] + no["problems"] == 3
    assert solved["refused_by_check"] == 0
    assert 0.0 < solved["ipopt_median_s"] <= solved["median_s"] <= solved["most_s"]


@pytest.mark.heavy
def test_a_cycle_that_is_repeated_goes_on_where_it_ended() -> None:
    gait = solve_poses(PoseProblem(load_robot("deltawalker"), (1, 2, 3, 4), 0.0, step=0.02)).gait
    assert gait is not None
    trajectory, waypoints = repeated(gait, 3)
    assert waypoints.count == 3 * gait.problem.move_count + 1
    assert trajectory.body_world[-1, 0] - trajectory.body_world[0, 0] == pytest.approx(0.06)
    assert np.abs(trajectory.strokes(gait.problem.model) - waypoints.strokes).max() < 1e-6
