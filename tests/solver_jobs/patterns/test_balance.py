"""The rule `balance`: what the body can do decides what limbs may do, and its places are the witness."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from ortools.sat.python.cp_model import CpSolver

from app.bench.patterns.cases import random_periodic, random_transition
from core.arrays import Bools, Floats
from core.motion.support_polygon import polygon_margin, support_polygon
from core.patterns.check import broken_rules, check_pattern
from core.patterns.problem import BalanceModel, PatternProblem, PatternRules, PatternStatus, Rule
from solver_jobs.patterns.model import build_model
from solver_jobs.patterns.solve import best_patterns
from tests.support.solvers.conflicts import periodic, transition

RADIUS, MARGIN = 0.040, 0.003


def ring(legs: int, reach: float = 0.0175, speed: float = 0.015) -> BalanceModel:
    angles = np.arange(legs) * 2 * np.pi / legs
    return BalanceModel(RADIUS * np.column_stack([np.cos(angles), np.sin(angles)]), reach, speed)


def balanced(problem: PatternProblem, model: BalanceModel, margin: float = MARGIN) -> PatternProblem:
    return replace(problem, rules=replace(problem.rules, balance=margin), balance_model=model)


def opposite_swings(samples: int, speed: float) -> PatternProblem:
    """Feet 1 and 3 of a square each swing once while 2 and 4 stand: the body has to change sides between."""
    rules = PatternRules(feet_down=3, feet_down_each_side=None, shortest_stance=None)
    problem = transition("1111", "1111", samples, locked=(2, 4), rules=rules)
    return balanced(problem, ring(4, speed=speed))


@pytest.mark.parametrize(
    ("speed", "gap"),
    [(0.0155, 0), (0.0149, 1), (0.0077, 1), (0.0074, 2), (0.0052, 2), (0.0049, 3)],
)
def test_the_body_needs_time_to_change_sides(speed: float, gap: int) -> None:
    """The way is two margins, 6 mm, of which the body goes speed × 0.4 s from one sample to the next."""
    shortest = 2 + 4 + gap
    assert best_patterns(opposite_swings(shortest - 1, speed)).status is PatternStatus.INFEASIBLE
    problem = opposite_swings(shortest, speed)
    pattern = best_patterns(problem).patterns[0]
    assert check_pattern(problem, pattern.stance, pattern.body_xy) == ()
    assert pattern.sample_changes == (4 if gap else 3)


@pytest.mark.parametrize(("reach", "works"), [(0.0029, False), (0.0032, True)])
def test_the_body_needs_reach(reach: float, works: bool) -> None:
    problem = replace(opposite_swings(10, 0.1), balance_model=ring(4, reach=reach, speed=0.1))
    assert bool(best_patterns(problem).patterns) == works


@pytest.mark.parametrize(("margin", "gap"), [(0.0, 0), (0.003, 0), (0.006, 2), (0.009, 4)])
def test_more_margin_takes_more_time(margin: float, gap: int) -> None:
    """The way between the sides is two margins, of which the body goes 6.2 mm a sample."""
    problem = opposite_swings(6 + gap, 0.0155)
    problem = replace(problem, rules=replace(problem.rules, balance=margin))
    pattern = best_patterns(problem).patterns[0]
    assert check_pattern(problem, pattern.stance, pattern.body_xy) == ()


@pytest.mark.parametrize(("margin", "works"), [(0.0, False), (-0.0175, False), (-0.0185, True)])
def test_the_body_can_lean_out_by_a_margin_below_nothing(margin: float, works: bool) -> None:
    """Feet 1 to 3 of a hexagon are up; the others' nearest edge is 20 mm from the middle, the reach 2 mm."""
    rules = PatternRules(feet_down=3, feet_down_each_side=None)
    still = transition("000111", "000111", 6, locked=(1, 2, 3, 4, 5, 6), rules=rules)
    problem = balanced(still, ring(6, reach=0.002), margin)
    patterns = best_patterns(problem).patterns
    assert bool(patterns) == works
    assert not any(check_pattern(problem, pattern.stance, pattern.body_xy) for pattern in patterns)


def test_two_feet_bear_no_body() -> None:
    rules = PatternRules(feet_down=2, feet_down_each_side=None)
    problem = balanced(transition("0101", "0101", 8, locked=(1, 2, 3, 4), rules=rules), ring(4))
    assert best_patterns(problem).status is PatternStatus.INFEASIBLE
    alone = replace(problem, rules=replace(rules, balance=None), balance_model=None)
    assert best_patterns(alone).status is PatternStatus.OPTIMAL


@pytest.mark.parametrize("legs", [4, 6, 12])
def test_places_of_the_body_are_confirmed_by_the_check(legs: int) -> None:
    random, found = np.random.default_rng(legs), 0
    for make in (random_transition, random_periodic, random_transition):
        problem = balanced(make(random, legs, 20), ring(legs))
        for pattern in best_patterns(problem).patterns:
            found += 1
            assert pattern.body_xy is not None
            assert check_pattern(problem, pattern.stance, pattern.body_xy) == ()
            moved = pattern.body_xy + 0.05
            assert broken_rules(check_pattern(problem, pattern.stance, moved)) == {Rule.BALANCE}
    assert found


def test_a_gait_comes_back_to_where_the_body_was() -> None:
    problem = balanced(periodic(4, 40), ring(4))
    pattern = best_patterns(problem).patterns[0]
    assert check_pattern(problem, pattern.stance, pattern.body_xy) == ()
    slow = replace(problem, balance_model=ring(4, speed=0.0001))
    assert best_patterns(slow).status is PatternStatus.INFEASIBLE


def bearing(model: BalanceModel, stance: Bools) -> list[Floats]:
    """Grid places within reach that are balanced, sample by sample."""
    side = np.arange(-model.reach, model.reach, 0.0005)
    grid = np.stack(np.meshgrid(side, side), axis=-1).reshape(-1, 2)
    grid = grid[np.linalg.norm(grid, axis=1) <= model.reach]
    polygons = [support_polygon(model.feet_xy[column]) for column in stance.T]
    return [np.array([p for p in grid if polygon_margin(polygon, p) >= MARGIN]) for polygon in polygons]


def test_what_is_called_impossible_has_no_place_on_a_grid_either() -> None:
    """Feet 1 and 2 of a hexagon up: the body cannot reach what the others bear when one of them swings."""
    problem = balanced(periodic(6, 20, {1: 0, 2: 0}), ring(6))
    assert best_patterns(problem).status is PatternStatus.INFEASIBLE
    swung = np.ones((6, 4), dtype=np.bool_)
    swung[:2] = False
    swung[np.arange(2, 6), np.arange(4)] = False
    places = [len(found) for found in bearing(ring(6), swung)]
    assert 0 in places
    assert len(bearing(ring(6), np.ones((6, 1), dtype=np.bool_))[0]) > 100


@pytest.mark.parametrize("speed", [0.0149, 0.0049])
def test_the_model_by_samples_agrees(speed: float) -> None:
    for samples in range(6, 10):
        problem = opposite_swings(samples, speed)
        solver = CpSolver()
        solver.parameters.num_workers = 1
        status = solver.status_name(solver.solve(build_model(problem).model))
        assert (status == "OPTIMAL") == bool(best_patterns(problem).patterns)


def test_balance_can_be_left_out_of_single_samples() -> None:
    problem = opposite_swings(6, 0.0149)
    for left_out, works in (((), False), ((2, 3), True)):

        def active(rule: Rule, limb: int | None, sample: int | None, out: tuple[int, ...] = left_out) -> bool:
            return rule is not Rule.BALANCE or sample not in out

        built = build_model(problem, active)
        solver = CpSolver()
        solver.parameters.num_workers = 1
        assert (solver.status_name(solver.solve(built.model)) == "OPTIMAL") == works
