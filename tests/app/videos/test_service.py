"""Recordings that were broken off are kept as far as they came; old ones make room."""

from __future__ import annotations

import sqlite3
from pathlib import Path

import numpy as np
import pytest

from app.store.database import Database
from app.store.tables.video_store import VideoStore
from app.videos import service as video_service
from app.videos.files import Upload
from app.videos.service import VideoService
from app.vision.frame_source import PICTURES
from app.vision.recording_file import Recording, RecordingWriter
from app.vision.services import VisionServices, VisionTask, ask
from app.vision.video_io import jpeg, read_picture
from app.vision.worker import ReadFacts
from core.errors import FootfallError, InputError, StateError
from tests.support.studio_process import wait_for

GREY = jpeg(np.full((48, 64, 3), 120, dtype=np.uint8))


@pytest.fixture
def service(tmp_path: Path, database: Database, vision: VisionServices) -> VideoService:
    return VideoService(tmp_path, database, vision)


def recorded(service: VideoService, pictures: int, name: str = "Walk") -> str:
    """A recording that nobody ended."""
    video = str(service.begin_recording(name, "run", "under")["id"])
    writer = RecordingWriter(service.files.path(video))
    for number in range(pictures):
        writer.add(GREY, 0.1 * number)
    writer.close()
    return video


def ended(service: VideoService, video: str) -> str:
    wait_for(lambda: service.view(video)["state"] != "recording", "it is known what there is", 60)
    return str(service.view(video)["state"])


def test_what_a_killed_program_recorded_is_kept(
    service: VideoService, database: Database, vision: VisionServices
) -> None:
    video = recorded(service, 5)
    again = VideoService(service.files.folder.parent, database, vision)
    again.tidy()
    assert ended(again, video) == "kept"
    view = again.view(video)
    assert (view["frames"], view["size"], view["bytes"]) == (5, [64, 48], 5 * len(GREY))
    assert view["rate"] == pytest.approx(10.0)
    assert "The studio ended while this was recorded." in view["sentence"]


def test_a_picture_that_was_not_written_whole_is_left_out(service: VideoService) -> None:
    video = recorded(service, 3)
    pictures = service.files.path(video) / PICTURES
    pictures.write_bytes(pictures.read_bytes()[:-10])
    footage = Recording(service.files.path(video))
    assert footage.facts.count == 2
    with pytest.raises(InputError, match="ends before picture 2"):
        footage.picture(2)
    footage.close()


def test_a_recording_without_pictures_says_so(service: VideoService) -> None:
    video = recorded(service, 0)
    service.salvage(video, "The camera's process ended.")
    assert ended(service, video) == "removed"
    assert "holds no picture" in service.view(video)["sentence"]
    with pytest.raises(StateError, match="holds no picture"):
        service.path(video)


def test_the_oldest_recordings_make_room(service: VideoService, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(video_service, "MOST_RECORDED", 1.5 * len(GREY) * 3)
    old, new = recorded(service, 3), recorded(service, 3)
    for video in (old, new):
        service.change(video, state="kept", bytes=3 * len(GREY))
    service.make_room()
    assert [service.view(video)["state"] for video in (old, new)] == ["removed", "kept"]
    assert not service.files.path(old).exists()


def test_a_video_that_was_deleted_long_ago_goes(
    service: VideoService, monkeypatch: pytest.MonkeyPatch
) -> None:
    video = recorded(service, 3)
    service.change(video, state="kept")
    service.delete(video)
    service.tidy()
    assert service.files.path(video).exists()
    monkeypatch.setattr(video_service, "MOST_DELETED", -1.0)
    service.tidy()
    assert not service.files.path(video).exists()


def test_a_video_that_is_being_recorded_cannot_be_deleted(service: VideoService) -> None:
    with pytest.raises(StateError, match="being recorded"):
        service.delete(recorded(service, 1))


def test_a_video_that_is_being_recorded_is_not_read_yet(service: VideoService) -> None:
    with pytest.raises(StateError, match="being recorded"):
        service.source(recorded(service, 1), 0)


def test_an_upload_that_the_disk_does_not_take_leaves_nothing(tmp_path: Path) -> None:
    partial = tmp_path / "full"
    partial.symlink_to("/dev/full")
    upload = Upload(partial, "walk.mp4")
    upload.add(b"\0few")
    with pytest.raises(StateError, match="Make room"):
        upload.finish()
    upload.discard()
    assert not partial.is_symlink()


def test_an_upload_that_the_database_refuses_leaves_nothing(
    service: VideoService, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(log: VideoStore, content: object) -> None:
        raise sqlite3.OperationalError("The database is locked.")

    monkeypatch.setattr(VideoStore, "put", refuse)
    upload = service.begin("row.mjpeg", None)
    upload.add(GREY * 3)
    with pytest.raises(sqlite3.OperationalError):
        service.keep(upload)
    assert list(service.files.folder.iterdir()) == []


def test_an_answer_that_cannot_be_kept_is_told_and_the_next_one_comes(
    service: VideoService, vision: VisionServices
) -> None:
    failures: list[FootfallError] = []

    def broken(_: object) -> None:
        raise OSError("The disk is full.")

    def broken_again(error: FootfallError) -> None:
        failures.append(error)
        raise OSError("The disk is full.")

    facts = ReadFacts(service.files.path(recorded(service, 3)))
    look = vision.interactive.ask(VisionTask(facts, done=broken, failed=broken_again))
    with pytest.raises(StateError):
        look.result(60.0)
    assert ask(vision.interactive, facts, 60.0).count == 3
    assert len(failures) == 1


def test_a_bare_row_of_pictures_is_counted_and_sought_in(service: VideoService) -> None:
    shades = [jpeg(np.full((48, 64, 3), 20 * number, dtype=np.uint8)) for number in range(12)]
    upload = service.begin("row.mjpeg", None)
    upload.add(b"".join(shades))
    video = service.keep(upload)
    assert video["frames"] == 12
    for number in (9, 2, 11):
        shown = read_picture(service.picture(service.source(video["id"], number), None), "shown")
        assert shown.mean() == pytest.approx(20 * number, abs=2)
    with pytest.raises(InputError, match="there is no picture 12"):
        service.source(video["id"], 12)


def test_a_count_of_pictures_that_an_earlier_version_kept_is_put_right(service: VideoService) -> None:
    upload = service.begin("row.mjpeg", None)
    upload.add(GREY * 12)
    video = service.keep(upload)["id"]
    service.change(video, frames=20, seconds=99.0)
    assert service.times(video).size == 12
    assert (service.view(video)["frames"], service.view(video)["seconds"]) == (12, pytest.approx(12 / 25))
    with pytest.raises(InputError, match="there is no picture 12"):
        service.source(video, 12)


def test_an_answer_that_does_not_come_in_time_is_a_sentence(
    service: VideoService, vision: VisionServices
) -> None:
    with pytest.raises(StateError, match="the computer is busy"):
        ask(vision.interactive, ReadFacts(service.files.path(recorded(service, 3))), 0.0)
