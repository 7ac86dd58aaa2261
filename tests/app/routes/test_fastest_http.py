"""The fastest gait over HTTP: prices, a search that can be cancelled, a gait made of an answer, bad input."""

from __future__ import annotations

import json
import urllib.request
from collections.abc import Iterator
from typing import Any

import pytest

from tests.support.studio_process import StudioProcess, running_studio, wait_for

ASKED = {"order": [1, 4, 2, 3], "heading": 0.7853981633974483, "stop_bound": 1.5}


@pytest.fixture(scope="module")
def studio(tmp_path_factory: pytest.TempPathFactory) -> Iterator[StudioProcess]:
    with running_studio(tmp_path_factory.mktemp("data")) as running:
        yield running


def lines(studio: StudioProcess, wanted: dict[str, Any]) -> Iterator[dict[str, Any]]:
    address, body = f"{studio.url}api/fastest/prices", json.dumps(wanted).encode()
    request = urllib.request.Request(address, body, {"Content-Type": "application/json"})
    with urllib.request.urlopen(request, timeout=120.0) as answer:
        for line in answer:
            yield json.loads(line)


@pytest.mark.heavy
def test_prices_that_come_with_the_program_are_there_at_once(studio: StudioProcess) -> None:
    first = next(lines(studio, ASKED))
    options = first["options"]
    bounds = {one["value"]: one["price"]["pace"] for one in options if one["group"] == "stop_bound"}
    assert set(bounds) == {1.0, 1.2, 1.5, 2.0}
    # A stop that is heard earlier costs speed.
    assert bounds[1.0] < 0.75 * bounds[1.5]
    assert bounds[1.5] > 0.0030
    orders = [one for one in options if one["group"] == "order"]
    assert len(orders) == 7
    assert all(one["price"]["pace"] > 0.0018 for one in orders)


@pytest.mark.heavy
def test_a_price_that_is_not_known_is_looked_for(studio: StudioProcess) -> None:
    asked = {**ASKED, "step": 0.0123}
    answer = lines(studio, asked)
    options = next(answer)["options"]
    way = next(one for one in options if one["group"] == "course")
    assert way["price"] is None
    found = next(answer)["prices"]
    assert {one["group"] for one in found} >= {"course", "order"}
    assert all(one["price"]["step"] == pytest.approx(0.0123) for one in found)
    assert [options[one["number"]]["value"] for one in found] == [one["value"] for one in found]


@pytest.mark.heavy
def test_a_gait_is_made_and_solves_itself(studio: StudioProcess) -> None:
    made = studio.ask("POST", "/api/fastest/gaits", {**ASKED, "name": "Mine", "cycles": 1, "step": 0.02})
    assert made.status == 201, made.content
    view = made.content
    assert (view["document"]["name"], view["document"]["poses"]["free_step"]) == ("Mine", False)

    def is_solved() -> bool:
        plan = studio.ask("GET", f"/api/gaits/{view['id']}/view").content["plan"]
        return bool(plan["source"] == "poses")

    wait_for(is_solved, "the poses are found", 120.0)


def search_of(studio: StudioProcess, job: str) -> dict[str, Any]:
    content: dict[str, Any] = studio.ask("GET", f"/api/jobs/{job}").content
    return content


@pytest.mark.heavy
def test_one_search_at_a_time_tells_how_far_it_is_and_is_cancelled(studio: StudioProcess) -> None:
    job = studio.ask("POST", "/api/fastest/searches", {**ASKED, "front": True}).content["id"]
    second = studio.ask("POST", "/api/fastest/searches", ASKED)
    assert (second.status, "cancel it in Jobs" in second.content["error"]) == (409, True)
    wait_for(lambda: bool(search_of(studio, job)["tried"]), "a gait was tried", 120.0)
    known = search_of(studio, job)
    assert (known["kind"], known["state"]) == ("fastest", "running")
    assert 0.0 < known["share"] < 1.0
    studio.ask("DELETE", f"/api/jobs/{job}")
    wait_for(lambda: search_of(studio, job)["state"] == "cancelled", "the search has ended", 60.0)
    ended = search_of(studio, job)
    assert (ended["result"], len(ended["tried"]) >= 1) == (None, True)


def searched(studio: StudioProcess, **asked: Any) -> tuple[dict[str, Any], list[dict[str, Any]]]:
    """The result of a search, and what it has tried."""
    job = studio.ask("POST", "/api/fastest/searches", {**ASKED, **asked}).content["id"]
    wait_for(lambda: search_of(studio, job)["state"] == "done", "the search has ended", 900.0)
    ended = search_of(studio, job)
    return ended["result"], ended["tried"]


@pytest.mark.soak
def test_a_search_ranks_every_order(studio: StudioProcess) -> None:
    result, tried = searched(studio)
    assert (result["orders"], result["complete"], result["front"]) == (6, True, [])
    assert max(one["speed"] or 0.0 for one in tried) > 0.0031


@pytest.mark.soak
def test_a_search_finds_its_front(studio: StudioProcess) -> None:
    result, tried = searched(studio, front=True)
    assert (result["orders"], result["complete"], len(tried)) == (6, True, result["front_tried"])
    best = max(one["speed"] or 0.0 for one in tried if one["margin"] == 0.006)
    assert best > 0.0031
    front = result["front"]
    assert [one["speed"] for one in front] == sorted((one["speed"] for one in front), reverse=True)
    assert {one["margin"] for one in front} == {0.003, 0.006, 0.008, 0.01}


@pytest.mark.parametrize(
    ("path", "body", "words"),
    [
        ("prices", {"robot": "nobody"}, "nobody"),
        ("prices", {"order": [1, 2]}, "1 to 4"),
        ("prices", {"margin": 1.0}, "between 0 and 50 mm"),
        ("prices", {"speed": 1.0}, "speed"),
        ("searches", {"stop_bound": 0.0}, "between 0.8 and 10"),
        ("gaits", {"name": ""}, "name"),
        ("gaits", {"name": "x", "sway": 3.0}, "sway"),
        ("gaits", {"name": "x", "cycles": 0}, "cycles"),
    ],
)
def test_bad_input_is_refused_with_a_sentence(
    studio: StudioProcess, path: str, body: dict[str, Any], words: str
) -> None:
    answer = studio.ask("POST", f"/api/fastest/{path}", body)
    assert answer.status == 422
    assert words in answer.content["error"]
