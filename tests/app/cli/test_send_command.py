"""`footfall send`: its runs are kept beside those of a studio that is open, however they end."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from app.emulator.emulated_robot import EmulatedRobot
from app.runs.service import RunService
from app.store.database import Database
from app.store.tables.run_store import RunFilter
from tests.support.command import run, run_json
from tests.support.patience import patient_robot
from tests.support.studio_process import PATIENT, PROJECT, wait_for

SPEED = 10.0
COUNT = 12
MANY = 1200
"""Waypoints of a run that is broken off: it would last for more than a minute."""


@pytest.fixture
def way(tmp_path: Path) -> Path:
    """Every motor goes to and fro."""
    return write_way(tmp_path / "way.csv", COUNT)


def write_way(path: Path, count: int) -> Path:
    rows = ["0.4," + ",".join([f"{h}.0000"] * 12) for h in (5, 8) * (count // 2)]
    header = "duration_s," + ",".join(f"h{i}" for i in range(1, 13))
    path.write_text("\n".join([header, *rows]) + "\n")
    return path


@pytest.fixture
def robot() -> Iterator[EmulatedRobot]:
    with patient_robot(SPEED, booted=True) as emulated:
        yield emulated


@pytest.fixture
def service(database: Database) -> RunService:
    """The runs of a studio that has the data folder open."""
    return RunService(database)


def words(way: Path, robot: str) -> tuple[str, ...]:
    return ("send", str(way), "--robot", robot, "--yes", "--data", str(way.parent))


def newest(service: RunService) -> dict[str, Any]:
    run: dict[str, Any] = service.found(RunFilter(), 0, 1)["runs"][0]
    return run


@pytest.mark.heavy
def test_a_run_of_a_file_is_kept_where_the_studio_lists_it(
    capsys: pytest.CaptureFixture[str], way: Path, robot: EmulatedRobot, service: RunService
) -> None:
    status, out, err = run(capsys, *words(way, robot.device), "--json")
    answer = json.loads(out)
    assert (status, answer["state"], answer["reached"]) == (0, "done", COUNT)
    kept = newest(service)
    assert (kept["id"], kept["state"], kept["gait_name"]) == (answer["run"], "done", "way.csv")
    assert (kept["reached"], kept["count"], kept["waypoints_hash"]) == (
        COUNT,
        COUNT,
        answer["waypoints_hash"],
    )
    assert kept["errors"]["arrived"] == COUNT
    assert [state["robot"] for state in service.summary(kept["id"])["states"]] == ["moving", "done"]
    assert f"moving: on the way to the start pose, then {COUNT} waypoints in about" in err
    assert f"moving: waypoint 3 of {COUNT} reached, about" in err
    assert f"done: waypoint {COUNT} of {COUNT} reached," in err


def test_ctrl_c_stops_the_robot_says_what_happened_and_the_next_run_goes_to_its_end(
    way: Path, robot: EmulatedRobot, service: RunService
) -> None:
    command = [sys.executable, "-m", PATIENT, *words(way, robot.device), "--json"]
    pipe = subprocess.PIPE
    write_way(way, MANY)
    with subprocess.Popen(command, cwd=PROJECT, stdout=pipe, stderr=pipe, text=True) as first:
        wait_for(lambda: len(robot.firmware.messages) > 4, "the run has begun")
        assert newest(service)["state"] == "running"
        first.send_signal(signal.SIGINT)
        out, _ = first.communicate(timeout=60)
    answer = json.loads(out)
    assert (first.returncode, answer["state"]) == (130, "stopped")
    assert answer["error"].startswith(f"Interrupted: {answer['reached']} of {MANY} waypoints were reached.")
    assert robot.firmware.messages[-1].payload == "s,1"
    assert (newest(service)["state"], newest(service)["reached"]) == ("stopped", answer["reached"])
    refused = subprocess.run(command, cwd=PROJECT, capture_output=True, text=True, timeout=60)
    answer = json.loads(refused.stdout)
    assert (refused.returncode, answer["state"], answer["reached"]) == (5, "fault", 0)
    assert "--clear-stop" in answer["error"]
    assert "s,0" not in [message.payload for message in robot.firmware.messages]
    command.append("--clear-stop")
    write_way(way, COUNT)
    second = subprocess.run(command, cwd=PROJECT, capture_output=True, text=True, timeout=60)
    assert second.returncode == 0, second.stderr
    assert json.loads(second.stdout)["reached"] == COUNT


@pytest.mark.heavy
def test_a_send_that_is_killed_leaves_its_run_interrupted_with_what_had_passed(
    way: Path, robot: EmulatedRobot, service: RunService
) -> None:
    command = [sys.executable, "-m", PATIENT, *words(way, robot.device)]
    write_way(way, MANY)
    with subprocess.Popen(command, cwd=PROJECT, stderr=subprocess.PIPE) as sending:
        wait_for(lambda: len(robot.firmware.messages) > 5, "the run is on")
        sending.kill()
    kept = newest(service)
    assert kept["state"] == "interrupted"
    assert kept["errors"]["arrived"] >= 1


def test_a_single_pose_is_sent_and_kept_without_figures(
    capsys: pytest.CaptureFixture[str], way: Path, robot: EmulatedRobot, service: RunService
) -> None:
    way.write_text("\n".join(way.read_text().splitlines()[:2]) + "\n")
    status, answer = run_json(capsys, *words(way, robot.device))
    assert (status, answer["reached"]) == (0, 1)
    assert newest(service)["errors"] is None


def test_a_data_folder_that_cannot_be_used_is_bad_input(
    capsys: pytest.CaptureFixture[str], way: Path, robot: EmulatedRobot
) -> None:
    status, answer = run_json(capsys, *words(way, robot.device)[:-1], str(way))
    assert (status, answer["where"]) == (2, "--data")
    assert "Give another with --data" in answer["error"]
    assert robot.firmware.messages == []


@pytest.mark.parametrize("duration", ["0", "0.001", "1e9"])
def test_a_duration_that_no_message_can_carry_is_bad_input_with_its_line(
    capsys: pytest.CaptureFixture[str], way: Path, robot: EmulatedRobot, duration: str
) -> None:
    lines = way.read_text().splitlines()
    lines[3] = duration + lines[3][3:]
    way.write_text("\n".join(lines) + "\n")
    status, answer = run_json(capsys, *words(way, robot.device))
    assert (status, answer["where"]) == (2, f"{way}:4")
    assert "0.01 to 999 s" in answer["error"]
    assert robot.firmware.messages == []


def test_a_move_that_leaves_the_robot_deaf_for_too_long_is_not_fit(
    capsys: pytest.CaptureFixture[str], way: Path, robot: EmulatedRobot
) -> None:
    way.write_text(way.read_text().replace("5.0000", "1.0000").replace("8.0000", "19.0000"))
    status, answer = run_json(capsys, *words(way, robot.device))
    assert (status, [f["rule"] for f in answer["findings"] if f["severity"] == "error"]) == (4, ["deafness"])
    assert robot.firmware.messages == []
