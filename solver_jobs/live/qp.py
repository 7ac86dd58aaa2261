"""The quadratic program: rows stacked, solved by PIQP through CasADi, with multipliers."""

import time
from collections import OrderedDict
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from casadi import DM, Function, Sparsity, conic

from core.arrays import Floats
from core.problem.initial_guess import Indices
from solver_jobs.live.rows import Rows

SOLVER = "piqp"
MOST_ITERATIONS = 30
"""Programs that have an answer took at most 20 in hundreds of random edits."""

MOST_ELASTIC_ITERATIONS = 150
"""The search for the nearest motion always has an answer and may take its time."""

ACCURACY = {"eps_abs": 1e-9, "eps_rel": 1e-10, "verbose": False}
"""The checker's tolerance is 1e-6 SI; 1e-9 mm leaves it far behind."""

CACHE = 24
"""Solvers kept, one a pattern of entries."""


@dataclass(frozen=True, eq=False)
class QuadraticProgram:
    """min ½ xᵀ diag(curvature) x + gradientᵀ x subject to lower ≤ A x ≤ upper and x ≥ least.

    Args:
        curvature: (v,) above or equal 0.
        gradient: (v,).
        row: (nnz,) row of each entry of A.
        column: (nnz,) unknown of each entry.
        value: (nnz,) entries.
        lower: (m,).
        upper: (m,).
        least: (v,) lower bounds of the unknowns.
    """

    curvature: Floats
    gradient: Floats
    row: Indices
    column: Indices
    value: Floats
    lower: Floats
    upper: Floats
    least: Floats


@dataclass(frozen=True, eq=False)
class QpResult:
    """The solver's result.

    Args:
        solved: whether it claims an optimum.
        word: its own status.
        x: (v,) unknowns.
        multipliers: (m,) of the rows, positive where the upper bound presses.
        seconds: in the solver.
    """

    solved: bool
    word: str
    x: Floats
    multipliers: Floats
    seconds: float


def stacked(rows: Sequence[Rows]) -> tuple[Indices, Indices, Floats, Floats, Floats]:
    """Entries and bounds of several families under each other."""
    first = np.cumsum([0] + [one.count for one in rows])
    return (
        np.concatenate([one.row + start for one, start in zip(rows, first[:-1], strict=True)]),
        np.concatenate([one.column for one in rows]),
        np.concatenate([one.value for one in rows]),
        np.concatenate([one.lower for one in rows]),
        np.concatenate([one.upper for one in rows]),
    )


class Solver:
    """Solves programs; solvers are kept by their pattern of entries. Not for several threads at once."""

    def __init__(self) -> None:
        self._known: OrderedDict[tuple[int, bytes], tuple[Function, Sparsity]] = OrderedDict()

    def solve(self, qp: QuadraticProgram, most_iterations: int = MOST_ITERATIONS) -> QpResult:
        """Solves one program."""
        size, count = len(qp.gradient), len(qp.lower)
        # CasADi holds matrices a column after the other.
        order = np.lexsort((qp.row, qp.column))
        row = qp.row[order]
        ends = np.searchsorted(qp.column[order], np.arange(size + 1))
        function, pattern = self._function(size, count, ends, row, most_iterations)
        begin = time.perf_counter()
        found = function(
            h=DM(Sparsity.diag(size), qp.curvature),
            g=qp.gradient,
            a=DM(pattern, qp.value[order]),
            lba=qp.lower,
            uba=qp.upper,
            lbx=qp.least,
            ubx=np.inf,
        )
        seconds = time.perf_counter() - begin
        stats = function.stats()
        return QpResult(
            bool(stats["success"]),
            str(stats["return_status"]),
            np.array(found["x"]).reshape(-1),
            np.array(found["lam_a"]).reshape(-1),
            seconds,
        )

    def _function(
        self, size: int, count: int, ends: Indices, row: Indices, most: int
    ) -> tuple[Function, Sparsity]:
        key = (most, np.concatenate([[size, count], ends, row]).astype(np.int32).tobytes())
        if key in self._known:
            self._known.move_to_end(key)
            return self._known[key]
        pattern = Sparsity(count, size, ends.tolist(), row.tolist())
        options: dict[str, Any] = {"error_on_fail": False, SOLVER: {**ACCURACY, "max_iter": most}}
        function = conic("live", SOLVER, {"h": Sparsity.diag(size), "a": pattern}, options)
        self._known[key] = (function, pattern)
        if len(self._known) > CACHE:
            self._known.popitem(last=False)
        return function, pattern
