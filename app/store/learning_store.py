"""Learning runs and the named sets of physics parameters, in the database."""

import json

from app.common.json import Json
from app.store.database import Database


class LearningStore:
    """Everything that is kept of learning; any thread may ask.

    Args:
        database: where it is kept.
    """

    def __init__(self, database: Database) -> None:
        self._database = database

    def put(self, content: Json) -> None:
        """Stores a course of learning as it is now."""
        with self._database.writing() as connection:
            text = json.dumps(content, allow_nan=False)
            connection.execute(
                "INSERT INTO learning(id, made, content) VALUES(?,?,?) "
                "ON CONFLICT(id) DO UPDATE SET content=excluded.content",
                (content["id"], content["made"], text),
            )

    def found(self, most: int) -> list[Json]:
        """The newest courses of learning, the newest first."""
        rows = self._database.rows("SELECT content FROM learning ORDER BY rowid DESC LIMIT ?", most)
        return [json.loads(row[0]) for row in rows]

    def get(self, learning: str) -> Json | None:
        """One of them; None where there is none."""
        rows = self._database.rows("SELECT content FROM learning WHERE id=?", learning)
        return json.loads(rows[0][0]) if rows else None

    def add_set(self, name: str, content: Json) -> int:
        """Stores a set of parameters as the next version of a name, which it is told."""
        with self._database.writing() as connection:
            newest = connection.execute("SELECT MAX(version) FROM physics_set WHERE name=?", (name,))
            version = int(newest.fetchone()[0] or 0) + 1
            text = json.dumps({**content, "version": version}, allow_nan=False)
            connection.execute(
                "INSERT INTO physics_set(name, version, made, content) VALUES(?,?,?,?)",
                (name, version, content["made"], text),
            )
        return version

    def sets(self, *, deleted: bool = False) -> list[Json]:
        """All sets, or the deleted ones, the newest first."""
        which = "NOT NULL" if deleted else "NULL"
        rows = self._database.rows(
            f"SELECT content FROM physics_set WHERE deleted IS {which} ORDER BY rowid DESC"
        )
        return [json.loads(row[0]) for row in rows]

    def put_set_deleted(self, name: str, version: int, deleted: float | None) -> bool:
        """Takes a set out of every list, or brings it back with None; whether there is one."""
        with self._database.writing() as connection:
            done = connection.execute(
                "UPDATE physics_set SET deleted=? WHERE name=? AND version=?", (deleted, name, version)
            )
        return done.rowcount == 1
