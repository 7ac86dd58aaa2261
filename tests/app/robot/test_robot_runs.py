"""Runs from a later pose and repeated ones over HTTP, the list of devices, and what happened."""

from __future__ import annotations

from typing import Any

import pytest

from app.emulator.emulated_robot import EmulatedRobot
from tests.support.studio_process import StudioProcess, wait_for

SPEED = 20.0


@pytest.fixture(scope="module")
def walk(studio: StudioProcess) -> dict[str, Any]:
    """The approved walk, and a robot that is up."""
    job = studio.ask("POST", "/api/jobs", {"gait": "walk"}).content["id"]
    wait_for(lambda: studio.ask("GET", f"/api/jobs/{job}").content["state"] == "done", "the job is done", 60)
    studio.ask("POST", "/api/gaits/walk/check")
    assert studio.ask("POST", "/api/gaits/walk/approve", {"by": "Ada", "accept_warnings": True}).status == 200
    assert studio.ask("POST", "/api/robot/connect").status == 200
    wait_for(lambda: studio.robot()["robot"] == "disarmed", "the robot is up")
    plan: dict[str, Any] = studio.ask("GET", "/api/gaits/walk/view").content["plan"]
    return plan


def summary(studio: StudioProcess, query: str = "") -> Any:
    return studio.ask("GET", f"/api/gaits/walk/run{query}").content


def ran(studio: StudioProcess, robot: EmulatedRobot, **content: Any) -> list[list[float]]:
    """Sends the walk and returns the strokes that the robot took, mm."""
    first = len(robot.firmware.messages)
    assert studio.ask("POST", "/api/robot/arm", {"by": "Ada"}).status == 200
    sent = studio.ask("POST", "/api/robot/send", {"gait": "walk", "by": "Ada", **content})
    assert sent.status == 200, sent.content
    wait_for(lambda: studio.robot()["robot"] in ("done", "fault"), "the run ended", 60)
    assert studio.robot()["robot"] == "done", studio.robot()["sentence"]
    messages = robot.firmware.messages[first:]
    return [[round(h, 4) for h in m.strokes_mm] for m in messages if m.strokes_mm is not None]


@pytest.mark.heavy
def test_a_run_from_a_later_pose_is_shown_and_sends_the_rest(
    studio: StudioProcess, robot: EmulatedRobot, walk: dict[str, Any]
) -> None:
    whole = summary(studio)
    later = [place for place in whole["beginnings"] if place["waypoint"] > 0]
    assert whole["beginnings"][0]["waypoint"] == 0
    start = later[len(later) // 2]["waypoint"]
    shown = summary(studio, f"?from={start}")
    assert shown["waypoints"] == whole["waypoints"] - start
    assert shown["estimated_seconds"] < whole["estimated_seconds"]
    assert shown["waypoints_hash"] == whole["waypoints_hash"]
    taken = ran(studio, robot, **{"from": start})
    assert taken[-shown["waypoints"] :] == walk["waypoint_strokes_mm"][start:]
    run = studio.robot()["run"]
    assert (run["reached"], run["count"]) == (shown["waypoints"], shown["waypoints"])
    assert run["plan_time"] == pytest.approx(whole["beginnings"][-1]["time"])


@pytest.mark.heavy
def test_a_gait_that_ends_as_it_begins_is_repeated(
    studio: StudioProcess, robot: EmulatedRobot, walk: dict[str, Any]
) -> None:
    assert summary(studio)["why_not_repeated"] is None
    shown = summary(studio, "?iterations=2")
    assert shown["waypoints"] == 2 * len(walk["waypoint_strokes_mm"])
    taken = ran(studio, robot, iterations=2)
    assert taken[-shown["waypoints"] :] == walk["waypoint_strokes_mm"] * 2
    assert studio.robot()["run"]["iteration"] == 2


def test_a_second_send_is_refused_and_takes_nothing_from_the_record_of_the_run_that_is_on(
    studio: StudioProcess, walk: dict[str, Any]
) -> None:
    before = studio.ask("GET", "/api/runs").content["total"]
    assert studio.ask("POST", "/api/robot/arm", {"by": "Ada"}).status == 200
    assert studio.ask("POST", "/api/robot/send", {"gait": "walk"}).status == 200
    again = studio.ask("POST", "/api/robot/send", {"gait": "walk"})
    assert (again.status, again.content["error"][:12]) == (409, "A run is on.")
    wait_for(lambda: studio.robot()["robot"] == "done", "the run is done", 60)
    wait_for(lambda: studio.ask("GET", "/api/runs?state=running").content["total"] == 0, "the record ended")
    kept = studio.ask("GET", "/api/runs").content
    assert kept["total"] == before + 1
    run = kept["runs"][0]
    assert (run["id"], run["state"]) == (studio.robot()["run"]["id"], "done")
    assert run["errors"]["arrived"] == len(walk["waypoint_strokes_mm"])


@pytest.mark.parametrize(
    ("content", "where", "words"),
    [
        ({"from": 9999}, "from", "There is no waypoint 10000"),
        ({"iterations": 0}, "iterations", "choose 1 to 100"),
        ({"iterations": 101}, "iterations", "choose 1 to 100"),
    ],
)
def test_what_cannot_be_sent_is_refused_before_it_is_confirmed_and_after(
    studio: StudioProcess, walk: dict[str, Any], content: dict[str, int], where: str, words: str
) -> None:
    query = "&".join(f"{name}={value}" for name, value in content.items())
    for answer in (
        studio.ask("GET", f"/api/gaits/walk/run?{query}"),
        studio.ask("POST", "/api/robot/send", {"gait": "walk", **content}),
    ):
        assert (answer.status, answer.content["where"]) == (422, where)
        assert words in answer.content["error"]


def test_a_pose_with_a_foot_in_the_air_is_no_beginning(studio: StudioProcess, walk: dict[str, Any]) -> None:
    places = {place["waypoint"] for place in summary(studio)["beginnings"]}
    swung = next(i for i in range(len(walk["waypoint_strokes_mm"])) if i not in places)
    refused = studio.ask("POST", "/api/robot/send", {"gait": "walk", "from": swung})
    assert refused.status == 422
    nearest = max(i for i in places if i < swung) + 1
    assert f"Begin at waypoint {nearest} or " in refused.content["error"]


def test_what_happened_is_told_with_its_cause(studio: StudioProcess, walk: dict[str, Any]) -> None:
    told = studio.ask("GET", "/api/robot/transitions").content["transitions"]
    causes = [one["cause"] for one in told]
    assert "The robot answers." in causes
    assert [one["at"] for one in told] == sorted(one["at"] for one in told)
    assert {"ready"} == {one["link"] for one in told if one["cause"] == "Armed by Ada."}


def test_devices_are_listed_and_the_last_one_is_remembered(
    studio: StudioProcess, robot: EmulatedRobot, walk: dict[str, Any]
) -> None:
    ports = studio.ask("GET", "/api/robot/ports").content
    assert ports["last"]["device"] == robot.device
    assert ports["again"] is None
    assert all(set(port) == {"device", "description", "serial_number"} for port in ports["ports"])
