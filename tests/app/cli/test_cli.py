"""The command line: exit statuses, one JSON object, whole files."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

from app.common.version import VERSION
from app.documents.gait_json import gait_content
from app.export.trajectory_files import read_trajectory
from core.library.library import library
from core.wire.robot_time import OVERRUN
from core.wire.trajectory_csv import parse_trajectory_csv
from core.wire.waypoints import parse_waypoint_csv
from tests.support.command import run, run_json
from tests.support.patience import patient_robot
from tests.support.reference import reference_path
from tests.support.studio_process import PROJECT


def test_the_way_from_gait_to_waypoints(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    trajectory, waypoints = tmp_path / "walk.csv", tmp_path / "way.csv"
    status, answer = run_json(capsys, "optimise", "walk", "--margin", "0.003", "-o", str(trajectory))
    assert (status, answer["status"]) == (0, "solved")
    assert answer["knots"] == 45
    assert answer["max_violation"] <= 1e-6
    assert set(answer["violations"]) >= {"dynamics", "body_torque", "clearance", "workspace"}
    assert answer["min_cop_margin"] == pytest.approx(0.003, abs=1e-6)
    assert run_json(capsys, "check", str(trajectory))[0] == 0
    assert run_json(capsys, "waypoints", str(trajectory), "-o", str(waypoints))[1]["waypoints"] == 45
    assert parse_waypoint_csv(waypoints.read_text()).count == 45
    merged = run_json(capsys, "waypoints", str(trajectory), "--merge", "0.001", "--stop-bound", "1.0")[1]
    assert merged["waypoints"] < 45
    assert merged["stop_seconds"] <= 1.0 + OVERRUN


@pytest.mark.heavy
def test_the_defaults_of_each_command_suit_the_next(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    trajectory, waypoints = tmp_path / "walk.csv", tmp_path / "way.csv"
    assert run(capsys, "optimise", "walk", "-o", str(trajectory))[0] == 0
    assert run(capsys, "check", str(trajectory))[0] == 0
    assert run(capsys, "waypoints", str(trajectory), "-o", str(waypoints))[0] == 0
    with patient_robot(20.0, booted=True) as robot:
        words = ("--robot", robot.device, "--yes", "--data", str(tmp_path))
        status, answer = run_json(capsys, "send", str(waypoints), *words)
    assert (status, answer["state"], answer["reached"]) == (0, "done", 45)


def test_a_gait_without_a_standing_foot_is_valid_json(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    document = gait_content(library()["walk"].gait)
    document["timeline"]["feet"] = [row[:20] + "0" + row[21:] for row in document["timeline"]["feet"]]
    path = tmp_path / "hop.json"
    path.write_text(json.dumps(document))
    status, answer = run_json(capsys, "optimise", str(path))
    assert status in (3, 4)
    assert answer["min_margin"] is None
    assert answer["explanation"]


def test_a_file_keeps_its_yaw(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    path, output = tmp_path / "turn.json", tmp_path / "turn.csv"
    path.write_text(json.dumps(gait_content(library()["walk"].gait) | {"step": [0.005, 0.005, 0.1]}))
    assert run_json(capsys, "optimise", str(path), "-o", str(output))[0] == 0
    assert read_trajectory(output).trajectory.heading[-1] == pytest.approx(0.1)


def test_feet_from_their_own_modules_are_no_trajectory(capsys: pytest.CaptureFixture[str]) -> None:
    path = reference_path("simulation_manual/planned/trajA0_o1.csv")
    status, answer = run_json(capsys, "check", str(path))
    assert status == 2
    assert "modules' centres" in answer["error"]


def test_directions_are_the_same_motion_turned(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    ends = []
    for direction in ("1", "2"):
        path = tmp_path / f"{direction}.csv"
        assert run(capsys, "optimise", "s-gait", "--direction", direction, "-o", str(path))[0] == 0
        ends.append(parse_trajectory_csv(path.read_text(), path.name).trajectory.body_world[-1])
    assert ends[0][:2] == pytest.approx([0.010, 0.0], abs=1e-9)
    assert ends[1][:2] == pytest.approx([0.0, 0.010], abs=1e-9)


def test_the_manual_walk_has_55_knots(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    path = tmp_path / "manual.csv"
    status, answer = run_json(capsys, "manual", "walk", "-o", str(path))
    assert (status, answer["knots"]) == (0, 55)
    assert parse_trajectory_csv(path.read_text(), path.name).trajectory.knot_count == 55


@pytest.mark.parametrize(
    ("words", "status", "sentence"),
    [
        (["optimise", "hop"], 2, "no gait “hop”"),
        (["optimise", "walk", "--step", "nan"], 2, "--step"),
        (["optimise", "walk", "--step", "-0.01"], 2, "--step"),
        (["optimise", "walk", "--step", "0.01", "--goal", "0.01,0"], 2, "not allowed with"),
        (["optimise", "walk", "--order", "1,2,3"], 2, "order"),
        (["manual", "walk", "--version", "5"], 2, "no version 5"),
        (["manual", "walk", "--step", "0.05"], 3, "cannot reach"),
        (["check", "absent.csv"], 2, "absent.csv cannot be read"),
        (["waypoints", "absent.csv"], 2, "absent.csv cannot be read"),
        (["send", "absent.csv", "--robot", "emulator"], 2, "absent.csv cannot be read"),
        (["emulate", "--fault", "sneeze"], 2, "sneeze"),
        (["bench", "nothing"], 2, "no benchmark “nothing”"),
        (["dance"], 2, "dance"),
        ([], 2, "COMMAND"),
    ],
)
def test_bad_input_has_its_status_and_sentence(
    capsys: pytest.CaptureFixture[str], words: list[str], status: int, sentence: str
) -> None:
    code, out, err = run(capsys, *words)
    assert (code, out) == (status, "")
    assert sentence in err
    code, answer = run_json(capsys, *words)
    assert code == status
    assert sentence in answer["error"]


def test_an_absent_serial_device_is_exit_5(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    path = tmp_path / "way.csv"
    header = "duration_s," + ",".join(f"h{i}" for i in range(1, 13))
    path.write_text(f"{header}\n0.4," + ",".join(["5.5"] * 12) + "\n")
    status, answer = run_json(
        capsys, "send", str(path), "--robot", "/dev/no-such-robot", "--yes", "--data", str(tmp_path)
    )
    assert status == 5
    assert "/dev/no-such-robot" in answer["error"]


def test_the_studio_does_not_start_for_a_robot_that_is_not_there(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    status, answer = run_json(capsys, "serve", "--robot", "/dev/no-such-robot", "--data", str(tmp_path))
    assert status == 5
    assert "Plug the robot in" in answer["error"]


def test_listing_gaits_makes_no_folder(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    status, answer = run_json(capsys, "gaits", "--data", str(tmp_path / "absent"))
    assert status == 0
    assert answer["gaits"][0]["id"] == "fast-c-gait"
    assert list(tmp_path.iterdir()) == []


def test_waypoints_out_of_range_are_bad_input_by_line(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    path = tmp_path / "way.csv"
    header = "duration_s," + ",".join(f"h{i}" for i in range(1, 13))
    path.write_text(f"{header}\n0.4," + ",".join(["5.5"] * 11 + ["25.0"]) + "\n")
    status, answer = run_json(capsys, "send", str(path), "--robot", "emulator", "--yes")
    assert status == 2
    assert "25.00 mm" in answer["error"]
    assert answer["where"].endswith("way.csv:2")


def test_nothing_is_left_where_a_file_cannot_be_written(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    status, _, err = run(capsys, "manual", "walk", "-o", str(tmp_path / "absent" / "walk.csv"))
    assert status == 2
    assert "cannot be written" in err
    assert list(tmp_path.iterdir()) == []


def test_the_version_stands_in_one_place_each() -> None:
    project = tomllib.loads((PROJECT / "pyproject.toml").read_text())
    assert project["project"]["version"] == VERSION


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_the_emulator_prints_its_line_and_ends_by_a_signal(number: signal.Signals) -> None:
    process = subprocess.Popen(
        [sys.executable, "-m", "app", "emulate", "--json"],
        cwd=PROJECT,
        stdout=subprocess.PIPE,
        text=True,
        env={**os.environ, "PYTHONUNBUFFERED": "1"},
    )
    with process:
        assert process.stdout is not None
        device = json.loads(process.stdout.readline())["device"]
        assert Path(device).exists()
        process.send_signal(number)
        assert process.wait(60) == 0
