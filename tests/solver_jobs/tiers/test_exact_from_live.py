"""The exact tier's answer, and the live tier's where it finds none."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from core.gait.gait import motion_problem
from core.library.library import library, optimised_entry
from core.problem.motion_check import check_motion
from core.problem.motion_problem import Cost, MotionProblem
from core.robot.model import load_robot
from solver_jobs import MotionResult, SolveStatus, solve_exact, solve_live
from solver_jobs.nlp.motion_nlp import solve_motion
from solver_jobs.tiers import exact_from_live


def walk(cost: Cost) -> MotionProblem:
    gait = library()["walk"].gait.with_options(cost=cost)
    return motion_problem(gait, load_robot(gait.robot))


def finds_nothing(*arguments: object, **words: object) -> MotionResult:
    """The exact tier, if it said that it failed whatever it is asked."""
    result = solve_motion(walk(Cost.GOAL))
    return replace(result, status=SolveStatus.FAILED, explanation=("It stalled.",), optimal=False)


@pytest.mark.parametrize("cost", Cost)
def test_a_solved_motion_is_optimal(cost: Cost) -> None:
    result = solve_exact(walk(cost))
    assert result.status is SolveStatus.SOLVED
    assert result.optimal
    assert result.explanation == ()


@pytest.mark.parametrize("cost", Cost)
def test_the_live_motion_is_the_answer_where_the_exact_tier_finds_none(
    cost: Cost, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(exact_from_live, "solve_motion", finds_nothing)
    problem = walk(cost)
    result = solve_exact(problem)
    assert result.status is SolveStatus.SOLVED
    assert not result.optimal
    assert "not optimised" in result.explanation[0]
    assert check_motion(problem, result.trajectory).confirmed
    assert (result.objective is None) == (cost is Cost.GOAL_EFFORT)


@pytest.mark.parametrize("solve", [solve_exact, solve_live])
def test_the_gentle_cost_is_what_it_says(solve: Callable[[MotionProblem], MotionResult]) -> None:
    problem = walk(Cost.GENTLE)
    result = solve(problem)
    motion = result.trajectory
    assert motion.body_velocity is not None
    assert motion.feet_velocity is not None
    body, feet = (float((v**2).sum()) for v in (motion.body_velocity, motion.feet_velocity))
    assert result.objective == pytest.approx((body + 0.01 * feet) / 2, rel=1e-6)


def stepping(gait: str, step: float) -> MotionProblem:
    document = optimised_entry(gait).gait
    dx, dy, yaw = document.step
    longer = step / float(np.hypot(dx, dy))
    return motion_problem(replace(document, step=(dx * longer, dy * longer, yaw)), load_robot(document.robot))


@pytest.mark.heavy
@pytest.mark.parametrize("gait", ["s-gait", "c-gait"])
def test_a_no_says_where_the_margin_alone_forbids_a_motion(gait: str) -> None:
    result = solve_exact(stepping(gait, 0.025))
    assert result.status is SolveStatus.INFEASIBLE
    assert result.explanation[-2] == (
        "Only the margin forbids it: with 2 mm instead of 6.0 mm there is a motion."
    )


@pytest.mark.heavy
def test_a_no_of_what_no_margin_makes_possible_does_not() -> None:
    result = solve_exact(stepping("s-gait", 0.045))
    assert result.status is SolveStatus.INFEASIBLE
    assert not any("Only the margin" in sentence for sentence in result.explanation)
