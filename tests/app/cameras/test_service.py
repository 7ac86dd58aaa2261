"""What cameras are for is kept, also of those that are unplugged."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from app.cameras import service as camera_desk
from app.cameras.address import CameraAddress
from app.cameras.service import CameraDesk
from app.cameras.setup_service import SetupDesk
from app.store.camera_setup_store import SetupLog
from app.store.database import Database
from core.errors import InputError, NotFoundError

RECORDS = {"name": "Lab camera", "use": "side", "setup": "", "records": True}


@pytest.fixture
def desk(database: Database, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[CameraDesk]:
    """A desk with one served film, on a computer without cameras."""
    monkeypatch.setattr(camera_desk, "devices", lambda: [])
    film = CameraAddress("film", "Film", str(tmp_path / "film.avi"), True)
    opened = CameraDesk(database, SetupDesk(database), [film])
    yield opened
    opened.close()


def test_a_camera_that_nobody_looks_at_is_idle(desk: CameraDesk) -> None:
    (film,) = desk.views()
    assert (film["id"], film["state"], film["use"], film["records"]) == ("film", "idle", "under", False)
    assert desk.change("film", {"use": "side"})["use"] == "side"
    assert desk.view("film")["use"] == "side"


def test_a_recording_camera_that_is_unplugged_is_missed(desk: CameraDesk, database: Database) -> None:
    SetupLog(database).put_camera("video0", RECORDS)
    missed = desk.view("video0")
    assert missed["state"] == "unplugged"
    assert "“Lab camera” is unplugged" in missed["sentence"]
    assert [view["id"] for view in desk.recording()] == ["video0"]
    with pytest.raises(NotFoundError, match="Plug it in"):
        desk.link("video0")


def test_a_film_that_is_served_no_more_is_not_missed(desk: CameraDesk, database: Database) -> None:
    SetupLog(database).put_camera("other", RECORDS)
    assert [view["id"] for view in desk.views()] == ["film"]


def test_a_camera_that_is_to_find_feet_needs_a_setup_to_record(desk: CameraDesk) -> None:
    with pytest.raises(InputError, match="has no setup"):
        desk.change("film", {"records": True})
    assert not desk.view("film")["records"]
