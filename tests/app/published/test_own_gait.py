"""Our gait of a published row: with the robot's own margin, or the largest that has a motion."""

from __future__ import annotations

from dataclasses import replace

import pytest

from app.plans.make_plan import Solve
from app.published.own_gait import own_gait
from core.errors import CheckError, StateError
from core.problem.initial_guess import initial_guess
from core.problem.motion_problem import MotionProblem
from core.published.gaits import published_gait
from core.published.tables import published_table
from solver_jobs import MotionResult, SolveStatus, solve_live

TABLE = published_table("t4-2")
GAIT = published_gait(TABLE, TABLE.row("walk-10"))


def only_up_to(margin: float, status: SolveStatus = SolveStatus.INFEASIBLE) -> Solve:
    """A solver that has a motion for small margins alone."""

    def solve(problem: MotionProblem) -> MotionResult:
        found = solve_live(problem)
        if problem.limits.margin <= margin:
            return found
        return replace(found, status=status, trajectory=initial_guess(problem), explanation=("Not so wide.",))

    return solve


def test_the_robots_own_margin_is_asked_for_first() -> None:
    own = own_gait(GAIT, solve_live)
    assert (own.margin, own.sentence, own.gait) == (0.006, "", GAIT)


def test_the_largest_margin_that_has_a_motion_counts_and_is_named() -> None:
    own = own_gait(GAIT, only_up_to(0.0025))
    assert own.margin == 0.0025
    assert "no motion with the robot's own margin of 6 mm; 2.5 mm are asked" in own.sentence


def test_a_gait_without_a_motion_is_refused_with_the_reason() -> None:
    with pytest.raises(CheckError, match=r"down to 0 mm has a motion\. Not so wide"):
        own_gait(GAIT, only_up_to(-1.0))


def test_a_solver_that_gives_no_answer_is_no_proof_that_there_is_no_motion() -> None:
    with pytest.raises(StateError, match="gave no answer"):
        own_gait(GAIT, only_up_to(0.0025, SolveStatus.FAILED))
