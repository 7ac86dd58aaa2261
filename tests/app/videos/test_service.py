"""Recordings that were broken off are kept as far as they came; old ones make room."""

from __future__ import annotations

import sqlite3
from pathlib import Path

import numpy as np
import pytest

from app.store.database import Database
from app.store.video_store import VideoLog
from app.videos import service as video_desk
from app.videos.files import Upload
from app.videos.service import VideoDesk
from app.vision.footage import PICTURES
from app.vision.recording_file import Recording, RecordingWriter
from app.vision.services import Eyes, Look, seen
from app.vision.video_io import jpeg, read_picture
from app.vision.worker import FactsOf
from core.errors import FootfallError, InputError, StateError
from tests.support.studio_process import wait_for

GREY = jpeg(np.full((48, 64, 3), 120, dtype=np.uint8))


@pytest.fixture
def desk(tmp_path: Path, database: Database, eyes: Eyes) -> VideoDesk:
    return VideoDesk(tmp_path, database, eyes)


def recorded(desk: VideoDesk, pictures: int, name: str = "Walk") -> str:
    """A recording that nobody ended."""
    video = str(desk.begin_recording(name, "run", "under")["id"])
    writer = RecordingWriter(desk.files.path(video))
    for number in range(pictures):
        writer.add(GREY, 0.1 * number)
    writer.close()
    return video


def ended(desk: VideoDesk, video: str) -> str:
    wait_for(lambda: desk.view(video)["state"] != "recording", "it is known what there is", 60)
    return str(desk.view(video)["state"])


def test_what_a_killed_program_recorded_is_kept(desk: VideoDesk, database: Database, eyes: Eyes) -> None:
    video = recorded(desk, 5)
    again = VideoDesk(desk.files.folder.parent, database, eyes)
    again.tidy()
    assert ended(again, video) == "kept"
    view = again.view(video)
    assert (view["frames"], view["size"], view["bytes"]) == (5, [64, 48], 5 * len(GREY))
    assert view["rate"] == pytest.approx(10.0)
    assert "The studio ended while this was recorded." in view["sentence"]


def test_a_picture_that_was_not_written_whole_is_left_out(desk: VideoDesk) -> None:
    video = recorded(desk, 3)
    pictures = desk.files.path(video) / PICTURES
    pictures.write_bytes(pictures.read_bytes()[:-10])
    footage = Recording(desk.files.path(video))
    assert footage.facts.count == 2
    with pytest.raises(InputError, match="ends before picture 2"):
        footage.picture(2)
    footage.close()


def test_a_recording_without_pictures_says_so(desk: VideoDesk) -> None:
    video = recorded(desk, 0)
    desk.salvage(video, "The camera's process ended.")
    assert ended(desk, video) == "removed"
    assert "holds no picture" in desk.view(video)["sentence"]
    with pytest.raises(StateError, match="holds no picture"):
        desk.path(video)


def test_the_oldest_recordings_make_room(desk: VideoDesk, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(video_desk, "MOST_RECORDED", 1.5 * len(GREY) * 3)
    old, new = recorded(desk, 3), recorded(desk, 3)
    for video in (old, new):
        desk.change(video, state="kept", bytes=3 * len(GREY))
    desk.make_room()
    assert [desk.view(video)["state"] for video in (old, new)] == ["removed", "kept"]
    assert not desk.files.path(old).exists()


def test_a_video_that_was_deleted_long_ago_goes(desk: VideoDesk, monkeypatch: pytest.MonkeyPatch) -> None:
    video = recorded(desk, 3)
    desk.change(video, state="kept")
    desk.delete(video)
    desk.tidy()
    assert desk.files.path(video).exists()
    monkeypatch.setattr(video_desk, "MOST_DELETED", -1.0)
    desk.tidy()
    assert not desk.files.path(video).exists()


def test_a_video_that_is_being_recorded_cannot_be_deleted(desk: VideoDesk) -> None:
    with pytest.raises(StateError, match="being recorded"):
        desk.delete(recorded(desk, 1))


def test_a_video_that_is_being_recorded_is_not_read_yet(desk: VideoDesk) -> None:
    with pytest.raises(StateError, match="being recorded"):
        desk.source(recorded(desk, 1), 0)


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
    desk: VideoDesk, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(log: VideoLog, content: object) -> None:
        raise sqlite3.OperationalError("The database is locked.")

    monkeypatch.setattr(VideoLog, "put", refuse)
    upload = desk.begin("row.mjpeg", None)
    upload.add(GREY * 3)
    with pytest.raises(sqlite3.OperationalError):
        desk.keep(upload)
    assert list(desk.files.folder.iterdir()) == []


def test_an_answer_that_cannot_be_kept_is_told_and_the_next_one_comes(desk: VideoDesk, eyes: Eyes) -> None:
    failures: list[FootfallError] = []

    def broken(_: object) -> None:
        raise OSError("The disk is full.")

    def broken_again(error: FootfallError) -> None:
        failures.append(error)
        raise OSError("The disk is full.")

    facts = FactsOf(desk.files.path(recorded(desk, 3)))
    look = eyes.near.ask(Look(facts, done=broken, failed=broken_again))
    with pytest.raises(StateError):
        look.result(60.0)
    assert seen(eyes.near, facts, 60.0).count == 3
    assert len(failures) == 1


def test_a_bare_row_of_pictures_is_counted_and_sought_in(desk: VideoDesk) -> None:
    shades = [jpeg(np.full((48, 64, 3), 20 * number, dtype=np.uint8)) for number in range(12)]
    upload = desk.begin("row.mjpeg", None)
    upload.add(b"".join(shades))
    video = desk.keep(upload)
    assert video["frames"] == 12
    for number in (9, 2, 11):
        shown = read_picture(desk.picture(desk.source(video["id"], number), None), "shown")
        assert shown.mean() == pytest.approx(20 * number, abs=2)
    with pytest.raises(InputError, match="there is no picture 12"):
        desk.source(video["id"], 12)


def test_an_answer_that_does_not_come_in_time_is_a_sentence(desk: VideoDesk, eyes: Eyes) -> None:
    with pytest.raises(StateError, match="the computer is busy"):
        seen(eyes.near, FactsOf(desk.files.path(recorded(desk, 3))), 0.0)
