"""Simulations in the database: the newest ones of each gait, by what was simulated."""

import json
from dataclasses import dataclass

from app.common.json import Json
from app.store.database import Database

MOST_KEPT = 100
"""Simulations that are kept, about 0.2 MB each; the oldest go."""


@dataclass(frozen=True)
class SimulationRow:
    """What is known of a simulation without its states.

    Args:
        gait: which gait it is of.
        key: hash of everything that was simulated.
        waypoints: content hash of the waypoints.
        physics: name of the physics set.
        made: when, s since the epoch.
    """

    gait: str
    key: str
    waypoints: str
    physics: str
    made: float


class SimulationStore:
    """Everything that is kept of simulations; any thread may ask.

    Args:
        database: where it is kept.
    """

    def __init__(self, database: Database) -> None:
        self._database = database

    def put(self, row: SimulationRow, content: Json) -> None:
        """Stores a simulation in place of one of the same."""
        text = json.dumps(content, allow_nan=False)
        with self._database.writing() as connection:
            connection.execute(
                "INSERT OR REPLACE INTO simulation VALUES(?,?,?,?,?,?)",
                (row.gait, row.key, row.waypoints, row.physics, row.made, text),
            )
            connection.execute(
                "DELETE FROM simulation WHERE rowid NOT IN "
                "(SELECT rowid FROM simulation ORDER BY rowid DESC LIMIT ?)",
                (MOST_KEPT,),
            )

    def of_gait(self, gait_id: str) -> tuple[SimulationRow, ...]:
        """The simulations of a gait, the newest first."""
        return self._rows("gait=?", gait_id)

    def of_waypoints(self, waypoints: str) -> tuple[SimulationRow, ...]:
        """The simulations of waypoints, of whatever gait they are, the newest first."""
        return self._rows("waypoints=?", waypoints)

    def content(self, key: str) -> Json | None:
        """A simulation with its states; None where there is none, or it was long ago."""
        rows = self._database.rows("SELECT content FROM simulation WHERE key=? ORDER BY rowid DESC", key)
        return json.loads(rows[0][0]) if rows else None

    def _rows(self, where: str, value: str) -> tuple[SimulationRow, ...]:
        found = self._database.rows(
            f"SELECT gait, key, waypoints, physics, made FROM simulation WHERE {where} ORDER BY rowid DESC",
            value,
        )
        return tuple(SimulationRow(*row) for row in found)
