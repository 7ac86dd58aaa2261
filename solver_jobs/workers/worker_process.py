"""One worker process, as its parent drives it."""

import threading
import time
from collections.abc import Callable
from multiprocessing.connection import Connection
from multiprocessing.process import BaseProcess
from typing import Any

from solver_jobs.workers.core_wait import CoreWait
from solver_jobs.workers.nlp_worker import run_worker
from solver_jobs.workers.spawning import NICENESS, start_process
from solver_jobs.workers.worker_pipe import JOIN_SECONDS, PipeClosedError, WorkerPipe

POLL_SECONDS = 0.02
"""How soon a wish to end is noticed."""
EXIT_SECONDS = 1.0
"""How long a process may live on that has closed its pipe."""
SILENCE_SECONDS = 120.0
"""A worker that sends nothing for so long hangs; time in which it waits for a core does not count."""


def hung_sentence(name: str, seconds: float, remedy: str) -> str:
    """The end of a worker that hung, in a sentence for a person.

    Args:
        name: of what hung, as in a sentence.
        seconds: how long it gave no sign of life.
        remedy: what to do.
    """
    return f"The {name} gave no sign of life for {seconds:.0f} s and was ended. {remedy}"


class WorkerEndedError(Exception):
    """The worker process is gone; the text says how it ended."""


class WorkerProcess:
    """Starts, feeds, reads and ends one worker. For one thread; `send` and `kill` may come from others.

    Nothing waits for a worker that hangs: `send` returns at once, and `receive` in time.

    Args:
        warm_up: what the worker solves ahead; None for nothing.
        body: what the process runs, given its end of the pipe and `warm_up`.
        name: of the process.
        niceness: how far it stands back where cores are scarce.
    """

    def __init__(
        self,
        warm_up: Any,
        body: Callable[[Connection, Any], None] = run_worker,
        name: str = "footfall-solver",
        niceness: int = NICENESS,
    ) -> None:
        self._warm_up = warm_up
        self._body = body
        self._name = name
        self._niceness = niceness
        self._process: BaseProcess | None = None
        self._pipe: WorkerPipe | None = None
        self._lock = threading.Lock()
        self._core_wait: CoreWait | None = None
        self._waited = 0.0

    @property
    def process_id(self) -> int | None:
        """The process's number, or None where none runs."""
        process = self._process
        return process.pid if process is not None and process.is_alive() else None

    def ensure_started(self) -> None:
        """Starts a process where none lives; it imports the solver by itself."""
        if self.process_id is not None:
            return
        self.kill()
        process, ours = start_process(self._body, self._warm_up, self._name, self._niceness)
        self._process, self._pipe = process, WorkerPipe(ours, self._name)
        self._core_wait = CoreWait(process.pid or 0)

    def clock(self) -> float:
        """Seconds without those in which the worker waited for a core."""
        core_wait = self._core_wait
        return time.monotonic() - self._waited - (core_wait.look() if core_wait is not None else 0.0)

    def send(self, message: object) -> None:
        """Begins to send a message.

        Raises:
            WorkerEndedError: the process was ended; `receive` tells of one that ended by itself.
        """
        self._open_pipe().send(message)

    def receive(self, timeout: float | None = None) -> Any:
        """The next message, or None when none came within `timeout` seconds.

        Raises:
            WorkerEndedError: the process is gone, or does not keep to the protocol and was ended.
        """
        try:
            return self._open_pipe().receive(timeout)
        except PipeClosedError as closed:
            raise self._ended(str(closed)) from closed

    def kill(self) -> None:
        """Ends the process at once, also one that is stopped, and waits until it is gone."""
        with self._lock:
            process, pipe, core_wait = self._process, self._pipe, self._core_wait
            self._process = self._pipe = self._core_wait = None
            if core_wait is not None:
                self._waited += core_wait.look()
        if process is not None:
            process.kill()
            process.join(JOIN_SECONDS)
        if pipe is not None:
            pipe.close()

    def _open_pipe(self) -> WorkerPipe:
        pipe = self._pipe
        if pipe is None:
            raise WorkerEndedError("it was ended")
        return pipe

    def _ended(self, reason: str) -> WorkerEndedError:
        """Why nothing comes any more; a process that lives on is ended."""
        process, code = self._process, None
        if process is not None and not reason:
            process.join(EXIT_SECONDS)
            code = process.exitcode
        self.kill()
        if code is None:
            return WorkerEndedError(reason or "it closed its pipe")
        return WorkerEndedError(f"signal {-code}" if code < 0 else f"exit code {code}")
