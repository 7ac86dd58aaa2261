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
    """To the worker: find changes of this gait that make it walk, until something else is asked.

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


Question = SolveLive | FindRemedies | FindLimit


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


class _Worker:
    """Answers questions; one that a long search has taken out of the pipe waits until that has ended."""

    def __init__(self, pipe: Connection) -> None:
        self._pipe = pipe
        self._waiting: deque[Question] = deque()

    def run(self) -> None:
        """Goes on until the parent's end of the pipe closes."""
        while True:
            self._reply(self._waiting.popleft() if self._waiting else self._pipe.recv())

    def _reply(self, message: Question) -> None:
        try:
            reply = Answered(message.number, self._answer(message))
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
        model = load_robot(message.gait.robot)
        if isinstance(message, FindLimit):
            return largest_value(message.gait, model, message.which, self._plans_first)
        number = message.number
        return find_remedies(
            message.gait,
            model,
            lambda: not self._pipe.poll(),
            lambda remedy: self._pipe.send(Found(number, remedy)),
            tips=message.tips,
        )

    def _plans_first(self) -> bool:
        """Answers the plans that were asked for meanwhile; false where another search was."""
        while self._pipe.poll():
            message = self._pipe.recv()
            if isinstance(message, SolveLive):
                self._reply(message)
            else:
                self._waiting.append(message)
        return not self._waiting
