"""The search for patterns: against trying them all, and what it promises of order, drawings and time."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from app.bench.patterns.cases import random_periodic, random_small, random_transition
from core.arrays import Bools
from core.errors import InputError
from core.patterns.brute_force import least_weighted_sum
from core.patterns.check import check_pattern, weighted_sum
from core.patterns.problem import (
    FREE,
    PatternKind,
    PatternProblem,
    PatternProgress,
    PatternResult,
    PatternRules,
    PatternStatus,
    PatternWeights,
    index_halves,
)
from solver_jobs.patterns.callbacks import SearchMonitor
from solver_jobs.patterns.model import build_model
from solver_jobs.patterns.solve import best_patterns
from tests.support.solvers.brute_force import every_sum
from tests.support.solvers.conflicts import periodic, transition

NO_RULES = PatternRules(None, None, None, None, None, None, None)


def sums(problem: PatternProblem, result: PatternResult) -> list[int]:
    return [weighted_sum(problem, pattern) for pattern in result.patterns]


@pytest.mark.parametrize("seed", range(4))
def test_small_cases_are_as_good_as_trying_them_all(seed: int) -> None:
    random = np.random.default_rng(100 + seed)
    for _ in range(10):
        problem = random_small(random)
        if problem.drawing is not None and problem.leg_count > 3:
            continue
        result = best_patterns(problem)
        wanted = least_weighted_sum(problem)
        assert sums(problem, result) == ([] if wanted is None else [wanted])
        assert result.status is (PatternStatus.INFEASIBLE if wanted is None else PatternStatus.OPTIMAL)
        assert not any(check_pattern(problem, pattern.stance) for pattern in result.patterns)


@pytest.mark.parametrize(("legs", "samples"), [(4, 20), (6, 20), (6, 40), (12, 30)])
def test_answers_keep_every_rule_as_the_check_counts(legs: int, samples: int) -> None:
    random = np.random.default_rng(legs + samples)
    for make in (random_transition, random_periodic):
        problem = make(random, legs, samples)
        result = best_patterns(problem)
        assert result.status is PatternStatus.OPTIMAL
        assert check_pattern(problem, result.patterns[0].stance) == ()
        assert result.bound == sums(problem, result)[0]


def test_the_two_models_agree() -> None:
    random = np.random.default_rng(2)
    for _ in range(6):
        problem = random_small(random)
        built = build_model(problem)
        built.model.minimize(built.objective())
        with SearchMonitor(problem, 30.0, lambda known: True) as monitor:
            status, solver = monitor.solve(built.model, linear=0)
        wanted = sums(problem, best_patterns(problem))
        found = [round(solver.objective_value)] if solver.status_name(status) == "OPTIMAL" else []
        assert found == wanted


TINY = replace(transition("111", "101", 6, rules=NO_RULES), weights=PatternWeights(10, 3, 1))


def test_the_best_patterns_come_in_order_and_none_is_left_out() -> None:
    result = best_patterns(TINY, count=40)
    assert sums(TINY, result) == every_sum(TINY)[:40]
    assert len({pattern.stance.tobytes() for pattern in result.patterns}) == 40


def test_more_patterns_than_there_are_give_all() -> None:
    problem = replace(TINY, rules=replace(NO_RULES, limb_changes=1, feet_down=3), sides=index_halves(3))
    fixed = problem.fixed.copy()
    fixed[:, -1] = 1
    problem = replace(problem, fixed=fixed)
    result = best_patterns(problem, count=5)
    assert sums(problem, result) == every_sum(problem) == [0]


def test_a_drawing_is_kept_where_it_can_be() -> None:
    drawing = np.array([[1, 0, 0, 1, 1, 1], [1, 1, 0, 1, 0, 0], [1, 1, 1, 1, 0, 1]], dtype=np.bool_)
    problem = replace(TINY, drawing=drawing, weights=PatternWeights(10, 3, 4))
    assert sums(problem, best_patterns(problem, count=12)) == every_sum(problem)[:12]
    kept = replace(problem, weights=PatternWeights(0, 0, 1))
    best = best_patterns(kept).patterns[0]
    assert best.redrawn == 0
    assert (best.stance[:, 1:-1] == drawing[:, 1:-1]).all()


def canonical(stance: Bools) -> bytes:
    return min(np.roll(stance, turn, axis=1).tobytes() for turn in range(stance.shape[1]))


def test_rotations_of_a_gait_are_one_pattern() -> None:
    problem = periodic(4, 12)
    result = best_patterns(problem, count=6)
    assert len({canonical(pattern.stance) for pattern in result.patterns}) == 6
    assert all(check_pattern(problem, pattern.stance) == () for pattern in result.patterns)
    longest = result.patterns[0].stance
    assert (longest[:, 0] != longest[:, -1]).any(), "it begins where limbs switch"


def test_a_pinned_gait_keeps_its_cells() -> None:
    problem = periodic(4, 12)
    fixed = problem.fixed.copy()
    fixed[2, 4:7] = 0
    pinned = replace(problem, fixed=fixed)
    pattern = best_patterns(pinned).patterns[0]
    assert not pattern.stance[2, 4:7].any()
    assert pattern.sample_changes == best_patterns(problem).patterns[0].sample_changes


def test_a_gait_without_walking_limbs_stands_still() -> None:
    problem = periodic(4, 12, dict.fromkeys((1, 2, 3, 4), 1))
    result = best_patterns(problem, count=3)
    assert [pattern.sample_changes for pattern in result.patterns] == [0]


def test_answers_are_the_same_each_time() -> None:
    problem = random_transition(np.random.default_rng(11), 12, 30)
    answers = [best_patterns(problem, count=4) for _ in range(2)]
    first, second = ([pattern.stance.tobytes() for pattern in answer.patterns] for answer in answers)
    assert first == second


def test_limbs_may_change_as_often_as_they_like_where_that_rule_is_off() -> None:
    fixed = transition("1111", "1111", 14).fixed.copy()
    fixed[0, [3, 9]] = 0
    fixed[0, 6] = 1
    problem = replace(transition("1111", "1111", 14), fixed=fixed)
    assert best_patterns(problem).status is PatternStatus.INFEASIBLE
    free = replace(problem, rules=replace(problem.rules, limb_changes=None))
    pattern = best_patterns(free).patterns[0]
    assert check_pattern(free, pattern.stance) == ()
    assert (np.diff(pattern.stance[0].astype(int)) != 0).sum() == 4


def hard_problem() -> PatternProblem:
    """A drawing of noise, for which the best pattern takes minutes to prove."""
    drawing = np.random.default_rng(7).random((6, 40)) > 0.4
    cells, walking = np.full((6, 40), FREE, dtype=np.int8), np.ones(6, dtype=np.bool_)
    weights = PatternWeights(1, 1, 10)
    return PatternProblem(
        PatternKind.PERIODIC, cells, walking, index_halves(6), weights=weights, drawing=drawing
    )


def test_what_is_known_is_used_when_the_listener_has_seen_enough() -> None:
    problem, heard = hard_problem(), []

    def until_one(known: PatternProgress) -> bool:
        heard.append(known)
        return known.pattern is None

    result = best_patterns(problem, seconds=300.0, progress=until_one)
    assert result.status is PatternStatus.FEASIBLE
    assert check_pattern(problem, result.patterns[0].stance) == ()
    assert result.bound is not None
    assert result.bound <= sums(problem, result)[0]
    assert heard[-1].objective is not None
    assert result.solve_seconds < 300.0


def test_stopped_at_once_there_is_no_pattern() -> None:
    result = best_patterns(hard_problem(), seconds=0.001)
    assert (result.status, result.patterns) == (PatternStatus.CANCELLED, ())


@pytest.mark.parametrize(("count", "seconds"), [(0, 1.0), (51, 1.0), (1, 0.0), (1, float("nan"))])
def test_numbers_out_of_range_are_refused(count: int, seconds: float) -> None:
    with pytest.raises(InputError):
        best_patterns(TINY, count=count, seconds=seconds)


def order_of(stance: Bools) -> bytes:
    """The states that a pattern goes through, whenever it does."""
    changed = (stance[:, 1:] != stance[:, :-1]).any(axis=0)
    return stance[:, np.concatenate([[True], changed])].tobytes()


def test_patterns_that_change_at_other_samples_are_one_where_each_order_is_wanted_once() -> None:
    everyone = best_patterns(TINY, count=50)
    once = best_patterns(replace(TINY, once_an_order=True), count=50)
    orders = [order_of(pattern.stance) for pattern in once.patterns]
    assert len(set(orders)) == len(orders)
    assert {order_of(pattern.stance) for pattern in everyone.patterns} <= set(orders)
    assert weighted_sum(TINY, once.patterns[0]) == weighted_sum(TINY, everyone.patterns[0])


def test_of_one_order_the_pattern_most_like_the_drawing_is_given() -> None:
    drawing = np.array([[1, 1, 1, 1, 1, 1], [1, 1, 1, 1, 0, 0], [1, 1, 1, 1, 1, 1]], dtype=np.bool_)
    problem = replace(TINY, drawing=drawing, once_an_order=True)
    best = best_patterns(problem, count=3).patterns
    assert (best[0].stance == drawing).all()
    assert len({order_of(pattern.stance) for pattern in best}) == 3


def test_rotated_orders_of_a_gait_are_one() -> None:
    result = best_patterns(replace(periodic(4, 12), once_an_order=True), count=4)
    rings = []
    for pattern in result.patterns:
        changed = (pattern.stance != np.roll(pattern.stance, 1, axis=1)).any(axis=0)
        rings.append(canonical(pattern.stance[:, changed]))
    assert len(set(rings)) == 4
