"""Leaving a robot that does not confirm its stop: everybody is answered in time, and told how it stands."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from app.emulator.ports import PtyPort
from app.robot import service
from app.robot.ports import RobotPorts
from app.robot.service import RobotService
from app.store.database import Database
from app.undo.history import Author
from core.errors import RobotError, StateError
from tests.support.studio_process import running_studio, wait_for

ADA = Author("page-a", "Ada")
GRACE = Author("page-g", "Grace")


class Clock:
    """The bridge's clock: stands still until it runs, which is after every deadline that it was asked for."""

    def __init__(self) -> None:
        self.runs = threading.Event()

    def __call__(self) -> float:
        return 100.0 * time.monotonic() if self.runs.is_set() else 0.0


@pytest.fixture
def clock() -> Clock:
    return Clock()


@pytest.fixture
def port() -> Iterator[PtyPort]:
    """A line at whose end nobody answers."""
    opened = PtyPort()
    yield opened
    opened.close()


@pytest.fixture
def views() -> list[dict[str, Any]]:
    """What the pages were shown."""
    return []


@pytest.fixture
def robot(
    database: Database,
    tmp_path: Path,
    views: list[dict[str, Any]],
    clock: Clock,
    monkeypatch: pytest.MonkeyPatch,
) -> Iterator[RobotService]:
    monkeypatch.setattr(service, "DISCONNECT_SECONDS", 0.1)
    opened = RobotService(database, "emulator", views.append, RobotPorts(tmp_path / "robot.json"))
    monkeypatch.setattr(opened.bridge, "_clock", clock)
    yield opened
    clock.runs.set()
    opened.close()


def stopping(robot: RobotService, port: PtyPort) -> RobotService:
    """The robot with Ada at it, and a stop that nobody confirms."""
    with robot.lease.held_by(ADA):
        robot.connect(port.device)
    robot.bridge.stop("Ada")
    return robot


def test_leaving_a_robot_without_a_stop_is_done_at_once(
    robot: RobotService, port: PtyPort, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(service, "DISCONNECT_SECONDS", 60.0)
    robot.connect(port.device)
    assert robot.disconnect(ADA)
    assert (robot.view()["link"], robot.view()["disconnecting"]) == ("disconnected", False)
    assert robot.disconnect(ADA)


def test_what_takes_longer_is_told_of_and_goes_on_by_itself(
    robot: RobotService, port: PtyPort, views: list[dict[str, Any]], clock: Clock
) -> None:
    stopping(robot, port)
    assert not robot.disconnect(ADA)
    shown = robot.view()
    assert (shown["link"], shown["disconnecting"], shown["lease"]["name"]) == ("connecting", True, "Ada")
    assert shown["allowed"]["disconnect"] in shown["sentence"]
    clock.runs.set()
    wait_for(lambda: robot.view()["link"] == "disconnected", "the line is closed")
    wait_for(lambda: robot.view()["lease"]["page"] is None, "nobody holds the robot")
    wait_for(lambda: (views[-1]["link"], views[-1]["disconnecting"]) == ("disconnected", False), "pages know")
    with robot.lease.held_by(GRACE):
        robot.connect(port.device)


def test_who_disconnects_meanwhile_waits_for_the_same_and_nobody_connects(
    robot: RobotService, port: PtyPort, clock: Clock, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(service, "CONNECT_PATIENCE", 0.0)
    stopping(robot, port)
    assert not robot.disconnect(ADA)
    assert not robot.disconnect(ADA)
    with pytest.raises(StateError, match="being opened or closed"):
        robot.connect(port.device)
    monkeypatch.setattr(service, "DISCONNECT_SECONDS", 60.0)
    clock.runs.set()
    assert robot.disconnect(ADA)
    assert robot.view()["link"] == "disconnected"
    causes = [one["cause"] for one in robot.transitions()]
    assert causes.count("Disconnected.") == 1


def test_who_only_looks_on_cannot_disconnect(robot: RobotService, port: PtyPort) -> None:
    stopping(robot, port)
    with pytest.raises(StateError, match="Ada is in control"):
        robot.disconnect(GRACE)
    assert not robot.view()["disconnecting"]


def test_a_line_that_is_opened_at_the_moment_is_waited_for_and_closed(
    robot: RobotService, monkeypatch: pytest.MonkeyPatch
) -> None:
    begun, refused = threading.Event(), threading.Event()

    def connect(device: str) -> None:
        begun.set()
        refused.wait(60.0)
        raise RobotError(f"Nothing answers at {device}.", device)

    monkeypatch.setattr(robot.bridge, "connect", connect)

    def try_to_connect() -> None:
        with pytest.raises(RobotError):
            robot.connect("/dev/robot")

    opening = threading.Thread(target=try_to_connect)
    opening.start()
    assert begun.wait(60.0)
    assert not robot.disconnect(ADA)
    refused.set()
    opening.join()
    wait_for(lambda: robot.disconnect(ADA), "the line is closed")


@pytest.mark.heavy
def test_over_http_the_answer_comes_before_the_end(tmp_path: Path, port: PtyPort) -> None:
    with running_studio(tmp_path, "--robot", port.device) as studio:
        assert studio.ask("POST", "/api/robot/disconnect").status == 200
        assert studio.ask("POST", "/api/robot/connect").status == 200
        assert studio.ask("POST", "/api/robot/stop").status == 200
        answer = studio.ask("POST", "/api/robot/disconnect")
        assert (answer.status, answer.content["disconnecting"]) == (202, True)
        port.close()  # nothing is left to wait for
        wait_for(lambda: studio.robot()["link"] == "disconnected", "the line is closed")
        assert not studio.robot()["disconnecting"]
