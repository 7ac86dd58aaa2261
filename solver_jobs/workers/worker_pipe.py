"""The parent's end of a worker's pipe, where neither sending nor receiving waits for the worker.

A worker that is stopped reads nothing, and may have sent half of a message. Two threads of the pipe's own
wait for that, so that whoever drives the worker looks at the clock meanwhile.
"""

import logging
import queue
import threading
from multiprocessing.connection import Connection
from multiprocessing.reduction import ForkingPickler
from typing import Any

JOIN_SECONDS = 5.0
"""How long a killed process, and what reads its pipe, may take to be gone."""

_log = logging.getLogger(__name__)


class PipeClosedError(Exception):
    """Nothing comes any more; the text says why, where that is not the end of the process."""


class WorkerPipe:
    """Sends and receives on a connection; any thread may do either.

    Args:
        connection: our end.
        name: of the worker.
    """

    def __init__(self, connection: Connection, name: str) -> None:
        self._connection = connection
        self._name = name
        self._outgoing: queue.SimpleQueue[Any] = queue.SimpleQueue()
        self._incoming: queue.SimpleQueue[Any] = queue.SimpleQueue()
        self._threads = [
            threading.Thread(target=work, name=f"{name} {word}", daemon=True)
            for word, work in (("out", self._send_all), ("in", self._receive_all))
        ]
        for thread in self._threads:
            thread.start()

    def send(self, message: object) -> None:
        """Begins to send a message. A worker that is gone is noticed by `receive`."""
        self._outgoing.put(ForkingPickler.dumps(message))

    def receive(self, timeout: float | None = None) -> Any:
        """The next message, or None where none came within `timeout` seconds.

        Raises:
            PipeClosedError: nothing comes any more.
        """
        try:
            message = self._incoming.get(timeout=timeout)
        except queue.Empty:
            return None
        if isinstance(message, PipeClosedError):
            self._incoming.put(message)  # for whoever asks again
            raise message
        return message

    def close(self) -> None:
        """Closes the pipe of a worker that has ended."""
        self._outgoing.put(None)
        for thread in self._threads:
            thread.join(JOIN_SECONDS)
        if not any(thread.is_alive() for thread in self._threads):
            self._connection.close()

    def _send_all(self) -> None:
        while (message := self._outgoing.get()) is not None:
            try:
                self._connection.send_bytes(message)
            except OSError:
                return

    def _receive_all(self) -> None:
        while True:
            try:
                self._incoming.put(self._connection.recv())
            except EOFError:
                self._incoming.put(PipeClosedError(""))
                return
            except Exception as error:  # whatever a damaged pickle raises
                if not isinstance(error, ConnectionError):
                    _log.error("What %s sent cannot be read: %r", self._name, error)
                self._incoming.put(PipeClosedError("it sent what cannot be read"))
                return
