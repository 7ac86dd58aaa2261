"""How long each gait's plan lasts, in the database."""

import sqlite3
from contextlib import closing
from pathlib import Path
from typing import Any

from app.store.database import DATABASE, Database
from app.store.quick_check import reading
from app.store.tables.shapes import NUMBER, text
from app.store.tables.table import Table, TableKind
from core.errors import FootfallError
from core.library.robot_times import RobotTimes

Known = tuple[str, str, RobotTimes]
"""A gait, the hash of what is sent (`app.documents.gait_json.sent_hash`), and its times."""


def _known(gait: str, sent: str, **times: Any) -> Known:
    return gait, sent, RobotTimes(**times)


TIMES = TableKind(
    "times",
    "duration of the gait",
    ("gait",),
    {
        "gait": text,
        "sent": text,
        "plan_seconds": NUMBER,
        "robot_seconds": NUMBER,
        "speed": NUMBER,
        "turn_rate": NUMBER,
    },
    _known,
)


class TimesStore:
    """The table `times`: a row for each gait, of the document whose plan was made last; any thread may ask.

    Args:
        database: where it is kept.
    """

    def __init__(self, database: Database) -> None:
        self._database, self._table = database, Table(database, TIMES)

    def all(self) -> dict[str, tuple[str, RobotTimes]]:
        """Hash and times by gait."""
        return {gait: (sent, times) for gait, sent, times in self._table.select().rows}

    def put(self, gait_id: str, sent: str, times: RobotTimes) -> None:
        """Stores a gait's times in place of earlier ones."""
        with self._database.writing() as connection:
            connection.execute(
                "INSERT OR REPLACE INTO times VALUES(?,?,?,?,?,?)",
                (gait_id, sent, times.plan_seconds, times.robot_seconds, times.speed, times.turn_rate),
            )


def read_times(data: Path) -> dict[str, tuple[str, RobotTimes]]:
    """The same as `TimesStore.all`, of a data folder that a studio may have open; nothing is written.

    Where there is no database, or one of an earlier program, nothing is known.
    """
    path = data / DATABASE
    if not path.exists():
        return {}
    try:
        with closing(reading(path, is_open=True)) as connection:
            found = connection.execute(f"SELECT {', '.join(TIMES.shapes)} FROM times").fetchall()
    except sqlite3.Error:
        return {}
    known = {}
    for row in found:
        try:
            gait, sent, times = TIMES.value(dict(zip(TIMES.shapes, row, strict=True)))
        except (
            FootfallError,
            ValueError,
        ):  # the studio marks it, and finds it anew with the gait's next plan
            continue
        known[gait] = (sent, times)
    return known
