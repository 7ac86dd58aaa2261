"""How cameras see the platform, and what each camera is for, in the database."""

import json
from dataclasses import dataclass

from app.common.json import Json
from app.store.database import Database
from app.store.row_damage import RowDamage
from app.store.tables.contents import CAMERA, SETUP
from app.store.tables.shapes import COUNT, MOMENT, Maybe, Stored, text
from app.store.tables.table import Table, TableKind


@dataclass(frozen=True)
class CameraSetupRow:
    """A revision of a setup as it is kept."""

    id: str
    revision: int
    made: float
    content: Json


@dataclass(frozen=True)
class DeletedSetup:
    """A setup that is deleted, and when, s since the epoch."""

    id: str
    deleted: float | None


@dataclass(frozen=True)
class CameraRow:
    """What a camera is for."""

    id: str
    content: Json


SETUPS = TableKind(
    "camera_setup",
    "camera setup",
    ("id", "revision"),
    {"id": text, "revision": COUNT, "made": MOMENT, "content": Stored(SETUP)},
    CameraSetupRow,
)
DELETED_SETUPS = TableKind(
    "camera_setup_deleted",
    "deletion of a camera setup",
    ("id",),
    {"id": text, "deleted": Maybe(MOMENT)},
    DeletedSetup,
)
CAMERAS = TableKind("camera", "camera", ("id",), {"id": text, "content": Stored(CAMERA)}, CameraRow)


class CameraSetupStore:
    """Every revision of every setup, and the cameras' settings.

    Args:
        database: where they are kept.
    """

    def __init__(self, database: Database) -> None:
        self._database = database
        self._setups, self._cameras = Table(database, SETUPS), Table(database, CAMERAS)
        self._deleted = Table(database, DELETED_SETUPS)

    def newest(self) -> tuple[tuple[CameraSetupRow, ...], tuple[RowDamage, ...]]:
        """The newest revision of each setup, the last changed first, and revisions that cannot be read.

        A setup whose newest revision cannot be read goes by none: an older one would be another setup.
        """
        selection = self._setups.select("ORDER BY rowid DESC")
        newest: dict[str, CameraSetupRow] = {}
        for row in selection.rows:
            if row.id not in newest or newest[row.id].revision < row.revision:
                newest[row.id] = row
        unknown = {damage.key.rpartition(" of ")[2] for damage in selection.damaged}
        return tuple(row for row in newest.values() if row.id not in unknown), selection.damaged

    def deleted(self) -> frozenset[str]:
        """Ids of the setups that are deleted; one whose deletion cannot be read is."""
        selection = self._deleted.select()
        gone = {row.id for row in selection.rows if row.deleted is not None}
        return frozenset({*gone, *(damage.key for damage in selection.damaged)})

    def get(self, setup: str, revision: int | None = None) -> CameraSetupRow | None:
        """A setup, also a deleted one, at a revision or its newest; None where there is none.

        Raises:
            DamagedRowError: it cannot be read.
        """
        if revision is None:
            return self._setups.first("WHERE id=? ORDER BY revision DESC", setup)
        return self._setups.first("WHERE id=? AND revision=?", setup, revision)

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
        """What each camera is for; one that cannot be read is for nothing."""
        return {row.id: row.content for row in self._cameras.select().rows}

    def put_camera(self, camera: str, content: Json) -> None:
        """Stores what a camera is for."""
        with self._database.writing() as connection:
            connection.execute("INSERT OR REPLACE INTO camera VALUES(?,?)", (camera, json.dumps(content)))
