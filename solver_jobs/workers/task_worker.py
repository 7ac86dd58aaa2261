"""The worker's side of the task service: one task after the other, for as long as the parent lives."""

import traceback
from collections.abc import Callable
from dataclasses import dataclass
from multiprocessing.connection import Connection
from typing import Any

from core.errors import FootfallError

Report = Callable[[Any], bool]
"""Tells the parent what is known in the middle of a question; false where it wants an end."""


@dataclass(frozen=True, eq=False)
class Submit:
    """To the worker: do this task."""

    number: int
    task: Any


@dataclass(frozen=True)
class Cancel:
    """To the worker: end this task, with what is known or as cancelled."""

    number: int


@dataclass(frozen=True, eq=False)
class Progress:
    """From the worker: progress of a task."""

    number: int
    known: Any


@dataclass(frozen=True, eq=False)
class TaskResult:
    """From the worker: the result, or a refusal's sentence, or the text of a bug."""

    number: int
    result: Any
    refusal: FootfallError | None = None
    error: str = ""


def run_tasks(pipe: Connection, work: Callable[[Any, Report], Any]) -> None:
    """Runs tasks until the parent's end of the pipe closes.

    Args:
        pipe: the worker's end.
        work: makes the answer of a task; it calls its second argument often, where an end is noticed.
    """
    try:
        while True:
            message = pipe.recv()
            if isinstance(message, Submit):
                pipe.send(_answer(pipe, message, work))
    except (EOFError, ConnectionError):
        return


def _answer(pipe: Connection, ask: Submit, work: Callable[[Any, Report], Any]) -> TaskResult:
    try:
        return TaskResult(ask.number, work(ask.task, _reporter(pipe, ask.number)))
    except FootfallError as refusal:
        return TaskResult(ask.number, None, refusal)
    except Exception as error:
        # A bug in one answer must not end the process; the parent logs it and says so.
        return TaskResult(ask.number, None, error=f"{error!r}\n{traceback.format_exc()}")


def _reporter(pipe: Connection, number: int) -> Report:
    """Sends what is known and looks for an end; the parent sends nothing else in the middle of a question."""

    def report(known: Any) -> bool:
        try:
            pipe.send(Progress(number, known))
            while pipe.poll():
                message = pipe.recv()
                if isinstance(message, Cancel) and message.number == number:
                    return False
        except (EOFError, OSError):
            return False
        return True

    return report
