"""The quadratic program: rows stacked, solved by PIQP through CasADi, with multipliers."""

import time
from collections import OrderedDict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from casadi import DM, Function, Sparsity, conic

from core.arrays import Floats
from core.problem.initial_guess import Indices
from solver_jobs.live.rows import Rows

SOLVER = "piqp"
ACCURACY = {"eps_abs": 1e-9, "eps_rel": 1e-10, "verbose": False, "max_iter": 30}
"""The checker's tolerance is 1e-6 SI; 1e-9 mm leaves it far behind. Programs that have an answer took at most
20 iterations in hundreds of random edits."""

LONG = {**ACCURACY, "max_iter": 150}
"""The search for the nearest motion always has an answer and may take its time."""

FLAT = {**LONG, "eps_duality_gap_abs": 1e-9, "eps_duality_gap_rel": 1e-12}
"""For programs of small curvatures: a duality gap g leaves an unknown of curvature c off by up to √(2 g / c).
PIQP's own gaps are 1e-8 and 1e-9 of the cost."""

FLAT_SCALE = 10.0
"""Factor on the whole cost of a flat program, so that the accuracy above counts for it. With data that
differ by 1e-12 of themselves, the nearest motions of 197 drawings differed by up to 0.017 mm without factor
and gaps, and by 0.0004 mm with them. With 1000, 4 of 394 searches ended in rounding, without an answer."""

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

    def solve(self, qp: QuadraticProgram) -> QpResult:
        """Solves one program."""
        return self._solve(qp, ACCURACY)

    def solve_flat(self, qp: QuadraticProgram) -> QpResult:
        """Solves a program of small curvatures (`FLAT`), or once more less accurately where that fails."""
        scaled = replace(qp, curvature=FLAT_SCALE * qp.curvature, gradient=FLAT_SCALE * qp.gradient)
        answer = self._solve(scaled, FLAT)
        if answer.solved:
            return replace(answer, multipliers=answer.multipliers / FLAT_SCALE)
        return self._solve(qp, LONG)

    def _solve(self, qp: QuadraticProgram, settings: Mapping[str, Any]) -> QpResult:
        size, count = len(qp.gradient), len(qp.lower)
        # CasADi holds matrices a column after the other.
        order = np.lexsort((qp.row, qp.column))
        row = qp.row[order]
        ends = np.searchsorted(qp.column[order], np.arange(size + 1))
        function, pattern = self._function(size, count, ends, row, settings)
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
        self, size: int, count: int, ends: Indices, row: Indices, settings: Mapping[str, Any]
    ) -> tuple[Function, Sparsity]:
        key = (id(settings), np.concatenate([[size, count], ends, row]).astype(np.int32).tobytes())
        if key in self._known:
            self._known.move_to_end(key)
            return self._known[key]
        pattern = Sparsity(count, size, ends.tolist(), row.tolist())
        options: dict[str, Any] = {"error_on_fail": False, SOLVER: dict(settings)}
        function = conic("live", SOLVER, {"h": Sparsity.diag(size), "a": pattern}, options)
        self._known[key] = (function, pattern)
        if len(self._known) > CACHE:
            self._known.popitem(last=False)
        return function, pattern
