"""Keeps every byte and every change of state of a run, with its time, as it happens."""

import json
import logging
import sqlite3
import threading
import time
from collections.abc import Callable, Iterable

from app.bridge.states import Direction, Transition
from app.common.clock import boot_seconds
from app.common.json import Json
from app.store.database import Database
from app.store.run_journal import Entry, EntryKind, RunJournal
from app.store.tables.run_store import RunStore
from app.store.tables.run_writer import RunWriter
from core.errors import StateError, StorageError
from core.running_time import Deadline

logger = logging.getLogger(__name__)

GATHER_SECONDS = 0.1
"""The database gets what has gathered for this long, s; the journal has it at once."""

RETRY_SECONDS = 0.5
"""Time between two attempts where the database does not take the record, s."""

LAG_SHOWN = 1.0
"""A record that lags by more is told of, s."""

MOST_WAITING = 64_000_000
"""Bytes of memory for what waits: more than an hour of telemetry."""

ENTRY_OVERHEAD = 300
"""Bytes of memory that an entry takes beside its data."""

CLOSE_SECONDS = 5.0
"""How long the end of the program waits for a database that does not take the record, s."""

_KINDS = {Direction.TO_ROBOT: EntryKind.TO_ROBOT, Direction.FROM_ROBOT: EntryKind.FROM_ROBOT}


class RunRecorder:
    """Writes what the bridge logs while a run is on, into a journal at once and then into the database.

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
        self._runs, self._database = RunStore(database), database
        self._data = database.path.parent
        self._writer = writer or RunWriter(database.path, database.files)
        self._changed = changed
        self._lock, self._noting = threading.Lock(), threading.Lock()
        self._waiting: list[tuple[str, Entry]] = []
        self._memory = 0
        self._left_out = 0
        self._run: str | None = None
        self._noted = 0
        self._journals: dict[str, RunJournal] = {}
        self._behind: float | None = None
        self._reason = ""
        self._wake, self._closing = threading.Event(), threading.Event()
        self._thread = threading.Thread(target=self._work, name="run recorder", daemon=True)
        self._thread.start()

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
        if self._database.damage is not None:
            return (
                "The database takes nothing of the run any more. The run stands in its journal, in the "
                "folder running of the data folder, and is taken from there once the database is back."
            )
        return (
            f"The record of the run lags by {lag:.0f} s: the database does not take it "
            f"({self._reason.rstrip('.')}). Nothing is lost so far; make room on the disk of the data folder."
        )

    def log(self, direction: Direction, data: bytes, when: float) -> None:
        """Takes bytes from the bridge; kept only while a run is on."""
        self._put(Entry(_KINDS[direction], when, data))

    def note(self, changes: Iterable[Transition]) -> None:
        """Takes the bridge's changes of state; those since the run began are kept, each once."""
        with self._noting:
            fresh = [change for change in changes if change.number > self._noted]
            for change in fresh:
                self._noted = change.number
                words = (change.link.value, change.robot.value, change.cause)
                self._put(Entry(EntryKind.STATE, change.time, json.dumps(words).encode()))

    def begin(self, content: Json, plan: Json | None = None, after: int = 0) -> None:
        """Starts the record of a run.

        Args:
            content: needs `id`, `started` and `started_monotonic`, which is the start by `boot_seconds`; the
                name is older than that clock.
            plan: what the run is to do, where it is to be compared with that.
            after: number of the last change of state before the run.

        Raises:
            StateError: the data folder does not take it, so that the run would leave no trace.
        """
        run = content["id"]
        try:
            journal = RunJournal(self._data, run)
            try:
                self._runs.begin(content, plan)
            except StorageError:
                journal.close(is_in_database=True)
                raise
        except StorageError as error:
            raise StateError(f"The record of the run cannot be begun. {error.sentence}", "record") from error
        except OSError as error:
            raise StateError(
                f"The record of the run cannot be begun: the data folder does not take it ({error}). Make "
                "room on its disk, then send again.",
                "record",
            ) from error
        with self._lock:
            self._journals[run] = journal
            self._left_out, self._noted, self._run = 0, after, run

    def end(self, content: Json) -> None:
        """Completes the record of a run, after every byte that was logged before."""
        whole = {**content, "left_out": self._left_out} if self._left_out else content
        self._put(Entry(EntryKind.END, boot_seconds(), json.dumps(whole, allow_nan=False).encode()))

    def close(self) -> None:
        """Writes what is left and ends."""
        self._closing.set()
        self._wake.set()
        self._thread.join()
        for journal in self._journals.values():
            journal.close(is_in_database=False)
        self._writer.close()

    def _put(self, entry: Entry) -> None:
        with self._lock:
            run = self._run
            if run is None:
                return
            if entry.kind.is_bytes and self._memory + len(entry.data) > MOST_WAITING:
                self._left_out += len(entry.data)
                return
            if entry.kind is EntryKind.END:
                self._run = None
            self._memory += _memory(entry)
            self._waiting.append((run, entry))
            self._journals[run].add(entry)
        self._wake.set()

    def _work(self) -> None:
        give_up: Deadline | None = None
        while True:
            self._wake.wait()
            self._wake.clear()
            is_closing = self._closing.wait(GATHER_SECONDS)
            is_written = self._write()
            if is_closing:
                give_up = give_up or Deadline(CLOSE_SECONDS, time.monotonic, most=2 * RETRY_SECONDS)
                if is_written or give_up.is_over:
                    break
            if not is_written:
                time.sleep(RETRY_SECONDS)
                self._wake.set()
        if self._waiting:
            logger.error("%d pieces of a run's record could not be written.", len(self._waiting))

    def _write(self) -> bool:
        """Writes what waits; it waits on where the database does not take it."""
        with self._lock:
            batch = list(self._waiting)
        if not batch:
            return True
        try:
            self._writer.write(batch)
        except sqlite3.Error as error:
            self._fell_behind(str(error))
            return False
        with self._lock:
            del self._waiting[: len(batch)]
            self._memory -= sum(_memory(entry) for _, entry in batch)
            ended = [self._journals.pop(run) for run, entry in batch if entry.kind is EntryKind.END]
        for journal in ended:
            journal.close(is_in_database=True)
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


def _memory(entry: Entry) -> int:
    return len(entry.data) + ENTRY_OVERHEAD
