"""The table of an atlas file with what physics made of its gaits; a file may lack it."""

import math
import sqlite3

from core.atlas.physics_row import PHYSICS_FIGURES, PhysicsRow

_TABLE = f"""
CREATE TABLE IF NOT EXISTS physics (
    id INTEGER PRIMARY KEY,
    variations INTEGER NOT NULL,
    reason TEXT NOT NULL,
    {", ".join(f"{name} REAL" for name in PHYSICS_FIGURES)}
)
"""
_COLUMNS = ("id", "variations", "reason", *PHYSICS_FIGURES)


def physics_rows(connection: sqlite3.Connection) -> dict[int, PhysicsRow]:
    """What physics made of the gaits that were simulated, by their numbers; none where there is no table.

    Args:
        connection: to the file, which is not changed.
    """
    query = "SELECT count(*) FROM sqlite_master WHERE type = 'table' AND name = 'physics'"
    if not connection.execute(query).fetchone()[0]:
        return {}
    found = connection.execute(f"SELECT {', '.join(_COLUMNS)} FROM physics ORDER BY id").fetchall()
    return {values[0]: _row(values) for values in found}


def store_physics_row(connection: sqlite3.Connection, row: PhysicsRow) -> None:
    """Stores what physics made of a gait, in one transaction; makes the table where the file lacks it.

    Args:
        connection: to the file.
        row: takes the place of an earlier one.
    """
    figures = (None if math.isnan(value) else value for value in row.figures.values())
    places = ", ".join("?" * len(_COLUMNS))
    with connection:
        connection.execute(_TABLE)
        connection.execute(
            f"INSERT OR REPLACE INTO physics VALUES ({places})",
            (row.number, row.variations, row.reason, *figures),
        )


def _row(values: tuple[int, int, str, *tuple[float | None, ...]]) -> PhysicsRow:
    number, variations, reason, *kept = values
    figures = {
        name: math.nan if value is None else value for name, value in zip(PHYSICS_FIGURES, kept, strict=True)
    }
    return PhysicsRow(number, variations, reason, **figures)
