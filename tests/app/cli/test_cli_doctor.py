"""`footfall doctor`: what it finds, and what it says to do."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from app.bridge.devices import SerialDevice
from app.cli import commands_doctor
from app.cli.commands_doctor import State
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
    assert found["exact optimiser"] == found["Python"] == found["data folder"] == State.OK
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
