"""Several gaits at a time: answers in the order of the questions, progress, and an end in the middle."""

from __future__ import annotations

from contextlib import closing
from dataclasses import replace

import pytest

from core.pose_gaits.pose_problem import PoseProblem
from core.robot.model import load_robot
from solver_jobs import FastestSearch, SearchStep, SolveStatus, fastest_of

SHORT = PoseProblem(load_robot("deltawalker"), (1, 2, 3, 4), 0.0, step=0.010)
LONG, TOO_LONG = replace(SHORT, step=0.030), replace(SHORT, step=0.150)


@pytest.mark.heavy
def test_answers_stand_in_the_order_of_the_questions() -> None:
    steps: list[SearchStep] = []
    with closing(FastestSearch(processes=2)) as search:
        tried = search.solve([SHORT, TOO_LONG, LONG], steps.append)
    assert [one.result.status for one in tried] == [
        SolveStatus.SOLVED,
        SolveStatus.INFEASIBLE,
        SolveStatus.SOLVED,
    ]
    assert [one.problem for one in tried] == [SHORT, TOO_LONG, LONG]
    assert fastest_of(tried) is tried[2]
    assert [step.done for step in steps] == [1, 2, 3]
    assert steps[-1].fastest is not None
    assert steps[-1].fastest.problem is LONG


@pytest.mark.heavy
def test_an_ended_search_answers_with_what_is_known() -> None:
    with closing(FastestSearch(processes=1)) as search:
        free = replace(SHORT, step=None)
        tried = search.solve([SHORT, free, free, free], lambda step: search.cancel())
    assert tried[0].result.status is SolveStatus.SOLVED
    assert {one.result.status for one in tried[2:]} == {SolveStatus.CANCELLED}
