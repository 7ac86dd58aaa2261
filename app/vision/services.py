"""The vision processes, and how to submit tasks to them."""

import logging
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from app.vision.worker import VisionRequest, run_picture_worker
from core.errors import FootfallError, StateError
from core.running_time import wait_within
from solver_jobs import Task, TaskService

_log = logging.getLogger(__name__)


class VisionTask(Task[VisionRequest, float, Any]):
    """A question about pictures.

    Args:
        task: what is asked.
        progress: told the share that is done.
        done: told the answer, from a thread of the service's; None where somebody waits for it.
        failed: told why there is none.
    """

    def __init__(
        self,
        task: VisionRequest,
        progress: Callable[[float], object] = lambda share: None,
        done: Callable[[Any], object] = lambda answer: None,
        failed: Callable[[FootfallError], object] = lambda error: None,
    ) -> None:
        super().__init__(task, progress)
        self._done, self._failed = done, failed

    def unanswered(self, seconds: float) -> Any:
        """Nothing comes of a look that was cancelled."""
        raise StateError("It was cancelled.")

    def answer(self, result: Any) -> None:
        """Ends the wait; where what is to be done with the answer fails, the service says so by `fail`."""
        self._done(result)
        super().answer(result)

    def fail(self, error: FootfallError) -> None:
        """Ends the wait with a sentence."""
        super().fail(error)
        try:
            self._failed(error)
        except Exception:
            # The service's thread must live on for the questions that follow.
            _log.exception("It could not be kept that there is no answer: %s", error)


@dataclass(frozen=True)
class VisionServices:
    """One process each for requests that a person waits for, for checkerboards, and for tracking.

    Each starts with its first task.
    """

    interactive: TaskService[VisionTask]
    checkerboards: TaskService[VisionTask]
    tracker: TaskService[VisionTask]

    def close(self) -> None:
        """Ends the processes and whatever waits for them."""
        for service in (self.interactive, self.checkerboards, self.tracker):
            service.close()


def ask(service: TaskService[VisionTask], task: VisionRequest, seconds: float) -> Any:
    """The answer to a question about pictures.

    Args:
        service: which process answers.
        task: what is asked.
        seconds: longest wait.

    Raises:
        FootfallError: it was refused.
        StateError: the answer does not come in time; the question is ended.
    """
    look = service.ask(VisionTask(task))
    try:
        return wait_within(look.result, seconds, time.monotonic)
    except TimeoutError:
        look.cancel()
        raise StateError(
            f"The pictures could not be read within {seconds:.0f} s: the computer is busy. Try again.",
            "picture",
        ) from None


def open_vision_services() -> VisionServices:
    """The processes, none started yet."""
    return VisionServices(
        TaskService("picture reader", run_picture_worker),
        TaskService("checkerboard finder", run_picture_worker),
        TaskService("video tracker", run_picture_worker),
    )
