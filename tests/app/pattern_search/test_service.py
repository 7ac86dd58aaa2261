"""Pattern searches: a page has one, its newest; pages do not disturb each other; lengths come in turn."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from app.pattern_search.service import PatternRequest, PatternSearchService, next_length
from core.errors import InputError, NotFoundError, StateError
from core.patterns.problem import (
    Pattern,
    PatternKind,
    PatternProblem,
    PatternProgress,
    PatternResult,
    PatternStatus,
    Relaxation,
    Rule,
    index_halves,
    transition_cells,
)
from tests.support.studio_process import wait_for

STANDING = np.ones(4, dtype=np.bool_)


def transition(samples: int | None) -> PatternProblem:
    cells = transition_cells(STANDING, STANDING, samples or 12, ~STANDING)
    return PatternProblem(PatternKind.TRANSITION, cells, STANDING, index_halves(4))


def found(problem: PatternProblem) -> PatternResult:
    stance = np.ones(problem.fixed.shape, dtype=np.bool_)
    return PatternResult(PatternStatus.OPTIMAL, (Pattern(stance, 0, 0),), 0.0, 0.01)


def none(problem: PatternProblem, longer: int | None = None) -> PatternResult:
    more = () if longer is None else (Relaxation(Rule.FIXED, None, (), f"{longer} samples", longer),)
    return PatternResult(PatternStatus.INFEASIBLE, (), None, 0.01, ("It is too short.",), more)


class Handle:
    """A search that ends when a test says so."""

    def __init__(self, problem: PatternProblem, progress: Callable[[PatternProgress], object]) -> None:
        self.problem = problem
        self.progress = progress
        self.ended = threading.Event()
        self.answer: PatternResult | Exception = found(problem)

    def result(self) -> PatternResult:
        assert self.ended.wait(60)
        if isinstance(self.answer, Exception):
            raise self.answer
        return self.answer

    def use_now(self) -> None:
        self.end(PatternResult(PatternStatus.FEASIBLE, found(self.problem).patterns, 0.0, 0.1))

    def cancel(self) -> None:
        self.end(PatternResult(PatternStatus.CANCELLED, (), 0.0, 0.1))

    def end(self, answer: PatternResult | Exception) -> None:
        if not self.ended.is_set():
            self.answer = answer
            self.ended.set()


class Tier:
    """Searches that wait for a test, or end at once by a function."""

    def __init__(self, answer: Callable[[PatternProblem], PatternResult] | None = None) -> None:
        self.handles: list[Handle] = []
        self.answer = answer

    def submit(
        self,
        problem: PatternProblem,
        *,
        count: int = 1,
        seconds: float = 30.0,
        progress: Callable[[PatternProgress], object] = lambda known: None,
    ) -> Handle:
        handle = Handle(problem, progress)
        self.handles.append(handle)
        if self.answer is not None:
            handle.end(self.answer(problem))
        return handle


@pytest.fixture
def told() -> list[tuple[str, dict[str, Any]]]:
    return []


def service_of(told: list[tuple[str, dict[str, Any]]], *tiers: Tier) -> PatternSearchService:
    return PatternSearchService(tiers, lambda page, event: told.append((page, event)))


def question(samples: range | None = None) -> PatternRequest:
    return PatternRequest(transition, samples, 1, 5.0)


def begun(tier: Tier, count: int = 1) -> Handle:
    wait_for(lambda: len(tier.handles) == count, f"{count} searches")
    return tier.handles[-1]


def test_an_answer_holds_pattern_score_and_fixed_cells(told: list[tuple[str, dict[str, Any]]]) -> None:
    search = service_of(told, Tier(found)).ask("page", question())
    content = search.future.result(5)
    assert content["state"] == "done"
    assert content["result"]["patterns"][0]["feet"] == ["1" * 12] * 4
    assert content["result"]["patterns"][0]["score"] == 0
    assert content["result"]["fixed"] == ["1..........1"] * 4
    assert told == []


def test_the_newest_question_of_a_page_ends_the_one_before(told: list[tuple[str, dict[str, Any]]]) -> None:
    tier = Tier()
    service = service_of(told, tier)
    older = service.ask("page", question())
    begun(tier)
    assert service.detach(older)
    newer = service.ask("page", question())
    assert older.future.result(5)["result"]["status"] == "cancelled"
    assert not newer.future.done()
    begun(tier, 2).end(found(transition(None)))
    newer.future.result(5)
    assert told == []


def test_pages_and_scripts_do_not_end_each_others_searches(told: list[tuple[str, dict[str, Any]]]) -> None:
    tier = Tier()
    service = service_of(told, tier)
    searches = [service.ask(page, question()) for page in ("one", "two", "", "")]
    begun(tier, 4)
    assert not any(search.future.done() for search in searches)
    for handle in tier.handles:
        handle.use_now()
    assert {search.future.result(5)["result"]["status"] for search in searches} == {"feasible"}


def test_a_search_that_goes_on_tells_its_page_alone(told: list[tuple[str, dict[str, Any]]]) -> None:
    tier = Tier()
    service = service_of(told, tier)
    search = service.ask("one", question())
    handle = begun(tier)
    assert service.detach(search)
    best = found(transition(None)).patterns[0]
    handle.progress(PatternProgress(0.3, 3000.0, 2000.0, best))
    handle.use_now()
    wait_for(lambda: len(told) == 2, "progress and answer")
    assert [page for page, _ in told] == ["one", "one"]
    assert told[0][1]["state"] == "running"
    assert told[0][1]["progress"]["bound"] == 2000.0
    assert told[1][1]["result"]["status"] == "feasible"


def test_a_search_goes_to_the_process_that_has_the_fewest(told: list[tuple[str, dict[str, Any]]]) -> None:
    first, second = Tier(), Tier()
    service = service_of(told, first, second)
    service.ask("one", question())
    begun(first)
    service.ask("two", question())
    begun(second)
    assert (len(first.handles), len(second.handles)) == (1, 1)
    first.handles[0].cancel()
    second.handles[0].cancel()


def test_a_cancelled_search_and_one_of_a_page_that_left_end(told: list[tuple[str, dict[str, Any]]]) -> None:
    tier = Tier()
    service = service_of(told, tier)
    search = service.ask("one", question())
    begun(tier)
    assert service.cancel(search.id)["id"] == search.id
    assert search.future.result(5)["result"]["status"] == "cancelled"
    left = service.ask("two", question())
    begun(tier, 2)
    service.forget("two")
    assert left.future.result(5)["result"]["status"] == "cancelled"


def test_the_first_length_that_works_is_taken(told: list[tuple[str, dict[str, Any]]]) -> None:
    tier = Tier(lambda problem: none(problem, 7) if problem.sample_count < 7 else found(problem))
    search = service_of(told, tier).ask("page", question(range(4, 61)))
    assert search.future.result(5)["result"]["samples"] == 7
    assert [handle.problem.sample_count for handle in tier.handles] == [4, 7]


def test_lengths_that_were_not_tried_are_not_said_to_be_impossible(
    told: list[tuple[str, dict[str, Any]]],
) -> None:
    tier = Tier()
    service = service_of(told, tier)
    search = service.ask("page", question(range(4, 61)))
    handle = begun(tier)
    # The answer of this length arrives together with the wish to end.
    handle.cancel = lambda: handle.end(none(handle.problem))  # type: ignore[method-assign]
    service.cancel(search.id)
    result = search.future.result(5)["result"]
    assert (result["status"], result["explanation"]) == ("cancelled", [])
    assert len(tier.handles) == 1


def test_a_search_that_is_cancelled_before_it_reaches_a_process_ends(
    told: list[tuple[str, dict[str, Any]]],
) -> None:
    reached, goes_on = threading.Event(), threading.Event()

    class SlowTier(Tier):
        def submit(self, problem: PatternProblem, **words: Any) -> Handle:
            reached.set()
            assert goes_on.wait(60)
            return super().submit(problem, **words)

    service = service_of(told, SlowTier())
    search = service.ask("page", question())
    assert reached.wait(60)
    service.cancel(search.id)
    goes_on.set()
    assert search.future.result(5)["result"]["status"] == "cancelled"


def test_what_no_length_helps_is_not_tried_longer() -> None:
    up = np.array([1, 0, 0, 0], dtype=np.bool_)
    stuck = PatternProblem(
        PatternKind.TRANSITION, transition_cells(up, up, 8, ~STANDING), STANDING, index_halves(4)
    )
    assert next_length(stuck, none(stuck), range(4, 61)) is None
    short = transition(8)
    assert next_length(short, none(short), range(4, 61)) == 9
    assert next_length(short, none(short), range(4, 9)) is None
    assert next_length(short, found(short), range(4, 61)) is None
    assert next_length(short, none(short), None) is None


def test_a_length_that_is_too_short_is_said_with_the_first_one_that_works(
    told: list[tuple[str, dict[str, Any]]],
) -> None:
    tier = Tier(lambda problem: none(problem, 9) if problem.sample_count < 9 else found(problem))
    asked = PatternRequest(transition, range(7, 61), 1, 5.0, too_few=4)
    result = service_of(told, tier).ask("page", asked).future.result(5)["result"]
    assert (result["status"], result["patterns"]) == ("infeasible", [])
    assert result["explanation"][0].startswith("4 samples are too few to finish the swings and stances")
    assert [(one["samples"], one["words"]) for one in result["relaxations"]] == [
        (9, "9 samples instead of 4")
    ]


def test_where_no_length_works_the_last_ones_reason_stands_too(
    told: list[tuple[str, dict[str, Any]]],
) -> None:
    asked = PatternRequest(transition, range(7, 8), 1, 5.0, too_few=4)
    result = service_of(told, Tier(none)).ask("page", asked).future.result(5)["result"]
    assert result["explanation"][1:] == ["None of 7 to 7 samples works.", "It is too short."]


def test_where_no_length_up_to_the_longest_works_that_is_said(
    told: list[tuple[str, dict[str, Any]]],
) -> None:
    result = service_of(told, Tier(none)).ask("page", question(range(4, 9))).future.result(5)["result"]
    assert (result["status"], result["samples"]) == ("infeasible", 8)
    assert result["explanation"] == ["None of 4 to 8 samples works.", "It is too short."]


def test_a_solver_that_breaks_off_is_said(told: list[tuple[str, dict[str, Any]]]) -> None:
    tier = Tier()
    service = service_of(told, tier)
    search = service.ask("page", question())
    begun(tier).end(StateError("The pattern solver's process ended twice."))
    assert search.future.result(5) == {
        "id": search.id,
        "state": "failed",
        "sentence": "The pattern solver's process ended twice.",
    }


def test_a_problem_that_cannot_be_posed_is_refused_at_once(told: list[tuple[str, dict[str, Any]]]) -> None:
    def refuse(samples: int | None) -> PatternProblem:
        raise InputError("No limb walks.", "limbs")

    with pytest.raises(InputError, match="No limb walks"):
        service_of(told, Tier()).ask("page", PatternRequest(refuse, None, 1, 5.0))


def test_a_search_that_nobody_began_is_unknown(told: list[tuple[str, dict[str, Any]]]) -> None:
    with pytest.raises(NotFoundError, match="no search 7"):
        service_of(told, Tier()).search(7)
