"""The studio's SQLite file (WAL): results, jobs and runs; other tables have stores of their own.

Every write is committed before its method returns, so that what was acknowledged survives a kill.
"""

import json
import logging
import sqlite3
import threading
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any

from app.common.clock import CLOCK, Clock
from app.common.json import Json
from app.store import run_rows
from app.store.backups import MIGRATION, damaged_sentence, make_backup
from app.store.folder_lock import DatabaseUse
from app.store.folder_time import FolderTime
from app.store.quick_check import missing_sentence
from app.store.schema import bring_up_to_date, is_outdated, try_write
from app.store.storage_errors import storage_error
from core.errors import StorageDamagedError

logger = logging.getLogger(__name__)

DATABASE = "studio.sqlite3"
"""Name of the file in a data folder."""


class Database:
    """The studio's database.

    Args:
        path: the file; made where it does not exist.
        clock: the clocks of the machine.

    Attributes:
        path: the file.
        clock: from which whoever keeps something in the database takes its times.
        folder_time: by which old things in the data folder go.
        damage: says that the file is damaged, and how to get back; nothing is written to it then, since going
            back to a backup would lose it again. None where nothing of the kind is known.
        damaged: called, from any thread, once `damage` is set.

    Raises:
        InputError: a newer program wrote it, or the data folder cannot be used.
        StorageError: it cannot be read or brought up to date.
    """

    def __init__(self, path: Path, clock: Clock = CLOCK) -> None:
        self.path, self.clock = path, clock
        self.folder_time = FolderTime(path.parent, clock)
        self.damage: str | None = None
        self.damaged: Callable[[], None] = lambda: None
        self._lock = threading.Lock()
        with ExitStack() as opened:
            opened.callback(DatabaseUse(path.parent).close)
            with self._sentences():
                self._connection = sqlite3.connect(path, check_same_thread=False)
                opened.callback(self._connection.close)
                self._connection.text_factory = _text
                self._connection.execute("PRAGMA journal_mode=WAL")
                self._connection.execute("PRAGMA synchronous=FULL")
                if is_outdated(self._connection):
                    make_backup(path, MIGRATION)
                bring_up_to_date(self._connection)
                missing = missing_sentence(self._connection)
                if missing:
                    raise StorageDamagedError(f"The database {path} is damaged ({missing}).", str(path))
                try_write(self._connection)
            self._opened = opened.pop_all()

    def close(self) -> None:
        """Closes the file."""
        with self._lock:
            self._opened.close()

    @contextmanager
    def writing(self) -> Iterator[sqlite3.Connection]:
        """One transaction; it is on disk when this ends without an error, and nothing of it is otherwise.

        Raises:
            StorageError: the disk or the database does not take it.
        """
        if self.damage is not None:
            raise StorageDamagedError(self.damage, str(self.path))
        with self._sentences(), self._lock, self._connection:
            yield self._connection

    def rows(self, query: str, *values: Any) -> list[tuple[Any, ...]]:
        """What a query finds.

        Raises:
            StorageError: it cannot be read.
        """
        with self._sentences(), self._lock:
            return self._connection.execute(query, values).fetchall()

    def take_damage(self, sentence: str) -> None:
        """Refuses to write from now on, since the file is damaged."""
        if self.damage is None:
            self.damage = damaged_sentence(sentence, self.path.parent)
            logger.error("%s", self.damage)
            self.damaged()

    @contextmanager
    def _sentences(self) -> Iterator[None]:
        """Turns what SQLite refuses into sentences."""
        try:
            yield
        except (sqlite3.Error, StorageDamagedError) as error:
            refusal = storage_error(error, self.path) if isinstance(error, sqlite3.Error) else error
            if refusal is None:
                raise
            if isinstance(refusal, StorageDamagedError):
                self.take_damage(refusal.sentence)
                raise StorageDamagedError(self.damage or refusal.sentence, refusal.where) from error
            raise refusal from error

    def result(self, motion: str) -> Json | None:
        """The stored result for a motion hash."""
        rows = self.rows("SELECT content FROM result WHERE motion=?", motion)
        return json.loads(rows[0][0]) if rows else None

    def put_result(self, motion: str, content: Json) -> None:
        """Stores a checked result."""
        with self.writing() as connection:
            connection.execute(
                "INSERT OR REPLACE INTO result VALUES(?,?)", (motion, json.dumps(content, allow_nan=False))
            )

    def jobs(self, most: int = 50) -> list[Json]:
        """The newest jobs, newest first."""
        rows = self.rows("SELECT content FROM job ORDER BY rowid DESC LIMIT ?", most)
        return [json.loads(row[0]) for row in rows]

    def job(self, job_id: str) -> Json | None:
        """A job as it was stored; None where there is none of that id."""
        rows = self.rows("SELECT content FROM job WHERE id = ?", job_id)
        return json.loads(rows[0][0]) if rows else None

    def put_job(self, content: Json) -> None:
        """Stores a job as it is now."""
        with self.writing() as connection:
            connection.execute(
                "INSERT INTO job(id, created, content) VALUES(?,?,?) "
                "ON CONFLICT(id) DO UPDATE SET content=excluded.content",
                (content["id"], content["created"], json.dumps(content, allow_nan=False)),
            )

    def runs(self, most: int = 100) -> list[Json]:
        """The newest runs, newest first."""
        rows = self.rows("SELECT content FROM run ORDER BY rowid DESC LIMIT ?", most)
        return [json.loads(row[0]) for row in rows]

    def put_run(self, content: Json) -> None:
        """Stores a run as it is now."""
        with self.writing() as connection:
            run_rows.put_run(connection, content)

    def add_bytes(self, rows: list[run_rows.ByteRow]) -> None:
        """Adds to the record of bytes."""
        with self.writing() as connection:
            run_rows.add_bytes(connection, rows)


def _text(content: bytes) -> str:
    """A stored text; pages that were overwritten hold no text any more, or end in zeros.

    Raises:
        sqlite3.OperationalError: as SQLite's own reader of texts would.
    """
    try:
        if content.strip(b"\0") == content:  # within a text an older version may have kept one
            return content.decode()
    except UnicodeDecodeError:
        pass
    raise sqlite3.OperationalError("could not decode a stored text")
