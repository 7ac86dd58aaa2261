"""A transition that is asked for so that the robot's feet can take its steps."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from app.pattern_search.service import PatternRequest, PatternSearchService
from app.routes.patterns.problems import Posed, posed
from app.routes.patterns.schema import TransitionBody
from core.gait.gait import heading_step
from core.library.library import library
from core.patterns.problem import FREE, PatternProblem, PatternProgress, PatternResult, PatternRules
from core.patterns.relaxation import with_samples
from solver_jobs import solve_pattern


def asked(walkable: bool, samples: int | None = 12, to_sample: int = 9) -> Posed:
    question = TransitionBody(
        kind="transition",
        gait="walk",
        sample=5,
        to="amble",
        to_sample=to_sample,
        samples=samples,
        walkable=walkable,
    )
    return posed(question, lambda gait_id: library()[gait_id].gait)


def test_swings_are_long_enough_and_those_that_a_cursor_cuts_are_finished() -> None:
    problem = asked(walkable=True).problem()
    assert (problem.rules.shortest_swing, problem.rules.least_swing) == (3, 3)
    # Foot 3 has swung for one sample at the first cursor.
    assert problem.fixed[2, :4].tolist() == [0, 0, 0, FREE]


def test_without_it_f_s_rules_hold_as_they_are() -> None:
    problem = asked(walkable=False).problem()
    assert problem.rules == PatternRules()
    assert (problem.fixed[:, 1:-1] == FREE).all()


def test_every_length_that_is_tried_is_walkable() -> None:
    question = asked(walkable=True, samples=None)
    assert question.lengths is not None
    for length in question.lengths:
        problem = question.problem(length)
        assert problem.sample_count == length
        assert problem.fixed[2, 1] == 0


def test_a_length_in_which_a_cut_swing_cannot_be_finished_leads_to_longer_ones() -> None:
    short = asked(walkable=True, samples=3, to_sample=10)
    assert (short.too_few, short.lengths) == (3, range(4, 61))
    whole = asked(walkable=True, samples=4, to_sample=10)
    assert (whole.too_few, whole.lengths) == (None, None)
    assert asked(walkable=False, samples=3, to_sample=10).too_few is None
    assert asked(walkable=True, samples=1, to_sample=10).lengths is None


class Solved:
    """An answer that is there at once."""

    def __init__(self, answer: PatternResult) -> None:
        self._answer = answer

    def result(self) -> PatternResult:
        return self._answer

    def use_now(self) -> None:
        pass

    def cancel(self) -> None:
        pass


class InProcess:
    """The pattern solver in this process, with the lengths that it was asked for."""

    def __init__(self) -> None:
        self.lengths: list[int] = []

    def submit(
        self,
        problem: PatternProblem,
        *,
        count: int = 1,
        seconds: float = 30.0,
        progress: Callable[[PatternProgress], object] = lambda known: None,
    ) -> Solved:
        self.lengths.append(problem.sample_count)
        return Solved(solve_pattern(problem, count=count, seconds=seconds))


def long_step(samples: int | None) -> Posed:
    """Walk with a step of 28.5 mm, whose swings last 7 samples, to Amble; both cursors in mid-swing."""
    walk = library()["walk"].gait
    gaits = {
        "walk": replace(walk, step=heading_step(walk.orientation, 0.0285)),
        "amble": library()["amble"].gait,
    }
    question = TransitionBody(
        kind="transition",
        gait="walk",
        sample=17,
        to="amble",
        to_sample=17,
        samples=samples,
        walkable=True,
    )
    return posed(question, gaits.__getitem__)


def test_the_shortest_length_is_found_though_cut_swings_overlap_in_shorter_ones() -> None:
    asked_for, tier = long_step(None), InProcess()
    assert asked_for.lengths is not None
    assert asked_for.lengths[0] == 6
    service = PatternSearchService([tier], lambda page, event: None)
    request = PatternRequest(asked_for.problem, asked_for.lengths, 1, 30.0)
    content = service.ask("", request).future.result(60)
    assert (content["result"]["status"], content["result"]["samples"]) == ("optimal", 28)
    assert tier.lengths == [6, 28], "what lies between was proven while 6 was explained"


def test_a_longer_transition_is_offered_before_any_rule_is_loosened() -> None:
    result = solve_pattern(long_step(20).problem())
    assert [one.words for one in result.relaxations] == [
        "28 samples instead of 20",
        "2 feet down instead of 3",
    ]


def test_cut_swings_are_finished_in_another_length_too() -> None:
    question = long_step(None)
    assert np.array_equal(with_samples(question.problem(12), 28).fixed, question.problem(28).fixed)
