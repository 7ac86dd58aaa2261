"""The live tier's own process: one answer after the other.

The solver is imported here and nowhere in the parent; when the parent ends, its end of the pipe closes and
the worker leaves.
"""

import traceback
from dataclasses import dataclass
from multiprocessing.connection import Connection
from typing import Any

from core.gait.gait import Gait
from core.problem.motion_problem import MotionProblem
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
    from core.robot.model import load_robot
    from solver_jobs.live.solve import solve_live
    from solver_jobs.remedies.search import find_remedies

    def answer(message: SolveLive | FindRemedies) -> Any:
        if isinstance(message, SolveLive):
            return solve_live(message.problem)
        model = load_robot(message.gait.robot)
        return find_remedies(
            message.gait,
            model,
            lambda: not pipe.poll(),
            lambda remedy: pipe.send(Found(message.number, remedy)),
            tips=message.tips,
        )

    try:
        if warm_up is not None:
            solve_live(warm_up)
        while True:
            message = pipe.recv()
            try:
                reply = Answered(message.number, answer(message))
            except Exception as error:
                # A bug in one answer must not end the process; the parent logs it and says so.
                reply = Answered(message.number, None, f"{error!r}\n{traceback.format_exc()}")
            pipe.send(reply)
    except (EOFError, ConnectionError):
        return
