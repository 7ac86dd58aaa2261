"""Trials in the database."""

import json
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from app.common.json import Json
from app.store.database import Database
from app.store.tables.contents import TRIAL
from app.store.tables.shapes import MOMENT, Maybe, ShapeError, Stored, text
from app.store.tables.table import Selection, Table, TableKind, View, json_of, key_of


@dataclass(frozen=True)
class TrialRow:
    """A trial as it is kept: what is known of it, its track as text in cm, and when it was deleted."""

    id: str
    content: Json
    track: str
    deleted: float | None = None

    def __post_init__(self) -> None:
        key_of(self, self.content, "id")

    @property
    def is_deleted(self) -> bool:
        """Whether it is in no list."""
        return self.deleted is not None


def _trial(**columns: Any) -> TrialRow:
    row = TrialRow(**columns)
    ends, count = row.content.get("ends"), row.content["iterations"]
    if ends is not None and len(ends) != count:
        raise ShapeError("content.ends", f"has {len(ends)} ends of {count} iterations")
    return row


TRIALS = TableKind(
    "trial",
    "trial",
    ("id",),
    {"id": text, "content": Stored(TRIAL), "track": text, "deleted": Maybe(MOMENT)},
    _trial,
)


class TrialStore:
    """Everything that is kept of trials.

    Args:
        database: where it is kept.
    """

    def __init__(self, database: Database) -> None:
        self._database, self._table = database, Table(database, TRIALS)

    def listed(self, view: Callable[[TrialRow], View]) -> Selection[View]:
        """All trials that are not deleted, the newest first.

        Args:
            view: makes of each what is wanted.
        """
        return self._table.viewed(view, "WHERE deleted IS NULL ORDER BY rowid DESC")

    def get(self, trial: str) -> TrialRow | None:
        """One trial, also a deleted one; None where there is none.

        Raises:
            DamagedRowError: it cannot be read.
        """
        return self._table.first("WHERE id=?", trial)

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
                f"AND coalesce({json_of('$.revision')}, 1)=?",
                (text, content["id"], revision),
            )
            return changed.rowcount == 1

    def put_deleted(self, trial: str, deleted: float | None) -> bool:
        """Takes a trial out of every list, or brings it back with None; tells whether there is one."""
        return self._table.put_deleted(deleted, id=trial)
