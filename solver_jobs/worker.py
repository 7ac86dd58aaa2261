"""The worker process: one solve after the other, and no longer than its parent lives.

The solver is imported here and nowhere in the parent. Everything goes over one pipe; when the parent ends in
whatever way, its end of the pipe closes and the worker leaves at its next look.
"""

from __future__ import annotations

import signal
import traceback
from dataclasses import dataclass
from multiprocessing.connection import Connection

from core.motion_problem import MotionProblem
from solver_jobs.results import Iterate, MotionResult


@dataclass(frozen=True, eq=False)
class Work:
    """To the worker: solve this."""

    job: str
    problem: MotionProblem


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
    result: MotionResult


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
    # Ctrl-C in a terminal reaches the whole group; the parent decides when a worker ends.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    from solver_jobs.motion_nlp import solve_motion

    try:
        if warm_up is not None:
            solve_motion(warm_up, lambda iterate: not pipe.poll())
        while True:
            message = pipe.recv()
            if isinstance(message, Work):
                _solve(pipe, message)
    except (EOFError, ConnectionError):
        return


def _solve(pipe: Connection, work: Work) -> None:
    from solver_jobs.motion_nlp import solve_motion

    def progress(iterate: Iterate) -> bool:
        pipe.send(Progressed(work.job, iterate))
        while pipe.poll():
            message = pipe.recv()
            if isinstance(message, Stop) and message.job == work.job:
                return False
        return True

    try:
        pipe.send(Finished(work.job, solve_motion(work.problem, progress)))
    except (EOFError, ConnectionError):
        raise
    except Exception as error:
        pipe.send(Broke(work.job, f"{type(error).__name__}: {error}", traceback.format_exc()))
