"""Whether a database is whole, and what of it is not."""

import sqlite3
from contextlib import closing
from pathlib import Path
from urllib.parse import quote

from app.store.schema import missing_tables
from app.store.storage_errors import storage_error
from core.errors import StorageDamagedError

_PARTS = {
    "open_gait": "edits",
    "history": "edits",
    "version": "versions",
    "approval": "approvals",
    "result": "optimised motions",
    "job": "jobs",
    "simulation": "simulations",
    "run": "runs",
    "trial": "trials",
    "video": "videos",
    "camera": "cameras",
    "learning": "learned parameters",
    "physics": "learned parameters",
    "published": "figures of published gaits",
}
"""What is in the tables, by the beginning of their names."""


def reading(path: Path, *, is_open: bool = False) -> sqlite3.Connection:
    """A connection that changes nothing, also no file beside the database where none is open."""
    return sqlite3.connect(f"file:{quote(str(path))}?mode=ro" + ("" if is_open else "&immutable=1"), uri=True)


def damage_of(path: Path, *, is_open: bool = False) -> str | None:
    """What a quick check of a database finds wrong; None where it is whole.

    Args:
        path: the file.
        is_open: whether a program may be writing to it.

    Raises:
        StorageError: it cannot be read at all.
    """
    try:
        with closing(reading(path, is_open=is_open)) as connection:
            found = _findings(connection)
            parts = sorted({_part(table) for table in _damaged_tables(connection)}) if found else ()
            found = found or missing_sentence(connection)
    except sqlite3.Error as error:
        refusal = storage_error(error, path)
        if isinstance(refusal, StorageDamagedError):
            return str(error)
        raise refusal or error from error
    return (f"in {', '.join(parts)}: {found}" if parts else found) or None


def missing_sentence(connection: sqlite3.Connection) -> str:
    """Which tables a database of this program's version has not; empty where it has all."""
    missing = missing_tables(connection)
    return f"its table {', '.join(missing)} is missing" if missing else ""


def _findings(connection: sqlite3.Connection, table: str = "") -> str:
    """What the quick check of everything, or of one table, says first; empty where all is well."""
    argument = f"'{table}'" if table else "1"
    try:
        rows = connection.execute(f"PRAGMA quick_check({argument})").fetchall()
    except sqlite3.DatabaseError as error:
        if isinstance(storage_error(error, Path()), StorageDamagedError):
            return str(error)
        raise
    lines = [line for row in rows for line in row[0].splitlines() if not line.startswith("***")]
    return "" if lines == ["ok"] else lines[0]


def _damaged_tables(connection: sqlite3.Connection) -> list[str]:
    tables = connection.execute("SELECT name FROM sqlite_master WHERE type='table'").fetchall()
    return [name for (name,) in tables if _findings(connection, name)]


def _part(table: str) -> str:
    """What a table holds, in a person's words."""
    return next((word for start, word in _PARTS.items() if table.startswith(start)), table)
