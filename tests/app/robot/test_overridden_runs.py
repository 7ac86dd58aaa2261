"""Gaits with errors that a person overrides: approved over HTTP, sent to the emulated robot, kept with it."""

from __future__ import annotations

import csv
import io
from typing import Any

import pytest

from app.emulator.emulated_robot import EmulatedRobot
from core.overrides import MOST_REASON, OVERRIDABLE
from tests.support.studio_process import StudioProcess, wait_for

SPEED = 40.0
GAIT = "amble-manual-2"
REASON = 'It walked, "rocking", on the real robot.'
BY_HAND = [f"{name}-manual-{version}" for name in ("walk", "amble", "s-gait") for version in (0, 1, 2)]


def errors(studio: StudioProcess, gait: str) -> set[str]:
    """The rules of the gait's errors, after a check."""
    verdict = studio.ask("POST", f"/api/gaits/{gait}/check").content
    found = [one for one in verdict["findings"] if one["severity"] == "error"]
    assert all(one["overridable"] for one in found)
    return {one["rule"] for one in found}


def approve(studio: StudioProcess, gait: str, override: Any) -> Any:
    word = {"by": "Ada", "accept_warnings": True, "override": override}
    return studio.ask("POST", f"/api/gaits/{gait}/approve", word)


def sent(studio: StudioProcess, robot: EmulatedRobot, gait: str) -> dict[str, Any]:
    """Sends an approved gait to its end, and returns its run."""
    first = len(robot.firmware.messages)
    assert studio.ask("POST", "/api/robot/arm", {"by": "Grace"}).status == 200
    answer = studio.ask("POST", "/api/robot/send", {"gait": gait, "by": "Grace"})
    assert answer.status == 200, answer.content
    wait_for(lambda: studio.robot()["robot"] in ("done", "fault"), "the run ended", 60)
    assert studio.robot()["robot"] == "done", studio.robot()["sentence"]
    plan = studio.ask("GET", f"/api/gaits/{gait}/view").content["plan"]["waypoint_strokes_mm"]
    messages = [one for one in robot.firmware.messages[first:] if one.strokes_mm is not None]
    taken = [[round(h, 4) for h in one.strokes_mm or ()] for one in messages]
    assert taken[-len(plan) :] == plan
    wait_for(lambda: newest(studio)["state"] != "running", "the record is complete")
    run = newest(studio)
    assert (run["gait"], run["state"], run["reached"]) == (gait, "done", len(plan))
    return run


def newest(studio: StudioProcess) -> dict[str, Any]:
    run: dict[str, Any] = studio.ask("GET", "/api/runs?most=1").content["runs"][0]
    return run


def connected(studio: StudioProcess) -> None:
    if studio.robot()["link"] != "ready":
        assert studio.ask("POST", "/api/robot/connect").status == 200
        wait_for(lambda: studio.robot()["robot"] == "disarmed", "the robot is up")


@pytest.mark.parametrize(
    ("override", "status", "sentence"),
    [
        ({"rules": ["balance", "path_balance"]}, 422, "reason"),
        ({"rules": ["balance", "path_balance"], "reason": " "}, 422, "An override needs a reason of 1 to"),
        ({"rules": ["balance"], "reason": "x" * (MOST_REASON + 1)}, 422, "reason"),
        ({"rules": [], "reason": REASON}, 422, "rules"),
        ({"rules": ["shoe_distance"], "reason": REASON}, 422, "“shoe_distance” cannot be overridden"),
        ({"rules": ["walks"], "reason": REASON}, 422, "There is no rule “walks”"),
        ({"rules": ["balance", "travel"], "reason": REASON}, 409, "No error of the rule “travel” stands"),
        ({"rules": ["balance"], "reason": REASON}, 409, "Errors block approval (1)"),
        ({"rules": ["balance"], "reason": REASON, "by": "Ada"}, 422, "by"),
        (None, 409, "Errors block approval (2)"),
    ],
)
def test_an_override_that_does_not_fit_is_refused_and_nothing_can_be_sent(
    studio: StudioProcess, override: Any, status: int, sentence: str
) -> None:
    assert errors(studio, GAIT) == {"balance", "path_balance"}
    answer = approve(studio, GAIT, override)
    assert (answer.status, sentence in str(answer.content)) == (status, True), answer.content
    assert studio.ask("GET", f"/api/gaits/{GAIT}/view").content["approval"] is None
    assert studio.ask("GET", f"/api/gaits/{GAIT}/approvals").content["approvals"] == []
    refused = studio.ask("POST", "/api/robot/send", {"gait": GAIT, "by": "Ada"})
    assert refused.status == 409


def test_an_override_of_a_gait_that_was_edited_since_is_refused(studio: StudioProcess) -> None:
    rules = sorted(errors(studio, GAIT))
    document = studio.ask("GET", f"/api/gaits/{GAIT}").content
    document["step"] = [0.9 * value for value in document["step"]]
    assert studio.ask("PUT", f"/api/gaits/{GAIT}", document).status == 200
    answer = approve(studio, GAIT, {"rules": rules, "reason": REASON})
    assert answer.status == 409
    assert "Check this gait first" in answer.content["error"]
    assert studio.ask("POST", f"/api/gaits/{GAIT}/undo").status == 200


def test_the_api_names_the_rules_that_may_be_overridden(studio: StudioProcess) -> None:
    schemas = studio.ask("GET", "/openapi.json").content["components"]["schemas"]
    assert schemas["OverrideErrors"]["properties"]["rules"]["items"]["enum"] == list(OVERRIDABLE)


@pytest.mark.heavy
def test_a_run_keeps_the_override_in_list_detail_and_files(
    studio: StudioProcess, robot: EmulatedRobot
) -> None:
    connected(studio)
    rules = sorted(errors(studio, GAIT))
    given = approve(studio, GAIT, {"rules": rules, "reason": REASON}).content["override"]
    assert (given["rules"], given["reason"]) == (rules, REASON)
    assert {one["rule"] for one in given["errors"]} == set(rules)
    run = sent(studio, robot, GAIT)
    assert run["by"] == "Grace"
    assert run["override"] == {"rules": rules, "reason": REASON, "by": "Ada"}
    detail = studio.ask("GET", f"/api/runs/{run['id']}").content
    assert detail["override"] == run["override"]
    assert detail["approval"]["override"]["errors"] == given["errors"]
    rows = list(csv.reader(io.StringIO(studio.blob(f"/api/runs/{run['id']}/run.csv").decode())))
    assert rows[0][-1] == "approved_in_spite_of"
    assert {len(row) for row in rows} == {len(rows[0])}
    assert {row[-1] for row in rows[1:]} == {f"balance, path_balance, by Ada: {REASON}"}
    assert REASON.split(",")[0].encode() in studio.blob(f"/api/runs/{run['id']}/run.mcap")


@pytest.mark.heavy
def test_all_nine_gaits_by_hand_can_be_sent_by_a_person(studio: StudioProcess, robot: EmulatedRobot) -> None:
    connected(studio)
    overridden = []
    for gait in BY_HAND:
        rules = sorted(errors(studio, gait))
        answer = approve(studio, gait, {"rules": rules, "reason": REASON} if rules else None)
        assert answer.status == 200, answer.content
        run = sent(studio, robot, gait)
        assert (run["override"] is not None) == bool(rules)
        overridden += [gait] if rules else []
    assert len(overridden) == 5
