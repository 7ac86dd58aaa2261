"""Runs in the database: what is found of them, their plans, states, bytes, figures and notes."""

import json
import sqlite3
from dataclasses import dataclass
from typing import Any

from app.bridge.states import Direction
from app.common.json import Json
from app.store.database import Database
from app.store.tables.contents import RUN, RUN_FIGURES, RUN_PLAN
from app.store.tables.run_rows import ByteRow, StateRow, add_bytes, add_states, put_run
from app.store.tables.shapes import COUNT, MOMENT, NUMBER, Maybe, OneOf, Stored, data, text
from app.store.tables.table import Selection, Table, TableKind, json_of, key_of


@dataclass(frozen=True)
class RunRow:
    """A run as it is kept: its content, a person's note, and when it was deleted, s since the epoch."""

    id: str
    content: Json
    note: str
    deleted: float | None

    def __post_init__(self) -> None:
        key_of(self, self.content, "id")


@dataclass(frozen=True)
class RunContent:
    """The plan or the figures of a run."""

    run: str
    content: Json


@dataclass(frozen=True)
class RunPiece:
    """Bytes that passed: time in s by `boot_seconds`, direction and data."""

    run: str
    number: int
    time: float
    direction: str
    data: bytes


@dataclass(frozen=True)
class RunState:
    """A change of state: time in s by `boot_seconds`, link, robot and cause."""

    run: str
    number: int
    time: float
    link: str
    robot: str
    cause: str


@dataclass(frozen=True)
class RunChoice:
    """What a run can be filtered by."""

    gait: str
    gait_name: str
    state: str
    by: str


RUNS = TableKind(
    "run",
    "run",
    ("id",),
    {"id": text, "content": Stored(RUN), "note": text, "deleted": Maybe(MOMENT)},
    RunRow,
)
RUN_PLANS = TableKind(
    "run_plan", "plan of the run", ("run",), {"run": text, "content": Stored(RUN_PLAN)}, RunContent
)
ALL_FIGURES = TableKind(
    "run_figures",
    "record of figures of the run",
    ("run",),
    {"run": text, "content": Stored(RUN_FIGURES)},
    RunContent,
)
PIECES = TableKind(
    "run_bytes",
    "piece of bytes",
    ("run", "number"),
    {
        "run": text,
        "number": COUNT,
        "time": NUMBER,
        "direction": OneOf(tuple(way.value for way in Direction)),
        "data": data,
    },
    RunPiece,
)
STATES = TableKind(
    "run_state",
    "change of state",
    ("run", "number"),
    {"run": text, "number": COUNT, "time": NUMBER, "link": text, "robot": text, "cause": text},
    RunState,
)


def _choice(**columns: str) -> RunChoice:
    return RunChoice(**{name: columns[column] for name, column in _CHOSEN.items()})


_CHOSEN = {name: json_of(f"$.{name}") for name in ("gait", "gait_name", "state", "by")}
_TEXT = "'text'"
_CHOICES = TableKind("run", "run", ("id",), {"id": text, **dict.fromkeys(_CHOSEN.values(), text)}, _choice)


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
            f"{_CHOSEN['gait']} = ?": self.gait,
            f"{_CHOSEN['state']} = ?": self.state,
            f"{_CHOSEN['by']} = ?": self.by,
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
        self._database, self._runs = database, Table(database, RUNS)
        self._plans, self._figures = Table(database, RUN_PLANS), Table(database, ALL_FIGURES)
        self._pieces, self._states = Table(database, PIECES), Table(database, STATES)
        self._choices = Table(database, _CHOICES)

    def listed(self, wanted: RunFilter, offset: int, most: int) -> Selection[RunRow]:
        """Some of the runs that a filter leaves, the newest first."""
        where, values = wanted.condition()
        return self._runs.select(f"WHERE {where} ORDER BY rowid DESC LIMIT ? OFFSET ?", *values, most, offset)

    def count(self, wanted: RunFilter) -> int:
        """How many runs a filter leaves."""
        where, values = wanted.condition()
        return int(self._database.rows(f"SELECT COUNT(*) FROM run WHERE {where}", *values)[0][0])

    def newest(self) -> Json | None:
        """The newest run, also a deleted one; None where there is none, or it cannot be read."""
        rows = self._runs.select("ORDER BY rowid DESC LIMIT 1").rows
        return rows[0].content if rows else None

    def running(self) -> tuple[Json, ...]:
        """Runs that have not ended as far as is known, also deleted ones."""
        rows = self._runs.select(f"WHERE {_CHOSEN['state']} = 'running'").rows
        return tuple(row.content for row in rows)

    def counts(self, run: str) -> RunCounts:
        """How much of a run's bytes and states is kept."""
        pieces = self._database.rows("SELECT COUNT(*) FROM run_bytes WHERE run=?", run)
        states = self._database.rows("SELECT COUNT(*) FROM run_state WHERE run=?", run)
        return RunCounts(pieces[0][0], states[0][0])

    def choices(self) -> dict[str, list[Any]]:
        """What can be filtered by: gaits with their names, states and operators that there are."""
        columns = _CHOSEN.values()
        found = self._choices.select(
            f"WHERE deleted IS NULL AND {' AND '.join(f'typeof({column})={_TEXT}' for column in columns)} "
            f"GROUP BY {', '.join(columns)}"
        ).rows
        gaits = {choice.gait: choice.gait_name for choice in found}
        return {
            "gaits": [{"id": gait, "name": gaits[gait]} for gait in sorted(gaits, key=lambda g: gaits[g])],
            "states": sorted({choice.state for choice in found}),
            "operators": sorted({choice.by for choice in found}),
        }

    def get(self, run: str) -> RunRow | None:
        """One run, also a deleted one; None where there is none.

        Raises:
            DamagedRowError: it cannot be read.
        """
        return self._runs.first("WHERE id=?", run)

    def put_note(self, run: str, note: str) -> None:
        """Stores a person's note."""
        with self._database.writing() as connection:
            connection.execute("UPDATE run SET note=? WHERE id=?", (note, run))

    def put_deleted(self, run: str, deleted: float | None) -> bool:
        """Takes a run out of every list, or brings it back with None; tells whether there is one."""
        return self._runs.put_deleted(deleted, id=run)

    def put(self, content: Json) -> None:
        """Stores a run as it is now."""
        with self._database.writing() as connection:
            put_run(connection, content)

    def plan(self, run: str) -> Json | None:
        """What the run was to do; None where it was not kept.

        Raises:
            DamagedRowError: it cannot be read.
        """
        row = self._plans.first("WHERE run=?", run)
        return None if row is None else row.content

    def begin(self, content: Json, plan: Json | None) -> None:
        """Stores a run that begins, and what it is to do, together."""
        with self._database.writing() as connection:
            put_run(connection, content)
            if plan is not None:
                _put_content(connection, "run_plan", content["id"], plan)

    def figures(self, run: str) -> Json | None:
        """Figures of a run that has ended; None where none can be read, so that they are computed."""
        rows = self._figures.select("WHERE run=?", run).rows
        return rows[0].content if rows else None

    def put_figures(self, run: str, content: Json) -> None:
        """Stores what was computed from a run."""
        with self._database.writing() as connection:
            _put_content(connection, "run_figures", run, content)

    def bytes_of(self, run: str) -> tuple[RunPiece, ...]:
        """Everything that passed, in order.

        Raises:
            DamagedRowError: a piece cannot be read.
        """
        return self._pieces.select("WHERE run=? ORDER BY time, number", run).whole()

    def add_bytes(self, rows: list[ByteRow]) -> None:
        """Adds to the record of bytes."""
        with self._database.writing() as connection:
            add_bytes(connection, rows)

    def add_states(self, rows: list[StateRow]) -> None:
        """Adds changes of state."""
        with self._database.writing() as connection:
            add_states(connection, rows)

    def states_of(self, run: str) -> tuple[RunState, ...]:
        """Changes of state, in order.

        Raises:
            DamagedRowError: one cannot be read.
        """
        return self._states.select("WHERE run=? ORDER BY number", run).whole()


def _put_content(connection: sqlite3.Connection, table: str, run: str, content: Json) -> None:
    text = json.dumps(content, allow_nan=False)
    connection.execute(f"INSERT OR REPLACE INTO {table} VALUES(?,?)", (run, text))
