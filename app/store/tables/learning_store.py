"""Learning runs and the named sets of physics parameters, in the database."""

import json
from collections.abc import Callable
from dataclasses import dataclass

from app.common.json import Json
from app.store.database import Database
from app.store.tables.contents import LEARNING, PHYSICS_SET
from app.store.tables.shapes import MOMENT, WHOLE, Maybe, Stored, text
from app.store.tables.table import Selection, Table, TableKind, View, key_of


@dataclass(frozen=True)
class LearningRow:
    """A course of learning as it is kept."""

    id: str
    content: Json

    def __post_init__(self) -> None:
        key_of(self, self.content, "id")


@dataclass(frozen=True)
class PhysicsSetRow:
    """A set of parameters as it is kept."""

    name: str
    version: int
    deleted: float | None
    content: Json

    def __post_init__(self) -> None:
        key_of(self, self.content, "name", "version")


COURSES = TableKind(
    "learning", "learning job", ("id",), {"id": text, "content": Stored(LEARNING)}, LearningRow
)
PHYSICS_SETS = TableKind(
    "physics_set",
    "set of learned parameters",
    ("name", "version"),
    {"name": text, "version": WHOLE, "deleted": Maybe(MOMENT), "content": Stored(PHYSICS_SET)},
    PhysicsSetRow,
)


class LearningStore:
    """Everything that is kept of learning; any thread may ask.

    Args:
        database: where it is kept.
    """

    def __init__(self, database: Database) -> None:
        self._database = database
        self._courses, self._sets = Table(database, COURSES), Table(database, PHYSICS_SETS)

    def put(self, content: Json) -> None:
        """Stores a course of learning as it is now."""
        with self._database.writing() as connection:
            text = json.dumps(content, allow_nan=False)
            connection.execute(
                "INSERT INTO learning(id, made, content) VALUES(?,?,?) "
                "ON CONFLICT(id) DO UPDATE SET content=excluded.content",
                (content["id"], content["made"], text),
            )

    def newest(self, most: int) -> Selection[LearningRow]:
        """The newest courses of learning, the newest first."""
        return self._courses.select("ORDER BY rowid DESC LIMIT ?", most)

    def get(self, learning: str) -> Json | None:
        """One of them; None where there is none.

        Raises:
            DamagedRowError: it cannot be read.
        """
        row = self._courses.first("WHERE id=?", learning)
        return None if row is None else row.content

    def add_set(self, name: str, content: Json) -> int:
        """Stores a set of parameters as the next version of a name; returns the version."""
        with self._database.writing() as connection:
            newest = connection.execute(
                "SELECT MAX(version) FROM physics_set WHERE name=? AND typeof(version)='integer'", (name,)
            )
            version = int(newest.fetchone()[0] or 0) + 1
            text = json.dumps({**content, "version": version}, allow_nan=False)
            connection.execute(
                "INSERT INTO physics_set(name, version, made, content) VALUES(?,?,?,?)",
                (name, version, content["made"], text),
            )
        return version

    def sets(self, view: Callable[[Json], View], *, deleted: bool = False) -> Selection[View]:
        """All sets, or the deleted ones, the newest first.

        Args:
            view: makes of a set's content what is wanted.
            deleted: the deleted ones.
        """
        which = "NOT NULL" if deleted else "NULL"
        return self._sets.viewed(
            lambda row: view(row.content), f"WHERE deleted IS {which} ORDER BY rowid DESC"
        )

    def put_set_deleted(self, name: str, version: int, deleted: float | None) -> bool:
        """Takes a set out of every list, or brings it back with None; tells whether there is one."""
        return self._sets.put_deleted(deleted, name=name, version=version)
