"""One SQLite file (WAL) for edit history, results, jobs, approvals and runs.

Every write is committed before its method returns, so that what was acknowledged survives a kill.
"""

from __future__ import annotations

import json
import sqlite3
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from core.errors import InputError

_SCHEMA = """
CREATE TABLE IF NOT EXISTS history(
    gait TEXT, position INTEGER, label TEXT, document TEXT, PRIMARY KEY(gait, position));
CREATE TABLE IF NOT EXISTS open_gait(
    gait TEXT PRIMARY KEY, revision INTEGER, cursor INTEGER, notice TEXT, approval TEXT);
CREATE TABLE IF NOT EXISTS result(motion TEXT PRIMARY KEY, content TEXT);
CREATE TABLE IF NOT EXISTS job(id TEXT PRIMARY KEY, created REAL, content TEXT);
CREATE TABLE IF NOT EXISTS approval(
    number INTEGER PRIMARY KEY AUTOINCREMENT, gait TEXT, content TEXT);
CREATE TABLE IF NOT EXISTS run(id TEXT PRIMARY KEY, started REAL, content TEXT);
CREATE TABLE IF NOT EXISTS run_bytes(
    number INTEGER PRIMARY KEY AUTOINCREMENT, run TEXT, time REAL, direction TEXT, data BLOB);
"""


@dataclass(frozen=True)
class HistoryRow:
    """One step of a gait's history: what the edit was called, and the document after it."""

    label: str
    document: str


@dataclass(frozen=True)
class OpenGaitRow:
    """Where a gait's editing stands."""

    revision: int
    cursor: int
    notice: str | None
    approval: str | None


class Database:
    """The studio's database.

    Args:
        path: the file; made where it does not exist.
    """

    def __init__(self, path: Path) -> None:
        self._lock = threading.Lock()
        try:
            self._connection = sqlite3.connect(path, check_same_thread=False)
            self._connection.execute("PRAGMA journal_mode=WAL")
            self._connection.execute("PRAGMA synchronous=FULL")
            self._connection.executescript(_SCHEMA)
        except sqlite3.Error as error:
            raise InputError(f"The database {path} cannot be used: {error}.", str(path)) from error

    def close(self) -> None:
        """Closes the file."""
        with self._lock:
            self._connection.close()

    @contextmanager
    def _writing(self) -> Iterator[sqlite3.Connection]:
        with self._lock, self._connection:
            yield self._connection

    def _rows(self, query: str, *values: Any) -> list[tuple[Any, ...]]:
        with self._lock:
            return self._connection.execute(query, values).fetchall()

    def open_gait(self, gait: str) -> tuple[OpenGaitRow, tuple[HistoryRow, ...]] | None:
        """A gait's editing state and history, or None where it was never edited."""
        rows = self._rows("SELECT revision, cursor, notice, approval FROM open_gait WHERE gait=?", gait)
        if not rows:
            return None
        history = self._rows("SELECT label, document FROM history WHERE gait=? ORDER BY position", gait)
        return OpenGaitRow(*rows[0]), tuple(HistoryRow(*row) for row in history)

    def has_open_gait(self, gait: str) -> bool:
        """Whether a gait's editing state is stored."""
        return bool(self._rows("SELECT 1 FROM open_gait WHERE gait=?", gait))

    def put_open_gait(
        self, gait: str, row: OpenGaitRow, tail_from: int, tail: tuple[HistoryRow, ...]
    ) -> None:
        """Stores the editing state and replaces the history from a position on."""
        with self._writing() as connection:
            connection.execute("DELETE FROM history WHERE gait=? AND position>=?", (gait, tail_from))
            connection.executemany(
                "INSERT INTO history VALUES(?,?,?,?)",
                [(gait, tail_from + i, entry.label, entry.document) for i, entry in enumerate(tail)],
            )
            connection.execute(
                "INSERT OR REPLACE INTO open_gait VALUES(?,?,?,?,?)",
                (gait, row.revision, row.cursor, row.notice, row.approval),
            )

    def drop_open_gait(self, gait: str) -> None:
        """Forgets a gait's editing state."""
        with self._writing() as connection:
            connection.execute("DELETE FROM history WHERE gait=?", (gait,))
            connection.execute("DELETE FROM open_gait WHERE gait=?", (gait,))

    def result(self, motion: str) -> dict[str, Any] | None:
        """The stored result for a motion hash."""
        rows = self._rows("SELECT content FROM result WHERE motion=?", motion)
        return json.loads(rows[0][0]) if rows else None

    def put_result(self, motion: str, content: dict[str, Any]) -> None:
        """Stores a checked result."""
        with self._writing() as connection:
            connection.execute(
                "INSERT OR REPLACE INTO result VALUES(?,?)", (motion, json.dumps(content, allow_nan=False))
            )

    def jobs(self, most: int = 50) -> list[dict[str, Any]]:
        """The newest jobs, newest first."""
        rows = self._rows("SELECT content FROM job ORDER BY created DESC LIMIT ?", most)
        return [json.loads(row[0]) for row in rows]

    def put_job(self, content: dict[str, Any]) -> None:
        """Stores a job as it is now."""
        with self._writing() as connection:
            connection.execute(
                "INSERT OR REPLACE INTO job VALUES(?,?,?)",
                (content["id"], content["created"], json.dumps(content, allow_nan=False)),
            )

    def add_approval(self, gait: str, content: dict[str, Any]) -> None:
        """Adds to the record of approvals."""
        with self._writing() as connection:
            connection.execute(
                "INSERT INTO approval(gait, content) VALUES(?,?)",
                (gait, json.dumps(content, allow_nan=False)),
            )

    def runs(self, most: int = 100) -> list[dict[str, Any]]:
        """The newest runs, newest first."""
        rows = self._rows("SELECT content FROM run ORDER BY started DESC LIMIT ?", most)
        return [json.loads(row[0]) for row in rows]

    def put_run(self, content: dict[str, Any]) -> None:
        """Stores a run as it is now."""
        with self._writing() as connection:
            connection.execute(
                "INSERT OR REPLACE INTO run VALUES(?,?,?)",
                (content["id"], content["started"], json.dumps(content, allow_nan=False)),
            )

    def add_bytes(self, rows: list[tuple[str, float, str, bytes]]) -> None:
        """Adds to the record of bytes: (run, monotonic time in s, direction, data) each."""
        with self._writing() as connection:
            connection.executemany("INSERT INTO run_bytes(run, time, direction, data) VALUES(?,?,?,?)", rows)
