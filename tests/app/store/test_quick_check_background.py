"""The check of a large database: the studio is in use meanwhile, and damage is reported when it is found."""

from __future__ import annotations

import json
import shutil
import sqlite3
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path
from threading import Event
from typing import Any

import pytest

from app.common.json import Json
from app.store.backups import found_backups
from app.store.database import DATABASE, Database
from app.store.quick_check import damage_of
from app.store.tables.result_store import ResultStore
from app.studio import database_keeper
from app.studio.database_keeper import CHECKED_AT_ONCE, DatabaseKeeper
from core.errors import StorageDamagedError, StorageError
from tests.app.server.test_storage_http import MANUAL, client_of, edited
from tests.support.spoilt_database import overwrite
from tests.support.studio_process import running_studio, text_of, wait_for

HELD_SECONDS = 60.0
"""Longest time that a check is held back; no test waits it out."""


@pytest.fixture(scope="module")
def sound(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A large database: one stored motion takes nearly all of it."""
    path = tmp_path_factory.mktemp("large") / DATABASE
    Database(path).close()
    with closing(sqlite3.connect(path)) as connection, connection:
        content = json.dumps({"explanation": ["x" * CHECKED_AT_ONCE]})
        connection.execute("INSERT INTO result VALUES('large', ?)", (content,))
    return path


@pytest.fixture
def whole(sound: Path, tmp_path: Path) -> Path:
    """The large database in a data folder."""
    return shutil.copyfile(sound, tmp_path / DATABASE)


@pytest.fixture
def damaged(whole: Path) -> Path:
    """The same with garbage in the stored motion, which nothing reads when a studio starts."""
    overwrite(whole, 0.5, 0.51)
    return whole


class HeldCheck:
    """The check of the database, held back until a test lets it go on."""

    def __init__(self) -> None:
        self.begun, self.may_go_on = Event(), Event()

    def damage_of(self, path: Path, *, is_open: bool = False) -> str | None:
        """The result of the check, once it may go on."""
        self.begun.set()
        if not self.may_go_on.wait(HELD_SECONDS):
            raise AssertionError("the check was never let go on")
        return damage_of(path, is_open=is_open)


@pytest.fixture
def held(monkeypatch: pytest.MonkeyPatch) -> Iterator[HeldCheck]:
    check = HeldCheck()
    monkeypatch.setattr(database_keeper, "damage_of", check.damage_of)
    yield check
    check.may_go_on.set()


def test_a_studio_is_in_use_while_its_large_database_is_checked_and_then_reports_the_damage(
    damaged: Path, held: HeldCheck, monkeypatch: pytest.MonkeyPatch
) -> None:
    with client_of(damaged.parent, monkeypatch) as (client, _):
        assert held.begun.wait(HELD_SECONDS)
        unharmed = {"damaged": False, "sentence": None}
        assert client.get("/api/health").json()["storage"] == unharmed
        assert client.put(MANUAL, json=edited(client, "before")).status_code == 200
        with client.websocket_connect("/api/events", headers={"host": "127.0.0.1:8400"}) as socket:
            assert socket.receive_json()["storage"] == unharmed
            held.may_go_on.set()
            view = storage_event(socket)
        assert view == client.get("/api/health").json()["storage"]
        for part in ("is damaged", "optimised motions", "no good backup", "footfall restore"):
            assert part in view["sentence"]
        answer = client.put(MANUAL, json=edited(client, "after"))
        assert (answer.status_code, answer.json()["error"]) == (503, view["sentence"])
        assert client.get(MANUAL).json()["notes"] == "before"
        assert client.post("/api/robot/stop").status_code == 200
    assert found_backups(damaged.parent) == ()


def storage_event(socket: Any) -> Json:
    """The next event about the database."""
    while (event := socket.receive_json())["type"] != "storage":
        pass
    view: Json = event["storage"]
    return view


def test_nothing_is_reported_of_a_sound_large_database(
    whole: Path, held: HeldCheck, caplog: pytest.LogCaptureFixture
) -> None:
    told: list[Json] = []
    with closing(Database(whole)) as database:
        keeper = DatabaseKeeper(database, told.append, lambda: True)
        assert not held.begun.is_set()
        with closing(keeper):
            keeper.start()
            assert held.begun.wait(HELD_SECONDS)
            ResultStore(database).put("new", {"stored": "during the check"})
            held.may_go_on.set()
            wait_for(lambda: len(found_backups(whole.parent)) == 1, "the backup after the check")
            assert keeper.view() == {"damaged": False, "sentence": None}
        ResultStore(database).put("newer", {"stored": "after the check"})
    assert (told, caplog.records) == ([], [])


def test_damage_ends_writing_from_the_moment_that_the_check_finds_it(
    damaged: Path, held: HeldCheck, caplog: pytest.LogCaptureFixture
) -> None:
    told: list[Json] = []
    with closing(Database(damaged)) as database:
        with closing(DatabaseKeeper(database, told.append, lambda: True)) as keeper:
            keeper.start()
            ResultStore(database).put("before", {})
            held.may_go_on.set()
            wait_for(lambda: bool(told), "the report")
            assert told == [keeper.view()]
            with pytest.raises(StorageDamagedError, match="Nothing can be stored"):
                ResultStore(database).put("after", {})
            assert ResultStore(database).get("before") == {}
        assert [record.getMessage() for record in caplog.records] == [keeper.view()["sentence"]]
    assert found_backups(damaged.parent) == ()


def test_a_check_that_fails_is_reported_and_the_database_stays_in_use(
    whole: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fails(path: Path, *, is_open: bool) -> str | None:
        raise StorageError("The disk does not answer.", str(path))

    monkeypatch.setattr(database_keeper, "damage_of", fails)
    told: list[Json] = []
    with closing(Database(whole)) as database:
        keeper = DatabaseKeeper(database, told.append, lambda: False)
        assert told == []
        with closing(keeper):
            keeper.start()
            wait_for(lambda: bool(told), "the report")
        ResultStore(database).put("new", {})
    sentence = "The database could not be checked. The disk does not answer."
    assert told == [{"damaged": False, "sentence": sentence}]


@pytest.mark.heavy
@pytest.mark.parametrize("is_damaged", [False, True])
def test_a_real_studio_on_a_large_database(whole: Path, is_damaged: bool) -> None:
    if is_damaged:
        overwrite(whole, 0.5, 0.51)
    with running_studio(whole.parent) as studio:

        def storage() -> Json:
            view: Json = studio.ask("GET", "/api/health").content["storage"]
            return view

        if is_damaged:
            wait_for(lambda: storage()["damaged"], "the damage is found")
            assert storage()["sentence"] in text_of(studio.said)
        else:
            wait_for(lambda: len(found_backups(whole.parent)) == 1, "the backup after the check")
            assert storage() == {"damaged": False, "sentence": None}
            assert "database" not in text_of(studio.said)
