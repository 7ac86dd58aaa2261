"""The live tier's own process: one answer after the other.

The solver is imported here and nowhere in the parent; when the parent ends, its end of the pipe closes and
the worker leaves.
"""

import traceback
from collections import deque
from dataclasses import dataclass
from multiprocessing.connection import Connection
from typing import Any

from core.gait.gait import Gait
from core.problem.motion_problem import MotionProblem
from solver_jobs.remedies.limit import Limit
from solver_jobs.remedies.remedy import Remedy


@dataclass(frozen=True, eq=False)
class SolveLive:
    """To the worker: solve this."""

    number: int
    problem: MotionProblem


@dataclass(frozen=True, eq=False)
class FindRemedies:
    """To the worker: find changes of this gait that make it walk; plans come before it.

    Args:
        number: of the question.
        gait: one without a motion, or one that tips.
        tips: whether it has a motion and tips in physics.
    """

    number: int
    gait: Gait
    tips: bool = False


@dataclass(frozen=True, eq=False)
class Found:
    """From the worker: a remedy, while the search goes on."""

    number: int
    remedy: Remedy


@dataclass(frozen=True, eq=False)
class FindLimit:
    """To the worker: find how far one number of this gait can go; plans come before it.

    Args:
        number: of the question.
        gait: a drawing.
        which: the number.
    """

    number: int
    gait: Gait
    which: Limit


@dataclass(frozen=True, eq=False)
class EndSearch:
    """To the worker: answer this search with what was found.

    Args:
        number: of the search.
    """

    number: int


Search = FindRemedies | FindLimit
Question = SolveLive | Search


@dataclass(frozen=True, eq=False)
class Answered:
    """From the worker: a result, or the text of a bug."""

    number: int
    value: Any
    error: str = ""


def run_live_worker(pipe: Connection, warm_up: MotionProblem | None) -> None:
    """Body of the process.

    Args:
        pipe: the worker's end.
        warm_up: solved before anything is asked, so that everything is loaded.
    """
    from solver_jobs.live.solve import solve_live

    try:
        if warm_up is not None:
            solve_live(warm_up)
        _Worker(pipe).run()
    except (EOFError, ConnectionError):
        return


class _PutOffError(Exception):
    """A limit that waits until remedies are found."""


class _Worker:
    """Answers plans at once, also while it searches; searches one after the other.

    Remedies come before limits, which begin anew after them: whoever waits for a remedy has a gait that
    cannot walk, and a limit is often of the edit that led there.
    """

    def __init__(self, pipe: Connection) -> None:
        self._pipe = pipe
        self._waiting: deque[Search] = deque()
        self._ended: set[int] = set()

    def run(self) -> None:
        """Goes on until the parent's end of the pipe closes."""
        while True:
            while not self._waiting or self._pipe.poll():
                self._receive()
            search = next(filter(_is_first, self._waiting), self._waiting[0])
            self._waiting.remove(search)
            try:
                self._reply(search)
            except _PutOffError:
                self._waiting.append(search)
            else:
                self._ended.discard(search.number)

    def _receive(self) -> None:
        message: Question | EndSearch = self._pipe.recv()
        match message:
            case SolveLive():
                self._reply(message)
            case EndSearch(number):
                self._ended.add(number)
            case _:
                self._waiting.append(message)

    def _reply(self, message: Question) -> None:
        try:
            reply = Answered(message.number, self._answer(message))
        except _PutOffError:
            raise
        except Exception as error:
            # A bug in one answer must not end the process; the parent logs it and says so.
            reply = Answered(message.number, None, f"{error!r}\n{traceback.format_exc()}")
        self._pipe.send(reply)

    def _answer(self, message: Question) -> Any:
        from core.robot.model import load_robot
        from solver_jobs.live.solve import solve_live
        from solver_jobs.remedies.limit import largest_value
        from solver_jobs.remedies.search import find_remedies

        if isinstance(message, SolveLive):
            return solve_live(message.problem)
        model, number = load_robot(message.gait.robot), message.number

        def go_on() -> bool:
            while self._pipe.poll():
                self._receive()
            if isinstance(message, FindLimit) and any(map(_is_first, self._waiting)):
                raise _PutOffError
            return number not in self._ended

        if isinstance(message, FindLimit):
            return largest_value(message.gait, model, message.which, go_on)
        return find_remedies(
            message.gait,
            model,
            go_on,
            lambda remedy: self._pipe.send(Found(number, remedy)),
            tips=message.tips,
        )


def _is_first(search: Search) -> bool:
    return isinstance(search, FindRemedies)
