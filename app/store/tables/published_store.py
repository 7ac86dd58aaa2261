"""Computed figures of the published tables' gaits, by the hash of everything that they depend on."""

import json
from dataclasses import dataclass

from app.common.json import Json
from app.store.database import Database
from app.store.tables.contents import PUBLISHED
from app.store.tables.shapes import Stored, text
from app.store.tables.table import Table, TableKind

MOST_KEPT = 400
"""Figures that are kept, about 30 kB each at most; the oldest go. All tables have some 130 of a version."""


@dataclass(frozen=True)
class FiguresRow:
    """Figures as they are kept."""

    key: str
    content: Json


FIGURES = TableKind(
    "published",
    "figures of a published gait",
    ("key",),
    {"key": text, "content": Stored(PUBLISHED)},
    FiguresRow,
)


class PublishedStore:
    """The figures; any thread may ask.

    What cannot be read counts as never computed, since it can be computed again.

    Args:
        database: where they are kept.
    """

    def __init__(self, database: Database) -> None:
        self._database, self._table = database, Table(database, FIGURES)

    def all(self) -> dict[str, Json]:
        """Everything that is kept, by its key."""
        return {row.key: row.content for row in self._table.select().rows}

    def put(self, key: str, made: float, content: Json) -> None:
        """Stores figures in place of earlier ones of the same.

        Args:
            key: hash of everything that they depend on.
            made: the present time, s since the epoch.
            content: the figures.
        """
        with self._database.writing() as connection:
            connection.execute(
                "INSERT OR REPLACE INTO published VALUES(?,?,?)",
                (key, made, json.dumps(content, allow_nan=False)),
            )
            connection.execute(
                "DELETE FROM published WHERE rowid NOT IN "
                "(SELECT rowid FROM published ORDER BY rowid DESC LIMIT ?)",
                (MOST_KEPT,),
            )
