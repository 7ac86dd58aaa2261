"""Every row that cannot be read: looking for them, setting them aside, and bringing them back."""

import base64
import json
import sqlite3
from collections.abc import Callable, Iterable
from typing import Any

from app.common.json import Json
from app.store.database import Database
from app.store.row_damage import DamagedText, RowDamage
from app.store.tables.camera_setup_store import CAMERAS, DELETED_SETUPS, SETUPS
from app.store.tables.edit_history_store import APPROVALS, HISTORY, OF_GAIT, OPEN_GAITS, VERSIONS
from app.store.tables.job_store import JOBS
from app.store.tables.learning_store import COURSES, PHYSICS_SETS
from app.store.tables.photo_store import PHOTOS
from app.store.tables.published_store import FIGURES as PUBLISHED_FIGURES
from app.store.tables.result_store import RESULTS
from app.store.tables.run_store import ALL_FIGURES, PIECES, RUN_PLANS, RUNS, STATES
from app.store.tables.simulation_store import SIMULATION_CONTENTS, SIMULATIONS
from app.store.tables.table import Table, TableKind, move_aside, reading
from app.store.tables.times_store import TIMES
from app.store.tables.trial_reference_store import SENT, SIMULATED
from app.store.tables.trial_store import TRIALS
from app.store.tables.video_store import VIDEOS
from core.errors import NotFoundError, StateError

KINDS: tuple[TableKind[Any], ...] = (
    OPEN_GAITS,
    HISTORY,
    VERSIONS,
    APPROVALS,
    RESULTS,
    JOBS,
    SIMULATIONS,
    SIMULATION_CONTENTS,
    RUNS,
    RUN_PLANS,
    STATES,
    ALL_FIGURES,
    PIECES,
    TRIALS,
    SENT,
    SIMULATED,
    PHOTOS,
    VIDEOS,
    SETUPS,
    DELETED_SETUPS,
    CAMERAS,
    COURSES,
    PHYSICS_SETS,
    TIMES,
    PUBLISHED_FIGURES,
)
"""What each table holds."""
NOT_SET_ASIDE = frozenset(kind.name for kind in KINDS if kind.way_out == OF_GAIT)
"""Tables whose rows belong together."""
PAGE = 20
"""Rows that are read at one time; others have their turn between."""
MOST_SHOWN = 100
"""Rows that are listed; once some of them are set aside, others follow."""


class Unreadable:
    """The rows that cannot be read; any thread may ask.

    Args:
        database: where they are.
    """

    def __init__(self, database: Database) -> None:
        self._database = database

    def look(self, goes_on: Callable[[], bool]) -> None:
        """Reads every row, so that damage is known before somebody needs the row.

        Args:
            goes_on: whether to go on; asked between pages.
        """
        for kind in KINDS:
            table, last = Table(self._database, kind), 0
            while goes_on():
                page = f"SELECT rowid FROM {kind.name} WHERE rowid>? ORDER BY rowid LIMIT ?"
                end = self._database.rows(f"SELECT max(rowid) FROM ({page})", last, PAGE)[0][0]
                if end is None:
                    break
                table.select("WHERE rowid>? AND rowid<=?", last, end)
                last = end

    def forget_replaced(self, *, is_read: bool = False) -> bool:
        """Forgets rows that are gone; tells whether there were any.

        Args:
            is_read: whether rows are read again, which takes a while, and forgotten where they can be.
        """
        known = self._database.row_damages
        places = tuple(known)[:MOST_SHOWN]
        is_there = self._is_damaged if is_read else self._exists
        replaced = [place for place in places if not is_there(*place)]
        for place in replaced:
            known.pop(place, None)
        return bool(replaced)

    def known(self) -> list[RowDamage]:
        """The rows that are known to be damaged."""
        return list(self._database.row_damages.values())

    def view(self) -> Json:
        """The same as JSON content: how many, and the first of them."""
        known = self.known()
        return {"count": len(known), "rows": [damage.content() for damage in known[:MOST_SHOWN]]}

    def full_view(self) -> Json:
        """The same, looked at again, and the rows that were set aside, the last one first."""
        self.forget_replaced(is_read=True)
        aside = self._database.rows(
            "SELECT number, name, row, made FROM set_aside ORDER BY number DESC LIMIT ?", MOST_SHOWN
        )
        keys = ("number", "table", "row", "made")
        return {**self.view(), "aside": [dict(zip(keys, row, strict=True)) for row in aside]}

    def set_aside(self, table: str, row: int) -> int:
        """Takes a damaged row out of its table and keeps it.

        Returns:
            The number by which it is brought back.

        Raises:
            NotFoundError: there is no such row.
            StateError: it can be read, and stays where it is.
        """
        if not any(kind.name == table for kind in KINDS):
            raise NotFoundError(f"There is no table “{table}”.", "table")
        if table in NOT_SET_ASIDE:
            raise StateError(f"This entry is not set aside alone. {OF_GAIT}", "table")
        if not self._exists(table, row):
            raise NotFoundError(f"The table {table} has no row {row}.", "row")
        if not self._is_damaged(table, row):
            raise StateError(f"Row {row} of the table {table} can be read, and stays where it is.", "row")
        with self._database.writing() as connection:
            number = move_aside(connection, table, row, self._database.clock.wall())
        if number is None:
            raise NotFoundError(f"Row {row} of the table {table} is set aside already.", "row")
        self._database.row_damages.pop((table, row), None)
        self._database.damaged()
        return number

    def bring_back(self, number: int) -> None:
        """Puts a row that was set aside back where it was.

        Raises:
            NotFoundError: none was set aside under this number.
        DamagedRowError: what was set aside cannot be read.
            StateError: another row has its place by now.
        """
        found = self._database.rows("SELECT name, row, columns FROM set_aside WHERE number=?", number)
        if not found:
            raise NotFoundError(f"No row was set aside under the number {number}.", "number")
        table, row, text = found[0]
        with reading("What was set aside cannot be read: "):
            columns = {name: _read(value) for name, value in json.loads(text).items()}
            self._require_columns(table, columns)
        names = ", ".join(("rowid", *columns))
        places = ", ".join(["?", *(_place(value) for value in columns.values())])
        try:
            with self._database.writing() as connection:
                connection.execute(f"INSERT INTO {table}({names}) VALUES({places})", (row, *columns.values()))
                connection.execute("DELETE FROM set_aside WHERE number=?", (number,))
        except sqlite3.IntegrityError as error:
            raise StateError(
                f"Row {row} of the table {table} was replaced meanwhile. What was set aside stays there.",
                "number",
            ) from error
        self._is_damaged(table, row)  # it is marked again

    def _require_columns(self, table: str, columns: Iterable[str]) -> None:
        """A table of this program has these columns.

        Raises:
            LookupError: it has not, or there is no such table.
        """
        if not any(kind.name == table for kind in KINDS):
            raise LookupError(f"there is no table “{table}”")
        names = {row[1] for row in self._database.rows(f"PRAGMA table_info({table})")}
        if not names.issuperset(columns):
            raise LookupError(f"the table {table} has other columns")

    def _is_damaged(self, table: str, row: int) -> bool:
        return any(
            Table(self._database, kind).select("WHERE rowid=?", row).damaged
            for kind in KINDS
            if kind.name == table
        )

    def _exists(self, table: str, row: int) -> bool:
        return bool(self._database.rows(f"SELECT 1 FROM {table} WHERE rowid=?", row))


def _read(value: Any) -> Any:
    """A column out of the JSON content that `move_aside` made of it."""
    if not isinstance(value, dict):
        return value
    ((kind, text),) = value.items()
    content = base64.b64decode(text)
    return DamagedText(content) if kind == "text" else content


def _place(value: Any) -> str:
    return "CAST(? AS TEXT)" if isinstance(value, DamagedText) else "?"
