"""Waypoint files with companions: robots of any number of legs, and companions that do not fit."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest

from app.export.trajectory_files import companion_path
from app.export.way_files import is_way_file, read_way_file
from app.store.plain_file import write_atomically
from core.errors import InputError
from core.motion.trajectory import Trajectory
from core.problem.motion_problem import standing_pose
from core.robot.model import load_robot
from core.wire.waypoint_companion import WaypointCompanion, format_waypoint_companion
from core.wire.waypoints import Waypoints, format_waypoint_csv
from tests.support.command import run
from tests.support.hostile_files import NO_FILES


def written(folder: Path, robot: str) -> Path:
    """A file of a robot that rises by 2 mm, with its companion."""
    model = load_robot(robot)
    low, high = (standing_pose(model, height, (0.0, 0.0)) for height in (0.0535, 0.0555))
    motion = Trajectory(
        np.array([0.0, 1.0]),
        np.array([low.body_world, high.body_world]),
        np.zeros(2),
        np.array([low.feet_world, high.feet_world]),
        np.ones((2, model.leg_count), dtype=np.bool_),
    )
    text = format_waypoint_csv(Waypoints(motion.strokes(model), np.array([1.0, 1.0])))
    path = folder / "way.csv"
    write_atomically(path, text)
    companion = WaypointCompanion(robot, 1.5, {"made": "test"}, motion)
    write_atomically(companion_path(path), format_waypoint_companion(companion, text))
    return path


@pytest.mark.parametrize("robot", ["deltawalker", "hexapod", "dodecapod"])
def test_robot_and_motion_come_from_the_companion(robot: str, tmp_path: Path) -> None:
    path = written(tmp_path, robot)
    assert is_way_file(path)
    way = read_way_file(path)
    assert way.model.name == robot
    assert way.motion is not None
    assert np.allclose(way.motion.strokes(way.model), way.waypoints.strokes, atol=1e-6)
    companion_path(path).unlink()
    assert read_way_file(path, robot).motion is None


def test_a_file_of_another_number_of_feet_names_the_remedy(tmp_path: Path) -> None:
    path = written(tmp_path, "hexapod")
    companion_path(path).unlink()
    with pytest.raises(InputError, match=r"strokes of 6 feet; .* has 4. Name its robot with --robot"):
        read_way_file(path)


def test_a_companion_that_does_not_fit_is_left_aside_or_refused(tmp_path: Path) -> None:
    path = written(tmp_path, "deltawalker")
    beside = companion_path(path)
    content = json.loads(beside.read_text())
    for text, words in (("{", "no JSON"), (json.dumps({**content, "version": 2}), "unknown format")):
        beside.write_text(text)
        way = read_way_file(path)
        assert way.motion is None
        assert words in way.assumptions[0]
    beside.write_text(json.dumps({**content, "csv_sha256": "0"}))
    assert "another version" in read_way_file(path).assumptions[0]
    motion = content["motion"]
    quoted = [["0"] * 4] * len(motion["contact"])
    for damage, words in (
        ({"motion": {"times": [0]}}, "damaged"),
        ({"stop_bound": "1_0"}, "damaged.*numbers in quotes"),
        ({"motion": {**motion, "times": list(map(str, motion["times"]))}}, "damaged.*numbers in quotes"),
        (
            {"motion": {**motion, "contact": quoted}},
            "damaged.*numbers in quotes",
        ),
        ({"stop_bound": math.nan}, r"column \d+ \(stop_bound\): NaN is not a finite number"),
        ({"motion": {**motion, "times": [math.inf]}}, r"\(times\): Infinity is not a finite number"),
    ):
        beside.write_text(json.dumps({**content, **damage}))
        with pytest.raises(InputError, match=words):
            read_way_file(path)
    feet = np.array(content["motion"]["feet"])
    feet[1, 0, 0] += 0.001
    beside.write_text(json.dumps({**content, "motion": {**content["motion"], "feet": feet.tolist()}}))
    with pytest.raises(InputError, match="differ by"):
        read_way_file(path)


@pytest.mark.parametrize("merge", [[], ["--merge", "0.001", "--stop-bound", "1"]])
def test_the_companion_says_where_all_feet_are_down(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, merge: list[str]
) -> None:
    motion, path = str(tmp_path / "m.csv"), tmp_path / "way.csv"
    assert run(capsys, "manual", "walk", "--version", "0", "-o", motion)[0] == 0
    assert run(capsys, "waypoints", motion, *merge, "-o", str(path))[0] == 0
    way = read_way_file(path)
    assert len(way.hold_ok) == way.waypoints.count
    assert way.hold_ok[0]
    assert way.hold_ok[-1]
    assert 1 < sum(way.hold_ok) < way.waypoints.count
    companion_path(path).unlink()
    assert not any(read_way_file(path).hold_ok)


@pytest.mark.parametrize("down", ["all", [-1], [45, 1000], [0.0], [True], {"0": True}])
def test_wrong_numbers_of_waypoints_are_refused(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, down: object
) -> None:
    motion, path = str(tmp_path / "m.csv"), tmp_path / "way.csv"
    assert run(capsys, "manual", "walk", "--version", "0", "-o", motion)[0] == 0
    assert run(capsys, "waypoints", motion, "--merge", "0.001", "-o", str(path))[0] == 0
    content = json.loads(companion_path(path).read_text())
    content["origin"]["all_feet_down"] = down
    companion_path(path).write_text(json.dumps(content))
    with pytest.raises(InputError, match="all_feet_down"):
        read_way_file(path)


@pytest.mark.parametrize("kind", ["folder", "pipe", "socket", "dangling", "loop", "device"])
@pytest.mark.parametrize("command", ["check", "waypoints", "import"])
def test_a_companion_that_is_no_file_is_refused_at_once(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, kind: str, command: str
) -> None:
    motion = tmp_path / "m.csv"
    assert run(capsys, "manual", "walk", "--version", "0", "-o", str(motion))[0] == 0
    companion_path(motion).unlink()
    NO_FILES[kind](companion_path(motion))
    status, *said = run(capsys, command, str(motion))
    assert status == 2
    assert "is no file" in "".join(said)
