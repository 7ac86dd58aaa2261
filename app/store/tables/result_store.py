"""Checked results of solvers in the database, by the hash of what they are."""

import json
from dataclasses import dataclass

from app.common.json import Json
from app.store.database import Database
from app.store.tables.contents import RESULT
from app.store.tables.shapes import Stored, text
from app.store.tables.table import Table, TableKind


@dataclass(frozen=True)
class ResultRow:
    """A result as it is kept."""

    motion: str
    content: Json


RESULTS = TableKind(
    "result", "optimised motion", ("motion",), {"motion": text, "content": Stored(RESULT)}, ResultRow
)


class ResultStore:
    """The results; any thread may ask.

    Args:
        database: where they are kept.
    """

    def __init__(self, database: Database) -> None:
        self._database, self._table = database, Table(database, RESULTS)

    def get(self, motion: str) -> Json | None:
        """The result for a hash; None where there is none, or it cannot be read and has to be found anew."""
        rows = self._table.select("WHERE motion=?", motion).rows
        return rows[0].content if rows else None

    def put(self, motion: str, content: Json) -> None:
        """Stores a checked result in place of an earlier one."""
        with self._database.writing() as connection:
            connection.execute(
                "INSERT OR REPLACE INTO result VALUES(?,?)", (motion, json.dumps(content, allow_nan=False))
            )
