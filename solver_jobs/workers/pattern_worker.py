"""The pattern solver's own process.

OR-Tools is imported here and nowhere in the parent, because it cannot live in one process with HiGHS.
"""

from dataclasses import dataclass
from multiprocessing.connection import Connection

import numpy as np

from core.patterns.problem import PatternKind, PatternProblem, PatternResult, index_halves, transition_cells
from solver_jobs.workers.task_worker import Report, run_tasks


@dataclass(frozen=True, eq=False)
class Find:
    """What is sought.

    Args:
        problem: the rules.
        count: how many different patterns, the best first.
        seconds: longest search.
    """

    problem: PatternProblem
    count: int
    seconds: float


def run_pattern_worker(pipe: Connection, warm_up: PatternProblem | None) -> None:
    """Body of the process.

    Args:
        pipe: the worker's end.
        warm_up: solved before anything is asked, so that everything is loaded; None for a small one.
    """
    from solver_jobs.patterns.solve import solve_pattern

    def found(find: Find, report: Report) -> PatternResult:
        return solve_pattern(find.problem, count=find.count, seconds=find.seconds, progress=report)

    solve_pattern(warm_up or small_problem())
    run_tasks(pipe, found)


def small_problem() -> PatternProblem:
    """A transition of four standing limbs, solved in milliseconds."""
    standing, walking = np.ones(4, dtype=np.bool_), np.ones(4, dtype=np.bool_)
    cells = transition_cells(standing, standing, 12, ~walking)
    return PatternProblem(PatternKind.TRANSITION, cells, walking, index_halves(4))
