"""Why there is no pattern: smallest sets of clauses that conflict, their words, and what relaxes them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from core.patterns.check import check_pattern
from core.patterns.clause import asked_by
from core.patterns.problem import BalanceModel, PatternProblem, PatternStatus, Rule
from core.patterns.relaxation import relaxed
from solver_jobs import solve_pattern
from solver_jobs.patterns.explain import Explanation, explain
from solver_jobs.patterns.probe import Feasibility, Probe
from tests.support.solvers.conflicts import CONFLICTS, F_RULES, periodic, transition

NO_ROOM = "at some sample only two feet are down, and at least 3 must be."

SENTENCES = {
    "locked limbs leave two feet": "Limbs 1 and 4 are locked in swing: at samples 1–20 only two feet are "
    "down, and at least 3 must be.",
    "no foot at the start": "Every limb swings at sample 1: no foot is down there, and at least 3 must be.",
    "the start lifts a side": "Limbs 1–3 swing at sample 1: no foot of limbs 1–3 is down there, and at least "
    "1 must be.",
    "both ends lift a side": "Limbs 4–6 swing at sample 1: no foot of limbs 4–6 is down there, and at least "
    "1 must be.",
    "four limbs have no room to swing": "Every limb stands at samples 1 and 9 and must swing at least 2 "
    f"samples in all: {NO_ROOM}",
    "six limbs have no room to swing": f"Every limb stands at sample 1 and must swing at least 2 samples in "
    f"all: {NO_ROOM}",
    "twelve limbs have no room to swing": "Every limb stands at samples 1 and 5, must swing at least 2 "
    "samples in all and must swing at least 2 samples at a time: at sample 3 no foot is down, and at least 3 "
    "must be.",
    "a locked limb lets no other swing": "Limb 3 is locked in swing and limb 1 must swing at least 2 samples "
    f"in all: {NO_ROOM}",
    "no change is allowed": "Limb 1 swings at sample 1, stands at sample 20 and may not change: not all of "
    "this can hold in 20 samples.",
    "more feet than there are": "The robot has 6 limbs, and at least 7 feet must be down.",
    "a drawn swing is too short": "Limb 2 swings at sample 5, stands at samples 4 and 6 and must swing at "
    "least 2 samples at a time: not all of this can hold in 20 "
    "samples.",
    "a drawn stance is too short": "Limb 2 swings at samples 7 and 9, stands at sample 8 and must rest at "
    "least 3 samples at a time: not all of this can hold in 20 "
    "samples.",
    "two limbs drawn in swing": "Limbs 1 and 2 swing at sample 8: only two feet are down there, and at least "
    "3 must be.",
    "unequal stance": "Limb 3 stands at samples 2–11, limb 5 swings at samples 4–8 and the stances of limbs "
    "3 and 5 may differ by at most 2 samples: not all of this can hold in "
    "12 samples.",
    "a gait has no room": f"Every limb must swing at least 2 samples in all: {NO_ROOM}",
    "a gait with one limb up": "Limb 1 is locked in swing and limb 3 must swing at least 2 samples in all: "
    f"{NO_ROOM}",
    "a gait of four limbs has no room": "Limbs 1 and 4 are locked in swing and every walking limb must swing "
    f"at least 2 samples in all: {NO_ROOM}",
    "ten limbs up": "Limbs 1–10 are locked in swing: at samples 1–40 only two feet are down, and at least 3 "
    "must be.",
}

RELAXED = {
    "locked limbs leave two feet": [],
    "no foot at the start": [],
    "the start lifts a side": ["A side without a foot down"],
    "both ends lift a side": ["A side without a foot down"],
    "six limbs have no room to swing": ["6 samples instead of 4", "Limbs that need not swing"],
    "twelve limbs have no room to swing": ["6 samples instead of 5", "Limbs that need not swing"],
    "four limbs have no room to swing": [
        "10 samples instead of 9",
        "Limbs that need not swing",
        "2 feet down instead of 3",
    ],
    "a locked limb lets no other swing": ["Limbs that need not swing", "Limb 3 free to walk"],
    "no change is allowed": ["2 changes a limb instead of 0"],
    "more feet than there are": ["5 feet down instead of 7"],
    "a drawn swing is too short": ["Limb 2 free at samples 4–6"],
    "two limbs drawn in swing": ["Limb 1 free at sample 8", "Limb 2 free at sample 8"],
    "a gait has no room": ["8 samples instead of 6", "2 feet down instead of 3"],
    "a gait with one limb up": ["Limb 1 free to walk", "2 feet down instead of 3"],
    "a gait of four limbs has no room": [
        "8 samples instead of 6",
        "Limb 1 free to walk",
        "Limb 4 free to walk",
        "2 feet down instead of 3",
    ],
    "a drawn stance is too short": ["Stances of 1 sample instead of 3", "Limb 2 free at samples 7–9"],
    "unequal stance": [
        "Limb 3 free at samples 2–11",
        "Limb 5 free at samples 4–8",
        "Stances that differ by 6 samples instead of 2",
    ],
    "ten limbs up": ["Limbs 1 and 2 free to walk"],
}


@pytest.fixture(scope="module", params=CONFLICTS)
def explained(request: pytest.FixtureRequest) -> tuple[str, PatternProblem, Explanation]:
    problem = CONFLICTS[request.param]
    return request.param, problem, explain(problem)


@pytest.mark.heavy
def test_the_clauses_conflict_and_each_is_needed(explained: tuple[str, PatternProblem, Explanation]) -> None:
    _, problem, why = explained
    assert Probe().conflict(problem, why.clauses)
    for clause in why.clauses:
        others = [other for other in why.clauses if other is not clause]
        assert Probe().ask(problem, asked_by(others)) is Feasibility.SOLVABLE, clause


def test_the_conflict_is_said_in_words(explained: tuple[str, PatternProblem, Explanation]) -> None:
    name, _, why = explained
    assert why.sentences[0] == SENTENCES[name]
    assert all(sentence[0].isupper() and sentence.endswith(".") for sentence in why.sentences)


def test_every_relaxation_makes_it_solvable(explained: tuple[str, PatternProblem, Explanation]) -> None:
    name, problem, why = explained
    assert len(why.relaxations) <= 6
    assert [one.words for one in why.relaxations] == RELAXED[name]
    for relaxation in why.relaxations:
        eased = relaxed(problem, relaxation)
        result = solve_pattern(eased, seconds=20)
        assert result.status is PatternStatus.OPTIMAL, relaxation.words
        assert check_pattern(eased, result.patterns[0].stance) == ()


def test_a_relaxed_number_is_the_mildest() -> None:
    problem = CONFLICTS["unequal stance"]
    for number, answer in ((5, Feasibility.CONFLICT), (6, Feasibility.SOLVABLE)):
        assert Probe().ask(replace(problem, rules=replace(problem.rules, workload=number))) is answer


def test_the_same_words_each_time() -> None:
    problem = CONFLICTS["six limbs have no room to swing"]
    assert explain(problem) == explain(problem)


def test_a_result_without_a_pattern_carries_its_explanation() -> None:
    problem = CONFLICTS["a locked limb lets no other swing"]
    result, why = solve_pattern(problem), explain(problem)
    assert (result.status, result.patterns) == (PatternStatus.INFEASIBLE, ())
    assert (result.explanation, result.relaxations) == (why.sentences, why.relaxations)


def test_a_pattern_needs_no_explanation() -> None:
    result = solve_pattern(transition("1111", "1111", 12))
    assert (result.status, result.explanation, result.relaxations) == (PatternStatus.OPTIMAL, (), ())


def test_feet_are_called_feet_in_a_document() -> None:
    problem = replace(CONFLICTS["a locked limb lets no other swing"], noun="foot")
    why = explain(problem)
    assert why.sentences == (
        f"Foot 3 is locked in swing and foot 1 must swing at least 2 samples in all: {NO_ROOM}",
        "It works with feet that need not swing or with foot 3 free to walk.",
    )


def test_without_work_left_a_question_is_answered_by_neither_yes_nor_no() -> None:
    problem = transition("1111", "1111", 12)
    probe = Probe(work=1e-9)
    assert [probe.ask(problem), probe.ask(problem)] == [Feasibility.SOLVABLE, Feasibility.UNKNOWN]
    assert not probe.solvable(problem)
    assert not probe.conflict(problem, [])
    assert probe.asked == 1


def test_two_rules_are_relaxed_where_one_does_not_suffice() -> None:
    problem = replace(periodic(4, 12, {1: 0}), rules=replace(F_RULES, least_swing=5))
    why = explain(problem)
    assert [one.words for one in why.relaxations] == [
        "1 foot down instead of 3 and a side without a foot down",
        "2 feet down instead of 3 and limb 1 free to walk",
    ]
    for one in why.relaxations:
        assert Probe().solvable(relaxed(problem, one))
        assert not Probe().solvable(relaxed(problem, replace(one, also=())))
        assert not Probe().solvable(relaxed(problem, one.also[0]))


def test_without_work_all_rules_are_said_to_conflict(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Probe, "ask", lambda *_: Feasibility.UNKNOWN)
    why = explain(CONFLICTS["a gait has no room"])
    assert {clause.rule for clause in why.clauses} == set(Rule) - {Rule.FIXED, Rule.BALANCE}
    assert why.relaxations == ()


def test_balance_conflicts_and_gives_way() -> None:
    angles = 2 * np.pi * np.arange(6) / 6
    feet = 0.06 * np.column_stack([np.cos(angles), np.sin(angles)])
    problem = replace(
        periodic(6, 12, {1: 0, 6: 0}),
        rules=replace(F_RULES, balance=0.0),
        balance_model=BalanceModel(feet, reach=0.012, speed=0.015),
    )
    why = explain(problem)
    assert why.sentences[0] == (
        "Limbs 1 and 6 are locked in swing and limb 2 must swing at least 2 samples in all: at some sample "
        "the body cannot keep a balance margin of 0 mm."
    )
    for clause in why.clauses:
        others = [other for other in why.clauses if other is not clause]
        assert Probe().ask(problem, asked_by(others)) is Feasibility.SOLVABLE, clause
    assert [one.words for one in why.relaxations] == [
        "Limb 1 free to walk",
        "Limb 6 free to walk",
        "Balance margin −19 mm instead of 0 mm",
    ]


def test_limbs_that_are_locked_all_count() -> None:
    problem = transition("110111", "110111", 12, (3,), rules=replace(F_RULES, feet_down=6))
    why = explain(problem)
    assert why.sentences == (
        "Limb 3 is locked in swing: at samples 1–12 only five feet are down, and at least 6 must be.",
        "It works with 4 feet down instead of 6.",
    )
    assert np.array_equal(relaxed(problem, why.relaxations[0]).fixed, problem.fixed)
