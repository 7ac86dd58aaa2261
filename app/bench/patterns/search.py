"""How long the search for a footfall pattern takes to be proven, and whether its answers hold.

Every answer is counted again by the check of patterns, and small ones are held against trying every pattern.
"""

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from app.bench.common.measure import Row, milliseconds
from app.bench.patterns.cases import random_periodic, random_small, random_transition
from core.patterns.brute_force import least_weighted_sum
from core.patterns.check import check_pattern, weighted_sum
from core.patterns.problem import PatternProblem, PatternResult, PatternStatus
from solver_jobs import PatternSolver

LIMBS, SAMPLES = (4, 6, 12), (20, 30, 40)
"""F's sizes."""

COUNT = 60
"""Searches of each size and kind."""

MANY = 1000
"""Transitions of 6 and of 12 limbs together."""

SMALL = 300
"""Cases that are held against trying every pattern."""

SECONDS = 60.0
"""Longest search."""

SEED = 1


@dataclass(frozen=True, eq=False)
class _Timed:
    """One search: what came out, and the time from question to answer with the explanation, s."""

    problem: PatternProblem
    result: PatternResult
    whole: float


def bench_patterns(count: int = COUNT, many: int = MANY, small: int = SMALL) -> list[Row]:
    """Times by size and kind, a large number of transitions, and small cases against trying them all.

    Args:
        count: searches of each size and kind.
        many: transitions of 6 and of 12 limbs together.
        small: cases that are tried out.
    """
    random = np.random.default_rng(SEED)
    solver = PatternSolver()
    _searched(solver, random_transition(random, LIMBS[0], SAMPLES[0]))
    kinds = {"transition": random_transition, "gait": random_periodic}
    try:
        rows = [
            _row(solver, f"{legs} × {samples}", kind, [make(random, legs, samples) for _ in range(count)])
            for kind, make in kinds.items()
            for legs in LIMBS
            for samples in SAMPLES
        ]
        for legs in LIMBS[1:]:
            mixed = [random_transition(random, legs, int(random.integers(20, 41))) for _ in range(many // 2)]
            rows.append(_row(solver, f"{legs} × 20 to 40", "transition", mixed))
        return [*rows, _against_trying(solver, [random_small(random) for _ in range(small)])]
    finally:
        solver.close()


def _searched(solver: PatternSolver, problem: PatternProblem) -> _Timed:
    begin = time.perf_counter()
    result = solver.solve(problem, seconds=SECONDS)
    return _Timed(problem, result, time.perf_counter() - begin)


def _row(solver: PatternSolver, size: str, kind: str, problems: Sequence[PatternProblem]) -> Row:
    found = [_searched(solver, problem) for problem in problems]
    seconds = np.array([one.result.solve_seconds for one in found])
    return {
        "limbs_samples": size,
        "kind": kind,
        **_statuses(found),
        "broken": sum(not _keeps_rules(one) for one in found),
        "median_ms": milliseconds(float(np.median(seconds))),
        "p95_ms": milliseconds(float(np.percentile(seconds, 95))),
        "max_ms": milliseconds(float(seconds.max())),
        "explained_p95_ms": milliseconds(float(np.percentile([one.whole for one in found], 95))),
    }


def _statuses(found: Sequence[_Timed]) -> Row:
    def counted(holds: Callable[[PatternResult], bool]) -> int:
        return sum(holds(one.result) for one in found)

    return {
        "searches": len(found),
        "optimal": counted(lambda result: result.status is PatternStatus.OPTIMAL),
        "infeasible": counted(lambda result: result.status is PatternStatus.INFEASIBLE),
        "explained": counted(lambda result: bool(result.explanation)),
        "unproven": counted(
            lambda result: result.status in (PatternStatus.FEASIBLE, PatternStatus.CANCELLED)
        ),
    }


def _keeps_rules(one: _Timed) -> bool:
    return not any(
        check_pattern(one.problem, pattern.stance, pattern.body_xy) for pattern in one.result.patterns
    )


def _against_trying(solver: PatternSolver, problems: Sequence[PatternProblem]) -> Row:
    found = [_searched(solver, problem) for problem in problems]
    return {
        "small_cases": len(found),
        **_statuses(found),
        "broken": sum(not _keeps_rules(one) for one in found),
        "identical": sum(_best_sum(one) == least_weighted_sum(one.problem) for one in found),
    }


def _best_sum(one: _Timed) -> int | None:
    patterns = one.result.patterns
    return weighted_sum(one.problem, patterns[0]) if patterns else None
