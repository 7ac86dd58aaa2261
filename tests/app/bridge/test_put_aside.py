"""Senders and studios that are really put aside; their emulated robot is a process of its own."""

from __future__ import annotations

import json
import os
import pty
import select
import signal
import subprocess
import time
from pathlib import Path
from typing import Any

import pytest

from app.bench.robot.processes import emulator_process
from app.bridge.telemetry import SILENCE_LIMIT
from tests.support.soak import is_soak
from tests.support.studio_process import PROGRAM, PROJECT, StudioProcess, running_studio, wait_for

pytestmark = [pytest.mark.alone, pytest.mark.soak(short=True)]

AWAY = (0.5, 2.0, 5.0, 20.0, 60.0) if is_soak() else (5.0,)
SPEED = 2.0
"""Of the robot; its time is not the program's."""


def put_aside(process: int, seconds: float) -> None:
    os.kill(process, signal.SIGSTOP)
    time.sleep(seconds)
    os.kill(process, signal.SIGCONT)


def footfall(*words: str) -> None:
    subprocess.run([*PROGRAM, *words], cwd=PROJECT, check=True, capture_output=True)


@pytest.fixture(scope="module")
def way(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("way")
    motion, way = str(folder / "walk.csv"), folder / "way.csv"
    footfall("optimise", "walk", "--step", "0.010", "-o", motion)
    footfall("waypoints", motion, "-o", str(way))
    return way


@pytest.mark.parametrize("seconds", AWAY)
def test_a_sender_that_was_put_aside_is_done_or_pauses_and_stops(
    way: Path, tmp_path: Path, seconds: float
) -> None:
    with emulator_process(SPEED) as robot:
        words = ("send", str(way), "--robot", robot, "--yes", "--data", str(tmp_path), "--json")
        with subprocess.Popen(
            [*PROGRAM, *words],
            cwd=PROJECT,
            text=True,
            env={**os.environ, "LOGNAME": "Ada"},
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
        ) as sender:
            assert sender.stderr is not None
            while "waypoint 2 of" not in sender.stderr.readline():
                assert sender.poll() is None
            put_aside(sender.pid, seconds)
            said, noted = sender.communicate(timeout=300)
    answer = json.loads(said)
    if seconds <= SILENCE_LIMIT:
        assert (sender.returncode, answer["state"]) == (0, "done"), answer
        assert answer["reached"] == answer["count"]
    else:
        assert (sender.returncode, answer["state"]) == (5, "stopped"), answer
        assert f"The program did not run for {seconds:.0f}." in answer["sentence"]
        assert "motor" not in answer["sentence"].partition("Nothing moves")[0]
        assert "paused: waypoint" in noted


def test_a_sender_that_was_put_aside_before_its_run_sends_nothing(way: Path, tmp_path: Path) -> None:
    with emulator_process(SPEED) as robot:
        words = ("send", str(way), "--robot", robot, "--yes", "--data", str(tmp_path), "--json")
        environment = {**os.environ, "LOGNAME": "Ada"}
        with subprocess.Popen(
            [*PROGRAM, *words], cwd=PROJECT, text=True, env=environment, stdout=-1, stderr=-1
        ) as sender:
            assert sender.stderr is not None
            while "line is open" not in sender.stderr.readline():
                assert sender.poll() is None
            put_aside(sender.pid, AWAY[-1])
            said, noted = sender.communicate(timeout=300)
    assert sender.returncode == 5
    assert "The program did not run for" in json.loads(said)["error"]
    assert "moving" not in noted


@pytest.mark.parametrize("seconds", AWAY)
def test_a_studio_that_was_put_aside_is_done_or_pauses(tmp_path: Path, seconds: float) -> None:
    with (
        emulator_process(SPEED) as robot,
        running_studio(tmp_path, "--robot", robot, program=PROGRAM) as studio,
    ):

        def act(verb: str, **content: Any) -> None:
            answer = studio.ask("POST", f"/api/robot/{verb}", content)
            assert answer.status == 200, answer

        act("connect")
        wait_for(lambda: studio.robot()["robot"] == "disarmed", "the robot is up")
        assert studio.ask("POST", "/api/gaits/walk/check").status == 200
        assert studio.ask("POST", "/api/gaits/walk/approve", {"by": "Ada"}).status == 200
        act("arm", by="Ada")
        act("send", by="Ada", gait="walk")
        wait_for(lambda: studio.robot()["run"]["reached"] >= 2, "it walks")
        put_aside(studio.pid, seconds)
        if seconds > SILENCE_LIMIT:
            wait_for(lambda: studio.robot()["robot"] != "pausing", "it pauses")
            paused = studio.robot()
            assert paused["robot"] == "paused", paused
            assert f"The program did not run for {seconds:.0f}." in paused["sentence"]
            act("resume", by="Ada")
        wait_for(lambda: studio.robot()["robot"] not in ("moving", "pausing"), "it has walked")
        ended = studio.robot()
        assert ended["robot"] == "done", ended
        assert ended["run"]["reached"] == ended["run"]["count"]
        assert noted(studio) == 1


def test_a_person_at_the_keyboard_resumes_what_was_put_aside(way: Path, tmp_path: Path) -> None:
    with emulator_process(SPEED) as robot:
        words = ("send", str(way), "--robot", robot, "--yes", "--data", str(tmp_path))
        sender, terminal = pty.fork()
        if sender == 0:
            os.chdir(PROJECT)
            os.environ["LOGNAME"] = "Ada"
            os.execv(PROGRAM[0], [*PROGRAM, *words])
        said = Said(terminal)
        said.wait_for("waypoint 2 of")
        os.write(terminal, b"\n")  # typed before it was asked, so it is no answer
        put_aside(sender, AWAY[-1])
        said.wait_for("Press Enter to resume")
        time.sleep(2.0)
        assert os.waitpid(sender, os.WNOHANG) == (0, 0)
        os.write(terminal, b"\n")
        said.wait_for("The plan is done.")
        assert os.waitstatus_to_exitcode(os.waitpid(sender, 0)[1]) == 0
        os.close(terminal)


class Said:
    """What a program says at a terminal."""

    def __init__(self, terminal: int) -> None:
        self.text = ""
        self._terminal = terminal

    def wait_for(self, words: str) -> None:
        deadline = time.monotonic() + 180.0
        while words not in self.text:
            assert time.monotonic() < deadline, self.text
            if select.select([self._terminal], [], [], 0.1)[0]:
                self.text += os.read(self._terminal, 65536).decode(errors="replace")


def noted(studio: StudioProcess) -> int:
    """How often the robot's log says that the program did not run."""
    changes = studio.ask("GET", "/api/robot/transitions").content["transitions"]
    return sum("did not run for" in change["cause"] for change in changes)
