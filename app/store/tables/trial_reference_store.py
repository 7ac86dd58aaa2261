"""The database's record of what a trial's robot was sent, and of its simulated feet, for comparison."""

import json
from dataclasses import dataclass

from app.common.json import Json
from app.store.database import Database
from app.store.tables.contents import TRIAL_SENT, TRIAL_SIMULATED
from app.store.tables.shapes import Stored, text
from app.store.tables.table import Table, TableKind


@dataclass(frozen=True)
class SentRow:
    """What a trial's robot was sent."""

    trial: str
    content: Json


@dataclass(frozen=True)
class SimulatedRow:
    """The simulated feet of a trial; `key` is the hash of everything that was simulated."""

    trial: str
    key: str
    content: Json


SENT = TableKind(
    "trial_sent",
    "record of what was sent",
    ("trial",),
    {"trial": text, "content": Stored(TRIAL_SENT)},
    SentRow,
)
SIMULATED = TableKind(
    "trial_simulated",
    "simulation of the trial",
    ("trial",),
    {"trial": text, "key": text, "content": Stored(TRIAL_SIMULATED)},
    SimulatedRow,
)


class TrialReferenceStore:
    """Everything that is kept beside trials but photos; any thread may ask.

    Args:
        database: where it is kept.
    """

    def __init__(self, database: Database) -> None:
        self._database = database
        self._sent, self._simulated = Table(database, SENT), Table(database, SIMULATED)

    def put_sent(self, trial: str, content: Json) -> None:
        """Stores what the robot was sent in a trial."""
        with self._database.writing() as connection:
            text = json.dumps(content, allow_nan=False)
            connection.execute("INSERT OR REPLACE INTO trial_sent VALUES(?,?)", (trial, text))

    def sent(self, trial: str) -> Json | None:
        """What the robot was sent; None where that is not known.

        Raises:
            DamagedRowError: it cannot be read.
        """
        row = self._sent.first("WHERE trial=?", trial)
        return None if row is None else row.content

    def put_simulated(self, trial: str, key: str, content: Json) -> None:
        """Stores a trial's simulated feet in place of others.

        Args:
            trial: its id.
            key: hash of everything that was simulated.
            content: the feet.
        """
        with self._database.writing() as connection:
            text = json.dumps(content, allow_nan=False)
            connection.execute("INSERT OR REPLACE INTO trial_simulated VALUES(?,?,?)", (trial, key, text))

    def simulated(self, trial: str) -> tuple[str, Json] | None:
        """Key and content of a trial's simulated feet; None where none can be read."""
        rows = self._simulated.select("WHERE trial=?", trial).rows
        return (rows[0].key, rows[0].content) if rows else None
