"""Learning by HTTP: refusals name the field, courses and sets are listed."""

from __future__ import annotations

from typing import Any

import pytest

from tests.support.studio_process import StudioProcess


@pytest.fixture(scope="module")
def studio(lent_studio: StudioProcess) -> StudioProcess:
    return lent_studio


@pytest.mark.parametrize(
    ("wanted", "status", "words"),
    [
        ({}, 422, "either trials or a table"),
        ({"trials": ["a"], "table": {"csv": "", "trajectories": {}}}, 422, "either trials or a table"),
        ({"trials": ["none"]}, 404, "no trial none"),
        ({"table": {"csv": "Traj\nTrajAa\n", "trajectories": {}}}, 422, "walk_a.csv"),
        ({"table": {"csv": "", "trajectories": {}, "iterations": 0}}, 422, "iterations"),
        ({"table": {"csv": f"Traj\n{'A' * 200_000}\n", "trajectories": {}}}, 422, "none of TrajAa to TrajDd"),
    ],
)
def test_what_cannot_be_learned_from_is_refused(
    studio: StudioProcess, wanted: dict[str, Any], status: int, words: str
) -> None:
    answer = studio.ask("POST", "/api/learning", wanted)
    assert answer.status == status
    assert words in answer.content["error"]


def test_nothing_is_learned_yet_and_what_there_is_not_is_not_found(studio: StudioProcess) -> None:
    assert studio.ask("GET", "/api/learning").content == {"courses": [], "unreadable": []}
    assert studio.ask("GET", "/api/learning/sets").content == {"sets": [], "unreadable": []}
    assert studio.ask("GET", "/api/learning/none").status == 404
    assert studio.ask("DELETE", "/api/learning/none").status == 404
    assert studio.ask("POST", "/api/learning/none/set", {"name": "Lab floor"}).status == 404
    missing = {"name": "Lab floor", "version": 1}
    assert studio.ask("POST", "/api/learning/sets/delete", missing).status == 404
    assert studio.ask("POST", "/api/learning/sets/restore", {**missing, "version": 0}).status == 422


def test_a_simulation_asked_for_with_an_unknown_set_names_those_there_are(studio: StudioProcess) -> None:
    asked = {"kind": "simulate", "gait": "walk-manual-0", "physics": "Lab floor, version 1"}
    answer = studio.ask("POST", "/api/jobs", asked)
    assert answer.status == 422
    assert "scales, published" in answer.content["error"]
