"""Runs whose program is gone: their records are completed from what it left behind."""

import json
import logging
from typing import Any

from app.store.database import Database
from app.store.run_journal import FOLDER, Entry, EntryKind, abandoned_journal, has_entries, journalled_runs
from app.store.storage_errors import left_undone
from app.store.tables.run_rows import add_bytes, add_states, byte_row, put_run, state_row
from app.store.tables.run_store import RunStore
from core.errors import DamagedRowError, InputError
from core.text.documents import json_content

logger = logging.getLogger(__name__)

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
            is_known = log.get(run) is not None
        except DamagedRowError:  # its journal stays, for the time when the row can be read again
            continue
        if not is_known and has_entries(database.path.parent, run):
            logger.warning(
                "The journal %s/%s belongs to no run of the database, and stays. It is taken once the "
                "database that has the run is back.",
                FOLDER,
                run,
            )
            continue
        with abandoned_journal(database.path.parent, run) as entries:
            row = log.get(run)
            if entries is not None and row is not None and row.content["state"] == "running":
                _complete(database, run, row.content, entries)


def _complete(database: Database, run: str, content: dict[str, object], entries: tuple[Entry, ...]) -> None:
    pieces = [entry for entry in entries if entry.kind.is_bytes]
    states = [entry for entry in entries if entry.kind is EntryKind.STATE and _is_state(_content(entry))]
    ends = [_content(entry) for entry in entries if entry.kind is EntryKind.END]
    end = content | {"state": "interrupted", "sentence": ABANDONED}
    if ends and _is_end(ends[-1], content):
        end = ends[-1]
    known = RunStore(database).counts(run)
    with database.writing() as connection:
        add_bytes(connection, [byte_row(run, entry) for entry in pieces[known.pieces :]])
        add_states(connection, [state_row(run, entry) for entry in states[known.states :]])
        put_run(connection, end)


def _content(entry: Entry) -> Any:
    """The JSON of an entry; None where it is damaged."""
    try:
        content = json_content(entry.data, "a journal")
        json.dumps(content, ensure_ascii=False).encode()
    except (InputError, UnicodeEncodeError):
        return None
    return content


def _is_state(content: Any) -> bool:
    return isinstance(content, list) and len(content) == 3 and all(isinstance(one, str) for one in content)


def _is_end(end: Any, content: dict[str, object]) -> bool:
    """Whether it is the same run with everything that the database has of it."""
    if not isinstance(end, dict) or not content.keys() <= end.keys() or not isinstance(end["state"], str):
        return False
    return all(end[key] == content[key] for key in ("id", "started"))
