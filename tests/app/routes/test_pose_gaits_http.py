"""Gaits for the robot's clock over HTTP: solved after every edit, undone at once, checked and refused."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import pytest

from app.documents.gait_json import gait_content
from core.gait.gait import heading_step
from core.gait.poses import Poses
from core.library.library import library
from core.pose_gaits.gait_poses import new_pose_gait
from core.robot.model import load_robot
from tests.support.studio_process import StudioProcess, running_studio, wait_for

LONG = 120.0


@pytest.fixture(scope="module")
def studio(tmp_path_factory: pytest.TempPathFactory) -> Iterator[StudioProcess]:
    with running_studio(tmp_path_factory.mktemp("data")) as running:
        yield running


@pytest.fixture(scope="module")
def gait(studio: StudioProcess) -> str:
    like = library()["c-gait"].gait.with_options(margin=0.006, stop_bound=1.5)
    asked = replace(like, step=heading_step(like.orientation, 0.010))
    document = new_pose_gait("By poses", asked, Poses(free_step=False), load_robot(like.robot))
    answer = studio.ask("POST", "/api/gaits", gait_content(document))
    assert answer.status in (200, 201), answer.content
    made: str = answer.content["id"]
    return made


def view(studio: StudioProcess, gait: str) -> dict[str, Any]:
    content: dict[str, Any] = studio.ask("GET", f"/api/gaits/{gait}/view").content
    return content


def solved(studio: StudioProcess, gait: str) -> dict[str, Any]:
    wait_for(lambda: view(studio, gait)["plan"]["source"] == "poses", "the poses are found", LONG)
    return view(studio, gait)


@pytest.mark.heavy
def test_a_new_one_is_solved_by_itself_and_keeps_its_poses(studio: StudioProcess, gait: str) -> None:
    found = solved(studio, gait)
    assert found["source"] == "poses"
    assert found["document"]["poses"]["found"]["step"] == pytest.approx(0.010)
    plan = found["plan"]
    assert plan["waypoint_count"] == len(plan["times"]) == len(found["document"]["timeline"]["feet"][0])
    assert 0.0 < plan["robot_seconds"] - plan["times"][-1] < 0.5  # the first message
    assert plan["speed_mm_s"] == pytest.approx(10.0 / plan["robot_seconds"], rel=0.02)
    assert found["undo"] is None


@pytest.mark.heavy
def test_an_edit_is_adapted_then_solved_and_undo_needs_no_search(studio: StudioProcess, gait: str) -> None:
    before = solved(studio, gait)
    document = before["document"]
    longer = {**document, "step": [0.012, 0.0, 0.0]}
    live = studio.ask("POST", f"/api/gaits/{gait}/live", {"document": longer}).content
    assert live["plan"]["source"] == "adapted"
    assert live["plan"]["body"][-1][0] == pytest.approx(0.012)
    answer = studio.ask("PUT", f"/api/gaits/{gait}", longer)
    assert answer.status == 200, answer.content
    assert solved(studio, gait)["plan"]["body"][-1][0] == pytest.approx(0.012)
    back = studio.ask("POST", f"/api/gaits/{gait}/undo").content
    assert back["plan"]["source"] == "poses"
    assert back["plan"]["hash"] == before["plan"]["hash"]
    verdict = studio.ask("POST", f"/api/gaits/{gait}/check").content
    assert verdict["passed"]
    assert verdict["costs"] == []  # nothing is merged or cut


@pytest.mark.heavy
def test_a_search_is_cancelled_and_begun_again(studio: StudioProcess, gait: str) -> None:
    document = solved(studio, gait)["document"]
    answer = studio.ask("PUT", f"/api/gaits/{gait}", {**document, "iterations": 4, "step": [0.020, 0.0, 0.0]})
    assert answer.status == 200, answer.content
    assert answer.content["search"]["state"] == "running"
    cancelled = studio.ask("DELETE", f"/api/gaits/{gait}/search")
    assert cancelled.content["search"]["state"] == "cancelled"
    assert studio.ask("DELETE", f"/api/gaits/{gait}/search").status == 409
    assert view(studio, gait)["plan"]["source"] == "adapted"
    assert view(studio, gait)["search"]["state"] == "cancelled"
    again = studio.ask("POST", f"/api/gaits/{gait}/search").content
    assert again["search"]["state"] == "running"
    assert solved(studio, gait)["search"] is None
    assert studio.ask("POST", f"/api/gaits/{gait}/search").status == 409
    assert studio.ask("POST", f"/api/gaits/{gait}/undo").content["plan"]["source"] == "poses"


@pytest.mark.heavy
def test_what_is_out_of_reach_says_why_and_is_not_sent(studio: StudioProcess, gait: str) -> None:
    document = solved(studio, gait)["document"]
    answer = studio.ask("PUT", f"/api/gaits/{gait}", {**document, "step": [0.15, 0.0, 0.0]})
    assert answer.status == 200, answer.content

    def explained() -> bool:
        poses = view(studio, gait)["plan"]["poses"]
        return bool(poses and poses["explanation"]) or view(studio, gait)["plan"]["refusal"] is not None

    wait_for(explained, "the search says why there is none", LONG)
    assert studio.ask("POST", f"/api/gaits/{gait}/approve", {"by": "Ada"}).status >= 400
    assert studio.ask("POST", f"/api/gaits/{gait}/undo").content["plan"]["source"] == "poses"


def test_its_timeline_cannot_be_drawn_on(studio: StudioProcess, gait: str) -> None:
    document = solved(studio, gait)["document"]
    feet = ["0" * len(document["timeline"]["feet"][0]), *document["timeline"]["feet"][1:]]
    timeline = {**document["timeline"], "feet": feet}
    answer = studio.ask("PUT", f"/api/gaits/{gait}", {**document, "timeline": timeline})
    assert answer.status == 409
    assert "follows from foot order" in str(answer.content)


def test_merging_is_nothing_to_it_and_a_pinned_pose_is_refused_where_there_is_none(
    studio: StudioProcess, gait: str
) -> None:
    before = solved(studio, gait)
    document = before["document"]
    merged = {**document, "options": {**document["options"], "merge": 0.001}}
    assert studio.ask("PUT", f"/api/gaits/{gait}", merged).status == 200
    after = view(studio, gait)
    assert after["plan"]["source"] == "poses"
    assert after["plan"]["hash"] == before["plan"]["hash"]
    poses = {**document["poses"], "pinned": [{"pose": 1, "along": 0.0, "sideways": 0.0}]}
    refused = studio.ask("PUT", f"/api/gaits/{gait}", {**document, "poses": poses})
    assert refused.status == 422
    assert "names pose 1" in str(refused.content)
    assert view(studio, gait)["revision"] == after["revision"]


@pytest.mark.soak
def test_an_edit_back_to_what_was_solved_before_takes_its_poses_and_step(
    studio: StudioProcess, gait: str
) -> None:
    before = solved(studio, gait)["document"]
    free = {**before, "poses": {**before["poses"], "free_step": True}}
    assert studio.ask("PUT", f"/api/gaits/{gait}", free).status == 200
    first = solved(studio, gait)["document"]
    wider = {**first, "options": {**first["options"], "margin": 0.008}}
    assert studio.ask("PUT", f"/api/gaits/{gait}", wider).status == 200
    second = solved(studio, gait)["document"]
    assert second["step"] != first["step"]
    back = {**second, "options": first["options"]}
    assert studio.ask("PUT", f"/api/gaits/{gait}", back).status == 200
    now = view(studio, gait)
    assert now["plan"]["source"] == "poses"
    assert now["document"]["step"] == first["step"]
    assert now["document"]["poses"] == first["poses"]
    assert studio.ask("POST", f"/api/gaits/{gait}/check").content["passed"]


@pytest.mark.soak
def test_a_pose_that_is_pinned_far_away_is_drawn_nearer_and_the_search_says_no(
    studio: StudioProcess, gait: str
) -> None:
    document = solved(studio, gait)["document"]
    poses = {**document["poses"], "pinned": [{"pose": 5, "along": 0.03, "sideways": 0.03}]}
    answer = studio.ask("PUT", f"/api/gaits/{gait}", {**document, "poses": poses})
    assert answer.status == 200, answer.content
    assert "where pose 5 is pinned; it is drawn nearer." in answer.content["plan"]["note"]
    wait_for(lambda: bool(view(studio, gait)["plan"]["poses"]["explanation"]), "the search says no", LONG)
    assert "at pose 5" in view(studio, gait)["plan"]["note"]
