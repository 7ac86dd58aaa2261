"""Simulations over HTTP: asked for by gait, watched as jobs, kept, gone stale with an edit, and refused."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

import pytest

from tests.support.studio_process import StudioProcess, running_studio, wait_for

GAIT = "walk-manual-0"
LONG = 120.0


@pytest.fixture(scope="module")
def studio(tmp_path_factory: pytest.TempPathFactory) -> Iterator[StudioProcess]:
    with running_studio(tmp_path_factory.mktemp("data")) as running:
        yield running


def submitted(studio: StudioProcess, **more: Any) -> str:
    answer = studio.ask("POST", "/api/jobs", {"kind": "simulate", "gait": GAIT, **more})
    assert answer.status == 202
    job_id: str = answer.content["id"]
    return job_id


def job_of(studio: StudioProcess, job_id: str) -> dict[str, Any]:
    content: dict[str, Any] = studio.ask("GET", f"/api/jobs/{job_id}").content
    return content


def waited(studio: StudioProcess, job_id: str, state: str) -> dict[str, Any]:
    wait_for(lambda: job_of(studio, job_id)["state"] == state, f"the simulation is {state}", LONG)
    return job_of(studio, job_id)


def standing(studio: StudioProcess) -> dict[str, Any]:
    content: dict[str, Any] = studio.ask("GET", f"/api/gaits/{GAIT}/view").content["simulation"]
    return content


@pytest.fixture(scope="module")
def job(studio: StudioProcess) -> dict[str, Any]:
    """A simulation with two variations that is done."""
    return waited(studio, submitted(studio, variations=2), "done")


@pytest.mark.heavy
def test_a_simulation_has_the_figures_of_the_command(job: dict[str, Any]) -> None:
    assert (job["kind"], job["share"], job["fresh"]) == ("simulate", 1.0, True)
    assert len(job["result"]["mean_error"]["feet"]) == 4
    assert job["result"]["fell"] is False


@pytest.mark.heavy
def test_the_kept_simulation_lies_on_the_plans_time_axis(studio: StudioProcess, job: dict[str, Any]) -> None:
    simulation = studio.ask("GET", f"/api/simulations/{job['motion']}").content
    plan = studio.ask("GET", f"/api/gaits/{GAIT}/view").content["plan"]
    motion = simulation["motion"]
    assert simulation["waypoints_hash"] == plan["waypoints_hash"]
    assert motion["times"][-1] == pytest.approx(plan["duration"])
    assert motion["times"] == sorted(motion["times"])
    rows = ("body", "attitude", "feet", "contact", "strokes_mm", "margins_mm", "robot_times")
    assert {len(motion[row]) for row in rows} == {len(motion["times"])}
    assert [one["walks"] for one in simulation["variations"]["runs"]].count(True) == pytest.approx(
        2 * simulation["variations"]["share"]
    )


def test_the_simulated_robot_comes_as_a_ghost(studio: StudioProcess, job: dict[str, Any]) -> None:
    blob = studio.blob(f"/api/simulations/{job['motion']}/ghost")
    length = int.from_bytes(blob[:4], "little")
    header = json.loads(blob[4 : 4 + length])
    assert header["format"] == "footfall-poses"
    assert len(header["overlay"]["contacts"]) == header["frames"]


def test_an_edit_makes_a_simulation_stale_and_undo_brings_it_back(
    studio: StudioProcess, job: dict[str, Any]
) -> None:
    document = studio.ask("GET", f"/api/gaits/{GAIT}").content
    document["step"] = [0.9 * value for value in document["step"]]
    assert studio.ask("PUT", f"/api/gaits/{GAIT}", document).status == 200
    assert standing(studio) | {"fresh": False} == standing(studio)
    assert job_of(studio, job["id"])["fresh"] is False
    assert studio.ask("POST", f"/api/gaits/{GAIT}/undo").status == 200
    assert standing(studio)["fresh"] is True
    assert standing(studio)["key"] == job["motion"]


def test_a_cancelled_simulation_ends(studio: StudioProcess, job: dict[str, Any]) -> None:
    job_id = submitted(studio, variations=256)
    again = studio.ask("POST", "/api/jobs", {"kind": "simulate", "gait": GAIT})
    assert again.status == 409
    assert "is being simulated" in again.content["error"]
    assert studio.ask("DELETE", f"/api/jobs/{job_id}").content["state"] == "cancelling"
    assert waited(studio, job_id, "cancelled")["result"] is None
    assert standing(studio)["key"] == job["motion"]


@pytest.mark.parametrize(
    ("request_body", "status", "sentence"),
    [
        ({"kind": "simulate", "gait": GAIT, "physics": "moon"}, 422, "no physics set “moon”"),
        ({"kind": "simulate", "gait": GAIT, "variations": 1000}, 422, "variations"),
        ({"kind": "optimise", "gait": GAIT, "variations": 8}, 422, "belong to simulate"),
        ({"kind": "simulate", "gait": "none"}, 404, "no gait “none”"),
    ],
)
def test_what_cannot_be_simulated_is_refused(
    studio: StudioProcess, request_body: dict[str, Any], status: int, sentence: str
) -> None:
    answer = studio.ask("POST", "/api/jobs", request_body)
    assert answer.status == status
    assert sentence in answer.content["error"]


def test_a_gait_that_is_out_of_reach_is_refused_with_its_reason(studio: StudioProcess) -> None:
    document = studio.ask("GET", f"/api/gaits/{GAIT}").content
    document |= {"name": "Too far", "step": [8 * value for value in document["step"]]}
    gait = studio.ask("POST", "/api/gaits", document).content["id"]
    answer = studio.ask("POST", "/api/jobs", {"kind": "simulate", "gait": gait})
    assert answer.status == 409
    assert "cannot reach" in answer.content["error"]


def test_a_robot_that_was_never_weighed_has_the_optimisers_masses(studio: StudioProcess) -> None:
    sets = studio.ask("GET", "/api/simulations/sets?robot=hexapod").content["sets"]
    assert [one["name"] for one in sets] == ["model"]
    assert studio.ask("GET", "/api/simulations/sets?robot=deltawalker").content["sets"][0]["name"] == "scales"
    wrong = {"kind": "simulate", "gait": "hexapod-tripod", "physics": "scales"}
    answer = studio.ask("POST", "/api/jobs", wrong)
    assert answer.status == 422
    assert "has no masses “scales”" in answer.content["error"]
    assert studio.ask("GET", "/api/simulations/sets?robot=spider").status == 422


def test_an_unknown_simulation_is_not_found(studio: StudioProcess) -> None:
    for path in ("/api/simulations/none", "/api/simulations/none/ghost"):
        assert studio.ask("GET", path).status == 404
