"""Recordings of runs that an unexpected error meets are broken off at once, and what there is is kept."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest

from app.bridge.states import LinkState, RobotSnapshot, RobotState
from app.store.database import Database
from app.store.run_log import RunLog
from app.trials.camera_desk import SIDE, CameraDesk
from app.trials.eyes import Eyes
from app.trials.recorder import RecordOrder
from app.trials.recording_file import RecordingWriter
from app.trials.run_recordings import RunRecordings
from app.trials.video import jpeg
from app.trials.video_desk import VideoDesk
from tests.studio_process import wait_for

GREY = jpeg(np.full((48, 64, 3), 120, dtype=np.uint8))
RUN = {"gait_name": "Walk", "started_monotonic": 0.0}


def broken(*_: object) -> None:
    raise RuntimeError("This is a defect.")


def writing(order: RecordOrder) -> None:
    writer = RecordingWriter(order.folder)
    for number in range(3):
        writer.add(GREY, 0.1 * number)
    writer.close()


def cameras(record: Callable[[RecordOrder], None]) -> CameraDesk:
    """One camera, whose recordings cannot be ended."""
    view = {"id": "side", "name": "Side", "use": SIDE, "setup": ""}
    link = SimpleNamespace(record=record, finish=broken)
    desk = SimpleNamespace(recording=lambda: [view], link=lambda camera: link, tell=lambda: None)
    return cast(CameraDesk, desk)


def snapshot(state: RobotState) -> RobotSnapshot:
    run = SimpleNamespace(run_id="run")
    return cast(RobotSnapshot, SimpleNamespace(run=run, robot=state, link=LinkState.READY))


@pytest.mark.parametrize(("record", "state"), [(writing, "kept"), (broken, "removed")])
def test_an_unexpected_error_leaves_no_video_that_is_being_recorded(
    tmp_path: Path,
    database: Database,
    eyes: Eyes,
    monkeypatch: pytest.MonkeyPatch,
    record: Callable[[RecordOrder], None],
    state: str,
) -> None:
    monkeypatch.setattr(RunLog, "get", lambda log, run: SimpleNamespace(content=RUN))
    videos = VideoDesk(tmp_path, database, eyes)
    nobody = cast(Any, None)
    recordings = RunRecordings(database, cameras(record), nobody, videos, nobody, nobody, nobody)
    recordings.follow(snapshot(RobotState.MOVING))
    recordings.follow(snapshot(RobotState.DONE))
    recordings.close()
    (video,) = videos.views("run")
    wait_for(lambda: videos.view(video["id"])["state"] == state, "it is known what there is", 60)
    assert "An error of the studio broke the recording off." in videos.view(video["id"])["sentence"]
