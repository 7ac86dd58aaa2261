"""Conversion of gaits over HTTP: one undo, the search that is not done twice, refusals with their field."""

from __future__ import annotations

import http.client
import json
from collections.abc import Iterator
from typing import Any
from urllib.parse import urlsplit

import pytest

from tests.support.studio_process import StudioProcess, running_studio, wait_for


@pytest.fixture(scope="module")
def studio(tmp_path_factory: pytest.TempPathFactory) -> Iterator[StudioProcess]:
    with running_studio(tmp_path_factory.mktemp("data")) as running:
        yield running


@pytest.fixture
def gait(studio: StudioProcess) -> str:
    """A C-gait of its own, with room for moves that are not divided."""
    made: str = studio.ask("POST", "/api/gaits?copy_of=c-gait&name=Slow").content["id"]
    document = studio.document(made)
    options = {**document["options"], "stop_bound": 1.5}
    assert studio.ask("PUT", f"/api/gaits/{made}", {**document, "options": options}).status == 200
    return made


def view(studio: StudioProcess, gait: str) -> dict[str, Any]:
    content: dict[str, Any] = studio.ask("GET", f"/api/gaits/{gait}/view").content
    return content


def converted(studio: StudioProcess, gait: str, to: str, **more: Any) -> Any:
    return studio.ask("POST", f"/api/gaits/{gait}/convert", {"to": to, **more})


@pytest.mark.heavy
def test_both_sides_are_shown_and_what_was_found_is_taken_without_another_search(
    studio: StudioProcess, gait: str
) -> None:
    before = view(studio, gait)
    first, *_, last = studio.lines(f"/api/gaits/{gait}/faster", {})
    assert first["state"] == "running"
    assert last["state"] == "solved"
    now, faster = last["now"], last["faster"]
    assert first["now"] == now
    assert now["seconds"] == pytest.approx(before["plan"]["robot_seconds"], abs=0.06)
    assert now["moves"] == before["plan"]["waypoint_count"] - 1
    assert now["distance"] == pytest.approx(0.010)
    assert now["cycle_seconds"] < now["seconds"]
    assert faster["distance"] == pytest.approx(0.010)
    assert faster["cycle_speed"] > now["cycle_speed"]
    assert faster["speed"] > now["speed"]
    assert faster["margin"] >= 0.0059
    assert view(studio, gait)["document"] == before["document"]

    answer = converted(studio, gait, "poses", revision=before["revision"])
    assert answer.status == 200, answer.content
    plan = answer.content["plan"]
    assert plan["source"] == "poses"
    assert answer.content["search"] is None
    assert plan["robot_seconds"] == pytest.approx(faster["seconds"], abs=0.06)
    assert plan["stop_seconds"] == pytest.approx(faster["stop_seconds"], abs=0.006)
    assert answer.content["document"]["poses"] == last["document"]["poses"]
    assert answer.content["undo"] == "Make it for the robot's clock"

    back = studio.ask("POST", f"/api/gaits/{gait}/undo").content
    assert back["document"] == before["document"]
    assert back["plan"]["hash"] == before["plan"]["hash"]
    remembered = studio.lines(f"/api/gaits/{gait}/faster", {})
    assert [state["state"] for state in remembered] == ["solved"]
    assert remembered[0]["faster"] == faster


def test_there_and_back_is_two_undo_steps_and_the_same_document(studio: StudioProcess, gait: str) -> None:
    before = view(studio, gait)["document"]
    poses = converted(studio, gait, "poses").content
    assert poses["document"]["poses"]["free_step"] is False
    drawn = converted(studio, gait, "drawn").content
    assert drawn["document"] == before
    assert drawn["undo"] == "Draw it freely"
    assert drawn["search"] is None
    for _ in range(2):
        studio.ask("POST", f"/api/gaits/{gait}/undo")
    assert view(studio, gait)["document"] == before


@pytest.mark.heavy
def test_a_new_gait_is_made_of_the_document_and_has_its_motion(studio: StudioProcess, gait: str) -> None:
    last = studio.lines(f"/api/gaits/{gait}/faster", {})[-1]
    made = studio.ask("POST", "/api/gaits", {**last["document"], "name": "Quick"})
    assert made.status == 201, made.content
    assert made.content["plan"]["source"] == "poses"
    assert made.content["search"] is None


@pytest.mark.parametrize(
    ("gait_id", "to", "where", "words"),
    [
        ("walk-turn-s-gait", "poses", "sequence", "A sequence has several gaits"),
        ("hexapod-tripod", "poses", "timeline", "are in the air together"),
        ("hexapod-five", "poses", "held", "every foot steps"),
        ("fast-curve-left", "drawn", "iterations", "goes in a curve"),
        ("walk", "drawn", "poses", "is no gait for the robot's clock"),
        ("fast-c-gait", "poses", "poses", "is a gait for the robot's clock already"),
    ],
)
def test_what_cannot_be_converted_is_refused_with_its_field(
    studio: StudioProcess, gait_id: str, to: str, where: str, words: str
) -> None:
    answer = converted(studio, gait_id, to)
    assert answer.status == 422
    assert answer.content["where"] == where
    assert words in answer.content["error"]
    if to == "poses":
        assert studio.ask("POST", f"/api/gaits/{gait_id}/faster").content == answer.content
    if gait_id not in ("walk", "fast-c-gait"):
        assert view(studio, gait_id)["conversion_refusal"] == answer.content["error"]


def test_another_kind_and_an_old_revision_are_refused(studio: StudioProcess, gait: str) -> None:
    assert converted(studio, gait, "sequence").status == 422
    assert converted(studio, gait, "poses", revision=99).status == 409
    assert "poses" not in view(studio, gait)["document"]
    assert studio.ask("POST", "/api/gaits/none/convert", {"to": "poses"}).status == 404
    assert studio.ask("POST", "/api/gaits/none/faster").status == 404


def test_a_table_is_set_aside_with_a_word(studio: StudioProcess) -> None:
    made = studio.ask("POST", "/api/gaits?copy_of=walk-manual-0&name=Table").content["id"]
    answer = converted(studio, made, "poses").content
    assert answer["notice"] == "The segment table is set aside. Undo brings it back."
    assert studio.ask("POST", f"/api/gaits/{made}/undo").content["document"]["segment_table"] is not None


@pytest.mark.soak
def test_a_step_that_is_too_long_says_so(studio: StudioProcess, gait: str) -> None:
    document = studio.document(gait)
    assert studio.ask("PUT", f"/api/gaits/{gait}", {**document, "step": [0.12, 0.0, 0.0]}).status == 200
    last = studio.lines(f"/api/gaits/{gait}/faster", {})[-1]
    assert last["state"] == "infeasible"
    assert last["now"] is None
    assert last["sentence"]
    assert "--" not in last["sentence"]


@pytest.mark.heavy
def test_a_search_ends_with_its_request(studio: StudioProcess, gait: str) -> None:
    document = studio.document(gait)
    long = {**document, "iterations": 5, "step": [0.02, 0.0, 0.0]}
    assert studio.ask("PUT", f"/api/gaits/{gait}", long).status == 200
    address = urlsplit(studio.url)
    line = http.client.HTTPConnection(address.hostname or "", address.port)
    line.request("POST", f"/api/gaits/{gait}/faster")
    answer = line.getresponse()
    assert json.loads(answer.readline())["state"] == "running"
    answer.close()
    line.close()
    # The solver answers one question after the other: it is free for the next one at once.
    other = studio.ask("POST", "/api/gaits?copy_of=c-gait&name=Other").content["id"]
    assert converted(studio, other, "poses").content["search"]["state"] == "running"
    wait_for(lambda: view(studio, other)["plan"]["source"] == "poses", "the next search is done")
