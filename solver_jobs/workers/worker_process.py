"""One worker process, as its parent drives it."""

from collections.abc import Callable
from multiprocessing.connection import Connection
from multiprocessing.process import BaseProcess
from typing import Any

from solver_jobs.workers.nlp_worker import run_worker
from solver_jobs.workers.spawning import NICENESS, start_process

POLL_SECONDS = 0.02
"""How soon a wish to end is noticed."""
JOIN_SECONDS = 5.0
"""How long a killed process may take to be gone."""


class WorkerEndedError(Exception):
    """The worker process is gone; the text says how it ended."""


class WorkerProcess:
    """Starts, feeds, reads and ends one worker. For one thread; only `kill` may come from another.

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
        self._pipe: Connection | None = None

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
        self._process, self._pipe = start_process(self._body, self._warm_up, self._name, self._niceness)

    def send(self, message: object) -> None:
        """Sends a message.

        Raises:
            WorkerEndedError: the process is gone.
        """
        try:
            self._open_pipe().send(message)
        except (OSError, ValueError) as error:
            raise self._ended() from error

    def receive(self, timeout: float) -> Any:
        """The next message, or None when none came within `timeout` seconds.

        Raises:
            WorkerEndedError: the process is gone.
        """
        pipe = self._open_pipe()
        try:
            if not pipe.poll(timeout):
                return None
            return pipe.recv()
        except (EOFError, OSError) as error:
            raise self._ended() from error

    def kill(self) -> None:
        """Ends the process at once and waits until it is gone."""
        process, pipe = self._process, self._pipe
        if process is not None:
            process.kill()
            process.join(JOIN_SECONDS)
        if pipe is not None:
            pipe.close()
        self._process = self._pipe = None

    def _open_pipe(self) -> Connection:
        if self._pipe is None:
            raise WorkerEndedError("it was ended")
        return self._pipe

    def _ended(self) -> WorkerEndedError:
        code = None
        if self._process is not None:
            self._process.join(JOIN_SECONDS)
            code = self._process.exitcode
        return WorkerEndedError(f"signal {-code}" if code is not None and code < 0 else f"exit code {code}")
