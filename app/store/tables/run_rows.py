"""The database rows of runs, for all that write them."""

import json
import sqlite3
from collections.abc import Iterable
from typing import Any

from app.bridge.states import Direction
from app.store.run_journal import Entry, EntryKind

ByteRow = tuple[str, float, str, bytes]
"""Run, time in s by `boot_seconds`, direction, data."""

StateRow = tuple[str, float, str, str, str]
"""Run, time in s by `boot_seconds`, link, robot, cause."""


def byte_row(run: str, entry: Entry) -> ByteRow:
    """An entry of bytes as its row."""
    way = Direction.TO_ROBOT if entry.kind is EntryKind.TO_ROBOT else Direction.FROM_ROBOT
    return run, entry.time, way.value, entry.data


def state_row(run: str, entry: Entry) -> StateRow:
    """A change of state as its row."""
    link, robot, cause = json.loads(entry.data)
    return run, entry.time, link, robot, cause


def put_run(connection: sqlite3.Connection, content: dict[str, Any]) -> None:
    """Stores a run as it is now; its note, and whether it was deleted, stay."""
    connection.execute(
        "INSERT INTO run(id, started, content) VALUES(?,?,?) "
        "ON CONFLICT(id) DO UPDATE SET started=excluded.started, content=excluded.content",
        (content["id"], content["started"], json.dumps(content, allow_nan=False)),
    )


def add_bytes(connection: sqlite3.Connection, rows: Iterable[ByteRow]) -> None:
    """Adds to the record of bytes."""
    connection.executemany("INSERT INTO run_bytes(run, time, direction, data) VALUES(?,?,?,?)", rows)


def add_states(connection: sqlite3.Connection, rows: Iterable[StateRow]) -> None:
    """Adds changes of state."""
    connection.executemany("INSERT INTO run_state(run, time, link, robot, cause) VALUES(?,?,?,?,?)", rows)
