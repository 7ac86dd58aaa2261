"""Trying every pattern of a small problem, held against the check's own counting."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from app.bench.patterns.cases import random_small
from core.errors import InputError
from core.patterns.brute_force import least_weighted_sum
from core.patterns.problem import FREE, PatternRules
from tests.support.solvers.brute_force import every_sum
from tests.support.solvers.conflicts import transition

MOST_FREE = 11


def test_it_finds_what_the_check_lets_pass() -> None:
    random, tried, solvable = np.random.default_rng(8), 0, 0
    while tried < 20:
        problem = random_small(random)
        if (problem.fixed == FREE).sum() <= MOST_FREE:
            wanted = min(every_sum(problem), default=None)
            assert least_weighted_sum(problem) == wanted
            tried, solvable = tried + 1, solvable + (wanted is not None)
    assert 3 <= solvable < tried


def test_fs_rules_on_one_step_of_each_limb() -> None:
    problem = transition("1111", "1111", 9)
    assert least_weighted_sum(problem) is None, "four swings of two samples need ten samples"
    longer = transition("1111", "1111", 10)
    assert least_weighted_sum(longer) == 5 * 1000 + 8
    eased = replace(problem, rules=PatternRules(least_swing=1, shortest_swing=1))
    assert least_weighted_sum(eased) == 5 * 1000 + 8


def test_large_problems_are_refused() -> None:
    with pytest.raises(InputError, match="too many"):
        least_weighted_sum(transition("1111", "1111", 11))
