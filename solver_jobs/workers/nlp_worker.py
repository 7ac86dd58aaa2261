"""The exact tier's worker process: one solve after the other, for as long as the parent lives.

The solver is imported here and nowhere in the parent. Everything goes over one pipe; when the parent ends in
whatever way, its end of the pipe closes and the worker leaves at its next look.
"""

import traceback
from collections.abc import Callable
from dataclasses import dataclass
from multiprocessing.connection import Connection

from core.problem.motion_problem import MotionProblem
from solver_jobs.nlp.timing import TimingResult, fastest_timing
from solver_jobs.results.motion import Iterate, MotionResult, SolveStatus
from solver_jobs.workers.job import JobKind


@dataclass(frozen=True, eq=False)
class Work:
    """To the worker: solve this."""

    job: str
    problem: MotionProblem
    kind: JobKind = JobKind.MOTION


@dataclass(frozen=True)
class Stop:
    """To the worker: end this job at the next iteration."""

    job: str


@dataclass(frozen=True)
class Progressed:
    """From the worker: an iteration."""

    job: str
    iterate: Iterate


@dataclass(frozen=True, eq=False)
class Finished:
    """From the worker: the result."""

    job: str
    result: MotionResult | TimingResult


@dataclass(frozen=True)
class Broke:
    """From the worker: a bug; the worker goes on."""

    job: str
    error: str
    details: str


def run_worker(pipe: Connection, warm_up: MotionProblem | None) -> None:
    """Body of the worker process.

    Args:
        pipe: the worker's end.
        warm_up: solved once before any work, so that the first job finds everything loaded and built.
    """
    from solver_jobs.tiers.exact_from_live import solve_exact

    try:
        if warm_up is not None:
            solve_exact(warm_up, lambda iterate: not pipe.poll(), resume=True)
        while True:
            message = pipe.recv()
            if isinstance(message, Work):
                _solve(pipe, message)
    except (EOFError, ConnectionError):
        return


def _solve(pipe: Connection, work: Work) -> None:
    from solver_jobs.tiers.exact_from_live import solve_exact

    def progress(iterate: Iterate) -> bool:
        pipe.send(Progressed(work.job, iterate))
        while pipe.poll():
            message = pipe.recv()
            if isinstance(message, Stop) and message.job == work.job:
                return False
        return True

    try:
        if work.kind is JobKind.TIMING:
            pipe.send(Finished(work.job, _timed(work.problem, progress)))
        else:
            pipe.send(Finished(work.job, solve_exact(work.problem, progress, resume=True)))
    except (EOFError, ConnectionError):
        raise
    except Exception as error:
        pipe.send(Broke(work.job, f"{type(error).__name__}: {error}", traceback.format_exc()))


def _timed(problem: MotionProblem, progress: Callable[[Iterate], bool]) -> TimingResult:
    from solver_jobs.tiers.timing_use import made_usable

    timing = fastest_timing(problem, progress=progress)
    return made_usable(timing, progress) if timing.status is SolveStatus.SOLVED else timing
