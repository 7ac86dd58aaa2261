"""`footfall fastest`: its figures, its file, which the other commands take as it is, and bad input."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from app.documents.gait_json import parse_gait
from core.gait.motion_source import MotionSource, motion_source
from core.pose_gaits.gait_poses import found_gait
from core.pose_gaits.pose_check import check_poses
from core.robot.model import load_robot
from core.wire.waypoints import parse_waypoint_csv
from tests.support.command import run, run_json
from tests.support.patience import patient_robot


@pytest.mark.heavy
def test_a_walk_is_written_and_every_other_command_takes_it(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    way = tmp_path / "way.csv"
    status, answer = run_json(capsys, "fastest", "c-gait", "--step", "0.010", "-o", str(way))
    assert (status, answer["status"], answer["optimal"]) == (0, "solved", True)
    assert (answer["gait"], answer["order"], answer["cycles"], answer["moves"]) == (
        "c-gait",
        [1, 2, 3, 4],
        1,
        8,
    )
    assert answer["step"] == pytest.approx(0.010)
    assert answer["total_distance"] == pytest.approx(0.010)
    assert answer["speed"] == pytest.approx(answer["step"] / answer["robot_seconds"])
    assert answer["total_speed"] == pytest.approx(answer["total_distance"] / answer["total_seconds"])
    assert answer["margin"] >= 0.00595
    assert answer["shoe_distance"] >= 0.028
    assert (answer["explanation"], answer["waypoints"]) == ([], str(way))
    waypoints = parse_waypoint_csv(way.read_text())
    assert abs(waypoints.strokes[[0, -1]] - 0.0055).max() < 1e-4
    companion = json.loads((tmp_path / "way.footfall.json").read_text())
    assert (companion["robot"], companion["stop_bound"]) == ("deltawalker", 1.5)
    assert companion["origin"]["gait"] == "c-gait"
    status, verdict = run_json(capsys, "check", str(way))
    assert (status, verdict["passed"]) == (0, True)
    assert "slip" in {margin["rule"] for margin in verdict["margins"]}
    status, simulated = run_json(capsys, "simulate", str(way))
    assert (status, simulated["fell"], simulated["waypoints"]) == (0, False, waypoints.count)
    with patient_robot(20.0, booted=True) as robot:
        words = ("--robot", robot.device, "--yes", "--data", str(tmp_path))
        status, sent = run_json(capsys, "send", str(way), *words)
    assert (status, sent["state"], sent["reached"]) == (0, "done", waypoints.count)
    way.write_text(way.read_text().replace("5.5000", "5.6000", 1))
    assert "belongs to another version of it" in "".join(map(str, run(capsys, "check", str(way))))
    (tmp_path / "way.footfall.json").unlink()
    assert run(capsys, "check", str(way))[0] == 0


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (("nonsense",), "There is no gait “nonsense”"),
        (("--step", "0"), "say how far with --turn"),
        (("--turn", "left"), "add --step 0"),
        (("--step", "0", "--turn", "5"), "--turn"),
        (("--sway", "2"), "--sway"),
        (("--order", "1,2,3,3"), "each foot 1 to 4 once"),
        (("--order", "1,2,3"), "each foot 1 to 4 once"),
        (("--step", "-0.01"), "--step"),
        (("--step", "quick"), "--step"),
        (("--step", "nan"), "--step"),
        (("--margin", "0.2"), "--margin"),
        (("--clearance", "-0.003"), "--clearance"),
        (("--stop-bound", "0.3"), "--stop-bound"),
        (("--slip", "0"), "--slip"),
        (("--shoe-distance", "1"), "--shoe-distance"),
        (("--cycles", "0"), "--cycles"),
        (("--direction", "5"), "--direction"),
        (("--robot", "centipede"), "centipede"),
        (("-o", "way.txt"), "neither a waypoint file nor a gait file"),
    ],
)
def test_bad_input_is_named_with_its_remedy(
    words: tuple[str, ...], sentence: str, capsys: pytest.CaptureFixture[str]
) -> None:
    status, answer = run_json(capsys, "fastest", *words)
    assert status == 2
    assert sentence in answer["error"]


@pytest.mark.heavy
def test_a_step_that_no_motor_reaches_is_infeasible_with_the_longest_that_works(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    way = tmp_path / "way.csv"
    status, answer = run_json(capsys, "fastest", "walk", "--step", "0.12", "-o", str(way))
    assert (status, answer["status"], answer["waypoints"]) == (3, "infeasible", None)
    assert "the longest that was found is" in answer["explanation"][0]
    assert not way.exists()


@pytest.mark.heavy
def test_a_turn_on_the_spot_is_a_gait_that_turns(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    file = tmp_path / "turn.json"
    words = ("rotate", "--step", "0", "--turn", "-0.3", "-o", str(file))
    status, answer = run_json(capsys, "fastest", *words)
    assert (status, answer["step"], answer["speed"]) == (0, 0.0, 0.0)
    assert answer["turn"] == pytest.approx(-0.3)
    gait = parse_gait(file.read_text(), file.name)
    found = found_gait(gait, load_robot("deltawalker"))
    assert found is not None
    assert found.turn == pytest.approx(-0.3)
    assert check_poses(found).confirmed
    assert run_json(capsys, "check", str(file))[0] == 0


@pytest.mark.heavy
def test_a_gait_file_opens_as_a_gait(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    file = tmp_path / "gait.json"
    words = ("c-gait", "--step", "0.010", "--direction", "2", "-o", str(file))
    status, answer = run_json(capsys, "fastest", *words)
    assert (status, answer["waypoints"]) == (0, str(file))
    gait = parse_gait(file.read_text())
    assert (gait.direction, gait.iterations, motion_source(gait)) == (2, 1, MotionSource.POSES)
    status, verdict = run_json(capsys, "check", str(file))
    assert (status, verdict["passed"]) == (0, True)
    status, refused = run_json(capsys, "optimise", str(file))
    assert status == 2
    assert "footfall fastest" in refused["error"]
