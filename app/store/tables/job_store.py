"""The list of jobs in the database."""

import json
from dataclasses import dataclass

from app.common.json import Json
from app.store.database import Database
from app.store.tables.contents import JOB
from app.store.tables.shapes import Stored, text
from app.store.tables.table import Selection, Table, TableKind, key_of


@dataclass(frozen=True)
class JobRow:
    """A job as it is kept."""

    id: str
    content: Json

    def __post_init__(self) -> None:
        key_of(self, self.content, "id")


JOBS = TableKind("job", "job", ("id",), {"id": text, "content": Stored(JOB)}, JobRow)


class JobStore:
    """The jobs that are kept; any thread may ask.

    Args:
        database: where they are kept.
    """

    def __init__(self, database: Database) -> None:
        self._database, self._table = database, Table(database, JOBS)

    def newest(self, most: int) -> Selection[JobRow]:
        """The newest jobs, the newest first."""
        return self._table.select("ORDER BY rowid DESC LIMIT ?", most)

    def get(self, job_id: str) -> Json | None:
        """A job as it was stored; None where there is none of that id.

        Raises:
            DamagedRowError: it cannot be read.
        """
        row = self._table.first("WHERE id=?", job_id)
        return None if row is None else row.content

    def put(self, content: Json) -> None:
        """Stores a job as it is now."""
        with self._database.writing() as connection:
            connection.execute(
                "INSERT INTO job(id, created, content) VALUES(?,?,?) "
                "ON CONFLICT(id) DO UPDATE SET content=excluded.content",
                (content["id"], content["created"], json.dumps(content, allow_nan=False)),
            )
