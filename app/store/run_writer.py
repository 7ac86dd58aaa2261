"""A way of its own into the database for what passes in a run, so that it waits for nobody else."""

from __future__ import annotations

import sqlite3
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from app.store.run_rows import ByteRow, StateRow, add_bytes, add_states, put_run
from core.errors import InputError

BUSY_SECONDS = 0.5
"""How long another program's write is waited for at a time, s."""


class RunWriter:
    """Writes pieces of runs; each write is whole or not at all.

    What `write` has written outlives the end of this program, however that comes; a power cut may take what
    was written since the last `sync`. The two may be called from two threads.

    Args:
        path: an existing database of today's form.

    Raises:
        InputError: it cannot be used.
    """

    def __init__(self, path: Path) -> None:
        try:
            self._pieces = _connect(path)
            self._disk = _connect(path)
        except sqlite3.Error as error:
            raise InputError(f"The database {path} cannot be used: {error}.", str(path)) from error

    def write(
        self, pieces: Sequence[ByteRow], states: Sequence[StateRow], runs: Sequence[dict[str, Any]]
    ) -> None:
        """Adds bytes and states, and stores runs as they are now.

        Raises:
            sqlite3.Error: nothing of it was written.
        """
        with self._pieces:
            add_bytes(self._pieces, pieces)
            add_states(self._pieces, states)
            for content in runs:
                put_run(self._pieces, content)

    def sync(self) -> None:
        """Brings what was written to the disk, and into the database's own file.

        Raises:
            sqlite3.Error: the disk did not take it.
        """
        self._disk.execute("PRAGMA wal_checkpoint(PASSIVE)").fetchall()

    def close(self) -> None:
        """Closes the line."""
        self._pieces.close()
        self._disk.close()


def _connect(path: Path) -> sqlite3.Connection:
    connection = sqlite3.connect(path, timeout=BUSY_SECONDS, check_same_thread=False)
    # Every other commit would wait for the disk; `sync` does, on a thread of its own.
    connection.execute("PRAGMA synchronous=NORMAL")
    connection.execute("PRAGMA wal_autocheckpoint=0")
    return connection
