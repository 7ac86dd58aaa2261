"""The studio on a full disk and over a damaged database: sentences with a fitting status, and Stop."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path
from typing import Any

import pytest
from fastapi.testclient import TestClient

from app.scene.registry import Scenes
from app.server.application import make_app
from app.store.backups import DAILY, found_backups, make_backup
from app.store.database import Database
from app.studio.studio import Studio
from app.web.access import Access
from tests.support.spoilt_database import fill, overwrite_table, take_more, take_no_more
from tests.support.studio_process import footfall, running_studio, text_of, wait_for

MANUAL = "/api/gaits/walk-manual-0"
APPROVE = {"by": "Ada", "accept_warnings": True}


@contextmanager
def client_of(data: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[tuple[TestClient, Database]]:
    """A studio in this process, asked as a browser asks, and its database."""
    opened: list[Database] = []

    def open_database(path: Path) -> Database:
        opened.append(Database(path))
        return opened[0]

    monkeypatch.setattr("app.studio.studio.Database", open_database)
    with closing(Studio(data, "emulator")) as studio:
        app = make_app(studio, Scenes(), Access("127.0.0.1", None))
        with TestClient(app, base_url="http://127.0.0.1:8400", raise_server_exceptions=False) as client:
            yield client, opened[0]


def edited(client: TestClient, notes: str) -> Any:
    return client.get(MANUAL).json() | {"notes": notes}


def test_a_full_disk_is_507_with_a_sentence_and_room_makes_everything_well(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with client_of(tmp_path, monkeypatch) as (client, database):
        assert client.put(MANUAL, json=edited(client, "kept")).status_code == 200
        assert client.post(f"{MANUAL}/check").json()["passed"]
        before = client.get(f"{MANUAL}/view").json()
        take_no_more(database)
        long = edited(client, "n" * 19_000)
        for answer in (
            client.put(MANUAL, json=long),
            client.post(f"{MANUAL}/approve", json={**APPROVE, "by": "Ada" * 20}),
            client.post(f"{MANUAL}/save"),
            client.post("/api/gaits", json=long | {"name": "New"}),
        ):
            assert answer.status_code == 507, answer.text
            assert "Free space" in answer.json()["error"]
        after = client.get(f"{MANUAL}/view").json()
        assert {key: after[key] for key in ("document", "revision", "approval", "saved_at")} == {
            key: before[key] for key in ("document", "revision", "approval", "saved_at")
        }
        assert not list((tmp_path / "gaits").iterdir())
        assert client.post("/api/robot/stop").status_code == 200
        take_more(database)
        assert client.post(f"{MANUAL}/approve", json=APPROVE).status_code == 200
        assert client.put(MANUAL, json=long).status_code == 200


def test_a_damaged_database_is_served_where_it_can_be_and_says_the_way_back(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    good = make_backup(fill(tmp_path), DAILY).path.name
    for table in ("job", "run", "version"):
        overwrite_table(tmp_path / "studio.sqlite3", table)
    with client_of(tmp_path, monkeypatch) as (client, _):
        health = client.get("/api/health").json()
        assert (health["status"], health["storage"]["damaged"]) == ("ok", True)
        with client.websocket_connect("/api/events", headers={"host": "127.0.0.1:8400"}) as socket:
            assert socket.receive_json()["storage"] == health["storage"]
        for word in (good, "jobs", "versions", "footfall restore"):
            assert word in health["storage"]["sentence"]
        assert client.get("/api/gaits/walk").json()["name"] == "Number 12"
        for answer in (
            client.put("/api/gaits/walk", json=client.get("/api/gaits/walk").json() | {"notes": "new"}),
            client.post("/api/gaits/walk/save"),
            client.get("/api/gaits/walk/versions"),
            client.get("/api/runs"),
        ):
            assert (answer.status_code, good in answer.json()["error"]) == (503, True), answer.text
        assert client.get("/api/gaits/walk").json()["notes"] != "new"
        assert client.post("/api/robot/stop").status_code == 200


@pytest.mark.heavy
def test_from_damage_to_the_last_good_backup_and_on(tmp_path: Path) -> None:
    data = tmp_path / "my data"
    with running_studio(data) as studio:
        document = studio.document("walk") | {"notes": "before"}
        assert studio.ask("PUT", "/api/gaits/walk", document).status == 200
        wait_for(lambda: len(found_backups(data)) == 1, "the backup of the day")
    backup = make_backup(data / "studio.sqlite3", DAILY)
    overwrite_table(data / "studio.sqlite3", "job")
    with running_studio(data) as studio:
        assert "footfall restore" in text_of(studio.said)
        assert studio.ask("PUT", "/api/gaits/walk", document | {"notes": "lost"}).status == 503
        refused = footfall("restore", "--data", str(data), "--backup", backup.path.name)
        assert (refused.returncode, str(studio.pid) in refused.stderr) == (2, True)
    listed = footfall("restore", "--data", str(data))
    assert (listed.returncode, backup.path.name in listed.stdout) == (0, True)
    back = footfall("restore", "--data", str(data), "--backup", backup.path.name)
    assert back.returncode == 0, back.stderr
    with running_studio(data) as studio:
        assert studio.ask("GET", "/api/health").content["storage"] == {"damaged": False, "sentence": None}
        assert studio.document("walk")["notes"] == "before"
        assert studio.ask("PUT", "/api/gaits/walk", document | {"notes": "after"}).status == 200


def test_a_database_that_cannot_be_opened_ends_serve_with_the_way_back(tmp_path: Path) -> None:
    backup = make_backup(fill(tmp_path), DAILY)
    (tmp_path / "studio.sqlite3").write_bytes(b"no database" * 1000)
    ended = footfall("serve", "--port", "0", "--data", str(tmp_path), "--no-browser")
    assert (ended.returncode, ended.stdout) == (2, "")
    assert backup.path.name in ended.stderr
    assert "Traceback" not in ended.stderr
