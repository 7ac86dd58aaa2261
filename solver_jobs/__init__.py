"""What is computed: optimisation problems, solvers and the worker processes that run them.

This is the public face. Importing it loads no solver; `solve_motion` loads it when it is called.
"""

from __future__ import annotations

from collections.abc import Callable

from core.motion_problem import MotionProblem
from solver_jobs.jobs import OPEN_STATES, Job, JobKind, JobState, result_sentence
from solver_jobs.results import Evidence, Iterate, MotionResult, SolveStatus
from solver_jobs.runner import JobRunner

__all__ = [
    "OPEN_STATES",
    "Evidence",
    "Iterate",
    "Job",
    "JobKind",
    "JobRunner",
    "JobState",
    "MotionResult",
    "SolveStatus",
    "result_sentence",
    "solve_motion",
]


def solve_motion(
    problem: MotionProblem, progress: Callable[[Iterate], bool] = lambda iterate: True
) -> MotionResult:
    """Solves a motion problem in this process; not for several threads at once.

    Args:
        problem: what is asked.
        progress: told of each iteration; false cancels.
    """
    from solver_jobs.motion_nlp import solve_motion as solve

    return solve(problem, progress)
