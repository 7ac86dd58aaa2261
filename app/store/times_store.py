"""How long each gait's plan lasts, in the database."""

import sqlite3
from collections.abc import Iterable
from contextlib import closing
from pathlib import Path
from typing import Any

from app.store.database import DATABASE, Database
from app.store.quick_check import reading
from core.library.robot_times import RobotTimes

_ALL = "SELECT gait, sent, plan_seconds, robot_seconds, speed, turn_rate FROM times"


class TimesStore:
    """The table `times`: a row a gait, of the document whose plan was made last; any thread may ask.

    Args:
        database: where it is kept.
    """

    def __init__(self, database: Database) -> None:
        self._database = database

    def all(self) -> dict[str, tuple[str, RobotTimes]]:
        """By gait the hash of what is sent (`app.documents.gait_json.sent_hash`), and its times."""
        return _by_gait(self._database.rows(_ALL))

    def put(self, gait_id: str, sent: str, times: RobotTimes) -> None:
        """Stores a gait's times in place of earlier ones."""
        with self._database.writing() as connection:
            connection.execute(
                "INSERT OR REPLACE INTO times VALUES(?,?,?,?,?,?)",
                (gait_id, sent, times.plan_seconds, times.robot_seconds, times.speed, times.turn_rate),
            )


def read_times(data: Path) -> dict[str, tuple[str, RobotTimes]]:
    """What `TimesStore.all` says, of a data folder that a studio may have open; nothing is written.

    Where there is no database, or one of an earlier program, nothing is known.
    """
    path = data / DATABASE
    if not path.exists():
        return {}
    try:
        with closing(reading(path, is_open=True)) as connection:
            return _by_gait(connection.execute(_ALL))
    except sqlite3.Error:
        return {}


def _by_gait(rows: Iterable[tuple[Any, ...]]) -> dict[str, tuple[str, RobotTimes]]:
    return {gait: (sent, RobotTimes(*values)) for gait, sent, *values in rows}
