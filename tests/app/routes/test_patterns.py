"""The pattern search over HTTP: searches, refusals, and gaits that patterns make."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest

from tests.support.studio_process import Answer, StudioProcess, running_studio, wait_for

LONG_SECONDS = 60.0

TRANSITION = {"kind": "transition", "gait": "walk", "sample": 0, "to": "amble", "to_sample": 0, "samples": 20}
SOME = {
    "kind": "limbs",
    "gait": "hexapod-tripod",
    "samples": 20,
    "limbs": ["walks", "walks", "held", "walks", "walks", "broken"],
}
PAGE = {"X-Footfall-Page": "page-of-a-test"}


@pytest.fixture(scope="module")
def studio(tmp_path_factory: pytest.TempPathFactory) -> Iterator[StudioProcess]:
    with running_studio(tmp_path_factory.mktemp("data")) as process:
        yield process


def asked(studio: StudioProcess, question: dict[str, Any]) -> dict[str, Any]:
    """The result of a question, however long it takes."""
    answer = studio.ask("POST", "/api/patterns", question)
    assert answer.status in (200, 202), answer.content
    path = f"/api/patterns/{answer.content['id']}"
    found: list[dict[str, Any]] = [answer.content]

    def is_done() -> bool:
        found[0] = studio.ask("GET", path).content
        return bool(found[0]["state"] != "running")

    wait_for(is_done, "the search has ended", LONG_SECONDS)
    assert found[0]["state"] == "done", found[0]
    result: dict[str, Any] = found[0]["result"]
    return result


def refused(studio: StudioProcess, question: dict[str, Any], status: int = 422) -> Answer:
    answer = studio.ask("POST", "/api/patterns", question)
    assert answer.status == status, answer.content
    return answer


def test_a_transition_is_found_and_becomes_a_gait(studio: StudioProcess) -> None:
    result = asked(studio, {**TRANSITION, "count": 3})
    assert result["status"] == "optimal"
    assert len({tuple(pattern["feet"]) for pattern in result["patterns"]}) == 3
    scores = [pattern["score"] for pattern in result["patterns"]]
    assert scores == sorted(scores)
    assert result["bound"] == scores[0]
    feet = result["patterns"][0]["feet"]
    assert [row[0] + row[-1] for row in feet] == ["11"] * 4
    made = studio.ask("POST", "/api/patterns/gait", {"question": TRANSITION, "feet": feet})
    assert made.status == 201
    assert made.content["name"] == "Walk 10 mm to Amble 10 mm"
    assert feet[2] in made.content["document"]["timeline"]["feet"][2]
    again = studio.ask("POST", "/api/patterns/gait", {"question": TRANSITION, "feet": feet})
    assert again.content["name"] == "Walk 10 mm to Amble 10 mm 2"
    for one in (made, again):
        assert studio.ask("DELETE", f"/api/gaits/{one.content['id']}").status == 200


def test_drawn_cells_and_locked_limbs_stay_and_freed_ones_do_not(studio: StudioProcess) -> None:
    drawn = {**TRANSITION, "cells": [[2, 9, 0], [2, 10, 0]], "locked": [1]}
    result = asked(studio, {**drawn, "rules": {"workload": None}})
    feet = result["patterns"][0]["feet"]
    assert feet[2][9:11] == "00"
    assert feet[1] == "1" * 20
    assert result["fixed"][2][8:12] == ".00."
    assert result["walking"] == [True, False, True, True]
    freed = asked(studio, {**drawn, "freed": [[1, sample] for sample in range(1, 19)]})
    assert freed["walking"] == [True] * 4


def test_the_shortest_length_that_works(studio: StudioProcess) -> None:
    shortest = asked(studio, {**TRANSITION, "samples": None})
    assert shortest["status"] == "optimal"
    shorter = asked(studio, {**TRANSITION, "samples": shortest["samples"] - 1})
    assert shorter["status"] == "infeasible"


def test_an_infeasible_transition_is_explained_and_can_be_relaxed(studio: StudioProcess) -> None:
    result = asked(studio, {**TRANSITION, "samples": 6})
    assert result["status"] == "infeasible"
    assert result["patterns"] == []
    assert "feet are down" in result["explanation"][0]
    change = next(one for one in result["relaxations"] if one["rule"] == "feet_down")
    again = asked(studio, {**TRANSITION, "samples": 6, "rules": {"feet_down": change["value"]}})
    assert again["status"] == "optimal"


def test_a_gait_of_some_limbs_walks(studio: StudioProcess) -> None:
    result = asked(studio, {**SOME, "rules": {"balance": 0.003}})
    assert result["status"] == "optimal"
    feet = result["patterns"][0]["feet"]
    assert (feet[2], feet[5]) == ("0" * 20, "0" * 20)
    use = {"question": SOME, "feet": feet, "name": "Four of six"}
    plan = studio.ask("POST", "/api/patterns/plan", use).content
    assert plan["source"] == "live"
    assert plan["live"]["status"] == "solved", plan["live"]["explanation"]
    made = studio.ask("POST", "/api/patterns/gait", use).content
    assert made["document"]["held"] == {"start": [3, 6], "end": [3, 6]}
    assert "limb 3 held up; limb 6 broken" in made["document"]["notes"].lower()


def test_a_drawing_is_completed_and_nothing_is_saved(studio: StudioProcess) -> None:
    document = studio.ask("GET", "/api/gaits/walk").content
    rows = ["1" * 20, "1" * 20, "1" * 20, "1111" + "0" * 4 + "1" * 12]
    document["timeline"] = {
        "sample_time": 0.4,
        "feet": rows,
        "locked": ["0" * 20] * 3 + ["0" * 4 + "1" * 4 + "0" * 12],
    }
    question = {"kind": "drawing", "gait": "walk", "document": document}
    result = asked(studio, question)
    assert result["status"] == "optimal"
    feet = result["patterns"][0]["feet"]
    assert feet[3][4:8] == "0000"
    done = studio.ask("POST", "/api/patterns/document", {"question": question, "feet": feet}).content[
        "document"
    ]
    assert done["timeline"]["feet"] == feet
    assert studio.ask("GET", "/api/gaits/walk").content["timeline"]["feet"] != feet


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"samples": 1}, "2 to 240 samples"),
        ({"samples": -5}, "2 to 240 samples"),
        ({"samples": 10**12}, "2 to 240 samples"),
        ({"samples": None, "to": "hexapod-tripod", "walkable": True}, "different robots"),
        ({"sample": 99}, "sample 100 of “Walk 10 mm”; it must be 1 to 45"),
        ({"to": "s-gait"}, "differ in orientation"),
        ({"to": "hexapod-tripod"}, "different robots"),
        ({"locked": [9]}, "no limb 10"),
        ({"cells": [[0, 25, 1]]}, "Free that cell"),
        ({"cells": [[0, 0, 0]]}, "Unlock that cell"),
        ({"drawing": ["1", "1"]}, "2 rows"),
        ({"rules": {"feet_down": -1}}, "feet_down"),
        ({"rules": {"balance": 0.5}}, "between −50 and 50 mm"),
        ({"rules": {"speed": 1}}, "speed"),
        ({"weights": {"drawing": -1}}, "weight drawing"),
        ({"kind": "trot"}, "kind"),
    ],
)
def test_what_does_not_fit_is_refused_with_a_sentence(
    studio: StudioProcess, change: dict[str, Any], words: str
) -> None:
    answer = refused(studio, {**TRANSITION, **change})
    assert words in answer.content["error"]
    assert answer.content["where"]


def test_unknown_gaits_and_searches_are_not_found(studio: StudioProcess) -> None:
    refused(studio, {**TRANSITION, "to": "nobody"}, 404)
    assert studio.ask("GET", "/api/patterns/7").status == 404
    assert studio.ask("DELETE", "/api/patterns/7").status == 404
    assert studio.ask("POST", "/api/patterns/7/use").status == 404


def test_a_pattern_that_is_of_another_question_makes_no_gait(studio: StudioProcess) -> None:
    use = {"question": {**TRANSITION, "sample": 12}, "feet": ["0" * 20] * 4}
    answer = studio.ask("POST", "/api/patterns/gait", use)
    assert answer.status == 422
    assert "Solve it again" in answer.content["error"]
    answer = studio.ask("POST", "/api/patterns/gait", {"question": TRANSITION, "feet": ["1" * 20] * 3})
    assert (answer.status, answer.content["where"]) == (422, "feet")


def test_the_page_that_asks_again_ends_its_own_search_only(studio: StudioProcess) -> None:
    long = {**TRANSITION, "samples": 120, "count": 20, "rules": {"limb_changes": None}, "seconds": 60}
    first = studio.ask("POST", "/api/patterns", long, PAGE).content
    other = studio.ask("POST", "/api/patterns", long, {"X-Footfall-Page": "another-page"}).content
    studio.ask("POST", "/api/patterns", TRANSITION, PAGE)

    def content(search: dict[str, Any]) -> dict[str, Any]:
        found: dict[str, Any] = studio.ask("GET", f"/api/patterns/{search['id']}").content
        return found

    wait_for(lambda: content(first)["state"] == "done", "the older search has ended")
    assert content(first)["result"]["status"] == "cancelled"
    studio.ask("DELETE", f"/api/patterns/{other['id']}")
    wait_for(lambda: content(other)["state"] == "done", "the other page's search has ended")


def test_the_routes_are_described(studio: StudioProcess) -> None:
    paths = studio.ask("GET", "/openapi.json").content["paths"]
    for path in ("", "/{number}", "/{number}/use", "/gait", "/document", "/plan"):
        assert f"/api/patterns{path}" in paths
    body = paths["/api/patterns"]["post"]["requestBody"]["content"]["application/json"]["schema"]
    assert len(body["oneOf"]) == 3
