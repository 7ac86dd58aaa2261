"""What the database keeps with trials for comparison: what the robot was sent, and the simulated feet."""

import json

from app.common.json import Json
from app.store.database import Database


class TrialReferenceStore:
    """Everything that is kept beside trials but photos; any thread may ask.

    Args:
        database: where it is kept.
    """

    def __init__(self, database: Database) -> None:
        self._database = database

    def put_sent(self, trial: str, content: Json) -> None:
        """Stores what the robot was sent in a trial."""
        with self._database.writing() as connection:
            text = json.dumps(content, allow_nan=False)
            connection.execute("INSERT OR REPLACE INTO trial_sent VALUES(?,?)", (trial, text))

    def sent(self, trial: str) -> Json | None:
        """What the robot was sent; None where that is not known."""
        rows = self._database.rows("SELECT content FROM trial_sent WHERE trial=?", trial)
        return json.loads(rows[0][0]) if rows else None

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
        """Key and content of a trial's simulated feet; None where there are none."""
        rows = self._database.rows("SELECT key, content FROM trial_simulated WHERE trial=?", trial)
        return (rows[0][0], json.loads(rows[0][1])) if rows else None
