"""Each gait's present document, its edit history, its versions and its approvals, in the database.

A change and the version that goes with it are one transaction: after a kill both are there, or neither.
"""

import json
import sqlite3
from collections.abc import Callable
from dataclasses import astuple, dataclass
from typing import Any

from app.common.json import Json
from app.store.database import Database
from app.store.tables.contents import APPROVAL_RECORD
from app.store.tables.shapes import COUNT, MOMENT, WHOLE, Maybe, Shape, Stored, text, text_or_nothing
from app.store.tables.table import Selection, Table, TableKind, View, move_aside
from app.undo.history import Action, Author, History, LogEntry
from core.errors import InputError

MOST_AUTOMATIC = 200
"""Automatic versions that are kept of a gait; of all others every one is kept."""

MOST_SAVED = 10
"""Saved documents that a gait's file is compared with."""

OF_GAIT = (
    "Go back to the last state of the gait that can be shown: its line in the list of gaits offers this."
)
"""The way out of rows that belong to the edits of a gait; see `app.gaits.recovery`."""

_MISSING = "Documents are missing in the history of “{}”."

_VERSION: dict[str, Shape] = {
    "number": COUNT,
    "made": MOMENT,
    "kind": text,
    "name": text,
    "by": text,
    "position": COUNT,
    "motion": text,
    "document": text,
}


@dataclass(frozen=True)
class EditHistoryRow:
    """Where a gait's editing stands."""

    revision: int
    history: History
    notice: str | None
    approval: str | None
    revoked: str | None = None


@dataclass(frozen=True)
class VersionRow:
    """A document worth going back to.

    Args:
        number: counts from 1, a gait at a time.
        made: s since the epoch.
        kind: why it was kept.
        name: a person's name for it, or nothing.
        by: whose name stands by it, or nothing.
        position: of the document in the gait's log when it was made.
        motion: hash of what a motion depends on.
        document: JSON text.
    """

    number: int
    made: float
    kind: str
    name: str
    by: str
    position: int
    motion: str
    document: str


@dataclass(frozen=True)
class OpenGaitRow:
    """The table's row of an edited gait."""

    gait: str
    revision: int
    last: int
    done: str
    undone: str
    notice: str | None
    approval: str | None
    revoked: str | None


@dataclass(frozen=True)
class ApprovalRow:
    """An entry of the record of approvals."""

    number: int
    content: Json


def _entry(**columns: Any) -> tuple[int, LogEntry]:
    author = Author(columns["page"], columns["name"])
    return columns["position"], LogEntry(columns["label"], columns["document"], author, columns["edit"])


OPEN_GAITS = TableKind(
    "open_gait",
    "editing state of the gait",
    ("gait",),
    {
        "gait": text,
        "revision": COUNT,
        "last": COUNT,
        "done": text,
        "undone": text,
        "notice": Maybe(text),
        "approval": Maybe(text),
        "revoked": Maybe(text),
    },
    OpenGaitRow,
    OF_GAIT,
)
HISTORY = TableKind(
    "history",
    "step in the history",
    ("gait", "position"),
    {
        "position": COUNT,
        "document": text,
        **dict.fromkeys(("label", "page", "name", "edit"), text_or_nothing),
    },
    _entry,
    OF_GAIT,
)
VERSIONS = TableKind("version", "version", ("gait", "number"), _VERSION, VersionRow)
APPROVALS = TableKind(
    "approval",
    "record of approval",
    ("gait", "number"),
    {"number": WHOLE, "content": Stored(APPROVAL_RECORD)},
    ApprovalRow,
)


class EditHistoryStore:
    """The tables `open_gait`, `history`, `version`, `approval`; a gait is the last entry of its history.

    Args:
        database: where they are kept.
    """

    def __init__(self, database: Database) -> None:
        self._database = database
        self._open_gaits, self._history = Table(database, OPEN_GAITS), Table(database, HISTORY)
        self._versions, self._approvals = Table(database, VERSIONS), Table(database, APPROVALS)

    def editing(self, gait: str) -> EditHistoryRow | None:
        """A gait's editing state, or None where it was never edited.

        Raises:
            InputError: what is kept of it contradicts itself.
        """
        row = self._open_gaits.first("WHERE gait=?", gait)
        if row is None:
            return None
        entries = self.entries(gait)
        history = History(entries, row.last, _actions(row.done, gait), _actions(row.undone, gait))
        edits = [action.position for action in (*history.done, *history.undone)]
        if not {row.last, *edits, *(position - 1 for position in edits)} <= entries.keys():
            raise InputError(_MISSING.format(gait), gait)
        return EditHistoryRow(row.revision, history, row.notice, row.approval, row.revoked)

    def entries(self, gait: str) -> dict[int, LogEntry]:
        """Every document of a gait's history that can be read, by position."""
        return dict(self._history.select("WHERE gait=?", gait).rows)

    def revision(self, gait: str) -> int:
        """Revision of a gait's present document; 0 where it was never edited.

        Where it cannot be read, it is at least the number of documents.
        """
        known = "SELECT max(revision) FROM open_gait WHERE gait=? AND typeof(revision)='integer'"
        steps = "SELECT count(*) FROM history WHERE gait=?"
        return int(self._database.rows(known, gait)[0][0] or self._database.rows(steps, gait)[0][0])

    def is_edited(self, gait: str) -> bool:
        """Whether there is an editing state of a gait, readable or not."""
        return bool(self._database.rows("SELECT 1 FROM open_gait WHERE gait=?", gait))

    def ids(self) -> frozenset[str]:
        """Every gait of which anything is kept."""
        rows = self._database.rows("SELECT gait FROM open_gait UNION SELECT gait FROM version")
        return frozenset(gait for (gait,) in rows if isinstance(gait, str))

    def present_document(self, gait: str) -> str | None:
        """A gait's present document as JSON text, or None where it was never edited.

        Raises:
            InputError: what is kept of it contradicts itself.
        """
        row = self._open_gaits.first("WHERE gait=?", gait)
        if row is None:
            return None
        for actions in (row.done, row.undone):
            _actions(actions, gait)
        entry = self._history.first("WHERE gait=? AND position=?", gait, row.last)
        if entry is None:
            raise InputError(_MISSING.format(gait), gait)
        return entry[1].document

    def last_saved(self, gait: str) -> list[tuple[float, str]]:
        """The last documents that were saved, the newest first: when, s since the epoch, and JSON text."""
        selection = self._versions.select(
            "WHERE gait=? AND kind='saved' ORDER BY number DESC LIMIT ?", gait, MOST_SAVED
        )
        return [(version.made, version.document) for version in selection.rows]

    def put(
        self,
        gait: str,
        row: EditHistoryRow,
        stored: History | None,
        version: VersionRow | None = None,
        approval: Json | None = None,
    ) -> None:
        """Stores an editing state, and in the same transaction a version and an approval's record with it.

        Args:
            gait: its id.
            row: the state.
            stored: the history that is in the database already; None where there is none.
            version: to be kept as well.
            approval: for the record of approvals.
        """
        before = {} if stored is None else stored.entries
        history = row.history
        added = [(at, entry) for at, entry in history.entries.items() if before.get(at) is not entry]
        gone = [(gait, at) for at in before if at not in history.entries]
        damaged = self._history.select("WHERE gait=?", gait).damaged if stored is None else ()
        with self._database.writing() as connection:
            for damage in damaged:
                move_aside(connection, damage.table, damage.row, self._database.clock.wall())
            if stored is None:
                connection.execute("DELETE FROM history WHERE gait=?", (gait,))
            connection.executemany("DELETE FROM history WHERE gait=? AND position=?", gone)
            connection.executemany(
                "INSERT OR REPLACE INTO history(gait, position, label, document, page, name, edit) "
                "VALUES(?,?,?,?,?,?,?)",
                [(gait, at, e.label, e.document, e.author.page, e.author.name, e.edit) for at, e in added],
            )
            connection.execute(
                "INSERT OR REPLACE INTO open_gait"
                "(gait, revision, last, done, undone, notice, approval, revoked) VALUES(?,?,?,?,?,?,?,?)",
                (
                    gait,
                    row.revision,
                    history.last,
                    json.dumps([astuple(action) for action in history.done]),
                    json.dumps([astuple(action) for action in history.undone]),
                    row.notice,
                    row.approval,
                    row.revoked,
                ),
            )
            if version is not None:
                _insert_version(connection, gait, version)
            if approval is not None:
                content = json.dumps(approval, allow_nan=False)
                connection.execute("INSERT INTO approval(gait, content) VALUES(?,?)", (gait, content))

    def rename(self, gait: str, to: str) -> None:
        """Keeps everything of a gait under another id, of which nothing is kept yet."""
        with self._database.writing() as connection:
            _rename(connection, gait, to)

    def bring_back(self, gait: str, to: str) -> bool:
        """The same, without the approval, but with its record; returns whether there was an approval."""
        with self._database.writing() as connection:
            _rename(connection, gait, to)
            changed = connection.execute(
                "UPDATE open_gait SET approval=NULL WHERE gait=? AND approval IS NOT NULL", (to,)
            )
            return changed.rowcount > 0

    def approvals(self, gait: str, view: Callable[[ApprovalRow], View]) -> Selection[View]:
        """The record of a gait's approvals, the newest first.

        Args:
            gait: its id.
            view: makes of each what is wanted.
        """
        return self._approvals.viewed(view, "WHERE gait=? ORDER BY number DESC", gait)

    def versions(self, gait: str) -> Selection[VersionRow]:
        """A gait's versions, the newest first."""
        return self._versions.select("WHERE gait=? ORDER BY number DESC", gait)

    def version(self, gait: str, number: int) -> VersionRow | None:
        """One version, or None where there is none of that number.

        Raises:
            DamagedRowError: it cannot be read.
        """
        return self._versions.first("WHERE gait=? AND number=?", gait, number)

    def newest_version(self, gait: str) -> VersionRow | None:
        """The version that was made last; None where there is none, or it cannot be read."""
        rows = self._versions.select("WHERE gait=? ORDER BY number DESC LIMIT 1", gait).rows
        return rows[0] if rows else None

    def newest_number(self, gait: str) -> int:
        """Number of the version that was made last, readable or not; 0 where there is none."""
        query = "SELECT MAX(number) FROM version WHERE gait=? AND typeof(number)='integer'"
        return int(self._database.rows(query, gait)[0][0] or 0)

    def add_version(self, gait: str, version: VersionRow) -> None:
        """Stores a version."""
        with self._database.writing() as connection:
            _insert_version(connection, gait, version)


def _actions(text: str, gait: str) -> tuple[Action, ...]:
    """A stack of edits out of its JSON text.

    Raises:
        InputError: it is none.
    """
    try:
        actions = tuple(Action(*action) for action in json.loads(text))
        if not all(isinstance(at, int) for action in actions for at in (action.position, action.since)):
            raise TypeError("a position is no number")
        return actions
    except (TypeError, ValueError) as error:
        raise InputError(f"What can be undone of “{gait}” cannot be read: {error}.", gait) from error


def _rename(connection: sqlite3.Connection, gait: str, to: str) -> None:
    for table in ("open_gait", "history", "version", "approval"):
        connection.execute(f"UPDATE {table} SET gait=? WHERE gait=?", (to, gait))


def _insert_version(connection: sqlite3.Connection, gait: str, version: VersionRow) -> None:
    connection.execute(
        f"INSERT INTO version(gait, {', '.join(_VERSION)}) VALUES(?,?,?,?,?,?,?,?,?)",
        (
            gait,
            version.number,
            version.made,
            version.kind,
            version.name,
            version.by,
            version.position,
            version.motion,
            version.document,
        ),
    )
    connection.execute(
        "DELETE FROM version WHERE gait=:gait AND kind='automatic' AND number NOT IN (SELECT number "
        "FROM version WHERE gait=:gait AND kind='automatic' ORDER BY number DESC LIMIT :most)",
        {"gait": gait, "most": MOST_AUTOMATIC},
    )
