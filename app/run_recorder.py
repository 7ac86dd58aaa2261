"""Keeps every byte of a run, with its time, as it happens."""

from __future__ import annotations

import logging
import queue
import sqlite3
import threading
import time
from typing import Any

from app.bridge.states import Direction
from app.store.database import Database

_Row = tuple[str, float, str, bytes]

logger = logging.getLogger(__name__)

FLUSH_SECONDS = 0.1
"""Bytes reach the disk at the latest this long after they passed."""


class RunRecorder:
    """Writes what the bridge logs while a run is on; never makes the bridge wait.

    Args:
        database: where it goes.
    """

    def __init__(self, database: Database) -> None:
        self._database = database
        self._waiting: queue.SimpleQueue[_Row | dict[str, Any] | None] = queue.SimpleQueue()
        self._run: str | None = None
        self._thread = threading.Thread(target=self._work, name="run recorder", daemon=True)
        self._thread.start()

    def log(self, direction: Direction, data: bytes, when: float) -> None:
        """Takes bytes from the bridge; kept only while a run is on."""
        run = self._run
        if run is not None:
            self._waiting.put((run, when, direction.value, data))

    def begin(self, content: dict[str, Any]) -> None:
        """Starts the record of a run; `content` needs `id` and `started`."""
        self._database.put_run(content)
        self._run = content["id"]

    def end(self, content: dict[str, Any]) -> None:
        """Completes the record of a run, after every byte that was logged before."""
        self._run = None
        self._waiting.put(content)

    def close(self) -> None:
        """Writes what is left and ends."""
        self._waiting.put(None)
        self._thread.join(timeout=5)

    def _work(self) -> None:
        is_open = True
        while is_open:
            batch = [self._waiting.get()]
            time.sleep(FLUSH_SECONDS)
            while not self._waiting.empty():
                batch.append(self._waiting.get())
            is_open = None not in batch
            self._write(
                [row for row in batch if isinstance(row, tuple)],
                [content for content in batch if isinstance(content, dict)],
            )

    def _write(self, rows: list[_Row], ended: list[dict[str, Any]]) -> None:
        try:
            self._database.add_bytes(rows)
            for content in ended:
                self._database.put_run(content)
        except sqlite3.Error:
            logger.exception("%d pieces of a run's record could not be written.", len(rows))
