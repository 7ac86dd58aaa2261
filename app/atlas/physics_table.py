"""The table of an atlas file with what physics made of its gaits; a file may lack it."""

import math
import sqlite3
from collections.abc import Sequence

from app.atlas.stored_values import StoredValues
from core.atlas.physics_row import PHYSICS_FIGURES, PhysicsRow

MOST_VARIATIONS = 1_000_000
"""Of a gait that was simulated."""
PHYSICS_TABLE = f"""
CREATE TABLE IF NOT EXISTS physics (
    id INTEGER PRIMARY KEY,
    variations INTEGER NOT NULL,
    reason TEXT NOT NULL,
    {", ".join(f"{name} REAL" for name in PHYSICS_FIGURES)}
)
"""
_COLUMNS = ("id", "variations", "reason", *PHYSICS_FIGURES)


def physics_rows(connection: sqlite3.Connection, values: StoredValues) -> dict[int, PhysicsRow]:
    """What physics made of the gaits that were simulated, by their numbers; none where there is no table.

    Args:
        connection: to the file, which is not changed.
        values: looks at what the file holds.

    Raises:
        InputError: a value cannot be one of an atlas.
    """
    query = "SELECT count(*) FROM sqlite_master WHERE type = 'table' AND name = 'physics'"
    if not connection.execute(query).fetchone()[0]:
        return {}
    found = connection.execute(f"SELECT {', '.join(_COLUMNS)} FROM physics ORDER BY id")
    return {row.number: row for row in (_row(stored, values) for stored in found)}


def store_physics_row(connection: sqlite3.Connection, row: PhysicsRow) -> None:
    """Stores what physics made of a gait, in one transaction; makes the table where the file lacks it.

    Args:
        connection: to the file.
        row: takes the place of an earlier one.
    """
    figures = (None if math.isnan(value) else value for value in row.figures.values())
    places = ", ".join("?" * len(_COLUMNS))
    with connection:
        connection.execute(PHYSICS_TABLE)
        connection.execute(
            f"INSERT OR REPLACE INTO physics VALUES ({places})",
            (row.number, row.variations, row.reason, *figures),
        )


def _row(stored: Sequence[object], values: StoredValues) -> PhysicsRow:
    number = values.number(stored[0])
    figures = {
        name: values.figure(value, f"{name} of gait {number}")
        for name, value in zip(PHYSICS_FIGURES, stored[3:], strict=True)
    }
    return PhysicsRow(
        number,
        values.whole(stored[1], f"the variations of gait {number}", 1, MOST_VARIATIONS),
        values.text(stored[2], f"the reason of gait {number}"),
        **figures,
    )
