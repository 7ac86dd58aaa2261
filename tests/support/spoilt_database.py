"""Databases that are damaged, and databases that take no more."""

from __future__ import annotations

import json
import random
import sqlite3
from contextlib import closing
from dataclasses import replace
from pathlib import Path

from app.documents.gait_json import gait_content
from app.gaits.live_plans import LivePlans
from app.gaits.service import GaitService
from app.store.database import Database
from app.store.gait_files import GaitFiles
from app.store.tables.result_store import ResultStore
from core.library.library import library
from solver_jobs import SolveStatus
from tests.support.live_tiers import FixedTier


def service_on(folder: Path, database: Database) -> GaitService:
    """The gaits of a data folder, without a solver."""
    return GaitService(GaitFiles(folder), database, LivePlans(FixedTier(SolveStatus.INFEASIBLE)).solve_for)


def fill(folder: Path, edits: int = 12) -> Path:
    """A database with edits of a gait, and long results that take many pages; its file."""
    path = folder / "studio.sqlite3"
    with closing(Database(path)) as database:
        service = service_on(folder, database)
        for number in range(1, edits + 1):
            gait = service.open_gait("walk").gait
            service.edit("walk", replace(gait, name=f"Number {number}"), "Name", None)
        document = gait_content(library()["walk"].gait)
        for number in range(40):
            ResultStore(database).put(f"{number:064d}", {"document": json.dumps(document) * 3})
    return path


def overwrite(path: Path, first: float = 0.3, last: float = 0.7) -> None:
    """Writes garbage over the pages of a part of a file."""
    size = path.stat().st_size
    start, end = (round(size * share) // 4096 * 4096 for share in (first, last))
    with path.open("r+b") as file:
        file.seek(start)
        file.write(random.Random(7).randbytes(end - start))


def pages_of(path: Path, table: str) -> list[int]:
    """The pages that hold a table."""
    with closing(sqlite3.connect(path)) as connection:
        root = connection.execute("SELECT rootpage FROM sqlite_master WHERE name=?", (table,)).fetchone()
    return [int(root[0])]


def overwrite_table(path: Path, table: str) -> None:
    """Writes garbage over the first page of a table."""
    (page,) = pages_of(path, table)
    with path.open("r+b") as file:
        file.seek((page - 1) * 4096)
        file.write(random.Random(7).randbytes(4096))


def take_no_more(database: Database) -> None:
    """Lets a database grow no more, as on a full disk."""
    count = database.rows("PRAGMA page_count")[0][0]
    database.rows(f"PRAGMA max_page_count={count}")


def take_more(database: Database) -> None:
    """Makes room again."""
    database.rows("PRAGMA max_page_count=1000000")
