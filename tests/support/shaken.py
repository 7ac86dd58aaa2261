"""What another processor changes: the last digits of a program's numbers, and the order of its rows."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from typing import Any

import numpy as np

from core.arrays import Floats
from solver_jobs.live import best_margin, solve
from solver_jobs.live.qp import QpResult, QuadraticProgram, Solver

SHARE = 1e-12
"""Every number is off by this share of itself (standard deviation); processors differ by 1e-16 to 1e-13."""
NOISE = 1e-9
"""What a motion is solved to, m."""


class ShakenSolver(Solver):
    """Solves each program with its numbers off by `SHARE`, and its rows in another order.

    Args:
        seed: of the noise.
    """

    def __init__(self, seed: int) -> None:
        super().__init__()
        self._random = np.random.default_rng(seed)

    def _off(self, values: Floats) -> Floats:
        return np.asarray(values * (1.0 + SHARE * self._random.standard_normal(values.shape)))

    def _solve(self, qp: QuadraticProgram, settings: Mapping[str, Any]) -> QpResult:
        upper = self._off(qp.upper)
        # Equations stay equations.
        lower = np.where(qp.lower == qp.upper, upper, self._off(qp.lower))
        order = self._random.permutation(len(upper))
        place = np.argsort(order)
        other = replace(
            qp,
            gradient=self._off(qp.gradient),
            row=place[qp.row],
            value=self._off(qp.value),
            lower=lower[order],
            upper=upper[order],
        )
        answer = super()._solve(other, settings)
        return replace(answer, multipliers=answer.multipliers[place])


@contextmanager
def shaken(seed: int = 0) -> Iterator[None]:
    """The live tier with a `ShakenSolver`.

    Args:
        seed: of the noise.
    """
    before = solve._solver, best_margin._solver
    solve._solver = best_margin._solver = ShakenSolver(seed)
    try:
        yield
    finally:
        solve._solver, best_margin._solver = before
