"""Searches for poses after edits: one a gait, cancelled, begun again, not repeated where they fail."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, cast

import pytest

from app.common.json import Json
from app.gaits.pose_searches import PoseAnswer, PoseSearches
from app.plans.make_plan import make_plan
from core.errors import StateError
from core.gait.gait import Gait
from core.library.library import library
from solver_jobs import PoseGaitSolver, PoseProgress, PoseResult, SolveStatus, solve_live

GAIT = library()["fast-c-gait"].gait.with_options(margin=0.0065)


class Search:
    """A search that ends when a test says so."""

    def __init__(self) -> None:
        self.is_cancelled = False
        self._done: Callable[[], None] = lambda: None
        self._result: PoseResult | None = None

    def when_done(self, call: Callable[[], None]) -> None:
        self._done = call

    def cancel(self) -> None:
        self.is_cancelled = True

    def result(self) -> PoseResult:
        assert self._result is not None
        return self._result

    def end(self, status: SolveStatus, sentence: str = "") -> None:
        self._result = PoseResult(status, None, None, False, (sentence,), 0.1, 0.1)
        self._done()


class Solver:
    """Keeps what was submitted."""

    def __init__(self) -> None:
        self.searches: list[Search] = []
        self.asked: list[tuple[Any, ...]] = []

    def submit(self, *asked: Any) -> Search:
        self.asked.append(asked)
        self.searches.append(Search())
        return self.searches[-1]


@pytest.fixture
def solver() -> Solver:
    return Solver()


@pytest.fixture
def answers() -> list[PoseAnswer]:
    return []


@pytest.fixture
def searches(solver: Solver, answers: list[PoseAnswer]) -> PoseSearches:
    return PoseSearches(cast(PoseGaitSolver, solver), lambda gait_id, answer: answers.append(answer))


def looked_at(searches: PoseSearches, gait: Gait = GAIT) -> Any:
    return searches.look_at("fast", gait, make_plan(gait, None, solve_live))


def test_one_search_a_gait_until_its_edit(searches: PoseSearches, solver: Solver) -> None:
    assert looked_at(searches)["state"] == looked_at(searches)["state"] == "running"
    assert len(solver.searches) == 1
    looked_at(searches, GAIT.with_options(margin=0.007))
    assert [search.is_cancelled for search in solver.searches] == [True, False]


def test_a_search_tells_speed_and_turn_of_its_fastest_yet(solver: Solver) -> None:
    told: list[Json] = []
    searches = PoseSearches(
        cast(PoseGaitSolver, solver), lambda gait_id, answer: None, lambda gait_id, state: told.append(state)
    )
    begun = looked_at(searches)
    take = solver.asked[0][1]
    take(PoseProgress("Solved, start 1", 0.1, speed=0.0, turn_rate=-0.1))
    assert (begun["speed"], begun["turn_rate"]) == (None, None)
    assert [(state["speed"], state["turn_rate"]) for state in told] == [(0.0, -0.1)]
    assert looked_at(searches) == told[-1]


def test_a_failed_search_says_why_and_is_begun_again_only_when_asked(
    searches: PoseSearches, solver: Solver, answers: list[PoseAnswer]
) -> None:
    looked_at(searches)
    solver.searches[0].end(SolveStatus.FAILED, "It was silent.")
    assert answers[0].content is None
    searches.take("fast", answers[0])
    assert looked_at(searches)["state"] == "failed"
    assert looked_at(searches)["stage"] == "It was silent."
    with pytest.raises(StateError, match="is running"):
        searches.cancel("fast")
    searches.again("fast")
    assert looked_at(searches)["state"] == "running"
    assert len(solver.searches) == 2


def test_a_cancelled_one_that_answers_late_forgets_no_newer_one(
    searches: PoseSearches, solver: Solver, answers: list[PoseAnswer]
) -> None:
    looked_at(searches)
    searches.cancel("fast")
    assert looked_at(searches)["state"] == "cancelled"
    searches.again("fast")
    looked_at(searches)
    solver.searches[0].end(SolveStatus.CANCELLED)
    searches.take("fast", answers[0])
    assert looked_at(searches)["state"] == "running"
    assert len(solver.searches) == 2
    with pytest.raises(StateError, match="was cancelled or broke off"):
        searches.again("fast")


def test_the_search_of_a_gait_that_is_gone_ends(searches: PoseSearches, solver: Solver) -> None:
    looked_at(searches)
    searches.forget("fast")
    assert solver.searches[0].is_cancelled
    with pytest.raises(StateError, match="No search"):
        searches.cancel("fast")
    searches.forget("fast")
