"""Runs of atlases over HTTP. Their workers run only while a core is free, so these tests run alone."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest

from tests.support.studio_process import StudioProcess, running_studio, wait_for

pytestmark = [pytest.mark.heavy, pytest.mark.alone]

MANY = 100_000


@pytest.fixture(scope="module")
def studio(tmp_path_factory: pytest.TempPathFactory) -> Iterator[StudioProcess]:
    with running_studio(tmp_path_factory.mktemp("data")) as running:
        yield running


def job_of(studio: StudioProcess, job: str) -> dict[str, Any]:
    content: dict[str, Any] = studio.ask("GET", f"/api/jobs/{job}").content
    return content


def test_an_atlas_is_made_by_a_job(studio: StudioProcess) -> None:
    asked = {"name": "small", "count": 24, "robot": "deltawalker", "seed": 7}
    answer = studio.ask("POST", "/api/atlases", asked)
    assert (answer.status, answer.content["kind"], answer.content["atlas"]) == (202, "atlas", "small")
    job = answer.content["id"]
    wait_for(lambda: job_of(studio, job)["state"] == "done", "the atlas is made", 120.0)
    made = studio.ask("GET", "/api/atlases/small").content
    assert (made["gaits"], made["seed"]) == (24, 7)


def test_a_run_tells_how_far_it_is_is_cancelled_and_goes_on(studio: StudioProcess) -> None:
    job = studio.ask("POST", "/api/atlases", {"name": "large", "count": MANY}).content["id"]
    second = studio.ask("POST", "/api/atlases", {"name": "other", "count": 10})
    assert (second.status, "cancel the job in Jobs" in second.content["error"]) == (409, True)
    assert studio.ask("POST", "/api/atlases", {"name": "../x"}).status == 422
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
