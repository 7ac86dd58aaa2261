"""The largest stability margin that a drawing allows: one quadratic program with the margin as unknown."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from core.problem.motion_problem import MotionProblem
from solver_jobs.live.assembly import TOLERANCE_MM, cost_terms, inner_rows, natural_linearisation
from solver_jobs.live.elastic import COST_WEIGHT
from solver_jobs.live.linearisation import MM
from solver_jobs.live.qp import QuadraticProgram, Solver, stacked
from solver_jobs.live.rows import Rows
from solver_jobs.nlp.constraint import Family

_solver = Solver()


def best_margin(problem: MotionProblem, sides: int) -> float | None:
    """The largest margin with the body at its natural height, m.

    Limits that are not linear (motors, room between shoes) are left out, so a motion with this margin is
    likely but not certain. Not thread-safe: all calls share one solver.

    Args:
        problem: the problem; the result is at most its own margin.
        sides: number of sides of the polygons inside discs.

    Returns:
        None if the drawing cannot walk with any margin, or the solver fails.
    """
    linearisation = natural_linearisation(problem.turned(-problem.quarter_turns))
    lack = linearisation.size
    rows = [_softened(one, lack) for one in inner_rows(linearisation, sides)]
    split = [one.split() for one in rows]
    if max(miss for _, miss in split) > TOLERANCE_MM:
        return None
    curvature, gradient = cost_terms(linearisation)
    qp = QuadraticProgram(
        np.append(COST_WEIGHT * curvature, COST_WEIGHT),
        np.append(COST_WEIGHT * gradient, 1.0),
        *stacked([kept for kept, _ in split]),
        np.append(np.full(lack, -np.inf), 0.0),
    )
    answer = _solver.solve_flat(qp)
    margin = problem.limits.margin - float(answer.x[lack]) / MM
    return margin if answer.solved and margin >= 0.0 else None


def _softened(rows: Rows, lack: int) -> Rows:
    """Rows whose required margin is reduced by the unknown `lack`, mm; rows of other families unchanged."""
    if rows.family is not Family.BODY_TORQUE:
        return rows
    # If the feet support only a line or a point, the rows are equations without a margin.
    asking = np.nonzero(np.isinf(rows.upper))[0]
    return replace(
        rows,
        row=np.append(rows.row, asking),
        column=np.append(rows.column, np.full(len(asking), lack)),
        value=np.append(rows.value, np.ones(len(asking))),
    )
