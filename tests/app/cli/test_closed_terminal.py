"""Whose terminal is closed stops the robot first, as by SIGTERM; its output then goes nowhere."""

from __future__ import annotations

import os
import re
import signal
import sqlite3
import subprocess
import sys
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path

import pytest

from app.cli.common.output import write
from app.emulator.emulated_robot import EmulatedRobot
from tests.support.closed_terminal import in_terminal
from tests.support.patience import patient_robot
from tests.support.studio_process import PATIENT, PROJECT, StudioProcess, wait_for

COUNT = 12
SOME, MANY = 60, 1200
"""Waypoints of a run that lasts for seconds, and of one that is broken off, which would last for a minute."""


@pytest.fixture
def robot() -> Iterator[EmulatedRobot]:
    with patient_robot(10.0, booted=True) as emulated:
        yield emulated


@pytest.fixture
def way(tmp_path: Path) -> Path:
    return write_way(tmp_path / "way.csv", MANY)


def write_way(path: Path, count: int) -> Path:
    rows = ["0.4," + ",".join([f"{h}.0000"] * 12) for h in (5, 8) * (count // 2)]
    path.write_text("\n".join(["duration_s," + ",".join(f"h{i}" for i in range(1, 13)), *rows]) + "\n")
    return path


def send_words(way: Path, robot: EmulatedRobot) -> tuple[str, ...]:
    return ("send", str(way), "--robot", robot.device, "--yes", "--data", str(way.parent))


def run_state(data: Path) -> str:
    with closing(sqlite3.connect(data / "studio.sqlite3")) as database:
        found = database.execute("SELECT json_extract(content, '$.state') FROM run").fetchone()
    return str(found[0])


@pytest.mark.heavy
def test_a_terminal_that_is_closed_in_a_send_stops_the_robot(way: Path, robot: EmulatedRobot) -> None:
    with in_terminal(*send_words(way, robot)) as terminal:
        wait_for(lambda: len(robot.firmware.messages) > 4, "the run has begun")
        terminal.close()
        assert terminal.process.wait(60) == 130
    assert robot.firmware.messages[-1].payload == "s,1"
    assert run_state(way.parent) == "stopped"


@pytest.mark.heavy
def test_several_hang_ups_at_once_stop_the_robot_too(way: Path, robot: EmulatedRobot) -> None:
    """A shell and the system each send one when a terminal is closed."""
    command = [sys.executable, "-m", PATIENT, *send_words(way, robot)]
    with subprocess.Popen(command, cwd=PROJECT, stderr=subprocess.DEVNULL) as sending:
        wait_for(lambda: len(robot.firmware.messages) > 4, "the run has begun")
        for _ in range(3):
            sending.send_signal(signal.SIGHUP)
        assert sending.wait(60) == 130
    assert robot.firmware.messages[-1].payload == "s,1"
    assert run_state(way.parent) == "stopped"


@pytest.mark.heavy
def test_nobody_who_reads_the_progress_is_no_reason_to_break_a_run_off(
    way: Path, robot: EmulatedRobot
) -> None:
    command = [sys.executable, "-m", PATIENT, *send_words(write_way(way, COUNT), robot)]
    with subprocess.Popen(command, cwd=PROJECT, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE) as sending:
        assert sending.stderr is not None
        sending.stderr.readline()
        sending.stderr.close()
        assert sending.wait(60) == 0
    assert run_state(way.parent) == "done"


@pytest.mark.heavy
@pytest.mark.parametrize("shell", ["", "nohup"])
def test_a_send_under_nohup_goes_on(way: Path, robot: EmulatedRobot, shell: str) -> None:
    words = send_words(write_way(way, SOME) if shell else way, robot)
    command = [*shell.split(), sys.executable, "-m", PATIENT, *words]
    with subprocess.Popen(
        command, cwd=PROJECT, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
    ) as sending:
        wait_for(lambda: len(robot.firmware.messages) > 4, "the run has begun")
        sending.send_signal(signal.SIGHUP)
        assert sending.wait(60) == (0 if shell else 130)


def test_what_nobody_reads_any_more_is_dropped() -> None:
    reading, writing = os.pipe()
    with os.fdopen(writing, "w") as stream:
        os.close(reading)
        write(stream, "a result\n")
        write(stream, "and more\n")


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="there is no device that is always full")
def test_a_result_that_finds_no_room_is_refused_with_the_reason() -> None:
    command = [sys.executable, "-m", "app", "gaits"]
    with open("/dev/full", "w") as full:
        ended = subprocess.run(command, cwd=PROJECT, stdout=full, stderr=subprocess.PIPE, text=True)
    assert ended.returncode == 2
    assert "No space left" in ended.stderr
    assert "Traceback" not in ended.stderr


def served(terminal_text: str) -> str | None:
    found = re.search(r"http://\S+", terminal_text)
    return found and found.group()


@pytest.mark.heavy
def test_a_terminal_that_is_closed_under_the_studio_stops_its_run(
    tmp_path: Path, robot: EmulatedRobot
) -> None:
    words = ("serve", "--port", "0", "--data", str(tmp_path), "--robot", robot.device, "--no-browser")
    with in_terminal(*words) as terminal:
        wait_for(lambda: served(terminal.shown) is not None, "the studio answers", 60)
        studio = StudioProcess(terminal.process.pid, served(terminal.shown) or "")
        studio.ask("GET", "/api/gaits/walk/view")
        studio.ask("POST", "/api/gaits/walk/check")
        approved = studio.ask("POST", "/api/gaits/walk/approve", {"by": "Ada", "accept_warnings": True})
        assert approved.status == 200, approved
        studio.ask("POST", "/api/robot/connect")
        wait_for(lambda: studio.robot()["robot"] == "disarmed", "the robot is up")
        studio.ask("POST", "/api/robot/arm")
        studio.ask("POST", "/api/robot/send", {"gait": "walk"})
        wait_for(lambda: (studio.robot()["run"] or {}).get("sent", 0) > 2, "some waypoints are out")
        terminal.close()
        assert terminal.process.wait(60) == 0
    assert robot.firmware.messages[-1].payload == "s,1"
    assert run_state(tmp_path) != "running"


@pytest.mark.parametrize(
    ("shell", "survives"), [("", False), pytest.param("nohup", True, marks=pytest.mark.heavy)]
)
def test_a_studio_ends_by_a_hang_up_and_not_under_nohup(tmp_path: Path, shell: str, survives: bool) -> None:
    words = ["serve", "--port", "0", "--data", str(tmp_path), "--no-browser"]
    with subprocess.Popen(
        [*shell.split(), sys.executable, "-u", "-m", "app", *words],
        cwd=PROJECT,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
    ) as process:
        assert process.stdout is not None
        url = served(process.stdout.readline())
        assert url is not None
        process.send_signal(signal.SIGHUP)
        if survives:
            studio = StudioProcess(process.pid, url)
            assert studio.ask("GET", "/api/health").status == 200
            process.send_signal(signal.SIGTERM)
        assert process.wait(60) == 0
