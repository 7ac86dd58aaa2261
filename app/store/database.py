"""The studio's SQLite file (WAL): results, jobs and runs; other tables have stores of their own.

Every write is committed before its method returns, so that what was acknowledged survives a kill.
"""

import json
import sqlite3
import threading
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any

from app.common.json import Json
from app.store import run_rows
from app.store.folder_lock import DatabaseUse
from app.store.schema import bring_up_to_date
from core.errors import InputError

DATABASE = "studio.sqlite3"
"""Name of the file in a data folder."""


class Database:
    """The studio's database.

    Args:
        path: the file; made where it does not exist.

    Attributes:
        path: the file.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self._lock = threading.Lock()
        with ExitStack() as opened:
            opened.callback(DatabaseUse(path.parent).close)
            try:
                self._connection = sqlite3.connect(path, check_same_thread=False)
                opened.callback(self._connection.close)
                self._connection.execute("PRAGMA journal_mode=WAL")
                self._connection.execute("PRAGMA synchronous=FULL")
                bring_up_to_date(self._connection)
            except sqlite3.Error as error:
                raise InputError(f"The database {path} cannot be used: {error}.", str(path)) from error
            self._opened = opened.pop_all()

    def close(self) -> None:
        """Closes the file."""
        with self._lock:
            self._opened.close()

    @contextmanager
    def writing(self) -> Iterator[sqlite3.Connection]:
        """One transaction; it is on disk when this ends without an error."""
        with self._lock, self._connection:
            yield self._connection

    def rows(self, query: str, *values: Any) -> list[tuple[Any, ...]]:
        """What a query finds."""
        with self._lock:
            return self._connection.execute(query, values).fetchall()

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
        rows = self.rows("SELECT content FROM job ORDER BY created DESC LIMIT ?", most)
        return [json.loads(row[0]) for row in rows]

    def put_job(self, content: Json) -> None:
        """Stores a job as it is now."""
        with self.writing() as connection:
            connection.execute(
                "INSERT OR REPLACE INTO job VALUES(?,?,?)",
                (content["id"], content["created"], json.dumps(content, allow_nan=False)),
            )

    def runs(self, most: int = 100) -> list[Json]:
        """The newest runs, newest first."""
        rows = self.rows("SELECT content FROM run ORDER BY started DESC LIMIT ?", most)
        return [json.loads(row[0]) for row in rows]

    def put_run(self, content: Json) -> None:
        """Stores a run as it is now."""
        with self.writing() as connection:
            run_rows.put_run(connection, content)

    def add_bytes(self, rows: list[run_rows.ByteRow]) -> None:
        """Adds to the record of bytes."""
        with self.writing() as connection:
            run_rows.add_bytes(connection, rows)
