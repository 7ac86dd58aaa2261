"""How cameras see the platform, and what each camera is for, in the database."""

import json
from dataclasses import dataclass

from app.common.json import Json
from app.store.database import Database

_NEWEST = """
SELECT s.id, s.revision, s.made, s.content, d.deleted FROM camera_setup s
JOIN (SELECT id, MAX(revision) AS last FROM camera_setup GROUP BY id) n ON n.id = s.id AND n.last = s.revision
LEFT JOIN camera_setup_deleted d ON d.id = s.id
"""


@dataclass(frozen=True)
class CameraSetupRow:
    """A revision of a setup as it is kept."""

    id: str
    revision: int
    made: float
    content: Json
    is_deleted: bool


class CameraSetupStore:
    """Every revision of every setup, and the cameras' settings.

    Args:
        database: where they are kept.
    """

    def __init__(self, database: Database) -> None:
        self._database = database

    def found(self, *, is_deleted: bool = False) -> tuple[CameraSetupRow, ...]:
        """The newest revision of each setup, the last changed first."""
        rows = (_row(*row) for row in self._database.rows(_NEWEST + "ORDER BY s.rowid DESC"))
        return tuple(row for row in rows if row.is_deleted == is_deleted)

    def get(self, setup: str, revision: int | None = None) -> CameraSetupRow | None:
        """A setup, also a deleted one, at a revision or its newest; None where there is none."""
        if revision is None:
            rows = self._database.rows(_NEWEST + "WHERE s.id=?", setup)
        else:
            query = (
                "SELECT s.id, s.revision, s.made, s.content, d.deleted FROM camera_setup s "
                "LEFT JOIN camera_setup_deleted d ON d.id = s.id WHERE s.id=? AND s.revision=?"
            )
            rows = self._database.rows(query, setup, revision)
        return _row(*rows[0]) if rows else None

    def add(self, setup: str, revision: int, made: float, content: Json) -> None:
        """Stores a new revision.

        Raises:
            sqlite3.IntegrityError: there is that revision already.
        """
        with self._database.writing() as connection:
            connection.execute(
                "INSERT INTO camera_setup VALUES(?,?,?,?)",
                (setup, revision, made, json.dumps(content, allow_nan=False)),
            )

    def put_deleted(self, setup: str, deleted: float | None) -> None:
        """Takes a setup out of the list, or brings it back with None."""
        with self._database.writing() as connection:
            if deleted is None:
                connection.execute("DELETE FROM camera_setup_deleted WHERE id=?", (setup,))
            else:
                connection.execute(
                    "INSERT OR REPLACE INTO camera_setup_deleted VALUES(?,?)", (setup, deleted)
                )

    def cameras(self) -> dict[str, Json]:
        """What each camera is for."""
        return {key: json.loads(text) for key, text in self._database.rows("SELECT id, content FROM camera")}

    def put_camera(self, camera: str, content: Json) -> None:
        """Stores what a camera is for."""
        with self._database.writing() as connection:
            connection.execute("INSERT OR REPLACE INTO camera VALUES(?,?)", (camera, json.dumps(content)))


def _row(setup: str, revision: int, made: float, content: str, deleted: float | None) -> CameraSetupRow:
    return CameraSetupRow(setup, revision, made, json.loads(content), deleted is not None)
