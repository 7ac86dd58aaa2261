"""Sentences about patterns, counted from 1."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from core.patterns.clause import Clause, asked_by
from core.patterns.numerals import counted, listed, named, only, times
from core.patterns.problem import BalanceModel, PatternProblem, PatternRules, Relaxation, Rule
from core.patterns.sentences import conflict_sentence, explanation, failing_samples, relaxation_words
from tests.support.solvers.conflicts import drawn, periodic, transition


def balanced(margin: float) -> PatternProblem:
    problem = transition("1101", "1101", 9, (3,))
    model = BalanceModel(np.zeros((4, 2)), 0.01, 0.01)
    return replace(problem, rules=replace(problem.rules, balance=margin), balance_model=model)


@pytest.mark.parametrize(
    ("indices", "words"),
    [
        ((2,), "limb 3"),
        ((0, 3), "limbs 1 and 4"),
        ((0, 1, 2, 4), "limbs 1–3 and 5"),
        ((3, 0), "limbs 1 and 4"),
    ],
)
def test_limbs_are_named_by_number(indices: tuple[int, ...], words: str) -> None:
    assert named("limb", indices) == words


def test_numbers_have_their_nouns() -> None:
    assert [counted(n, "foot") for n in (0, 1, 2)] == ["0 feet", "1 foot", "2 feet"]
    assert [only(n, "foot") for n in (0, 1, 2, 13)] == [
        "no foot is",
        "only one foot is",
        "only two feet are",
        "only 13 feet are",
    ]
    assert [times(n) for n in (1, 2, 3)] == ["once", "twice", "3 times"]
    assert [listed(parts) for parts in (["a"], ["a", "b"], ["a", "b", "c"])] == ["a", "a and b", "a, b and c"]


def test_clauses_ask_for_their_limbs_and_samples_alone() -> None:
    active = asked_by([Clause(Rule.FEET_DOWN, (), 3, 5), Clause(Rule.LIMB_CHANGES, (1,), 0, 8)])
    assert [active(Rule.FEET_DOWN, None, sample) for sample in (2, 3, 5, 6)] == [False, True, True, False]
    assert [active(Rule.LIMB_CHANGES, limb, None) for limb in (0, 1)] == [False, True]
    assert not active(Rule.WORKLOAD, 1, None)


def test_the_sentence_of_the_issue() -> None:
    problem = transition("1101", "1101", 12, (3,))
    clauses = [
        Clause(Rule.FIXED, (2,), 0, 11),
        Clause(Rule.SHORTEST_STANCE, (0,), 0, 11),
        Clause(Rule.FEET_DOWN, (), 3, 5),
    ]
    assert conflict_sentence(problem, clauses, 2) == (
        "Limb 3 is locked in swing and limb 1 must rest at least 3 samples at a time: somewhere in samples "
        "4–6 only two feet are down, and at least 3 must be."
    )


def test_what_one_limb_does_stands_together() -> None:
    problem = transition("0111", "1110", 9, rules=PatternRules(limb_changes=0))
    clauses = [
        Clause(Rule.FIXED, (0, 3), 0, 0),
        Clause(Rule.LIMB_CHANGES, (0,), 0, 8),
        Clause(Rule.FIXED, (0,), 8, 8),
    ]
    assert conflict_sentence(problem, clauses, None) == (
        "Limb 1 swings at sample 1, stands at sample 9 and may not change, and limb 4 stands at sample 1: "
        "not all of this can hold in 9 samples."
    )


def test_a_long_mixed_state_is_only_mentioned() -> None:
    problem = transition("011111", "111111", 9)
    clauses = [Clause(Rule.FIXED, tuple(range(6)), 0, 0), Clause(Rule.WORKLOAD, tuple(range(6)), 0, 8)]
    assert conflict_sentence(problem, clauses, None) == (
        "The state at sample 1 is given and the stances of limbs may differ by at most 2 samples: both "
        "cannot hold in 9 samples."
    )


def test_every_walking_limb_means_just_those() -> None:
    problem = periodic(4, 9, {1: 0, 2: 1})
    said = [
        conflict_sentence(problem, [Clause(Rule.SHORTEST_STANCE, limbs, 0, 8)], None).split(" must")[0]
        for limbs in ((2, 3), (1, 2), (0, 1, 2, 3))
    ]
    assert said == ["Every walking limb", "Limbs 2 and 3", "Every limb"]


def test_each_side_and_feet_down_can_both_be_asked() -> None:
    problem = transition("1111", "1111", 9)
    clauses = [Clause(Rule.FEET_DOWN, (), 2, 3), Clause(Rule.FEET_DOWN_EACH_SIDE, (), 4, 4)]
    assert conflict_sentence(problem, clauses, 1) == (
        "At least 1 foot must be down on each side at sample 5: somewhere in samples 3–4 only one foot is "
        "down, and at least 3 must be."
    )


def test_balance_is_said_in_millimetres() -> None:
    problem = balanced(0.005)
    clauses = [Clause(Rule.FIXED, (2,), 0, 8), Clause(Rule.BALANCE, (), 3, 3)]
    assert conflict_sentence(problem, clauses, None) == (
        "Limb 3 is locked in swing: at sample 4 the body cannot keep a balance margin of 5 mm."
    )
    words = [relaxation_words(problem, Relaxation(Rule.BALANCE, value, (), "")) for value in (-0.002, None)]
    assert words == ["Balance margin −2 mm instead of 5 mm", "Balance not asked for"]


@pytest.mark.parametrize(
    ("relaxation", "words"),
    [
        (Relaxation(Rule.FEET_DOWN, 1, (), ""), "1 foot down instead of 3"),
        (Relaxation(Rule.FEET_DOWN_EACH_SIDE, 0, (), ""), "A side without a foot down"),
        (Relaxation(Rule.SHORTEST_SWING, 1, (), ""), "Swings of 1 sample instead of 2"),
        (Relaxation(Rule.SHORTEST_STANCE, 2, (), ""), "Stances of 2 samples instead of 3"),
        (Relaxation(Rule.LEAST_SWING, 1, (), ""), "1 sample of swing a limb instead of 2"),
        (Relaxation(Rule.LEAST_SWING, 0, (), ""), "Limbs that need not swing"),
        (Relaxation(Rule.LIMB_CHANGES, 4, (), ""), "4 changes a limb instead of 2"),
        (Relaxation(Rule.WORKLOAD, 3, (), ""), "Stances that differ by 3 samples instead of 2"),
        (Relaxation(Rule.FIXED, None, ((2, 1), (2, 2)), ""), "Limb 3 free to walk"),
        (Relaxation(Rule.FIXED, None, ((0, 3), (0, 4), (0, 5)), ""), "Limb 1 free at samples 4–6"),
        (Relaxation(Rule.FIXED, None, (), "", 11), "11 samples instead of 9"),
        (
            Relaxation(Rule.FEET_DOWN, 2, (), "", also=(Relaxation(Rule.FIXED, None, (), "", 11),)),
            "2 feet down instead of 3 and 11 samples instead of 9",
        ),
    ],
)
def test_a_relaxation_has_words_for_a_button(relaxation: Relaxation, words: str) -> None:
    problem = drawn(transition("1101", "1101", 9, (3,)), 1, range(4, 7), 1)
    assert relaxation_words(problem, relaxation) == words


def test_without_a_way_out_it_is_said_what_to_do() -> None:
    ends = transition("0111", "0011", 9)
    assert failing_samples(ends) == [8]
    assert explanation(ends, "Why.", ())[1] == (
        "No change of one rule mends this: choose another state at sample 9."
    )
    assert explanation(periodic(4, 9), "Why.", ())[1] == (
        "No way out was found: loosen several of these together."
    )
