"""What cameras are for is kept, also of those that are unplugged."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from app.cameras import service as camera_service
from app.cameras.address import CameraAddress
from app.cameras.service import CameraService
from app.cameras.setup_service import CameraSetupService
from app.store.database import Database
from app.store.tables.camera_setup_store import CameraSetupStore
from core.errors import InputError, NotFoundError

RECORDS = {"name": "Lab camera", "use": "side", "setup": "", "records": True}


@pytest.fixture
def service(database: Database, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[CameraService]:
    """A service with one served film, on a computer without cameras."""
    monkeypatch.setattr(camera_service, "devices", lambda: [])
    film = CameraAddress("film", "Film", str(tmp_path / "film.avi"), True)
    opened = CameraService(database, CameraSetupService(database), [film])
    yield opened
    opened.close()


def test_a_camera_that_nobody_looks_at_is_idle(service: CameraService) -> None:
    (film,) = service.views()
    assert (film["id"], film["state"], film["use"], film["records"]) == ("film", "idle", "under", False)
    assert service.change("film", {"use": "side"})["use"] == "side"
    assert service.view("film")["use"] == "side"


def test_a_recording_camera_that_is_unplugged_is_missed(service: CameraService, database: Database) -> None:
    CameraSetupStore(database).put_camera("video0", RECORDS)
    missed = service.view("video0")
    assert missed["state"] == "unplugged"
    assert "“Lab camera” is unplugged" in missed["sentence"]
    assert [view["id"] for view in service.recording()] == ["video0"]
    with pytest.raises(NotFoundError, match="Plug it in"):
        service.link("video0")


def test_a_film_that_is_served_no_more_is_not_missed(service: CameraService, database: Database) -> None:
    CameraSetupStore(database).put_camera("other", RECORDS)
    assert [view["id"] for view in service.views()] == ["film"]


def test_a_camera_that_is_to_find_feet_needs_a_setup_to_record(service: CameraService) -> None:
    with pytest.raises(InputError, match="has no setup"):
        service.change("film", {"records": True})
    assert not service.view("film")["records"]
