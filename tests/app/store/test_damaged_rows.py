"""A damaged row takes one line: the studio starts, every list is there, and the row can be set aside."""

from __future__ import annotations

import json
import shutil
import sqlite3
import time
from contextlib import closing
from copy import deepcopy
from pathlib import Path
from typing import Any

import pytest

from app.store.backups import found_backups
from app.store.database import DATABASE, Database
from app.store.quick_check import reading
from app.store.tables.job_store import JobStore
from app.store.tables.result_store import ResultStore
from app.store.tables.run_store import RunStore
from app.store.tables.run_writer import RunWriter
from app.store.tables.unreadable import Unreadable
from app.studio import studio as studio_module
from core.errors import NotFoundError, StateError, StorageDamagedError
from tests.app.server.test_storage_http import client_of
from tests.support import stored_contents
from tests.support.damaged_rows import (
    DAMAGES,
    LISTS,
    TABLES,
    columns_of,
    damage_all,
    damage_each_column,
    parts,
    whole_folder,
)

KEPT = {"run": "runs", "trial": "trials", "video": "videos"}
"""Lists with ids, by table."""
QUICK = ("open brace", "no text")
"""Damages that are tried each time."""


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return whole_folder(tmp_path_factory.mktemp("whole")).parent


@pytest.fixture
def database(whole: Path, tmp_path: Path) -> Path:
    """A database with rows in every table."""
    shutil.copytree(whole, tmp_path / "data")
    return tmp_path / "data" / DATABASE


@pytest.fixture(autouse=True)
def no_solvers(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(studio_module, "STARTS_SOLVERS_AHEAD", False)


def require_lists(client: Any) -> None:
    """Every list answers, and says nothing of an error of the studio's own."""
    for path in LISTS:
        answer = client.get(path)
        assert answer.status_code < 500, (path, answer.text)


@pytest.mark.parametrize(
    "damage",
    [
        pytest.param(damage, id=name, marks=[] if name in QUICK else pytest.mark.heavy)
        for name, damage in DAMAGES.items()
    ],
)
def test_a_damaged_column_of_any_table_takes_one_line(
    database: Path, damage: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    with closing(sqlite3.connect(database)) as connection:
        query = "SELECT id FROM {} WHERE deleted IS NULL"
        kept = {table: {key for (key,) in connection.execute(query.format(table))} for table in KEPT}
    assert damage_each_column(database, damage) > 40
    with client_of(database.parent, monkeypatch) as (client, opened):
        require_lists(client)
        for table, name in KEPT.items():
            assert kept[table] <= {one["id"] for one in client.get(f"/api/{name}").json()[name]}
        Unreadable(opened).look(lambda: True)
        storage = client.get("/api/health").json()["storage"]
        assert storage["unreadable"]["count"] > 20
        assert not storage["damaged"]
        assert "cannot be read" in storage["sentence"]
        assert client.post("/api/robot/stop").status_code == 200
        gait = client.get("/api/gaits/walk").json()
        assert client.put("/api/gaits/walk", json=gait | {"notes": "Goes on."}).status_code == 200


@pytest.mark.heavy
@pytest.mark.parametrize("table", TABLES)
def test_a_table_whose_rows_are_all_damaged_loses_no_other_list(
    database: Path, table: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    damage_all(database, table, DAMAGES["an empty object"])
    with client_of(database.parent, monkeypatch) as (client, _):
        require_lists(client)


@pytest.mark.heavy
@pytest.mark.parametrize("table", ["job", "run", "trial", "trial_photo", "video", "learning", "physics_set"])
def test_content_that_lacks_a_key_or_has_another_kind_takes_one_line(
    database: Path, table: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Each key of the content is taken away, or has a text, a list, nothing or a huge number instead."""
    added: list[str] = []
    with closing(sqlite3.connect(database)) as connection, connection:
        columns = columns_of(connection, table)
        query = f"SELECT {', '.join(columns)} FROM {table} ORDER BY length(content) LIMIT 1"
        row = dict(zip(columns, connection.execute(query).fetchone(), strict=True))
        key = columns[0]
        for path in parts(json.loads(row["content"])):
            for value in ("gone", "x", [[1], [2, 3]], None, 1e300):
                name = f"{len(added):012d}"
                copy = {k: v.replace(row[key], name) if isinstance(v, str) else v for k, v in row.items()}
                content = deepcopy(json.loads(copy["content"]))
                holder = content
                for step in path[:-1]:
                    holder = holder[step]
                if value == "gone":
                    holder.pop(path[-1])
                else:
                    holder[path[-1]] = value
                copy["content"] = json.dumps(content)
                places = ", ".join("?" * len(columns))
                connection.execute(
                    f"INSERT INTO {table}({', '.join(columns)}) VALUES({places})", list(copy.values())
                )
                added.append(name)
    views = {"job": "/api/jobs/", "run": "/api/runs/", "trial": "/api/trials/", "video": "/api/videos/"}
    with client_of(database.parent, monkeypatch) as (client, _):
        require_lists(client)
        for name in added if table in views else ():
            answer = client.get(f"{views[table]}{name}")
            assert answer.status_code in (200, 422), answer.text
            if table == "trial":
                for part in ("paths", "beside", "photos", "track.csv"):
                    assert client.get(f"{views[table]}{name}/{part}").status_code in (200, 422)


def spoil(path: Path, content: bytes | str, key: str = "j") -> None:
    with closing(sqlite3.connect(path)) as connection, connection:
        connection.execute("UPDATE job SET content=CAST(? AS TEXT) WHERE id=?", (content, key))


@pytest.mark.parametrize("content", ["{", "[1]", '{"id": "j", "state": 3}', b"\xff\xfe", b"\0\0"])
def test_a_row_that_is_set_aside_comes_back_as_it_was(tmp_path: Path, content: bytes | str) -> None:
    path = tmp_path / DATABASE
    with closing(Database(path)) as database:
        JobStore(database).put(stored_contents.job("j"))
        JobStore(database).put(stored_contents.job("k"))
    spoil(path, content)
    with closing(Database(path)) as database:
        unreadable = Unreadable(database)
        before = database.rows("SELECT rowid, * FROM job")
        unreadable.look(lambda: True)
        (damage,) = unreadable.known()
        assert (damage.table, damage.key) == ("job", "j")
        number = unreadable.set_aside("job", damage.row)
        assert unreadable.known() == []
        assert [row.id for row in JobStore(database).newest(9).rows] == ["k"]
        unreadable.bring_back(number)
        assert database.rows("SELECT rowid, * FROM job") == before
        assert len(unreadable.known()) == 1
        with pytest.raises(NotFoundError, match="No row was set aside"):
            unreadable.bring_back(number)


def test_only_rows_that_cannot_be_read_are_set_aside(tmp_path: Path) -> None:
    with closing(Database(tmp_path / DATABASE)) as database:
        JobStore(database).put(stored_contents.job("j"))
        unreadable = Unreadable(database)
        with pytest.raises(StateError, match="can be read"):
            unreadable.set_aside("job", 1)
        with pytest.raises(NotFoundError, match="no row 2"):
            unreadable.set_aside("job", 2)
        with pytest.raises(NotFoundError, match="no table"):
            unreadable.set_aside("sqlite_master; DROP TABLE job", 1)
        assert len(JobStore(database).newest(9).rows) == 1


def test_a_row_does_not_come_back_over_another_one(tmp_path: Path) -> None:
    path = tmp_path / DATABASE
    with closing(Database(path)) as database:
        JobStore(database).put(stored_contents.job("j"))
        spoil(path, "{")
        unreadable = Unreadable(database)
        number = unreadable.set_aside("job", 1)
        JobStore(database).put(stored_contents.job("j", state="failed"))
        with pytest.raises(StateError, match="was replaced meanwhile"):
            unreadable.bring_back(number)
        assert JobStore(database).get("j") is not None


def cut_off(path: Path) -> None:
    with path.open("r+b") as file:
        file.truncate(4096)


def empty_log(path: Path) -> None:
    with path.with_name(f"{path.name}-wal").open("r+b") as file:
        file.truncate(0)


def replace_by_a_copy(path: Path) -> None:
    copy = path.with_name("copy")
    shutil.copyfile(path, copy)
    copy.replace(path)


TAKEN = {
    "deleted": lambda path: path.unlink(),
    "replaced": replace_by_a_copy,
    "cut off": cut_off,
    "log deleted": lambda path: path.with_name(f"{path.name}-wal").unlink(),
    "log emptied": empty_log,
    "index deleted": lambda path: path.with_name(f"{path.name}-shm").unlink(),
}


@pytest.mark.parametrize("take", TAKEN.values(), ids=TAKEN)
def test_a_database_that_is_taken_away_takes_no_write_and_loses_none(tmp_path: Path, take: Any) -> None:
    path = tmp_path / DATABASE
    with closing(Database(path)) as database:
        store, writer = ResultStore(database), RunWriter(path, database.files)
        for number in range(20):
            store.put(f"{number}", {"explanation": ["x" * 2000]})
        database.rows("PRAGMA wal_checkpoint")
        store.put("last", {})
        take(path)
        for name in ("lost", "lost too"):
            with pytest.raises(StorageDamagedError, match=r"while it was in use.*footfall restore"):
                store.put(name, {})
        with pytest.raises(sqlite3.OperationalError, match="while it was in use"):
            writer.write([])
        assert database.damage is not None
        (backup,) = found_backups(tmp_path)
        with closing(reading(backup.path)) as connection:
            kept = {motion for (motion,) in connection.execute("SELECT motion FROM result")}
        if "cut off" not in database.damage and "emptied" not in database.damage:
            assert {*map(str, range(20)), "last"} <= kept
        writer.close()


def test_a_write_that_changes_nothing_finds_no_fault(tmp_path: Path) -> None:
    path = tmp_path / DATABASE
    with closing(Database(path)) as database:
        ResultStore(database).put("kept", {})
    with closing(Database(path)) as database:
        assert not RunStore(database).put_deleted("no such run", 1.0)
        with closing(sqlite3.connect(path)) as other:
            other.execute("PRAGMA wal_checkpoint(TRUNCATE)")
        assert not RunStore(database).put_deleted("no such run", 1.0)
        ResultStore(database).put("kept too", {})
        with closing(sqlite3.connect(path, isolation_level=None)) as other:
            other.execute("VACUUM")
        ResultStore(database).put("kept as well", {})
        assert database.damage is None


def test_a_thousand_damaged_rows_delay_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / DATABASE
    Database(path).close()
    with closing(sqlite3.connect(path)) as connection, connection:
        rows = [(f"r{number}", "{" + "x" * 2000) for number in range(1000)]
        connection.executemany("INSERT INTO run(id, started, content) VALUES(?, 1.0, ?)", rows)
    begun = time.process_time()
    with client_of(tmp_path, monkeypatch) as (client, opened):
        Unreadable(opened).look(lambda: True)
        assert client.get("/api/health").json()["storage"]["unreadable"]["count"] == 1000
        assert len(client.get("/api/runs?most=200").json()["unreadable"]) == 200
    assert time.process_time() - begun < 20.0
