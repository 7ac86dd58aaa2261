"""The check of patterns: each rule alone, on patterns like those of F's figures 3.4 to 3.8."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace

import numpy as np
import pytest

from core.arrays import Bools
from core.errors import InputError
from core.patterns.check import broken_rules, check_pattern, scored, weighted_sum
from core.patterns.problem import (
    FREE,
    BalanceModel,
    PatternKind,
    PatternProblem,
    PatternRules,
    PatternWeights,
    Rule,
    index_halves,
)

Swings = Mapping[int, Iterable[int]]
F_RULES: Mapping[str, int | None] = {}
Breaking = Mapping[str, tuple[Rule, Swings, dict[str, int | None], int]]

TRIPODS: Swings = {limb: range(1, 5) if limb % 2 == 0 else range(7, 11) for limb in range(6)}
"""Samples in the air; limbs 1, 3, 5 and then 2, 4, 6, and everything stands at both ends."""

RING: Swings = {limb: (10, 11, 0, 1) if limb % 2 == 0 else (4, 5, 6, 7) for limb in range(6)}
"""The same as a gait of 12 samples, in which limbs 1, 3, 5 swing round the end."""


def drawn(swings: Swings, samples: int = 13) -> Bools:
    stance = np.ones((len(swings), samples), dtype=np.bool_)
    for limb, up in swings.items():
        stance[limb, list(up)] = False
    return stance


def problem_of(
    stance: Bools, kind: PatternKind = PatternKind.TRANSITION, rules: Mapping[str, int | None] = F_RULES
) -> PatternProblem:
    fixed = np.full(stance.shape, FREE, dtype=np.int8)
    if kind is PatternKind.TRANSITION:
        fixed[:, [0, -1]] = stance[:, [0, -1]]
    limbs = len(stance)
    numbers = PatternRules(**rules)
    return PatternProblem(kind, fixed, np.ones(limbs, dtype=np.bool_), index_halves(limbs), numbers)


def test_tripods_that_take_turns_keep_every_rule() -> None:
    stance = drawn(TRIPODS)
    assert check_pattern(problem_of(stance), stance) == ()


BREAKING: Breaking = {
    "figure 3.4: a swing of one sample": (Rule.SHORTEST_SWING, {0: (1, 2, 3, 11)}, {"limb_changes": 4}, 1),
    "3.2.4: two feet down": (Rule.FEET_DOWN, {3: range(4, 8)}, {}, 2),
    "figure 3.5: one side in the air": (
        Rule.FEET_DOWN_EACH_SIDE,
        {limb: range(1, 5) if limb < 3 else range(7, 11) for limb in range(6)},
        {},
        0,
    ),
    "figure 3.6: uneven work": (Rule.WORKLOAD, {0: range(1, 6), 1: (7, 8)}, {}, 3),
    "figure 3.7: three changes of limb 6": (Rule.LIMB_CHANGES, {5: (0, *range(7, 11))}, {}, 3),
    "figure 3.8: a stance of two samples": (Rule.SHORTEST_STANCE, {0: (1, 2, 5, 6)}, {"limb_changes": 4}, 2),
    "g11: a limb that hardly swings": (
        Rule.LEAST_SWING,
        {0: (0,), **{limb: range(1, 4) if limb % 2 == 0 else range(7, 10) for limb in range(1, 6)}},
        {},
        1,
    ),
}


@pytest.mark.parametrize("name", BREAKING)
def test_a_pattern_breaks_one_rule_only(name: str) -> None:
    rule, swings, rules, value = BREAKING[name]
    stance = drawn({**TRIPODS, **swings})
    problem = problem_of(stance, rules=rules)
    found = check_pattern(problem, stance)
    assert broken_rules(found) == {rule}
    assert found[0].value == value
    without = replace(problem, rules=replace(problem.rules, **{rule.value: None}))
    assert check_pattern(without, stance) == ()


def test_a_cell_that_is_fixed_otherwise_is_named() -> None:
    stance = drawn(TRIPODS)
    problem = problem_of(stance)
    fixed = problem.fixed.copy()
    fixed[2, 3] = 1
    (found,) = check_pattern(replace(problem, fixed=fixed), stance)
    assert (found.rule, found.limb, found.samples, found.value, found.limit) == (Rule.FIXED, 2, (3,), 0, 1)


def test_phases_that_the_window_cuts_are_exempt() -> None:
    stance = drawn({**TRIPODS, 0: (0, *range(4, 7)), 1: (6, 7, 8, 12)})
    broken = broken_rules(check_pattern(problem_of(stance, rules={"limb_changes": 4}), stance))
    assert not broken & {Rule.SHORTEST_SWING, Rule.SHORTEST_STANCE}


def test_a_locked_limb_counts_for_feet_down_but_not_for_the_workload() -> None:
    stance = drawn({**TRIPODS, 0: range(13)})
    fixed = problem_of(stance).fixed.copy()
    fixed[0] = 0
    walking = np.arange(6) > 0
    problem = replace(problem_of(stance), fixed=fixed, walking=walking)
    assert broken_rules(check_pattern(problem, stance)) == {Rule.FEET_DOWN}
    stance = drawn({**TRIPODS, 0: ()})
    fixed[0] = 1
    assert check_pattern(replace(problem, fixed=fixed), stance) == ()


def test_a_foot_on_the_centre_line_counts_for_both_sides() -> None:
    stance = drawn({0: range(1, 5), 1: (), 2: range(6, 10)})
    problem = problem_of(stance, rules=dict.fromkeys(("feet_down", "workload", "least_swing")))
    both, alone = index_halves(3), np.array([[True, False, False], [False, True, True]])
    assert check_pattern(replace(problem, sides=both), stance) == ()
    assert broken_rules(check_pattern(replace(problem, sides=alone), stance)) == {Rule.FEET_DOWN_EACH_SIDE}


ROUND_THE_END: Breaking = {
    "a swing": (Rule.SHORTEST_SWING, {0: (10, 11, 0)}, {"shortest_swing": 4}, 3),
    "a stance": (Rule.SHORTEST_STANCE, {0: (1, 2, 9, 10)}, {"limb_changes": 4}, 2),
    "a change": (Rule.LIMB_CHANGES, {0: (0, 1, 9, 10)}, {"shortest_stance": None}, 4),
    "a limb that stands": (Rule.LEAST_SWING, {0: ()}, {"workload": None, "least_swing": None}, 0),
    "a limb that is held": (Rule.LEAST_SWING, {0: range(12)}, {"workload": None, "feet_down": None}, 12),
}


@pytest.mark.parametrize("name", ROUND_THE_END)
def test_in_a_gait_rules_hold_round_the_end(name: str) -> None:
    rule, swings, rules, value = ROUND_THE_END[name]
    stance = drawn({**RING, **swings}, 12)
    found = check_pattern(problem_of(stance, PatternKind.PERIODIC, rules), stance)
    assert broken_rules(found) == {rule}
    assert found[0].value == value


def test_a_gait_that_swings_round_the_end_keeps_every_rule() -> None:
    stance = drawn(RING, 12)
    for turn in range(12):
        turned = np.roll(stance, turn, axis=1)
        assert check_pattern(problem_of(turned, PatternKind.PERIODIC), turned) == ()


def test_scores_count_changes_switches_and_redrawn_cells() -> None:
    stance = drawn(TRIPODS)
    problem = replace(problem_of(stance), drawing=drawn({**TRIPODS, 0: range(1, 4), 5: ()}))
    pattern = scored(problem, stance)
    assert (pattern.sample_changes, pattern.limb_changes, pattern.redrawn) == (4, 12, 1 + 4)
    assert weighted_sum(replace(problem, weights=PatternWeights(100, 10, 1)), pattern) == 400 + 120 + 5
    ring = drawn({**RING, 0: (0, 1)}, 12)
    pattern = scored(problem_of(ring, PatternKind.PERIODIC), ring)
    assert (pattern.sample_changes, pattern.limb_changes) == (5, 12)


SQUARE = BalanceModel(np.array([[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]]) * 0.1, 0.02, 0.01)


def balanced(places: list[tuple[float, float]], margin: float = 0.01) -> frozenset[Rule]:
    stance = np.ones((4, len(places)), dtype=np.bool_)
    stance[0, 1:] = False
    problem = problem_of(
        stance, rules=dict.fromkeys(("feet_down", "workload", "limb_changes", "least_swing"))
    )
    problem = replace(
        problem, rules=replace(problem.rules, balance=margin), balance_model=SQUARE, sample_time=1.0
    )
    return broken_rules(check_pattern(problem, stance, np.array(places)))


def test_balance_asks_for_margin_reach_and_a_way_in_time() -> None:
    assert balanced([(-0.005, 0.0), (-0.010, 0.0), (-0.018, 0.0)]) == set()
    assert balanced([(-0.005, 0.0), (-0.008, 0.0), (-0.010, 0.0)]) == {Rule.BALANCE}, "the margin"
    assert balanced([(-0.015, 0.0), (-0.021, 0.0), (-0.018, 0.0)]) == {Rule.BALANCE}, "the reach"
    assert balanced([(0.0, 0.0), (-0.015, 0.0), (-0.015, 0.0)]) == {Rule.BALANCE}, "the way"


def test_balance_needs_places() -> None:
    stance = drawn(TRIPODS)
    model = BalanceModel(np.eye(6, 2), 0.02, 0.01)
    problem = replace(problem_of(stance), rules=PatternRules(balance=0.0), balance_model=model)
    assert broken_rules(check_pattern(problem, stance)) == {Rule.BALANCE}


def test_a_pattern_of_another_size_is_refused() -> None:
    stance = drawn(TRIPODS)
    with pytest.raises(InputError, match="shape"):
        check_pattern(problem_of(stance), stance[:, :-1])
