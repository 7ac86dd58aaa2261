"""The command queue: one thread owns the studio's state and runs one command after the other.

Pages, jobs and robot put commands on the queue; only this thread changes state and publishes what changed.
The one exception is Stop, which goes straight to the bridge.
"""

import logging
import queue
import threading
from collections.abc import Callable
from concurrent.futures import Future
from dataclasses import dataclass
from typing import Any, TypeVar

logger = logging.getLogger(__name__)

Result = TypeVar("Result")


@dataclass(frozen=True, eq=False)
class Command:
    """Something to do on the command queue's thread, and where its result goes."""

    action: Callable[[], Any]
    future: Future[Any]


class CommandQueue:
    """The thread and its queue."""

    def __init__(self) -> None:
        self._commands: queue.SimpleQueue[Command | None] = queue.SimpleQueue()
        self._thread = threading.Thread(target=self._work, name="commands", daemon=True)
        self._thread.start()

    def submit(self, action: Callable[[], Result]) -> Future[Result]:
        """Puts a command on the queue.

        Returns:
            A future with what the command returns or raises; one that is cancelled in time is not done.
        """
        future: Future[Result] = Future()
        self._commands.put(Command(action, future))
        return future

    def tell(self, action: Callable[[], object]) -> None:
        """Puts a command on the queue whose failure nobody waits for; it is logged."""
        self.submit(action).add_done_callback(log_failure)

    def close(self) -> None:
        """Ends the thread after the commands that are already on the queue."""
        self._commands.put(None)
        self._thread.join(timeout=10)

    def _work(self) -> None:
        while (command := self._commands.get()) is not None:
            if not command.future.set_running_or_notify_cancel():
                continue
            try:
                result = command.action()
            except BaseException as error:  # it belongs to whoever waits for the result
                command.future.set_exception(error)
            else:
                command.future.set_result(result)


def log_failure(future: Future[Any]) -> None:
    """Writes into the log why a command failed whose result nobody waits for."""
    error = future.exception()
    if error is not None:
        logger.error("A background command failed.", exc_info=error)
