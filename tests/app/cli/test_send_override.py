"""`footfall send --override`: in spite of errors that may be overridden, with a reason that stays."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from app.emulator.emulated_robot import EmulatedRobot
from app.runs.service import RunService
from app.store.database import Database
from app.store.tables.run_store import RunFilter
from core.overrides import MOST_REASON
from tests.support.command import run
from tests.support.patience import patient_robot

REASON = "It walked on the real robot."
HEADER = "duration_s," + ",".join(f"h{i}" for i in range(1, 13))


@pytest.fixture
def robot() -> Iterator[EmulatedRobot]:
    with patient_robot(40.0, booted=True) as emulated:
        yield emulated


@pytest.fixture
def tipping(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> Path:
    """The waypoints of a walk by hand that rocks onto a foot."""
    trajectory, way = tmp_path / "walk.csv", tmp_path / "way.csv"
    assert run(capsys, "manual", "walk", "--version", "2", "-o", str(trajectory))[0] == 0
    assert run(capsys, "waypoints", str(trajectory), "-o", str(way))[0] == 0
    return way


def file_of(path: Path, *heights_mm: float) -> Path:
    rows = ["9.0," + ",".join([f"{height:.4f}"] * 12) for height in heights_mm]
    path.write_text("\n".join([HEADER, *rows]) + "\n")
    return path


def words(way: Path, robot: str, *more: str) -> tuple[str, ...]:
    return ("send", str(way), "--robot", robot, "--yes", "--data", str(way.parent / "data"), *more)


def refused(capsys: pytest.CaptureFixture[str], way: Path, robot: EmulatedRobot, *more: str) -> Any:
    """Status and answer of a file of which nothing may reach the robot."""
    status, out, _ = run(capsys, *words(way, robot.device, *more), "--json")
    assert robot.firmware.messages == []
    assert not (way.parent / "data").exists()
    return status, json.loads(out)


def test_without_an_override_the_errors_stand_and_the_way_out_is_named(
    capsys: pytest.CaptureFixture[str], tipping: Path, robot: EmulatedRobot
) -> None:
    status, answer = refused(capsys, tipping, robot)
    assert (status, answer["passed"]) == (4, False)
    assert {one["rule"] for one in answer["findings"] if one["overridable"]} == {"balance", "path_balance"}
    status, out, _ = run(capsys, *words(tipping, robot.device))
    assert (status, "--override REASON sends in spite of these errors" in out) == (4, True)


def test_the_file_is_sent_and_the_override_stands_in_answer_and_run(
    capsys: pytest.CaptureFixture[str], tipping: Path, robot: EmulatedRobot
) -> None:
    status, out, err = run(capsys, *words(tipping, robot.device, "--override", REASON), "--json")
    answer = json.loads(out)
    assert (status, answer["state"], answer["reached"]) == (0, "done", answer["count"])
    by = answer["approval"]["by"]
    assert answer["override"] == {"rules": ["balance", "path_balance"], "reason": REASON, "by": by}
    assert answer["approval"]["override"]["errors"][0]["rule"] == "balance"
    assert "Not fit: " in err
    database = Database(tipping.parent / "data" / "studio.sqlite3")
    kept = RunService(database).found(RunFilter(), 0, 1)["runs"][0]
    database.close()
    assert (kept["id"], kept["override"]) == (answer["run"], answer["override"])


@pytest.mark.parametrize("reason", ["", "   ", "x" * (MOST_REASON + 1)])
def test_a_reason_is_needed_and_bounded(
    capsys: pytest.CaptureFixture[str], tipping: Path, robot: EmulatedRobot, reason: str
) -> None:
    status, answer = refused(capsys, tipping, robot, "--override", reason)
    assert (status, answer["where"]) == (2, "override")
    assert "needs a reason of 1 to" in answer["error"]


@pytest.mark.parametrize(
    ("heights_mm", "sentence"),
    [
        ((5.0, 8.0, 5.0), "No error stands that could be overridden"),
        ((1.0, 19.0), "Errors of the rule “deafness” cannot be overridden"),
        ((5.0, 25.0), "its range is 0.5 to 19.5 mm"),
    ],
    ids=["nothing stands", "deafness", "stroke"],
)
def test_what_cannot_be_overridden_is_bad_input(
    capsys: pytest.CaptureFixture[str],
    tmp_path: Path,
    robot: EmulatedRobot,
    heights_mm: tuple[float, ...],
    sentence: str,
) -> None:
    way = file_of(tmp_path / "way.csv", *heights_mm)
    status, answer = refused(capsys, way, robot, "--override", REASON)
    assert (status, sentence in answer["error"]) == (2, True), answer
