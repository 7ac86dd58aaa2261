"""Tasks for a process that answers questions, quick to start: each task is a function that is run there."""

from __future__ import annotations

import threading
from collections.abc import Callable
from multiprocessing.connection import Connection
from typing import ClassVar

from core.errors import InputError, SimulationCancelledError
from solver_jobs.workers.task_service import Task, TaskService
from solver_jobs.workers.task_worker import Report, run_tasks

Errand = Callable[[Report], int]


class AskedErrand(Task[Errand, int, int]):
    """An errand; where it is cancelled and its process gives no answer, −1 comes of it."""

    grace: ClassVar[float] = 60.0

    def __init__(self, errand: Errand, progress: Callable[[int], object] = lambda known: None) -> None:
        super().__init__(errand, progress)

    def unanswered(self, seconds: float) -> int:
        """A number that no errand answers."""
        return -1


class HastyErrand(AskedErrand):
    """One whose process has a moment to end when it is asked to."""

    grace: ClassVar[float] = 0.05


class ShortErrand(AskedErrand):
    """One whose process has a moment to answer."""

    def latest(self, begun: float, heard: float) -> float:
        """A moment after its turn came."""
        return begun + 0.05


class Errands(TaskService[AskedErrand]):
    """The service over such a process."""

    def __init__(self) -> None:
        super().__init__("errand runner", run_errands)


def run_errands(pipe: Connection, warm_up: None) -> None:
    """Body of the process."""
    run_tasks(pipe, lambda errand, report: errand(report))


def seven(report: Report) -> int:
    """Answers at once."""
    report(3)
    return 7


def endless(report: Report) -> int:
    """Counts until it is ended, and answers how far it came."""
    count, pace = 0, threading.Event()
    while report(count):
        count += 1
        pace.wait(0.002)
    return count


def silent(report: Report) -> int:
    """Never tells or answers anything."""
    threading.Event().wait()
    return 0


def deaf(report: Report) -> int:
    """Tells once, and never looks for an end."""
    report(1)
    return silent(report)


def refused(report: Report) -> int:
    """Is refused with a sentence."""
    raise InputError("There is no errand. Give one.", "errand")


def cancelled(report: Report) -> int:
    """Counts until it is ended, and then has no answer."""
    endless(report)
    raise SimulationCancelledError("The errand was cancelled.")


def broken(report: Report) -> int:
    """Has a bug."""
    raise ZeroDivisionError("by nothing")
