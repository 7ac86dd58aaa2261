"""A data folder with everything, in whose database rows are damaged."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path
from typing import Any

from app.store.database import DATABASE, Database
from app.store.tables.unreadable import KINDS
from tests.support.data_folder.archive import unpack

ARCHIVE = Path(__file__).parents[1] / "app" / "store" / "data_folders" / "90583579.tar.xz"
TABLES = sorted({kind.name for kind in KINDS})
DAMAGES: dict[str, Any] = {
    "nothing": None,
    "open brace": "{",
    "a list": "[1]",
    "an empty object": "{}",
    "bytes": b"\xff\x00",
    "no text": memoryview(b"\xff\xfe\x00"),
    "a huge number": 1e300,
    "a long text": "x" * 100_000,
    "deep brackets": "[" * 100_000,
}
"""Values that a column may have after a damage; a memoryview stands for a text that is none."""
LISTS = (
    "/api/jobs",
    "/api/runs",
    "/api/runs?state=done",
    "/api/trials",
    "/api/trials/table?form=csv",
    "/api/videos",
    "/api/videos?deleted=true",
    "/api/setups",
    "/api/setups?deleted=true",
    "/api/cameras",
    "/api/learning",
    "/api/learning/sets",
    "/api/published",
    "/api/published/t4-2",
    "/api/simulations/sets?robot=deltawalker",
    "/api/gaits",
    "/api/gaits/deleted",
    "/api/gaits/walk-kept",
    "/api/gaits/walk-kept/versions",
    "/api/gaits/walk-kept/approvals",
    "/api/atlases",
    "/api/robot",
    "/api/robot/ports",
    "/api/health",
    "/api/storage/unreadable",
)
"""Addresses that show what is kept."""


def whole_folder(folder: Path) -> Path:
    """A data folder of today's form with rows in every table; its database."""
    data = unpack(ARCHIVE, folder).data
    Database(data / DATABASE).close()
    return data / DATABASE


def columns_of(connection: sqlite3.Connection, table: str) -> list[str]:
    """The columns of a table, but for numbers that the database gives itself."""
    found = connection.execute(f"PRAGMA table_info({table})").fetchall()
    return [
        name for _, name, kind, *_ in found if (name, kind) != ("number", "INTEGER") or table == "version"
    ]


def damage_each_column(database: Path, damage: Any) -> int:
    """Adds to each table a copy of a row for each column, in which this column is damaged; how many."""
    count = 0
    with closing(sqlite3.connect(database)) as connection, connection:
        for table in TABLES:
            columns = columns_of(connection, table)
            size = f"length(CAST({columns[-1]} AS BLOB))"
            row = connection.execute(
                f"SELECT {', '.join(columns)} FROM {table} ORDER BY {size} LIMIT 1"
            ).fetchone()
            for index in range(len(columns) if row else 0):
                count += _insert(connection, table, columns, _copy(row, index, damage, count))
    return count


def _copy(row: tuple[Any, ...], index: int, damage: Any, count: int) -> list[Any]:
    """A row under another name, with a damage in a column."""
    name = row[0] if isinstance(row[0], str) else None
    copy = [
        value.replace(name, f"{count:012d}") if name and isinstance(value, str) else value for value in row
    ]
    copy[index] = damage
    return copy


def _insert(connection: sqlite3.Connection, table: str, columns: list[str], row: list[Any]) -> int:
    places = ", ".join("CAST(? AS TEXT)" if isinstance(value, memoryview) else "?" for value in row)
    values = [bytes(value) if isinstance(value, memoryview) else value for value in row]
    query = f"INSERT OR IGNORE INTO {table}({', '.join(columns)}) VALUES({places})"
    return connection.execute(query, values).rowcount


def damage_all(database: Path, table: str, damage: Any) -> None:
    """Damages every column of every row of a table, but for the keys."""
    place = "CAST(? AS TEXT)" if isinstance(damage, memoryview) else "?"
    value = bytes(damage) if isinstance(damage, memoryview) else damage
    with closing(sqlite3.connect(database)) as connection, connection:
        for _, name, _, _, _, is_key in connection.execute(f"PRAGMA table_info({table})").fetchall():
            if not is_key:
                connection.execute(f"UPDATE {table} SET {name}={place}", (value,))


def parts(content: Any, path: tuple[Any, ...] = (), depth: int = 2) -> Iterator[tuple[Any, ...]]:
    """The paths to the values of JSON content; of a list, to its first one."""
    entries = content.items() if isinstance(content, dict) else enumerate(content[:1])
    for key, value in entries:
        yield (*path, key)
        if depth and isinstance(value, dict | list):
            yield from parts(value, (*path, key), depth - 1)
