"""Robots chosen in the document: over HTTP from a real process, and on the command line."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from app.documents.gait_json import gait_content
from core.library.library import manual_entry, optimised_entry
from core.robot.model import ROBOT_NAMES, load_robot
from core.wire.waypoints import parse_waypoint_csv
from tests.support.command import run, run_json
from tests.support.studio_process import StudioProcess, running_studio


@pytest.fixture(scope="module")
def studio(tmp_path_factory: pytest.TempPathFactory) -> Iterator[StudioProcess]:
    with running_studio(tmp_path_factory.mktemp("data")) as running:
        yield running


def plan_of(studio: StudioProcess, gait: str) -> dict[str, Any]:
    plan: dict[str, Any] = studio.ask("GET", f"/api/gaits/{gait}/view").content["plan"]
    return plan


def test_every_robot_is_listed_with_what_a_new_gait_needs(studio: StudioProcess) -> None:
    robots = studio.ask("GET", "/api/robots").content["robots"]
    assert [robot["name"] for robot in robots] == list(ROBOT_NAMES)
    assert [robot["motors"] for robot in robots] == [12, 9, 5, 18, 36]
    assert [robot["wired"] for robot in robots] == [True, False, False, False, False]
    for robot in robots:
        for orders in robot["orders"].values():
            assert all(sorted(order["feet"]) == list(range(1, robot["legs"] + 1)) for order in orders)


@pytest.mark.parametrize("robot", ROBOT_NAMES)
def test_a_name_and_a_robot_make_a_gait_that_is_solved(robot: str, studio: StudioProcess) -> None:
    answer = studio.ask("POST", "/api/gaits/drawn", {"name": f"New {robot}", "robot": robot})
    assert answer.status == 201
    assert answer.content["document"]["robot"] == robot
    assert answer.content["robot"] == load_robot(robot).title
    assert answer.content["kind"] == "saved"
    live = answer.content["plan"]["live"]
    if load_robot(robot).is_coupled:
        assert live["status"] == "failed"
        assert "The robot makes another motion: it goes" in live["explanation"][0]
        assert answer.content["plan"]["source"] == "live"
    else:
        assert live["status"] == "solved"


@pytest.mark.parametrize(
    ("change", "where", "word"),
    [
        ({"robot": "octopod"}, "robot", "choose one of deltawalker"),
        ({"order": []}, "order", "must name each of the feet 1 to 4 once"),
        ({"order": [1, 2, 3]}, "order", "must name each of the feet 1 to 4 once"),
        ({"step": 3.0}, "step", "at most 200 mm an iteration"),
        ({"step": -0.01}, "step", "at least 0 mm"),
        ({"name": " "}, "name", "give it one"),
        ({"phase_knots": 1}, "body.phase_knots", "greater than or equal to 2"),
        ({"colour": "red"}, "body.colour", "not permitted"),
    ],
)
def test_what_cannot_be_drawn_is_refused_at_its_field(
    change: dict[str, Any], where: str, word: str, studio: StudioProcess
) -> None:
    before = studio.ask("GET", "/api/gaits").content
    answer = studio.ask("POST", "/api/gaits/drawn", {"name": "Refused", **change})
    assert (answer.status, answer.content["where"]) == (422, where)
    assert word in answer.content["error"]
    assert studio.ask("GET", "/api/gaits").content == before


def test_a_gait_changes_to_a_coupled_robot_as_one_edit_and_shows_what_is_made(
    studio: StudioProcess,
) -> None:
    free = plan_of(studio, "walk-manual-0")
    document = studio.ask("GET", "/api/gaits/walk-manual-0").content
    changed = studio.ask("PUT", "/api/gaits/walk-manual-0?label=Robot", {**document, "robot": "deltawalker5"})
    assert changed.status == 200
    plan = changed.content["plan"]
    assert "The robot has 5, and misses strokes by up to 3.4 mm" in plan["note"]
    inner = [row[::3] for row in plan["strokes_mm"]]
    assert all(max(row) - min(row) < 1e-3 for row in inner)
    assert max(max(row[::3]) - min(row[::3]) for row in free["strokes_mm"]) > 4
    rises = [height for row in plan["real_heights_mm"] for height in row if height is not None]
    assert max(rises) < 0.1
    assert free["real_heights_mm"] is None
    assert max(foot[2] for row in free["feet"] for foot in row) == pytest.approx(0.0045)
    verdict = studio.ask("POST", "/api/gaits/walk-manual-0/check").content
    assert not verdict["passed"]
    errors = {f["rule"] for f in verdict["findings"] if f["severity"] == "error"}
    assert errors == {"clearance", "made_travel"}
    assert plan["balance"] < 0.001
    reason = studio.ask("GET", "/api/gaits/walk-manual-0/run").content["reason"]
    assert "can design for this robot but not drive it" in reason
    assert "DeltaWalker, 12 motors" in reason
    six = studio.ask("PUT", "/api/gaits/walk-manual-0?label=Robot", {**document, "robot": "hexapod"})
    assert six.status == 422
    assert studio.ask("POST", "/api/gaits/walk-manual-0/undo").status == 200


def test_nothing_is_sent_to_a_robot_without_a_cable_even_when_it_is_approved(studio: StudioProcess) -> None:
    document = studio.ask("GET", "/api/gaits/walk").content
    made = studio.ask(
        "POST", "/api/gaits", {**document, "name": "Walk of nine", "robot": "deltawalker9"}
    ).content
    gait = made["id"]
    assert studio.ask("POST", f"/api/gaits/{gait}/check").content["passed"]
    approval = studio.ask(
        "POST", f"/api/gaits/{gait}/approve", {"by": "Ada", "accept_warnings": True}
    ).content
    wish = {"gait": gait, "by": "Ada", "waypoints_hash": approval["waypoints_hash"]}
    answer = studio.ask("POST", "/api/robot/send", wish)
    assert (answer.status, answer.content["where"]) == (409, "robot")
    assert "DeltaWalker, 9 motors: this program can design for this robot" in answer.content["error"]


def test_the_command_line_takes_a_robot_by_name(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    path = str(tmp_path / "walk.csv")
    assert (
        run_json(capsys, "manual", "walk", "--robot", "deltawalker5", "-o", path)[1]["robot"]
        == "deltawalker5"
    )
    for robot, exit_status in (("deltawalker", 0), ("deltawalker9", 4), ("deltawalker5", 4)):
        status, verdict = run_json(capsys, "check", path, "--robot", robot)
        assert status == exit_status
        found = [f["severity"] for f in verdict["findings"] if f["rule"] == "coupling"]
        assert found == ([] if robot == "deltawalker" else ["warning"])
        is_simulated = any(f["rule"].startswith("simulated_") for f in verdict["findings"])
        assert is_simulated == (robot != "deltawalker")
    status, answer = run_json(capsys, "optimise", "walk", "--robot", "hexapod", "--method", "live")
    assert (status, answer["robot"], answer["knots"]) == (0, "hexapod", 65)
    status, _, error = run(capsys, "manual", "walk", "--robot", "hexapod")
    assert status == 2
    assert "made by hand for 4 legs" in error
    status, _, error = run(capsys, "optimise", "walk", "--robot", "spider")
    assert status == 2
    assert "must be one of deltawalker, deltawalker9" in error


def test_a_gait_file_is_checked_for_the_robot_that_it_names(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    content = gait_content(optimised_entry("walk").gait)
    for robot, exit_status in (("deltawalker9", 0), ("deltawalker5", 4)):
        path = tmp_path / f"{robot}.json"
        path.write_text(json.dumps({**content, "robot": robot}))
        assert run_json(capsys, "check", str(path))[0] == exit_status


def test_what_is_exported_of_a_coupled_robot_is_what_it_makes(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    path = tmp_path / "walk.json"
    gait = manual_entry("walk", 0).gait.with_options(merge=0.0, stop_bound=None)
    path.write_text(json.dumps({**gait_content(gait), "robot": "deltawalker5"}))
    ways, arrays, page = (tmp_path / name for name in ("way.csv", "motion.npz", "walk.html"))
    for form, target in (("waypoints", ways), ("npz", arrays), ("html", page)):
        assert run(capsys, "export", str(path), "--format", form, "-o", str(target))[0] == 0
    strokes = parse_waypoint_csv(ways.read_text()).strokes
    assert np.ptp(strokes[:, :, 0], axis=1).max() == 0.0
    assert np.abs(strokes[:, 0, 2] - strokes[:, 1, 1]).max() == 0.0
    with np.load(arrays) as kept:
        assert np.abs(kept["strokes"] - strokes).max() < 1e-6
    text = page.read_text().split('<script type="application/json" id="motion">')[1].split("</script>")[0]
    played = np.array(json.loads(text)["feet"])
    assert played[..., 2].max() < 0.003
