"""What tests of the services share."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from app.emulator.emulated_robot import EmulatedRobot
from app.store.database import Database
from app.vision.services import VisionServices, open_vision_services
from tests.support.studio_process import StudioProcess, running_studio


@pytest.fixture
def database(tmp_path: Path) -> Iterator[Database]:
    """An empty database."""
    opened = Database(tmp_path / "studio.sqlite3")
    yield opened
    opened.close()


@pytest.fixture(scope="module")
def studio(tmp_path_factory: pytest.TempPathFactory, robot: EmulatedRobot) -> Iterator[StudioProcess]:
    """A running studio with an empty data folder, told of the robot."""
    with running_studio(tmp_path_factory.mktemp("data"), "--robot", robot.device) as running:
        yield running


@pytest.fixture(scope="module")
def vision() -> Iterator[VisionServices]:
    """The processes that look at pictures."""
    opened = open_vision_services()
    yield opened
    opened.close()
