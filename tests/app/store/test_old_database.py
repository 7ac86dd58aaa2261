"""A database of the first release: its history, with and without something undone, goes on as it was."""

from __future__ import annotations

import json
import sqlite3
from dataclasses import replace
from pathlib import Path

import pytest

from app.documents.gait_json import gait_content
from app.gaits.live_plans import LivePlans
from app.gaits.service import GaitService
from app.store.database import Database
from app.store.gait_files import GaitFiles
from app.store.tables.job_store import JobStore
from core.errors import InputError, StateError
from core.gait.gait import Gait
from core.library.library import library
from solver_jobs import SolveStatus
from tests.support import stored_contents
from tests.support.live_tiers import FixedTier

GAIT = "walk"
OLD_SCHEMA = """
CREATE TABLE history(gait TEXT, position INTEGER, label TEXT, document TEXT, PRIMARY KEY(gait, position));
CREATE TABLE open_gait(
    gait TEXT PRIMARY KEY, revision INTEGER, cursor INTEGER, notice TEXT, approval TEXT);
CREATE TABLE result(motion TEXT PRIMARY KEY, content TEXT);
CREATE TABLE job(id TEXT PRIMARY KEY, created REAL, content TEXT);
CREATE TABLE approval(number INTEGER PRIMARY KEY AUTOINCREMENT, gait TEXT, content TEXT);
CREATE TABLE run(id TEXT PRIMARY KEY, started REAL, content TEXT);
CREATE TABLE run_bytes(
    number INTEGER PRIMARY KEY AUTOINCREMENT, run TEXT, time REAL, direction TEXT, data BLOB);
"""


def named(number: int) -> Gait:
    gait = library()[GAIT].gait
    return gait if number == 0 else replace(gait, name=f"Name {number}")


def old_database(path: Path, cursor: int) -> None:
    """Three edits of a name, and a cursor on one of the four documents."""
    connection = sqlite3.connect(path)
    with connection:
        connection.executescript(OLD_SCHEMA)
        rows = [(GAIT, at, f"Name to {at}", json.dumps(gait_content(named(at)))) for at in range(4)]
        connection.executemany("INSERT INTO history VALUES(?,?,?,?)", rows)
        connection.execute("INSERT INTO open_gait VALUES(?,?,?,NULL,NULL)", (GAIT, 9, cursor))
        connection.execute("INSERT INTO job VALUES('j', 1.0, ?)", (json.dumps(stored_contents.job("j")),))
    connection.close()


def service_on(folder: Path, database: Database) -> GaitService:
    return GaitService(GaitFiles(folder), database, LivePlans(FixedTier(SolveStatus.INFEASIBLE)).solve_for)


@pytest.mark.parametrize("cursor", [0, 1, 3])
def test_undo_and_redo_go_on_where_the_cursor_stood(tmp_path: Path, cursor: int) -> None:
    path = tmp_path / "studio.sqlite3"
    old_database(path, cursor)
    for _ in range(2):  # the second time there is nothing left to migrate
        database = Database(path)
        service = service_on(tmp_path, database)
        assert service.open_gait(GAIT).gait == named(cursor)
        assert service.open_gait(GAIT).revision == 9
        database.close()
    database = Database(path)
    service = service_on(tmp_path, database)
    for at in range(cursor + 1, 4):
        assert service.redo(GAIT).gait == named(at)
    with pytest.raises(StateError, match="nothing to redo"):
        service.redo(GAIT)
    for at in (2, 1, 0):
        assert service.undo(GAIT).gait == named(at)
    with pytest.raises(StateError, match="nothing to undo"):
        service.undo(GAIT)
    assert len(JobStore(database).newest(50).rows) == 1
    database.close()


def test_a_database_of_a_newer_program_is_refused_and_left_alone(tmp_path: Path) -> None:
    path = tmp_path / "studio.sqlite3"
    Database(path).close()
    connection = sqlite3.connect(path)
    connection.execute("PRAGMA user_version = 99")
    connection.close()
    content = path.read_bytes()
    with pytest.raises(InputError, match="version 99"):
        Database(path)
    assert path.read_bytes() == content
