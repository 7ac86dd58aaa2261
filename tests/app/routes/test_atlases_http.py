"""Atlases over HTTP: a job that makes one, its list, its front, its files, deleting, bad input."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from tests.support.studio_process import StudioProcess, running_studio, wait_for

MANY = 100_000


@pytest.fixture(scope="module")
def data(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("data")


@pytest.fixture(scope="module")
def studio(data: Path) -> Iterator[StudioProcess]:
    with running_studio(data) as running:
        yield running


@pytest.fixture(scope="module")
def made(studio: StudioProcess) -> str:
    """Name of a small atlas that is done."""
    answer = studio.ask(
        "POST", "/api/atlases", {"name": "small", "count": 24, "robot": "deltawalker", "seed": 7}
    )
    assert (answer.status, answer.content["kind"], answer.content["atlas"]) == (202, "atlas", "small")
    job = answer.content["id"]
    wait_for(lambda: job_of(studio, job)["state"] == "done", "the atlas is made", 120.0)
    return "small"


def job_of(studio: StudioProcess, job: str) -> dict[str, Any]:
    content: dict[str, Any] = studio.ask("GET", f"/api/jobs/{job}").content
    return content


def test_an_atlas_that_is_made_is_listed_with_what_it_has(studio: StudioProcess, made: str) -> None:
    listed = {one["name"]: one for one in studio.ask("GET", "/api/atlases").content["atlases"]}
    one = listed[made]
    assert (one["robot"], one["kind"], one["seed"], one["gaits"]) == ("deltawalker", "fast", 7, 24)
    assert one["solved"] + one["infeasible"] + one["failed"] == 24
    assert 0.0 < one["fastest"] < 0.004
    assert not one["robot_changed"]
    assert one == studio.ask("GET", f"/api/atlases/{made}").content


def test_its_front_and_files_have_its_gaits(studio: StudioProcess, made: str) -> None:
    front = studio.ask("GET", f"/api/atlases/{made}/front").content["front"]
    assert [row["speed"] for row in front] == sorted((row["speed"] for row in front), reverse=True)
    table = studio.text(f"/api/atlases/{made}/export?format=csv")
    assert len(table.splitlines()) == 1 + 24
    page = studio.text(f"/api/atlases/{made}/map")
    assert page == studio.text(f"/api/atlases/{made}/export?format=html")
    assert "<html" in page


def test_a_run_tells_how_far_it_is_is_cancelled_and_goes_on(studio: StudioProcess) -> None:
    job = studio.ask("POST", "/api/atlases", {"name": "large", "count": MANY}).content["id"]
    second = studio.ask("POST", "/api/atlases", {"name": "other", "count": 10})
    assert (second.status, "cancel it in Jobs" in second.content["error"]) == (409, True)
    refused = studio.ask("DELETE", "/api/atlases/large")
    assert (refused.status, "Cancel it in Jobs" in refused.content["error"]) == (409, True)
    wait_for(lambda: job_of(studio, job)["done"] >= 400, "a chunk is done", 120.0)
    known = job_of(studio, job)
    assert (known["state"], known["count"]) == ("running", MANY)
    assert "of 100,000 gaits" in known["sentence"]
    assert "left" in known["sentence"]
    studio.ask("DELETE", f"/api/jobs/{job}")
    wait_for(lambda: job_of(studio, job)["state"] == "cancelled", "the run has ended", 60.0)
    kept = studio.ask("GET", "/api/atlases/large").content["gaits"]
    assert kept >= 400
    again = studio.ask("POST", "/api/atlases", {"name": "large", "count": kept}).content["id"]
    wait_for(lambda: job_of(studio, again)["state"] == "done", "nothing was left to do", 60.0)
    assert studio.ask("GET", "/api/atlases/large").content["gaits"] == kept


def test_an_atlas_is_deleted_and_brought_back(studio: StudioProcess, made: str) -> None:
    before = studio.ask("GET", f"/api/atlases/{made}").content
    assert studio.ask("DELETE", f"/api/atlases/{made}").status == 200
    assert studio.ask("GET", f"/api/atlases/{made}").status == 404
    assert studio.ask("POST", f"/api/atlases/{made}/restore").content == before
    again = studio.ask("POST", f"/api/atlases/{made}/restore")
    assert (again.status, "No atlas" in again.content["error"]) == (404, True)


@pytest.mark.parametrize(
    ("body", "words"),
    [
        ({"name": ""}, "name"),
        ({"name": "../x"}, "letters, digits"),
        ({"name": "x", "count": 0}, "count"),
        ({"name": "x", "robot": "nobody"}, "nobody"),
        ({"name": "x", "space": "[vary]\nsped = [1, 2]"}, "sped"),
        ({"name": "x", "space": "robot = 'deltawalker'\n[vary]\nstep_x = [0.02, 0.01]"}, "step_x"),
        ({"name": "small", "robot": "deltawalker", "seed": 8}, "another space"),
    ],
)
def test_bad_input_is_refused_with_a_sentence(
    studio: StudioProcess, made: str, body: dict[str, Any], words: str
) -> None:
    answer = studio.ask("POST", "/api/atlases", body)
    assert answer.status == 422
    assert words in answer.content["error"]
    assert studio.ask("GET", "/api/atlases/x").status == 404


def test_a_file_that_is_no_atlas_is_listed_with_what_is_wrong(
    studio: StudioProcess, data: Path, made: str
) -> None:
    (data / "atlases" / "broken.sqlite").write_text("nothing of the kind, and no header " * 9)
    listed = {one["name"]: one for one in studio.ask("GET", "/api/atlases").content["atlases"]}
    assert "is no atlas" in listed["broken"]["trouble"]
    assert listed[made]["gaits"] == 24
    assert studio.ask("GET", "/api/atlases/broken/front").status == 422
