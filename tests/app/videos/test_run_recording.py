"""Recordings of runs: errors break them off and leave what there is, and the next run waits for no trial."""

from __future__ import annotations

import queue
import threading
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any, NoReturn, cast

import numpy as np
import pytest

from app.bridge.states import LinkState, RobotSnapshot, RobotState
from app.cameras.service import SIDE, CameraService
from app.store.database import Database
from app.store.tables.run_store import RunStore
from app.videos.run_recording import RunRecordings
from app.videos.service import VideoService
from app.vision.recorder import Recorded, RecordingJob
from app.vision.recording_file import RecordingWriter
from app.vision.services import VisionServices
from app.vision.video_io import jpeg
from tests.support.studio_process import wait_for

GREY = jpeg(np.full((48, 64, 3), 120, dtype=np.uint8))
RUN = {"gait_name": "Walk", "started_monotonic": 0.0}


def broken(*_: object) -> NoReturn:
    raise RuntimeError("This is a defect.")


def writing(order: RecordingJob) -> None:
    writer = RecordingWriter(order.folder)
    for number in range(3):
        writer.add(GREY, 0.1 * number)
    writer.close()


def cameras(
    record: Callable[[RecordingJob], None], finish: Callable[[float], Recorded] = broken
) -> CameraService:
    """One camera, whose recordings cannot be ended if nothing else is said."""
    view = {"id": "side", "name": "Side", "use": SIDE, "setup": ""}
    link = SimpleNamespace(record=record, finish=finish)
    service = SimpleNamespace(recording=lambda: [view], link=lambda camera: link, tell=lambda: None)
    return cast(CameraService, service)


def snapshot(state: RobotState, run_id: str = "run") -> RobotSnapshot:
    run = SimpleNamespace(run_id=run_id)
    return cast(RobotSnapshot, SimpleNamespace(run=run, robot=state, link=LinkState.READY))


@pytest.mark.parametrize(("record", "state"), [(writing, "kept"), (broken, "removed")])
def test_an_unexpected_error_leaves_no_video_that_is_being_recorded(
    tmp_path: Path,
    database: Database,
    vision: VisionServices,
    monkeypatch: pytest.MonkeyPatch,
    record: Callable[[RecordingJob], None],
    state: str,
) -> None:
    monkeypatch.setattr(RunStore, "get", lambda log, run: SimpleNamespace(content=RUN))
    videos = VideoService(tmp_path, database, vision)
    nobody = cast(Any, None)
    recordings = RunRecordings(database, cameras(record), nobody, videos, nobody, nobody, nobody)
    recordings.follow(snapshot(RobotState.MOVING))
    recordings.follow(snapshot(RobotState.DONE))
    recordings.close()
    (video,) = videos.views("run")
    wait_for(lambda: videos.view(video["id"])["state"] == state, "it is known what there is", 60)
    assert "An error of the studio broke the recording off." in videos.view(video["id"])["sentence"]


def test_the_next_run_is_recorded_while_the_trial_of_the_last_one_is_made(
    tmp_path: Path, database: Database, vision: VisionServices, monkeypatch: pytest.MonkeyPatch
) -> None:
    begun: queue.SimpleQueue[str] = queue.SimpleQueue()
    may_go_on = threading.Event()

    def recording(order: RecordingJob) -> None:
        writing(order)
        begun.put(order.folder.name)

    def waits(*_: object) -> tuple[str, tuple[str, ...]]:
        may_go_on.wait(60)
        return "", ("The trial is made.",)

    monkeypatch.setattr(RunStore, "get", lambda log, run: SimpleNamespace(content=RUN))
    monkeypatch.setattr(RunRecordings, "_trial", waits)
    videos = VideoService(tmp_path, database, vision)
    nobody = cast(Any, None)
    service = cameras(recording, lambda seconds: Recorded(3, 1200, (64, 48), 13.0, 0.2, None, "", ()))
    recordings = RunRecordings(database, service, nobody, videos, nobody, nobody, nobody)
    try:
        for run in ("first", "second"):
            recordings.follow(snapshot(RobotState.MOVING, run))
            assert begun.get(timeout=60)
            recordings.follow(snapshot(RobotState.DONE, run))
        assert [video["state"] for video in videos.views("first")] == ["recording"]
    finally:
        may_go_on.set()
        recordings.close()
    for run in ("first", "second"):
        assert [video["sentence"] for video in videos.views(run)] == ["The trial is made."]
