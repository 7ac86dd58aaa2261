"""The fastest pose gaits: confirmed by the independent check, refused with a reason, cancelled."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from app.bench.solvers.fastest_times import random_problems
from core.checks.checked_plan import CheckedPlan
from core.checks.rules import check_plan
from core.pose_gaits.pose_check import check_poses
from core.pose_gaits.pose_gait import PoseGait
from core.pose_gaits.pose_problem import PoseBounds, PoseProblem
from core.robot.model import load_robot
from core.wire.waypoint_merging import plan_of_knots
from solver_jobs import SolveStatus
from solver_jobs.pose_gaits.solve import solve_poses
from solver_jobs.results.pose import PoseProgress, PoseResult
from tests.support.soak import soaked

WALK, C_GAIT = (3, 2, 4, 1), (1, 2, 3, 4)


def solved(
    order: tuple[int, ...] = C_GAIT, heading: float = 0.0, robot: str = "deltawalker", **asked: Any
) -> PoseResult:
    return solve_poses(PoseProblem(load_robot(robot), order, heading, **asked))


@pytest.fixture(scope="module")
def c_gait() -> PoseGait:
    result = solved()
    assert result.gait is not None
    return result.gait


@pytest.mark.heavy
def test_the_c_gait_makes_three_millimetres_a_second_in_mid_walk(c_gait: PoseGait) -> None:
    check = check_poses(c_gait)
    assert check.confirmed
    assert c_gait.speed > 0.003
    assert c_gait.problem.move_count == 8
    assert check.figures.margin > 0.00599
    assert check.figures.shoe_distance >= 0.028
    assert check.figures.largest_move <= c_gait.problem.largest_move + 1e-7


@pytest.mark.heavy
def test_a_walk_from_the_standard_stance_to_rest_passes_every_rule() -> None:
    result = solved(cycles=1, step=0.010)
    assert result.status is SolveStatus.SOLVED
    assert result.gait is not None
    gait = result.gait
    assert gait.distance == pytest.approx(0.010)
    assert np.allclose(gait.strokes[[0, -1]], 0.0055, atol=1e-4)
    sent = plan_of_knots(gait.problem.model, gait.trajectory, gait.waypoints)
    verdict = check_plan(CheckedPlan(gait.problem.model, gait.trajectory, gait.waypoints, way=sent))
    assert verdict.passed, verdict.findings


@pytest.mark.heavy
def test_a_direction_is_the_same_gait_turned(c_gait: PoseGait) -> None:
    turned = solved((2, 3, 4, 1), np.pi / 2)
    assert turned.gait is not None
    assert turned.gait.speed == pytest.approx(c_gait.speed, rel=1e-3)
    travel = turned.gait.bodies[-1] - turned.gait.bodies[0]
    assert travel[0] == pytest.approx(0.0, abs=1e-7)
    assert travel[1] > 0.04


@pytest.mark.heavy
def test_an_even_turn_is_kept() -> None:
    result = solved(turn=0.1, step=0.02)
    assert result.status is SolveStatus.SOLVED
    assert result.gait is not None
    assert result.gait.headings[-1] == pytest.approx(0.1)


@pytest.mark.parametrize("change", ["stroke", "foothold", "height", "step"])
def test_the_check_sees_a_gait_that_was_changed(c_gait: PoseGait, change: str) -> None:
    strokes, feet, bodies = c_gait.strokes.copy(), c_gait.feet.copy(), c_gait.bodies.copy()
    step = c_gait.step
    if change == "stroke":
        strokes[3, 1, 0] += 0.001
    elif change == "foothold":
        feet[2, 3] += 0.002
    elif change == "height":
        bodies[:, 2] += 0.01
    else:
        step += 0.001
    assert not check_poses(replace(c_gait, strokes=strokes, feet=feet, bodies=bodies, step=step)).confirmed


@pytest.mark.parametrize(
    ("limit", "bounds"),
    [
        ("margin", PoseBounds(margin=0.008)),
        ("clearance", PoseBounds(clearance=0.009)),
        ("slip", PoseBounds(slip=0.0001)),
        ("shoe distance", PoseBounds(shoe_distance=0.045)),
        ("arm distance", PoseBounds(arm_distance=0.004)),
        ("stop bound", PoseBounds(stop_bound=1.2)),
    ],
)
def test_the_check_holds_a_gait_to_every_limit(c_gait: PoseGait, limit: str, bounds: PoseBounds) -> None:
    stricter = replace(c_gait, problem=replace(c_gait.problem, bounds=bounds))
    findings = [finding for finding in check_poses(stricter).findings if finding.limit == limit]
    assert findings
    assert all(finding.amount > 0 and "mm" in finding.sentence for finding in findings)


@pytest.mark.heavy
def test_a_step_that_is_too_long_is_explained_by_the_longest_that_works() -> None:
    result = solved(WALK, np.pi / 4, step=0.090)
    assert result.status is SolveStatus.INFEASIBLE
    assert result.gait is None
    assert "longest that was found is 51." in result.explanation[0]
    assert "foot" in result.explanation[0]
    assert "not a proof" in result.explanation[-1]


@pytest.mark.soak
def test_a_margin_that_is_too_wide_is_explained_by_the_widest_that_works() -> None:
    result = solved(bounds=PoseBounds(margin=0.025))
    assert result.status is SolveStatus.INFEASIBLE
    assert "The margin (--margin) is 25 mm" in result.explanation[0]


@pytest.mark.soak
def test_arms_that_come_near_each_other_are_kept_apart(c_gait: PoseGait) -> None:
    asked = 0.003
    assert 0.001 < check_poses(c_gait).figures.arm_distance < asked
    result = solved(bounds=PoseBounds(arm_distance=asked))
    assert result.gait is not None
    assert check_poses(result.gait).figures.arm_distance > asked - 5e-5
    assert 0.97 * c_gait.speed < result.gait.speed < c_gait.speed


def test_arms_that_are_nearer_in_the_standard_stance_are_refused_at_once() -> None:
    result = solved(cycles=1, bounds=PoseBounds(arm_distance=0.007))
    assert result.status is SolveStatus.INFEASIBLE
    assert "5.6 mm apart in the standard stance, and 7 mm are asked (--arm-distance)" in result.explanation[0]
    assert result.solve_seconds == 0.0


def test_a_cancelled_search_has_no_gait() -> None:
    told: list[PoseProgress] = []

    def until_solving(progress: PoseProgress) -> bool:
        told.append(progress)
        return not progress.stage.startswith("Solving")

    result = solve_poses(PoseProblem(load_robot("deltawalker"), C_GAIT, 0.0), until_solving)
    assert (result.status, result.gait) == (SolveStatus.CANCELLED, None)
    assert told[-1].stage.startswith("Solving")


@pytest.mark.heavy
def test_a_robot_with_six_legs_walks_too() -> None:
    result = solved((1, 4, 2, 5, 3, 6), robot="hexapod")
    assert result.status is SolveStatus.SOLVED


@pytest.mark.soak(short=True)
def test_what_is_called_solved_is_confirmed_whatever_is_asked() -> None:
    statuses = []
    for problem in random_problems(soaked(40, 4), 20261123, (None,)):
        result = solve_poses(problem)
        statuses.append(result.status)
        assert (result.status is SolveStatus.SOLVED) == (result.gait is not None)
        if result.gait is not None:
            assert check_poses(result.gait, samples=81).confirmed
        else:
            assert result.explanation
    assert SolveStatus.SOLVED in statuses
