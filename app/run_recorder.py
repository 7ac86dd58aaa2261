"""Keeps every byte and every change of state of a run, with its time, as it happens."""

from __future__ import annotations

import logging
import sqlite3
import threading
import time
from collections.abc import Callable, Iterable
from typing import Any

from app.bridge.states import Direction, Transition
from app.store.database import Database
from app.store.run_log import RunLog
from app.store.run_rows import ByteRow, StateRow
from app.store.run_writer import RunWriter
from core.errors import StateError

logger = logging.getLogger(__name__)

GATHER_SECONDS = 0.03
"""Bytes are gathered for this long, s. With the writing and a busy machine's delays that leaves room within
the 0.1 s after which a killed program's record has to have them."""

SYNC_SECONDS = 0.5
"""How often what was written is brought to the disk, s."""

RETRY_SECONDS = 0.5
"""Time between two attempts where the database does not take the record, s."""

LAG_SHOWN = 1.0
"""A record that lags by more is told of, s."""

MOST_WAITING = 64_000_000
"""Bytes of memory for what waits: more than an hour of telemetry."""

PIECE_OVERHEAD = 300
"""Bytes of memory that a piece takes beside its data."""

CLOSE_SECONDS = 5.0
"""How long the end of the program waits for a database that does not take the record, s."""

_Item = ByteRow | StateRow | dict[str, Any]


class RunRecorder:
    """Writes what the bridge logs while a run is on; never makes the bridge wait.

    What the database does not take is kept in memory and tried again. Where memory has an end too, bytes are
    left out, counted, and the record says so.

    Args:
        database: where it goes.
        changed: called from a thread of its own when `trouble` says something new.
        writer: the way into the database.
    """

    def __init__(
        self,
        database: Database,
        changed: Callable[[], None] = lambda: None,
        writer: RunWriter | None = None,
    ) -> None:
        self._runs = RunLog(database)
        self._writer = writer or RunWriter(database.path)
        self._changed = changed
        self._lock = threading.Lock()
        self._waiting: list[_Item] = []
        self._memory = 0
        self._left_out = 0
        self._run: str | None = None
        self._noted = 0
        self._behind: float | None = None
        self._reason = ""
        self._is_on_disk = True
        self._wake, self._closing, self._closed = threading.Event(), threading.Event(), threading.Event()
        self._threads = [
            threading.Thread(target=work, name=name, daemon=True)
            for work, name in ((self._work, "run recorder"), (self._sync_on, "run record to disk"))
        ]
        for thread in self._threads:
            thread.start()

    @property
    def trouble(self) -> str | None:
        """Says that the record lags, or lacks something; None where all is well."""
        behind = self._behind
        lag = 0.0 if behind is None else time.monotonic() - behind
        if self._left_out:
            return (
                f"The record of the run has a hole: {self._left_out} bytes found no room in memory while the "
                f"database did not take them ({self._reason})."
            )
        if lag <= LAG_SHOWN:
            return None
        return (
            f"The record of the run lags by {lag:.0f} s: the database does not take it ({self._reason}). "
            "Nothing is lost so far; make room on the disk of the data folder."
        )

    def log(self, direction: Direction, data: bytes, when: float) -> None:
        """Takes bytes from the bridge; kept only while a run is on."""
        run = self._run
        if run is not None:
            self._put((run, when, direction.value, data), len(data))

    def note(self, changes: Iterable[Transition]) -> None:
        """Takes the bridge's changes of state; those since the run began are kept, each once."""
        run = self._run
        if run is None:
            return
        for change in changes:
            if change.number > self._noted:
                self._noted = change.number
                self._put((run, change.time, change.link.value, change.robot.value, change.cause), 0)

    def begin(self, content: dict[str, Any], plan: dict[str, Any] | None = None, after: int = 0) -> None:
        """Starts the record of a run.

        Args:
            content: needs `id`, `started` and `started_monotonic`.
            plan: what the run is to do, where it is to be compared with that.
            after: number of the last change of state before the run.

        Raises:
            StateError: the database does not take it, so that the run would leave no trace.
        """
        try:
            self._runs.begin(content, plan)
        except sqlite3.Error as error:
            raise StateError(
                f"The record of the run cannot be begun: the database does not take it ({error}). Make room "
                "on the disk of the data folder, then send again.",
                "record",
            ) from error
        self._left_out, self._noted = 0, after
        self._run = content["id"]

    def end(self, content: dict[str, Any]) -> None:
        """Completes the record of a run, after every byte that was logged before."""
        self._run = None
        self._put({**content, "left_out": self._left_out} if self._left_out else content, 0)

    def close(self) -> None:
        """Writes what is left and ends."""
        self._closing.set()
        self._wake.set()
        for thread in self._threads:
            thread.join()
        self._writer.close()

    def _put(self, item: _Item, size: int) -> None:
        with self._lock:
            if size and self._memory + size > MOST_WAITING:
                self._left_out += size
                return
            self._memory += size + PIECE_OVERHEAD
            self._waiting.append(item)
        self._wake.set()

    def _work(self) -> None:
        give_up = float("inf")
        while not self._closed.is_set():
            self._wake.wait()
            self._closing.wait(GATHER_SECONDS)
            self._wake.clear()
            if self._closing.is_set():
                give_up = min(give_up, time.monotonic() + CLOSE_SECONDS)
            is_written = self._write()
            if not is_written:
                time.sleep(RETRY_SECONDS)
                self._wake.set()
            if self._closing.is_set() and (is_written or time.monotonic() > give_up):
                self._closed.set()
        if self._waiting:
            logger.error("%d pieces of a run's record could not be written.", len(self._waiting))

    def _write(self) -> bool:
        """Writes what waits; it waits on where the database does not take it."""
        with self._lock:
            batch = list(self._waiting)
        if not batch:
            return True
        try:
            self._writer.write(*_sorted(batch))
        except sqlite3.Error as error:
            self._fell_behind(str(error))
            return False
        self._is_on_disk = False
        with self._lock:
            del self._waiting[: len(batch)]
            self._memory = sum(PIECE_OVERHEAD + _size(item) for item in self._waiting)
        self._caught_up()
        return True

    def _fell_behind(self, reason: str) -> None:
        if self._behind is None:
            self._behind = time.monotonic()
            logger.warning("The database does not take a run's record: %s", reason)
        self._reason = reason
        if self.trouble is not None:
            self._changed()

    def _caught_up(self) -> None:
        if self._behind is not None:
            was_told = self.trouble is not None
            self._behind = None
            if was_told:
                self._changed()

    def _sync_on(self) -> None:
        while not self._closed.wait(SYNC_SECONDS):
            self._sync()
        self._sync()

    def _sync(self) -> None:
        if self._is_on_disk:
            return
        self._is_on_disk = True
        try:
            self._writer.sync()
        except sqlite3.Error as error:
            self._is_on_disk = False
            logger.warning("A run's record was not brought to the disk: %s", error)


def _sorted(batch: list[_Item]) -> tuple[list[ByteRow], list[StateRow], list[dict[str, Any]]]:
    pieces: list[ByteRow] = []
    states: list[StateRow] = []
    runs: list[dict[str, Any]] = []
    for item in batch:
        if isinstance(item, dict):
            runs.append(item)
        elif len(item) == 4:
            pieces.append(item)
        else:
            states.append(item)
    return pieces, states, runs


def _size(item: _Item) -> int:
    return len(item[3]) if isinstance(item, tuple) and len(item) == 4 else 0
