"""The pattern solver's process: answers, progress, an end when asked, and a new one where it dies.

What every process does that answers questions is in `test_questions`.
"""

from __future__ import annotations

import os
import queue
import signal
from collections.abc import Iterator

import pytest

from core.patterns.check import check_pattern
from core.patterns.problem import PatternProgress, PatternStatus
from solver_jobs import PatternSolver
from solver_jobs.patterns.solve import solve_pattern
from tests.solver_jobs.patterns.test_solve import hard_problem
from tests.support.solvers.conflicts import transition

PATIENCE = 60.0
"""Longest wait for anything, s."""

EASY = transition("111111", "011111", 20)


@pytest.fixture(scope="module")
def solver() -> Iterator[PatternSolver]:
    patterns = PatternSolver()
    patterns.start()
    yield patterns
    patterns.close()


def heard() -> queue.SimpleQueue[PatternProgress]:
    return queue.SimpleQueue()


def test_it_answers_as_the_function_does(solver: PatternSolver) -> None:
    result = solver.submit(EASY, count=2).result(PATIENCE)
    wanted = solve_pattern(EASY, count=2)
    assert result.status is PatternStatus.OPTIMAL
    assert [p.stance.tobytes() for p in result.patterns] == [p.stance.tobytes() for p in wanted.patterns]


def test_an_infeasible_problem_comes_with_its_explanation(solver: PatternSolver) -> None:
    result = solver.submit(transition("1100", "1111", 20, locked=())).result(PATIENCE)
    assert result.status is PatternStatus.INFEASIBLE
    assert result.explanation


def test_use_now_gives_the_best_pattern_yet(solver: PatternSolver) -> None:
    problem, told = hard_problem(), heard()
    search = solver.submit(problem, seconds=600.0, progress=told.put)
    while told.get(timeout=PATIENCE).pattern is None:
        pass
    search.use_now()
    result = search.result(PATIENCE)
    assert result.status is PatternStatus.FEASIBLE
    assert check_pattern(problem, result.patterns[0].stance) == ()


def test_a_cancelled_search_makes_room_for_the_next(solver: PatternSolver) -> None:
    told = heard()
    search = solver.submit(hard_problem(), seconds=600.0, progress=told.put)
    waiting = solver.submit(hard_problem(), seconds=600.0)
    easy = solver.submit(EASY)
    told.get(timeout=PATIENCE)
    waiting.cancel()
    search.cancel()
    assert search.result(PATIENCE).status is PatternStatus.CANCELLED
    assert waiting.result(PATIENCE).patterns == ()
    assert easy.result(PATIENCE).status is PatternStatus.OPTIMAL


def test_a_process_that_dies_in_the_middle_is_replaced(solver: PatternSolver) -> None:
    told = heard()
    search = solver.submit(hard_problem(), seconds=600.0, progress=told.put)
    told.get(timeout=PATIENCE)
    first = solver.process_id
    assert first is not None
    os.kill(first, signal.SIGKILL)
    while told.get(timeout=PATIENCE).pattern is None or solver.process_id in (None, first):
        pass
    search.use_now()
    assert search.result(PATIENCE).status is PatternStatus.FEASIBLE


@pytest.mark.heavy
def test_a_time_limit_ends_a_search(solver: PatternSolver) -> None:
    result = solver.submit(hard_problem(), seconds=2.0).result(PATIENCE)
    assert result.status is PatternStatus.FEASIBLE
