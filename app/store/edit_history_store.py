"""Each gait's present document, its edit history, its versions and its approvals, in the database.

A change and the version that goes with it are one transaction: after a kill both are there, or neither.
"""

import json
import sqlite3
from dataclasses import astuple, dataclass

from app.common.json import Json
from app.store.database import Database
from app.undo.history import Action, Author, History, LogEntry
from core.errors import InputError

MOST_AUTOMATIC = 200
"""Automatic versions that are kept of a gait; of all others every one is kept."""

MOST_SAVED = 10
"""Saved documents that a gait's file is compared with."""

_MISSING = "Documents are missing in the history of “{}”."

_VERSION_COLUMNS = "number, made, kind, name, by, position, motion, document"


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


class EditHistoryStore:
    """The tables `open_gait`, `history`, `version`, `approval`; a gait is the last entry of its history.

    Args:
        database: where they are kept.
    """

    def __init__(self, database: Database) -> None:
        self._database = database

    def editing(self, gait: str) -> EditHistoryRow | None:
        """A gait's editing state, or None where it was never edited.

        Raises:
            InputError: what is kept of it contradicts itself.
        """
        rows = self._database.rows(
            "SELECT revision, last, done, undone, notice, approval, revoked FROM open_gait WHERE gait=?", gait
        )
        if not rows:
            return None
        revision, last, done, undone, notice, approval, revoked = rows[0]
        entries = self.entries(gait)
        history = History(entries, last, _actions(done, gait), _actions(undone, gait))
        edits = [action.position for action in (*history.done, *history.undone)]
        if not {last, *edits, *(position - 1 for position in edits)} <= entries.keys():
            raise InputError(_MISSING.format(gait), gait)
        return EditHistoryRow(revision, history, notice, approval, revoked)

    def entries(self, gait: str) -> dict[int, LogEntry]:
        """Every document of a gait's history, by position."""
        rows = self._database.rows(
            "SELECT position, label, document, page, name, edit FROM history WHERE gait=?", gait
        )
        return {
            at: LogEntry(label, text, Author(page, name), edit) for at, label, text, page, name, edit in rows
        }

    def revision(self, gait: str) -> int:
        """Revision of a gait's present document; 0 where it was never edited."""
        rows = self._database.rows("SELECT revision FROM open_gait WHERE gait=?", gait)
        return rows[0][0] if rows else 0

    def ids(self) -> frozenset[str]:
        """Every gait of which anything is kept."""
        rows = self._database.rows("SELECT gait FROM open_gait UNION SELECT gait FROM version")
        return frozenset(row[0] for row in rows)

    def present_document(self, gait: str) -> str | None:
        """A gait's present document as JSON text, or None where it was never edited.

        Raises:
            InputError: what is kept of it contradicts itself.
        """
        rows = self._database.rows(
            "SELECT h.document, o.done, o.undone FROM open_gait o "
            "LEFT JOIN history h ON h.gait = o.gait AND h.position = o.last WHERE o.gait=?",
            gait,
        )
        if not rows:
            return None
        document, *stacks = rows[0]
        for actions in stacks:
            _actions(actions, gait)
        if document is None:
            raise InputError(_MISSING.format(gait), gait)
        return str(document)

    def last_saved(self, gait: str) -> list[tuple[float, str]]:
        """The last documents that were saved, the newest first: when, s since the epoch, and JSON text."""
        rows = self._database.rows(
            "SELECT made, document FROM version WHERE gait=? AND kind='saved' ORDER BY number DESC LIMIT ?",
            gait,
            MOST_SAVED,
        )
        return [(made, document) for made, document in rows]

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
        with self._database.writing() as connection:
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
            for table in ("open_gait", "history", "version", "approval"):
                connection.execute(f"UPDATE {table} SET gait=? WHERE gait=?", (to, gait))

    def withdraw_approval(self, gait: str) -> bool:
        """Takes a gait's approval away, but not its record; returns whether there was one."""
        with self._database.writing() as connection:
            changed = connection.execute(
                "UPDATE open_gait SET approval=NULL WHERE gait=? AND approval IS NOT NULL", (gait,)
            )
            return changed.rowcount > 0

    def approvals(self, gait: str) -> list[tuple[int, Json]]:
        """The record of a gait's approvals with their numbers, the newest first."""
        rows = self._database.rows(
            "SELECT number, content FROM approval WHERE gait=? ORDER BY number DESC", gait
        )
        return [(number, json.loads(content)) for number, content in rows]

    def versions(self, gait: str) -> tuple[VersionRow, ...]:
        """A gait's versions, the newest first."""
        rows = self._database.rows(
            f"SELECT {_VERSION_COLUMNS} FROM version WHERE gait=? ORDER BY number DESC", gait
        )
        return tuple(VersionRow(*row) for row in rows)

    def version(self, gait: str, number: int) -> VersionRow | None:
        """One version, or None where there is none of that number."""
        rows = self._database.rows(
            f"SELECT {_VERSION_COLUMNS} FROM version WHERE gait=? AND number=?", gait, number
        )
        return VersionRow(*rows[0]) if rows else None

    def newest_version(self, gait: str) -> VersionRow | None:
        """The version that was made last."""
        rows = self._database.rows(
            f"SELECT {_VERSION_COLUMNS} FROM version WHERE gait=? ORDER BY number DESC LIMIT 1", gait
        )
        return VersionRow(*rows[0]) if rows else None

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


def _insert_version(connection: sqlite3.Connection, gait: str, version: VersionRow) -> None:
    connection.execute(
        f"INSERT INTO version(gait, {_VERSION_COLUMNS}) VALUES(?,?,?,?,?,?,?,?,?)",
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
