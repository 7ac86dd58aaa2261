"""Keeps every byte and every change of state of a run, with its time, as it happens."""

from __future__ import annotations

import logging
import queue
import sqlite3
import threading
import time
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

from app.bridge.states import Direction, Transition
from app.store.database import Database
from app.store.run_log import RunLog

_Bytes = tuple[str, float, str, bytes]


@dataclass(frozen=True)
class _State:
    run: str
    change: Transition

    @property
    def row(self) -> tuple[str, float, str, str, str]:
        change = self.change
        return (self.run, change.time, change.link.value, change.robot.value, change.cause)


_Item = _Bytes | _State | dict[str, Any]

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
        self._runs = RunLog(database)
        self._waiting: queue.SimpleQueue[_Item | None] = queue.SimpleQueue()
        self._run: str | None = None
        self._noted = 0.0
        self._thread = threading.Thread(target=self._work, name="run recorder", daemon=True)
        self._thread.start()

    def log(self, direction: Direction, data: bytes, when: float) -> None:
        """Takes bytes from the bridge; kept only while a run is on."""
        run = self._run
        if run is not None:
            self._waiting.put((run, when, direction.value, data))

    def note(self, changes: Iterable[Transition]) -> None:
        """Takes the bridge's changes of state; those since the run began are kept, each once."""
        run = self._run
        fresh = [change for change in changes if change.time > self._noted] if run is not None else []
        for change in fresh:
            self._noted = max(self._noted, change.time)
            self._waiting.put(_State(str(run), change))

    def begin(self, content: dict[str, Any], plan: dict[str, Any] | None = None) -> None:
        """Starts the record of a run.

        Args:
            content: needs `id`, `started` and `started_monotonic`.
            plan: what the run is to do, where it is to be compared with that.
        """
        self._database.put_run(content)
        if plan is not None:
            self._runs.put_plan(content["id"], plan)
        self._noted = content["started_monotonic"]
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
            self._write([item for item in batch if item is not None])

    def _write(self, batch: list[_Item]) -> None:
        try:
            self._database.add_bytes([item for item in batch if isinstance(item, tuple)])
            self._runs.add_states([item.row for item in batch if isinstance(item, _State)])
            for content in batch:
                if isinstance(content, dict):
                    self._database.put_run(content)
        except sqlite3.Error:
            logger.exception("%d pieces of a run's record could not be written.", len(batch))
