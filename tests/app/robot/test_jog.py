"""Steps by hand over HTTP: looked at, made, and refused with a reason."""

from __future__ import annotations

import json
import urllib.request
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from tests.support.studio_process import Answer, StudioProcess, wait_for

SPEED = 20.0
LONG = 60.0
"""Deadline on a busy computer, s."""
ADA = {"X-Footfall-Page": "page-a", "X-Footfall-Name": "Ada"}
GRACE = {"X-Footfall-Page": "page-g", "X-Footfall-Name": "Grace"}
LIFT = {"part": "foot", "foot": 3, "axis": "z", "by_mm": 4.0}
ASIDE = {"part": "body", "axis": "x", "by_mm": 6.0}
RAISE = {"part": "body", "axis": "z", "by_mm": 6.0}
EIGHT = [8.0] * 12

Jog = Callable[..., Answer]


@pytest.fixture
def jog(studio: StudioProcess) -> Iterator[Jog]:
    """Asks for steps in Ada's name; the robot is disconnected afterwards."""

    def jogged(*steps: dict[str, Any], who: dict[str, str] | None = None, **content: Any) -> Answer:
        return studio.ask("POST", "/api/robot/jog", {"steps": steps, **content}, who or ADA)

    yield jogged
    holder = studio.robot()["lease"]["page"]
    studio.ask("POST", "/api/robot/disconnect", None, {"X-Footfall-Page": holder} if holder else None)


def arm(studio: StudioProcess) -> None:
    assert studio.ask("POST", "/api/robot/connect", None, ADA).status == 200
    wait_for(lambda: studio.robot()["robot"] == "disarmed", "the robot is up", LONG)
    assert studio.ask("POST", "/api/robot/arm", None, ADA).status == 200


def normalise(studio: StudioProcess) -> bool:
    return bool(studio.robot()["robot"] == "armed")


def made(jog: Jog, studio: StudioProcess, *steps: dict[str, Any]) -> dict[str, Any]:
    """Makes steps as soon as the robot stands still, waits for their end, and tells the robot's view."""
    answers: list[Answer] = []

    def accepted() -> bool:
        answers.append(jog(*steps))
        return answers[-1].status == 200 or "stand still" not in answers[-1].content["error"]

    wait_for(accepted, "the robot stands still", LONG)
    assert answers[-1].status == 200, answers[-1].content
    jogged = answers[-1].content["jog"]
    assert jogged is None or jogged["by"] == "Ada"  # it may be over by the time of the answer
    wait_for(lambda: normalise(studio), "the jog is done", LONG)
    return studio.robot()


def poses(studio: StudioProcess, target: dict[str, Any]) -> tuple[dict[str, Any], NDArray[np.float32]]:
    """Header and (frames, nodes, 7) values of a target's ghost."""
    request = urllib.request.Request(
        studio.url + "api/robot/jog/ghost",
        json.dumps(target).encode(),
        {"content-type": "application/json"},
    )
    with urllib.request.urlopen(request, timeout=60) as answer:
        blob: bytes = answer.read()
    size = int.from_bytes(blob[:4], "little")
    header: dict[str, Any] = json.loads(blob[4 : 4 + size])
    values = np.frombuffer(blob[4 + size :], "<f4")
    return header, values.reshape(header["frames"], len(header["nodes"]), 7)


def test_steps_are_looked_at_without_a_robot_and_move_nothing(studio: StudioProcess, jog: Jog) -> None:
    look = {"part": "foot", "foot": 3}
    shown = jog(ASIDE, LIFT, preview=True, from_mm=EIGHT, look=look).content
    assert shown["text"] == "the body along x by +6.0 mm, foot 3 along z by +4.0 mm"
    assert shown["from"] == "given"
    assert (shown["start_mm"], shown["residual_mm"]) == (EIGHT, [0.0] * 12)
    assert min(shown["target_mm"]) > 0.5
    assert shown["heights_mm"] == pytest.approx([0.0, 0.0, 4.0, 0.0], abs=1e-3)
    assert shown["margin_mm"] == pytest.approx(6.0)
    assert shown["reason"] == "Connect the robot first."
    height = shown["handles"][2]
    assert height["axis"] == "z"
    assert (height["start_mm"], height["target_mm"]) == (0.0, 4.0)
    assert height["least_mm"] < height["target_mm"] < height["most_mm"]
    assert studio.robot()["link"] == "disconnected"


def test_motors_and_the_body_tell_their_ranges(jog: Jog) -> None:
    motors = jog(preview=True, from_mm=EIGHT, look={"part": "motor", "foot": 2}).content["handles"]
    assert [(m["motor"], m["least_mm"], m["target_mm"], m["most_mm"]) for m in motors] == [
        (1, 0.5, 8.0, 19.5),
        (2, 0.5, 8.0, 19.5),
        (3, 0.5, 8.0, 19.5),
    ]
    _, _, height = jog(RAISE, preview=True, from_mm=EIGHT, look={"part": "body"}).content["handles"]
    assert (height["start_mm"], height["target_mm"]) == (56.0, 62.0)
    assert (height["least_mm"], height["most_mm"]) == (48.5, 67.5)


def test_a_robot_is_raised_by_hand_step_by_step(studio: StudioProcess, jog: Jog) -> None:
    arm(studio)
    assert jog(RAISE, preview=True).content["from"] == "measured"
    view = made(jog, studio, RAISE)
    assert view["strokes_mm"] == pytest.approx([6.5] * 12, abs=1.0)
    assert (view["jog"], view["run"], view["lease"]["name"]) == (None, None, "Ada")
    causes = [
        change["cause"] for change in studio.ask("GET", "/api/robot/transitions").content["transitions"]
    ]
    assert causes[-2:] == ["Jog by Ada: the body along z by +6.0 mm.", "Jog done."]
    before = view["strokes_mm"]
    view = made(jog, studio, {"part": "motor", "foot": 2, "motor": 1, "by_mm": 2.0})
    gone = np.subtract(view["strokes_mm"], before)
    assert 0.9 < gone[3] < 3.1
    assert np.abs(np.delete(gone, 3)).max() < 0.5


def test_only_who_holds_an_armed_robot_without_a_run_moves_it(studio: StudioProcess, jog: Jog) -> None:
    refused = jog(RAISE)
    assert (refused.status, refused.content["error"]) == (409, "Connect the robot first.")
    assert studio.robot()["lease"]["page"] is None
    assert studio.ask("POST", "/api/robot/connect", None, ADA).status == 200
    wait_for(lambda: studio.robot()["robot"] == "disarmed", "the robot is up", LONG)
    refused = jog(RAISE)
    assert (refused.status, refused.content["error"]) == (409, "Arm the robot first.")
    assert studio.ask("POST", "/api/robot/arm", None, ADA).status == 200
    refused = jog(RAISE, who=GRACE)
    assert (refused.status, refused.content["where"]) == (409, "lease")
    assert jog(RAISE, who=GRACE, preview=True).status == 200
    studio.ask("POST", "/api/robot/reset", None, ADA)
    wait_for(lambda: studio.robot()["robot"] != "moving", "the reset is over", LONG)
    assert normalise(studio)


def test_what_a_robot_cannot_make_is_refused_and_sends_nothing(studio: StudioProcess, jog: Jog) -> None:
    arm(studio)
    stands = studio.robot()["strokes_mm"]
    beyond = jog({**RAISE, "by_mm": 19.5})
    assert beyond.status == 422
    assert "its range is 0.5 to 19.5 mm" in beyond.content["error"]
    small = jog({**RAISE, "by_mm": 0.4})
    assert small.status == 409
    assert "No motor would move" in small.content["error"]
    tips = jog({**LIFT, "by_mm": -3.0})
    assert tips.status == 409
    assert "the robot would tip" in tips.content["error"]
    unseen = jog(RAISE, seen_mm=EIGHT)
    assert (unseen.status, unseen.content["where"]) == (409, "seen_mm")
    given = jog(RAISE, from_mm=EIGHT)
    assert "leave from_mm out" in given.content["error"]
    assert jog().status == 422
    assert normalise(studio)
    assert studio.robot()["strokes_mm"] == pytest.approx(stands, abs=0.1)


def test_the_same_refusals_stand_in_the_preview(studio: StudioProcess, jog: Jog) -> None:
    arm(studio)
    for step, rule in (({**RAISE, "by_mm": 19.5}, "stroke"), ({**RAISE, "by_mm": 0.4}, "threshold")):
        shown = jog(step, preview=True).content
        errors = [finding for finding in shown["findings"] if finding["severity"] == "error"]
        assert [(error["rule"], error["sentence"]) for error in errors] == [(rule, shown["reason"])]


def test_a_jog_that_is_ended_early_leaves_out_its_further_moves(jog: Jog, studio: StudioProcess) -> None:
    idle = studio.ask("POST", "/api/robot/jog/end", None, GRACE)
    assert (idle.status, idle.content["jog"]) == (200, None)
    arm(studio)
    answers: list[Answer] = []

    def accepted() -> bool:
        answers.append(jog({"part": "motor", "foot": 2, "motor": 1, "by_mm": 18}))
        return answers[-1].status == 200

    wait_for(accepted, "the robot stands still", LONG)
    assert answers[-1].content["jog"]["count"] == 6
    assert studio.ask("POST", "/api/robot/jog/end", None, GRACE).status == 200
    wait_for(lambda: normalise(studio), "the jog is done", LONG)
    assert studio.robot()["strokes_mm"][3] < 15.0


def test_a_stop_ends_a_jog(studio: StudioProcess, jog: Jog) -> None:
    arm(studio)
    wait_for(lambda: jog({**RAISE, "by_mm": 15.0}).status == 200, "the robot stands still", LONG)
    assert studio.robot()["stop_seconds"] < 1.2
    assert studio.ask("POST", "/api/robot/stop", None, GRACE).status == 200
    wait_for(lambda: studio.robot()["robot"] == "stopped", "the robot stands still", LONG)
    assert studio.robot()["jog"] is None
    assert jog(RAISE).status == 409


@pytest.mark.parametrize(
    ("content", "field"),
    [
        ({"steps": [{**LIFT, "foot": 5}]}, "foot"),
        ({"steps": [{**LIFT, "foot": 0}]}, "foot"),
        ({"steps": [{"part": "motor", "foot": 1, "motor": 4, "by_mm": 2}]}, "motor"),
        ({"steps": [{"part": "body", "by_mm": 2}]}, "axis"),
        ({"steps": [{**LIFT, "by_mm": 21}]}, "by"),
        ({"steps": [{**LIFT, "by_mm": "far"}]}, "body.steps.0.by_mm"),
        ({"steps": [{**LIFT, "speed": 2}]}, "body.steps.0.speed"),
        ({"steps": [LIFT] * 101}, "body.steps"),
        ({"steps": [LIFT], "from_mm": [8.0] * 11}, "from_mm"),
        ({"steps": [LIFT], "from_mm": [8.0] * 11 + [21.0]}, "from_mm"),
        ({"steps": [LIFT], "robot": "spider"}, "robot"),
        ({"steps": [LIFT], "look": {"part": "foot", "foot": 9}}, "look.foot"),
    ],
)
def test_a_step_that_cannot_be_meant_is_refused_by_its_field(
    studio: StudioProcess, content: dict[str, Any], field: str
) -> None:
    refused = studio.ask("POST", "/api/robot/jog", {"preview": True, **content}, ADA)
    assert (refused.status, refused.content["where"]) == (422, field)


def test_robots_without_a_cable_show_their_targets_and_what_they_lose(jog: Jog) -> None:
    lift = {**LIFT, "foot": 1, "by_mm": 6.0}
    shown = jog(lift, preview=True, robot="deltawalker5").content
    assert (shown["from"], shown["wired"], shown["moves"]) == ("standing", False, 0)
    assert "this program cannot drive this robot" in shown["reason"]
    assert max(map(abs, shown["residual_mm"])) == pytest.approx(4.5)
    assert any("slides rather than lifts" in finding["sentence"] for finding in shown["findings"])
    refused = jog(lift, robot="deltawalker5")
    assert refused.status == 409
    assert "cannot drive this robot" in refused.content["error"]


def test_the_target_is_drawn_where_the_body_stands(studio: StudioProcess) -> None:
    target = {"steps": [RAISE], "from_mm": EIGHT, "x": 0.1, "y": -0.2, "heading": 0.5}
    header, values = poses(studio, target)
    assert (header["robot"], header["nodes"][0]) == ("deltawalker", "/robot/body")
    np.testing.assert_allclose(values[:, 0, 4:], [[0.1, -0.2, 0.062]] * len(values), atol=1e-6)
    refused = studio.ask(
        "POST", "/api/robot/jog/ghost", {"steps": [{**RAISE, "by_mm": 15}], "from_mm": EIGHT}
    )
    assert refused.status == 422
