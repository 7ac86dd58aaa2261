"""A database connection of its own for runs, so that recording waits for nobody else."""

import json
import sqlite3
from collections.abc import Sequence
from pathlib import Path

from app.store.run_journal import Entry, EntryKind
from app.store.run_rows import add_bytes, add_states, byte_row, put_run, state_row
from app.store.storage_errors import storage_error

BUSY_SECONDS = 0.5
"""How long another program's write is waited for at a time, s."""


class RunWriter:
    """Writes pieces of runs; each write is whole or not at all, and on the disk when it returns.

    Args:
        path: an existing database of today's form.

    Raises:
        StorageError: it cannot be used.
    """

    def __init__(self, path: Path) -> None:
        try:
            self._connection = sqlite3.connect(path, timeout=BUSY_SECONDS, check_same_thread=False)
            self._connection.execute("PRAGMA synchronous=FULL")
        except sqlite3.Error as error:
            raise storage_error(error, path) or error from error

    def write(self, entries: Sequence[tuple[str, Entry]]) -> None:
        """Adds entries, each with its run's id.

        Raises:
            sqlite3.Error: nothing of it was written.
        """
        with self._connection:
            add_bytes(self._connection, [byte_row(run, e) for run, e in entries if e.kind.is_bytes])
            add_states(
                self._connection, [state_row(run, e) for run, e in entries if e.kind is EntryKind.STATE]
            )
            for _, entry in entries:
                if entry.kind is EntryKind.END:
                    put_run(self._connection, json.loads(entry.data))

    def close(self) -> None:
        """Closes the way."""
        self._connection.close()
