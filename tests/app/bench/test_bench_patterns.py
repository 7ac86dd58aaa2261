"""The benchmark of patterns: what it counts is what was searched, and a wrong answer shows in its table."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from app.bench.patterns import search as patterns
from app.bench.patterns.cases import random_gait, random_small, random_transition
from app.bench.patterns.search import bench_patterns
from core.patterns.problem import FREE, PatternProblem, PatternResult
from solver_jobs import PatternSolver

pytestmark = pytest.mark.heavy


def test_every_size_and_kind_is_measured(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(patterns, "SAMPLES", (20,))
    rows = bench_patterns(count=2, many=4, small=6)
    named = [(row["limbs_samples"], row["kind"]) for row in rows[:-1]]
    assert named[:4] == [
        ("4 × 20", "transition"),
        ("6 × 20", "transition"),
        ("12 × 20", "transition"),
        ("4 × 20", "gait"),
    ]
    assert named[-2:] == [("6 × 20 to 40", "transition"), ("12 × 20 to 40", "transition")]
    assert all(row["optimal"] + row["infeasible"] == row["searches"] for row in rows)
    assert all(row["explained"] == row["infeasible"] for row in rows)
    assert all(row["broken"] == 0 for row in rows)
    assert rows[-1]["identical"] == 6


def test_a_wrong_answer_is_counted(monkeypatch: pytest.MonkeyPatch) -> None:
    honest = PatternSolver.solve

    def wrong(
        solver: PatternSolver, problem: PatternProblem, *, count: int = 1, seconds: float = 30.0
    ) -> PatternResult:
        result = honest(solver, problem, count=count, seconds=seconds)
        turned = tuple(replace(pattern, stance=~pattern.stance) for pattern in result.patterns)
        return replace(result, patterns=turned)

    monkeypatch.setattr(PatternSolver, "solve", wrong)
    monkeypatch.setattr(patterns, "SAMPLES", (20,))
    monkeypatch.setattr(patterns, "LIMBS", (4,))
    rows = bench_patterns(count=2, many=0, small=0)
    assert [row["broken"] for row in rows[:2]] == [2, 2]


@pytest.mark.parametrize("legs", [4, 6, 12])
def test_random_states_come_from_gaits_that_stand(legs: int) -> None:
    random = np.random.default_rng(3)
    for _ in range(20):
        gait = random_gait(random, legs)
        assert gait.sum(axis=0).min() >= 3
        assert gait.any(axis=1).sum() >= 4
    kinds = {random_transition(random, legs, 20).walking.sum() for _ in range(40)}
    assert legs == 4 or len(kinds) > 1, "some limbs are locked"


def test_small_cases_are_of_every_sort() -> None:
    random = np.random.default_rng(4)
    cases = [random_small(random) for _ in range(60)]
    assert {case.kind.value for case in cases} == {"transition", "periodic"}
    assert {case.leg_count for case in cases} == {2, 3, 4, 5}
    assert any(case.drawing is not None for case in cases)
    assert any((case.fixed[case.walking][:, 1:-1] != FREE).any() for case in cases)
    assert any(case.rules.workload is None for case in cases)
