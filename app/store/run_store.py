"""Runs in the database: what is found of them, their plans, states, bytes, figures and notes."""

import json
import sqlite3
from dataclasses import dataclass
from typing import Any

from app.common.json import Json
from app.store.database import Database
from app.store.run_rows import StateRow, add_states, put_run


@dataclass(frozen=True)
class RunRow:
    """A run as it is kept: its content, a person's note, and when it was deleted, s since the epoch."""

    content: Json
    note: str
    deleted: float | None


@dataclass(frozen=True)
class RunCounts:
    """How many pieces of bytes and how many changes of state are kept of a run."""

    pieces: int
    states: int


@dataclass(frozen=True)
class RunFilter:
    """Which runs are wanted; None and empty for all.

    Args:
        gait: a gait's id.
        state: how the run ended.
        by: who sent it.
        since: started then or later, s since the epoch.
        until: started before then, s since the epoch.
    """

    gait: str = ""
    state: str = ""
    by: str = ""
    since: float | None = None
    until: float | None = None

    def condition(self) -> tuple[str, tuple[Any, ...]]:
        """The filter in SQL, with its values."""
        wanted = {
            "json_extract(content, '$.gait') = ?": self.gait,
            "json_extract(content, '$.state') = ?": self.state,
            "json_extract(content, '$.by') = ?": self.by,
            "started >= ?": self.since,
            "started < ?": self.until,
        }
        given = {text: value for text, value in wanted.items() if value not in ("", None)}
        return " AND ".join(["deleted IS NULL", *given]), tuple(given.values())


class RunStore:
    """Everything that is kept of runs.

    Args:
        database: where it is kept.
    """

    def __init__(self, database: Database) -> None:
        self._database = database

    def found(self, wanted: RunFilter, offset: int, most: int) -> tuple[RunRow, ...]:
        """Some of the runs that a filter leaves, the newest first."""
        where, values = wanted.condition()
        rows = self._database.rows(
            f"SELECT content, note, deleted FROM run WHERE {where} ORDER BY rowid DESC LIMIT ? OFFSET ?",
            *values,
            most,
            offset,
        )
        return tuple(RunRow(json.loads(content), note, deleted) for content, note, deleted in rows)

    def count(self, wanted: RunFilter) -> int:
        """How many runs a filter leaves."""
        where, values = wanted.condition()
        return int(self._database.rows(f"SELECT COUNT(*) FROM run WHERE {where}", *values)[0][0])

    def running(self) -> tuple[Json, ...]:
        """Runs that have not ended as far as is known, also deleted ones."""
        rows = self._database.rows(
            "SELECT content FROM run WHERE json_extract(content, '$.state') = 'running'"
        )
        return tuple(json.loads(content) for (content,) in rows)

    def counts(self, run: str) -> RunCounts:
        """How much of a run's bytes and states is kept."""
        pieces = self._database.rows("SELECT COUNT(*) FROM run_bytes WHERE run=?", run)
        states = self._database.rows("SELECT COUNT(*) FROM run_state WHERE run=?", run)
        return RunCounts(pieces[0][0], states[0][0])

    def choices(self) -> dict[str, list[Any]]:
        """What can be filtered by: gaits with their names, states and operators that there are."""
        rows = self._database.rows(
            "SELECT DISTINCT json_extract(content, '$.gait'), json_extract(content, '$.gait_name'), "
            "json_extract(content, '$.state'), json_extract(content, '$.by') FROM run WHERE deleted IS NULL"
        )
        gaits = {gait: name for gait, name, _, _ in rows}
        return {
            "gaits": [{"id": gait, "name": gaits[gait]} for gait in sorted(gaits, key=lambda g: gaits[g])],
            "states": sorted({state for _, _, state, _ in rows}),
            "operators": sorted({by for _, _, _, by in rows}),
        }

    def get(self, run: str) -> RunRow | None:
        """One run, also a deleted one; None where there is none."""
        rows = self._database.rows("SELECT content, note, deleted FROM run WHERE id=?", run)
        return RunRow(json.loads(rows[0][0]), rows[0][1], rows[0][2]) if rows else None

    def put_note(self, run: str, note: str) -> None:
        """Stores a person's note."""
        with self._database.writing() as connection:
            connection.execute("UPDATE run SET note=? WHERE id=?", (note, run))

    def put_deleted(self, run: str, deleted: float | None) -> None:
        """Takes a run out of every list, or brings it back with None; nothing of it is lost."""
        with self._database.writing() as connection:
            connection.execute("UPDATE run SET deleted=? WHERE id=?", (deleted, run))

    def plan(self, run: str) -> Json | None:
        """What the run was to do; None where it was not kept."""
        return self._content("run_plan", run)

    def begin(self, content: Json, plan: Json | None) -> None:
        """Stores a run that begins, and what it is to do, together."""
        with self._database.writing() as connection:
            put_run(connection, content)
            if plan is not None:
                _put_content(connection, "run_plan", content["id"], plan)

    def figures(self, run: str) -> Json | None:
        """What was computed from a run that has ended."""
        return self._content("run_figures", run)

    def put_figures(self, run: str, content: Json) -> None:
        """Stores what was computed from a run."""
        with self._database.writing() as connection:
            _put_content(connection, "run_figures", run, content)

    def bytes_of(self, run: str) -> list[tuple[float, str, bytes]]:
        """Monotonic time in s, direction and data of everything that passed, in order."""
        return [
            (time, direction, data)
            for time, direction, data in self._database.rows(
                "SELECT time, direction, data FROM run_bytes WHERE run=? ORDER BY time, number", run
            )
        ]

    def add_states(self, rows: list[StateRow]) -> None:
        """Adds changes of state."""
        with self._database.writing() as connection:
            add_states(connection, rows)

    def states_of(self, run: str) -> list[tuple[float, str, str, str]]:
        """Monotonic time in s, link, robot and cause of each change of state."""
        return [
            (time, link, robot, cause)
            for time, link, robot, cause in self._database.rows(
                "SELECT time, link, robot, cause FROM run_state WHERE run=? ORDER BY number", run
            )
        ]

    def _content(self, table: str, run: str) -> Json | None:
        rows = self._database.rows(f"SELECT content FROM {table} WHERE run=?", run)
        return json.loads(rows[0][0]) if rows else None


def _put_content(connection: sqlite3.Connection, table: str, run: str, content: Json) -> None:
    text = json.dumps(content, allow_nan=False)
    connection.execute(f"INSERT OR REPLACE INTO {table} VALUES(?,?)", (run, text))
