"""The exact tier: the whole motion as one nonlinear programme, solved by IPOPT."""

from __future__ import annotations

from dataclasses import replace

from core.draft import initial_motion
from core.motion_problem import MotionProblem
from core.trajectory import Trajectory, turn_trajectory
from solver_jobs.assembly import box_of
from solver_jobs.constraint import situation_of
from solver_jobs.diagnosis import broken_pose, explanation, nearest_motion
from solver_jobs.obstacles import obstacles
from solver_jobs.results import Evidence, MotionResult, SolveStatus
from solver_jobs.search import Attempt, Progress, Search
from solver_jobs.structure import StructureCache

SUCCEEDED = "Solve_Succeeded"
STOPPED = "User_Requested_Stop"
INFEASIBLE = "Infeasible_Problem_Detected"
"""IPOPT's return statuses that mean something by themselves; every other one is a failure."""

_structures = StructureCache()


def solve_motion(problem: MotionProblem, progress: Progress = lambda iterate: True) -> MotionResult:
    """Solves a motion problem; not for several threads at once.

    Where IPOPT finds no motion, a second search finds the nearest one: balance, reach, body speed and margin
    may be missed there at a price. What it still misses is the explanation; if it misses nothing, its motion
    is where IPOPT starts again.

    Args:
        problem: what is asked.
        progress: told of each iteration in the calling thread; false cancels.

    Returns:
        The result; solved only where IPOPT says Solve_Succeeded for the problem as asked.
    """
    situation = situation_of(problem)
    blocking = obstacles(situation, box_of(situation))
    if blocking:
        # Feet are named here, so this looks at the problem in its own direction.
        return _ruled_out(blocking, initial_motion(problem), 0.0)
    turns = problem.quarter_turns
    result = _search(problem.turned(-turns), progress)
    return replace(
        result,
        trajectory=turn_trajectory(result.trajectory, turns),
        initial=turn_trajectory(result.initial, turns),
    )


def _search(problem: MotionProblem, progress: Progress) -> MotionResult:
    """Solves a problem of direction 1 that no bound rules out."""
    situation = situation_of(problem)
    initial = initial_motion(problem)
    box = box_of(situation)
    structure, build_seconds = _structures.get(problem)
    search = Search(situation, initial, box, progress)
    broken = search.broken_constants(structure)
    if broken:
        return _ruled_out(tuple(broken_pose(one) for one in broken), initial, build_seconds)
    attempt = search.attempt(structure, search.start)
    if attempt.word in (SUCCEEDED, STOPPED):
        return _ended(search, attempt, initial, build_seconds)
    elastic, elastic_seconds = _structures.get(problem, elastic=True)
    nearest = search.attempt(elastic, search.start)
    build_seconds += elastic_seconds
    if nearest.word == SUCCEEDED and not nearest.missed:
        return _ended(search, search.attempt(structure, nearest.vector), initial, build_seconds)
    if nearest.word == SUCCEEDED:
        return _nearest(search, attempt, nearest, initial, build_seconds)
    return _ended(search, nearest if nearest.word == STOPPED else attempt, initial, build_seconds)


def _ended(search: Search, attempt: Attempt, initial: Trajectory, build_seconds: float) -> MotionResult:
    """A result in the words of one attempt."""
    status = {
        SUCCEEDED: SolveStatus.SOLVED,
        STOPPED: SolveStatus.CANCELLED,
        INFEASIBLE: SolveStatus.INFEASIBLE,
    }.get(attempt.word, SolveStatus.FAILED)
    sentences: tuple[str, ...] = ()
    if status is SolveStatus.CANCELLED:
        sentences = (f"Cancelled after {search.iterates[-1].number} iterations.",)
    elif status is not SolveStatus.SOLVED:
        sentences = explanation(attempt.missed)
    unsolved = status in (SolveStatus.INFEASIBLE, SolveStatus.FAILED)
    return MotionResult(
        status=status,
        solver_word=attempt.word,
        explanation=sentences,
        evidence=Evidence.DIAGNOSED if unsolved else None,
        iterations=tuple(search.iterates),
        objective=attempt.cost,
        solve_seconds=search.seconds,
        build_seconds=build_seconds,
        trajectory=search.trajectory(attempt),
        initial=initial,
    )


def _nearest(
    search: Search, attempt: Attempt, nearest: Attempt, initial: Trajectory, build_seconds: float
) -> MotionResult:
    """Infeasible as far as a search can tell, with the nearest motion."""
    return MotionResult(
        status=SolveStatus.INFEASIBLE,
        solver_word=attempt.word,
        explanation=nearest_motion(nearest.missed),
        evidence=Evidence.DIAGNOSED,
        iterations=tuple(search.iterates),
        objective=nearest.cost,
        solve_seconds=search.seconds,
        build_seconds=build_seconds,
        trajectory=search.trajectory(nearest),
        initial=initial,
    )


def _ruled_out(sentences: tuple[str, ...], initial: Trajectory, build_seconds: float) -> MotionResult:
    """Proven infeasible before any search."""
    closing = "This is proven: no motion of the model can do it."
    return MotionResult(
        status=SolveStatus.INFEASIBLE,
        solver_word="",
        explanation=(*sentences, closing),
        evidence=Evidence.PROVEN,
        iterations=(),
        objective=None,
        solve_seconds=0.0,
        build_seconds=build_seconds,
        trajectory=initial,
        initial=initial,
    )
