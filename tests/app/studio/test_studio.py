"""The studio opens its parts one after the other and closes them in the reverse order, the robot first."""

from __future__ import annotations

import threading
from pathlib import Path
from typing import Any

import pytest

from app.learning.service import LearningService
from app.robot.service import RobotService
from app.session.command_queue import CommandQueue
from app.store.database import Database
from app.studio import studio as module
from app.studio.studio import Studio
from app.videos.lab import Lab
from core.errors import RobotError
from solver_jobs import JobQueue, LiveSolver, Simulator

PARTS = (Database, CommandQueue, LiveSolver, LearningService, JobQueue, Simulator, Lab, RobotService)
"""Some parts, in the order in which they are opened."""


@pytest.fixture
def closed(monkeypatch: pytest.MonkeyPatch) -> list[type]:
    """Parts in the order in which they were closed."""
    order: list[type] = []

    def note(part: Any) -> None:
        close = part.close

        def closing(self: Any) -> None:
            order.append(part)
            close(self)

        monkeypatch.setattr(part, "close", closing)

    for part in PARTS:
        note(part)
    return order


def threads_of_the_studio() -> set[str]:
    names = {thread.name.split("_")[0].split("-")[0] for thread in threading.enumerate()}
    return names & {"commands", "stop", "plans", "footfall", "run recordings"}


def test_the_robot_is_closed_first_and_what_the_others_need_last(tmp_path: Path, closed: list[type]) -> None:
    Studio(tmp_path, "emulator").close()
    ended = list(dict.fromkeys(closed))
    assert (ended[0], ended[-2:]) == (RobotService, [CommandQueue, Database])
    assert set(ended) == set(PARTS)


def test_closing_it_twice_closes_no_part_again(tmp_path: Path, closed: list[type]) -> None:
    studio = Studio(tmp_path, "emulator")
    studio.close()
    once = list(closed)
    studio.close()
    assert closed == once


def test_a_part_that_cannot_be_opened_leaves_no_other_one_open(
    tmp_path: Path, closed: list[type], monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(*_: Any) -> None:
        raise RobotError("There is no robot.", "robot")

    before = threads_of_the_studio()
    monkeypatch.setattr(module, "RobotService", refuse)
    with pytest.raises(RobotError, match="no robot"):
        Studio(tmp_path, "emulator")
    assert set(closed) == {*PARTS} - {RobotService}
    assert threads_of_the_studio() <= before
