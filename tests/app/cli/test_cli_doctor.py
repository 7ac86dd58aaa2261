"""`footfall doctor`: what it finds, and what it says to do."""

from __future__ import annotations

import os
import socket
from contextlib import closing
from pathlib import Path

import pytest

from app.bridge.devices import SerialDevice
from app.cli import commands_doctor
from app.cli.commands_doctor import State
from app.store.folder_lock import StudioLock
from solver_jobs import SolveStatus
from tests.support.command import run_json


def states(answer: dict[str, object]) -> dict[str, str]:
    checks = answer["checks"]
    assert isinstance(checks, list)
    return {one["name"]: one["state"] for one in checks}


def test_all_is_well_here(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    status, answer = run_json(capsys, "doctor", "--data", str(tmp_path))
    found = states(answer)
    assert {
        "Python",
        "casadi",
        "mujoco-core",
        "live optimiser",
        "exact optimiser",
        "studio",
        "data folder",
    } <= set(found)
    assert found["exact optimiser"] == found["Python"] == found["data folder"] == found["page"] == State.OK
    assert list(tmp_path.iterdir()) == []
    assert (status == 0) == answer["passed"]


def test_a_device_that_may_not_be_opened_names_group_and_command(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    line = tmp_path / "ttyACM0"
    line.touch()
    monkeypatch.setattr(commands_doctor, "serial_devices", lambda: (SerialDevice(str(line)),))
    monkeypatch.setattr(os, "access", lambda path, mode: False)
    status, answer = run_json(capsys, "doctor", "--data", str(tmp_path / "none"))
    (robot,) = [one for one in answer["checks"] if one["name"].startswith("robot on")]
    assert (status, answer["passed"], robot["state"]) == (4, False, "error")
    assert f"sudo usermod -aG {line.group()} " in robot["remedy"]


def test_a_solver_that_does_not_run_is_named(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def broken(problem: object) -> SolveStatus:
        raise ImportError("libipopt.so is missing")

    monkeypatch.setattr(commands_doctor, "solve_motion", broken)
    monkeypatch.setitem(commands_doctor._LIBRARIES, "no-such-package", "nothing")
    status, answer = run_json(capsys, "doctor", "--data", str(tmp_path))
    found = {one["name"]: one for one in answer["checks"]}
    assert status == 4
    assert "libipopt.so is missing" in found["exact optimiser"]["sentence"]
    assert found["no-such-package"]["sentence"] == "missing, needed for nothing."


def test_a_folder_or_a_port_that_serve_cannot_use_is_named(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    (tmp_path / "file").touch()
    with socket.create_server(("127.0.0.1", 0)) as busy:
        port = busy.getsockname()[1]
        data = str(tmp_path / "file" / "data")
        status, answer = run_json(capsys, "doctor", "--data", data, "--port", str(port))
    found = {one["name"]: one for one in answer["checks"]}
    assert (status, answer["passed"]) == (4, False)
    assert found["data folder"]["sentence"].endswith(
        "cannot be made: Not a directory. Give another with --data."
    )
    assert f"Port {port} on 127.0.0.1 cannot be used" in found["studio"]["sentence"]
    assert (found["data folder"]["state"], found["studio"]["state"]) == ("error", "error")
    assert found["page"]["state"] == "ok"


def test_a_running_studio_is_left_alone(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    with closing(StudioLock(tmp_path)) as lock:
        lock.tell("http://127.0.0.1:1/")
        _, answer = run_json(capsys, "doctor", "--data", str(tmp_path))
    found = {one["name"]: one["sentence"] for one in answer["checks"]}
    assert found["data folder"] == f"{tmp_path}, open in the studio at http://127.0.0.1:1/."
    assert [path.name for path in tmp_path.iterdir()] == ["studio.lock"]
