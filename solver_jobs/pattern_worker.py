"""The pattern solver's own process: one search after the other.

OR-Tools is imported here and nowhere in the parent, because it cannot live in one process with HiGHS. When
the parent ends, its end of the pipe closes and the worker leaves.
"""

from __future__ import annotations

import signal
import traceback
from collections.abc import Callable
from dataclasses import dataclass
from multiprocessing.connection import Connection

import numpy as np

from core.patterns.problem import (
    PatternKind,
    PatternProblem,
    PatternProgress,
    PatternResult,
    index_halves,
    transition_cells,
)


@dataclass(frozen=True, eq=False)
class Find:
    """To the worker: search for this."""

    number: int
    problem: PatternProblem
    count: int
    seconds: float


@dataclass(frozen=True)
class Halt:
    """To the worker: end this search with what is known."""

    number: int


@dataclass(frozen=True, eq=False)
class Known:
    """From the worker: what is known in the middle of a search."""

    number: int
    progress: PatternProgress


@dataclass(frozen=True, eq=False)
class Found:
    """From the worker: how the search came out, or the text of a bug."""

    number: int
    result: PatternResult | None
    error: str = ""


def run_pattern_worker(pipe: Connection, warm_up: PatternProblem | None) -> None:
    """Body of the process.

    Args:
        pipe: the worker's end.
        warm_up: solved before anything is asked, so that everything is loaded; None for a small one.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    from solver_jobs.patterns.solve import solve_pattern

    solve_pattern(warm_up or small_problem())
    try:
        while True:
            message = pipe.recv()
            if not isinstance(message, Find):
                continue
            try:
                result = solve_pattern(
                    message.problem,
                    count=message.count,
                    seconds=message.seconds,
                    progress=_reporter(pipe, message.number),
                )
                reply = Found(message.number, result)
            except Exception as error:
                # A bug in one answer must not end the process; the parent logs it and says so.
                reply = Found(message.number, None, f"{error!r}\n{traceback.format_exc()}")
            pipe.send(reply)
    except (EOFError, ConnectionError):
        return


def small_problem() -> PatternProblem:
    """A transition of four standing limbs, solved in milliseconds."""
    standing, walking = np.ones(4, dtype=np.bool_), np.ones(4, dtype=np.bool_)
    cells = transition_cells(standing, standing, 12, ~walking)
    return PatternProblem(PatternKind.TRANSITION, cells, walking, index_halves(4))


def _reporter(pipe: Connection, number: int) -> Callable[[PatternProgress], bool]:
    """Sends what is known and looks for an end; the parent sends nothing else in the middle of a search."""

    def report(progress: PatternProgress) -> bool:
        try:
            pipe.send(Known(number, progress))
            while pipe.poll():
                message = pipe.recv()
                if isinstance(message, Halt) and message.number == number:
                    return False
        except (EOFError, OSError):
            return False
        return True

    return report
