"""Every pattern of a tiny problem by the check's own counting."""

from __future__ import annotations

import itertools

import numpy as np

from core.patterns.check import check_pattern, scored, weighted_sum
from core.patterns.problem import FREE, PatternProblem


def every_sum(problem: PatternProblem) -> list[int]:
    """Weighted sums of all patterns that keep the rules, the best first, by trying all cells."""
    free, found = np.argwhere(problem.fixed == FREE), []
    for values in itertools.product((False, True), repeat=len(free)):
        stance = problem.fixed == 1
        stance[tuple(free.T)] = values
        if not check_pattern(problem, stance):
            found.append(weighted_sum(problem, scored(problem, stance)))
    return sorted(found)
