"""Solves an infeasible problem with slack: the least total violation, and a proof that it is not 0."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from core.arrays import Floats
from solver_jobs.live.assembly import cost_terms
from solver_jobs.live.linearisation import Linearisation, ranges
from solver_jobs.live.qp import QpResult, QuadraticProgram, Solver, stacked
from solver_jobs.live.rows import NOBODY, Rows
from solver_jobs.nlp.constraint import Family

COST_WEIGHT = 1e-5
"""Weight of the motion's cost beside the sum of all misses; it makes the answer unique and quick to find."""

PROOF_MM = 0.02
"""A total miss that is proven to be at least this large counts as a proof; the checker overlooks less."""


@dataclass(frozen=True, eq=False)
class Nearest:
    """The motion that misses its limits by the least total.

    Args:
        x: its unknowns.
        misses: for each family of rows, the miss of each of its groups, in its unit.
        total: sum of all misses, mm.
        proven: lower bound of that sum for any motion within speed limits and footholds, mm; above 0 none
            keeps every row.
        answer: the solver's.
    """

    x: Floats
    misses: tuple[Floats, ...]
    total: float
    proven: float
    answer: QpResult


def nearest(solver: Solver, linearisation: Linearisation, rows: Sequence[Rows]) -> Nearest | None:
    """Finds the least total miss; None where the solver gives no answer.

    Every group of rows may miss its bounds by one amount s ≥ 0: lower − s ≤ A x ≤ upper + s, minimise Σ w s,
    where w is 1 for mm and the knots' interval for mm/s.

    Args:
        solver: to be used.
        linearisation: the known part.
        rows: every family; equations of motion stay exact.
    """
    size = linearisation.size
    qp, offsets = _elastic(cost_terms(linearisation), rows, float(linearisation.intervals.mean()))
    answer = solver.solve_flat(qp)
    if not answer.solved:
        return None
    misses = np.maximum(answer.x[size:], 0.0)
    split = tuple(misses[first - size : last - size] for first, last in pairwise(offsets))
    total = float(qp.gradient[size:] @ misses)
    return Nearest(answer.x[:size], split, total, _bound(qp, answer, *ranges(linearisation)), answer)


def _elastic(
    cost: tuple[Floats, Floats], rows: Sequence[Rows], interval: float
) -> tuple[QuadraticProgram, list[int]]:
    """The program with misses behind the unknowns, and where each family's misses begin and end."""
    size = len(cost[0])
    offsets = [size]
    halves, soft_column, weights = [], [], []
    for one in rows:
        misses = _group_count(one)
        for half in _halves(one):
            halves.append(half)
            soft_column.append(np.where(half.group == NOBODY, -1, offsets[-1] + half.group))
        weights.append(np.full(misses, interval if one.unit == "mm/s" else 1.0))
        offsets.append(offsets[-1] + misses)
    row, column, value, lower, upper = stacked(halves)
    columns = np.concatenate(soft_column)
    soft = np.nonzero(columns >= 0)[0]
    weight = np.concatenate(weights)
    qp = QuadraticProgram(
        np.concatenate([COST_WEIGHT * cost[0], np.full(len(weight), COST_WEIGHT)]),
        np.concatenate([COST_WEIGHT * cost[1], weight]),
        np.concatenate([row, soft]),
        np.concatenate([column, columns[soft]]),
        np.concatenate([value, np.full(len(soft), -1.0)]),
        lower,
        upper,
        np.concatenate([np.full(size, -np.inf), np.zeros(len(weight))]),
    )
    return qp, offsets


def _halves(one: Rows) -> list[Rows]:
    """The same rows with an upper bound only; equations of motion stay as they are."""
    if one.family is Family.DYNAMICS:
        return [one] if one.count else []
    return [half for half in (_half(one, 1.0), _half(one, -1.0)) if half.count]


def _half(one: Rows, sign: float) -> Rows:
    bound = one.upper if sign > 0 else -one.lower
    kept = np.isfinite(bound)
    number = np.cumsum(kept) - 1
    entries = kept[one.row]
    return Rows(
        one.family,
        one.unit,
        number[one.row[entries]],
        one.column[entries],
        sign * one.value[entries],
        np.full(int(kept.sum()), -np.inf),
        bound[kept],
        one.knot[kept],
        one.feet[kept],
        one.group[kept],
    )


def _group_count(one: Rows) -> int:
    """Misses of a family; rows that must be kept have none."""
    return int(one.group.max(initial=NOBODY)) + 1


def _bound(qp: QuadraticProgram, answer: QpResult, centre: Floats, reach: Floats) -> float:
    """A lower bound of the total miss by weak duality, whatever the solver's accuracy.

    With multipliers y ≥ 0 of the upper bounds, scaled so that no group's sum exceeds its weight, and z of the
    equations, every motion has Σ w s ≥ −(bᵀy + fᵀz) + rᵀx, where r = Aᵀy + Eᵀz is nearly 0.

    Args:
        qp: the program.
        answer: of the solver.
        centre: (size,) middle of what each unknown of a motion can be.
        reach: (size,) how far from there it can be.
    """
    size = len(centre)
    equation = qp.lower == qp.upper
    y = np.where(equation, answer.multipliers, np.maximum(answer.multipliers, 0.0))
    sums = np.zeros(len(qp.gradient))
    np.add.at(sums, qp.column, qp.value * y[qp.row])
    pressure = -sums[size:]
    excess = float((pressure / qp.gradient[size:]).max(initial=1.0))
    remainder = sums[:size] @ centre - np.abs(sums[:size]) @ reach
    bounds = np.where(y != 0, qp.upper, 0.0)
    return float((-(bounds @ y) + remainder) / max(excess, 1.0))
