"""Photos of trials in the database: what is known of each; the pictures are files."""

import json

from app.common.json import Json
from app.store.database import Database


class PhotoStore:
    """What is kept of photos; any thread may ask.

    Args:
        database: where it is kept.
    """

    def __init__(self, database: Database) -> None:
        self._database = database

    def add(self, content: Json) -> None:
        """Stores a new photo of `content["trial"]`."""
        with self._database.writing() as connection:
            connection.execute(
                "INSERT INTO trial_photo(id, trial, made, content) VALUES(?,?,?,?)",
                (content["id"], content["trial"], content["made"], json.dumps(content, allow_nan=False)),
            )

    def of_trial(self, trial: str) -> list[Json]:
        """A trial's photos that are not deleted, in the order in which they came."""
        rows = self._database.rows(
            "SELECT content FROM trial_photo WHERE trial=? AND deleted IS NULL ORDER BY rowid", trial
        )
        return [json.loads(row[0]) for row in rows]

    def get(self, trial: str, photo: str) -> Json | None:
        """One photo, also a deleted one; None where the trial has none of that id."""
        rows = self._database.rows("SELECT content FROM trial_photo WHERE id=? AND trial=?", photo, trial)
        return json.loads(rows[0][0]) if rows else None

    def change(self, content: Json) -> None:
        """Stores what is known of a photo now."""
        with self._database.writing() as connection:
            text = json.dumps(content, allow_nan=False)
            connection.execute("UPDATE trial_photo SET content=? WHERE id=?", (text, content["id"]))

    def put_deleted(self, photo: str, deleted: float | None) -> None:
        """Takes a photo away, or brings it back with None."""
        with self._database.writing() as connection:
            connection.execute("UPDATE trial_photo SET deleted=? WHERE id=?", (deleted, photo))
