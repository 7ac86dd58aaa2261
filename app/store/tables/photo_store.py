"""Photos of trials in the database: what is known of each; the pictures are files."""

import json
from dataclasses import dataclass

from app.common.json import Json
from app.store.database import Database
from app.store.tables.contents import PHOTO
from app.store.tables.shapes import MOMENT, Maybe, Stored, text
from app.store.tables.table import Selection, Table, TableKind, key_of


@dataclass(frozen=True)
class PhotoRow:
    """A photo as it is kept."""

    id: str
    trial: str
    content: Json
    deleted: float | None

    def __post_init__(self) -> None:
        key_of(self, self.content, "id", "trial")


PHOTOS = TableKind(
    "trial_photo",
    "photo",
    ("id",),
    {"id": text, "trial": text, "content": Stored(PHOTO), "deleted": Maybe(MOMENT)},
    PhotoRow,
)


class PhotoStore:
    """What is kept of photos; any thread may ask.

    Args:
        database: where it is kept.
    """

    def __init__(self, database: Database) -> None:
        self._database, self._table = database, Table(database, PHOTOS)

    def add(self, content: Json) -> None:
        """Stores a new photo of `content["trial"]`."""
        with self._database.writing() as connection:
            connection.execute(
                "INSERT INTO trial_photo(id, trial, made, content) VALUES(?,?,?,?)",
                (content["id"], content["trial"], content["made"], json.dumps(content, allow_nan=False)),
            )

    def of_trial(self, trial: str) -> Selection[PhotoRow]:
        """A trial's photos that are not deleted, in the order in which they came."""
        return self._table.select("WHERE trial=? AND deleted IS NULL ORDER BY rowid", trial)

    def get(self, trial: str, photo: str) -> PhotoRow | None:
        """One photo, also a deleted one; None where the trial has none of that id.

        Raises:
            DamagedRowError: it cannot be read.
        """
        return self._table.first("WHERE id=? AND trial=?", photo, trial)

    def change(self, content: Json) -> None:
        """Stores what is known of a photo now."""
        with self._database.writing() as connection:
            text = json.dumps(content, allow_nan=False)
            connection.execute("UPDATE trial_photo SET content=? WHERE id=?", (text, content["id"]))

    def put_deleted(self, photo: str, deleted: float | None) -> None:
        """Takes a photo away, or brings it back with None."""
        self._table.put_deleted(deleted, id=photo)
