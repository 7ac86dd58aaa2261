"""A camera's process: what it recorded is on the disk whatever becomes of it."""

from __future__ import annotations

import os
import signal
from pathlib import Path

import pytest

from app.bench.page.film import Film, draw_film, stepping_feet
from app.cameras.address import CameraAddress
from app.cameras.process import CameraError, CameraProcess
from app.common.clock import boot_seconds
from app.vision.frame_source import PICTURES
from app.vision.recorder import RecordingJob
from app.vision.recording_file import Recording, read_table
from core.errors import InputError
from tests.support.studio_process import wait_for


@pytest.fixture(scope="module")
def film(tmp_path_factory: pytest.TempPathFactory) -> Film:
    return draw_film(tmp_path_factory.mktemp("film") / "film", (160, 120), stepping_feet(1.0))


def link_of(film: Film) -> CameraProcess:
    address = CameraAddress("under", "Under", str(film.folder / PICTURES), True)
    return CameraProcess(address, lambda: None)


def order(film: Film, folder: Path) -> RecordingJob:
    return RecordingJob(folder, boot_seconds(), film.setup.tracking(), "Under")


def count(folder: Path) -> int:
    try:
        return len(read_table(folder).rows)
    except InputError:
        return 0


def test_feet_are_followed_while_a_camera_records(film: Film, tmp_path: Path) -> None:
    link = link_of(film)
    try:
        assert link.picture(None, 90.0)
        link.record(order(film, tmp_path / "recording"))
        wait_for(lambda: count(tmp_path / "recording") > 10, "pictures are kept", 60)
        recorded = link.finish(60.0)
    finally:
        link.close()
    assert recorded.count > 10
    assert recorded.shape == (160, 120)
    assert recorded.found is not None
    assert recorded.found.track.times[0] >= 0.0
    assert not recorded.remarks


def test_a_process_that_ends_leaves_what_it_recorded(film: Film, tmp_path: Path) -> None:
    link = link_of(film)
    try:
        assert link.picture(None, 90.0)
        link.record(order(film, tmp_path / "recording"))
        wait_for(lambda: count(tmp_path / "recording") > 5, "pictures are kept", 60)
        process = link.process_id
        assert process is not None
        os.kill(process, signal.SIGKILL)
        wait_for(lambda: not link.is_open, "its end is noticed")
        with pytest.raises(CameraError, match="ended"):
            link.finish(10.0)
    finally:
        link.close()
    footage = Recording(tmp_path / "recording")
    assert footage.facts.count > 5
    footage.close()


def test_a_camera_that_is_not_there_says_so(tmp_path: Path) -> None:
    link = CameraProcess(CameraAddress("under", "Under", str(tmp_path / "none.avi"), True), lambda: None)
    try:
        with pytest.raises(CameraError, match=r"The camera “Under” gives no pictures\. Plug it in again\."):
            link.picture(None, 90.0)
    finally:
        link.close()
