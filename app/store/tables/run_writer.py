"""A database connection of its own for runs, so that recording waits for nobody else."""

import json
import sqlite3
from collections.abc import Sequence
from pathlib import Path
from urllib.parse import quote

from app.store.database_files import DatabaseFiles
from app.store.run_journal import Entry, EntryKind
from app.store.storage_errors import storage_error
from app.store.tables.run_rows import add_bytes, add_states, byte_row, put_run, state_row

BUSY_SECONDS = 0.5
"""How long another program's write is waited for at a time, s."""


class RunWriter:
    """Writes pieces of runs; each write is whole or not at all, and on the disk when it returns.

    Args:
        path: an existing database of today's form.
        files: its files, as they were opened.

    Raises:
        StorageError: it cannot be used.
    """

    def __init__(self, path: Path, files: DatabaseFiles) -> None:
        self._files = files
        address = f"file:{quote(str(path.absolute()))}?mode=rw"
        try:
            self._connection = sqlite3.connect(
                address, uri=True, timeout=BUSY_SECONDS, check_same_thread=False
            )
            self._connection.execute("PRAGMA synchronous=FULL")
        except sqlite3.Error as error:
            raise storage_error(error, path) or error from error

    def write(self, entries: Sequence[tuple[str, Entry]]) -> None:
        """Adds entries, each with its run's id.

        Raises:
            sqlite3.Error: nothing of it was written, or it is not on the disk, since a file was taken away.
        """
        self._require(self._files.fault())
        with self._connection:
            add_bytes(self._connection, [byte_row(run, e) for run, e in entries if e.kind.is_bytes])
            add_states(
                self._connection, [state_row(run, e) for run, e in entries if e.kind is EntryKind.STATE]
            )
            for _, entry in entries:
                if entry.kind is EntryKind.END:
                    put_run(self._connection, json.loads(entry.data))
        self._require(self._files.fault())

    def _require(self, fault: str | None) -> None:
        if fault is not None:
            raise sqlite3.OperationalError(fault)

    def close(self) -> None:
        """Closes the way."""
        self._connection.close()
