"""Runs whose program is gone: their records are completed from what it left behind."""

import json

from app.store.database import Database
from app.store.run_journal import Entry, EntryKind, abandoned_journal, journalled_runs
from app.store.storage_errors import left_undone
from app.store.tables.run_rows import add_bytes, add_states, byte_row, put_run, state_row
from app.store.tables.run_store import RunStore
from core.errors import DamagedRowError

ABANDONED = "The program that sent this run ended while it was on; nothing resumes by itself."


def end_abandoned(database: Database) -> None:
    """Marks the runs of dead processes as interrupted, and takes their journals; leaves living ones alone."""
    with left_undone("Runs that were broken off are not marked so"):
        _end_abandoned(database)


def _end_abandoned(database: Database) -> None:
    log = RunStore(database)
    running = [content["id"] for content in log.running()]
    # A journal may also be of a run that was not begun yet, or that the database had wholly.
    for run in {*running, *journalled_runs(database.path.parent)}:
        try:
            log.get(run)
        except DamagedRowError:  # its journal stays, for the time when the row can be read again
            continue
        with abandoned_journal(database.path.parent, run) as entries:
            row = log.get(run)
            if entries is not None and row is not None and row.content["state"] == "running":
                _complete(database, run, row.content, entries)


def _complete(database: Database, run: str, content: dict[str, object], entries: tuple[Entry, ...]) -> None:
    pieces = [entry for entry in entries if entry.kind.is_bytes]
    states = [entry for entry in entries if entry.kind is EntryKind.STATE]
    ends = [json.loads(entry.data) for entry in entries if entry.kind is EntryKind.END]
    end = ends[-1] if ends else content | {"state": "interrupted", "sentence": ABANDONED}
    known = RunStore(database).counts(run)
    with database.writing() as connection:
        add_bytes(connection, [byte_row(run, entry) for entry in pieces[known.pieces :]])
        add_states(connection, [state_row(run, entry) for entry in states[known.states :]])
        put_run(connection, end)
