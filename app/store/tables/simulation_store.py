"""Simulations in the database: the newest ones of each gait, by what was simulated."""

import json
from dataclasses import dataclass

from app.common.json import Json
from app.store.database import Database
from app.store.tables.contents import SIMULATION
from app.store.tables.shapes import MOMENT, Shape, Stored, text
from app.store.tables.table import Table, TableKind, key_of

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


@dataclass(frozen=True)
class SimulationContent:
    """A simulation with its states."""

    key: str
    content: Json

    def __post_init__(self) -> None:
        key_of(self, self.content, "key")


_KEYS: dict[str, Shape] = {"gait": text, "key": text, "waypoints": text, "physics": text, "made": MOMENT}
SIMULATIONS = TableKind("simulation", "simulation", ("gait", "key"), _KEYS, SimulationRow)
SIMULATION_CONTENTS = TableKind(
    "simulation",
    "simulation",
    ("gait", "key"),
    {"key": text, "content": Stored(SIMULATION)},
    SimulationContent,
)


class SimulationStore:
    """Everything that is kept of simulations; any thread may ask.

    What cannot be read counts as never simulated, since it can be simulated again.

    Args:
        database: where it is kept.
    """

    def __init__(self, database: Database) -> None:
        self._database = database
        self._rows, self._contents = Table(database, SIMULATIONS), Table(database, SIMULATION_CONTENTS)

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
        return self._rows.select("WHERE gait=? ORDER BY rowid DESC", gait_id).rows

    def of_waypoints(self, waypoints: str) -> tuple[SimulationRow, ...]:
        """The simulations of waypoints, of whatever gait they are, the newest first."""
        return self._rows.select("WHERE waypoints=? ORDER BY rowid DESC", waypoints).rows

    def content(self, key: str) -> Json | None:
        """A simulation with its states; None where there is none, or it was long ago."""
        rows = self._contents.select("WHERE key=? ORDER BY rowid DESC", key).rows
        return rows[0].content if rows else None
