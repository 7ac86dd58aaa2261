"""The largest stability margin that a drawing allows, by one program in which the margin is an unknown."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from core.problem.motion_problem import MotionProblem
from solver_jobs.live.assembly import TOLERANCE_MM, cost_terms, inner_rows, natural_linearisation
from solver_jobs.live.elastic import COST_WEIGHT
from solver_jobs.live.linearisation import MM
from solver_jobs.live.qp import MOST_ELASTIC_ITERATIONS, QuadraticProgram, Solver, stacked
from solver_jobs.live.rows import Rows
from solver_jobs.nlp.constraint import Family

_solver = Solver()


def best_margin(problem: MotionProblem, sides: int) -> float | None:
    """The largest margin with the body at its natural height, m; not for several threads at once.

    Limits that are not linear (motors, room between shoes) have no part, so a motion with this margin is
    likely, not certain.

    Args:
        problem: its own margin is the most that is looked for.
        sides: of the polygons inside discs.

    Returns:
        None where the drawing cannot walk with any margin, or the solver has no answer.
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
    answer = _solver.solve(qp, MOST_ELASTIC_ITERATIONS)
    margin = problem.limits.margin - float(answer.x[lack]) / MM
    return margin if answer.solved and margin >= 0.0 else None


def _softened(rows: Rows, lack: int) -> Rows:
    """Rows that ask for the margin, asking for less by the unknown `lack`, mm; other rows unchanged."""
    if rows.family is not Family.BODY_TORQUE:
        return rows
    # Where the robot stands on a line or a point, rows are equations and know no margin.
    asking = np.nonzero(np.isinf(rows.upper))[0]
    return replace(
        rows,
        row=np.append(rows.row, asking),
        column=np.append(rows.column, np.full(len(asking), lack)),
        value=np.append(rows.value, np.ones(len(asking))),
    )
