"""The words of `--method` and what they mean."""

from __future__ import annotations

from collections.abc import Callable
from enum import StrEnum

from core.problem.motion_problem import MotionProblem
from solver_jobs import MotionResult, solve_exact, solve_live


class Method(StrEnum):
    """Which tier gives the answer."""

    LIVE = "live"
    NLP = "nlp"


SOLVERS: dict[Method, Callable[[MotionProblem], MotionResult]] = {
    Method.LIVE: solve_live,
    Method.NLP: solve_exact,
}
"""How each method solves a problem in this process."""
