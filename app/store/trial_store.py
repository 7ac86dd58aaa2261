"""Trials in the database."""

import json
from dataclasses import dataclass

from app.common.json import Json
from app.store.database import Database


@dataclass(frozen=True)
class TrialRow:
    """A trial as it is kept: what is known of it, its track as text in cm, and whether it was deleted."""

    content: Json
    track: str
    is_deleted: bool


class TrialStore:
    """Everything that is kept of trials.

    Args:
        database: where it is kept.
    """

    def __init__(self, database: Database) -> None:
        self._database = database

    def found(self) -> tuple[TrialRow, ...]:
        """All trials that are not deleted, the newest first."""
        rows = self._database.rows(
            "SELECT content, track, deleted FROM trial WHERE deleted IS NULL ORDER BY rowid DESC"
        )
        return tuple(_row(*row) for row in rows)

    def get(self, trial: str) -> TrialRow | None:
        """One trial, also a deleted one; None where there is none."""
        rows = self._database.rows("SELECT content, track, deleted FROM trial WHERE id=?", trial)
        return _row(*rows[0]) if rows else None

    def add(self, content: Json, track: str) -> None:
        """Stores a new trial."""
        with self._database.writing() as connection:
            connection.execute(
                "INSERT INTO trial(id, made, content, track) VALUES(?,?,?,?)",
                (content["id"], content["made"], json.dumps(content, allow_nan=False), track),
            )

    def change(self, content: Json, revision: int) -> bool:
        """Stores what is known of a trial now; False where it is deleted, or no longer of this revision.

        Args:
            content: with the next revision.
            revision: that the trial must have; trials that were never changed have 1.
        """
        with self._database.writing() as connection:
            text = json.dumps(content, allow_nan=False)
            changed = connection.execute(
                "UPDATE trial SET content=? WHERE id=? AND deleted IS NULL "
                "AND coalesce(json_extract(content, '$.revision'), 1)=?",
                (text, content["id"], revision),
            )
            return changed.rowcount == 1

    def put_deleted(self, trial: str, deleted: float | None) -> None:
        """Takes a trial out of every list, or brings it back with None; nothing of it is lost."""
        with self._database.writing() as connection:
            connection.execute("UPDATE trial SET deleted=? WHERE id=?", (deleted, trial))


def _row(content: str, track: str, deleted: float | None) -> TrialRow:
    return TrialRow(json.loads(content), track, deleted is not None)
