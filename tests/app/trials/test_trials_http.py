"""Trials by HTTP: a track beside the gait's plan, refusals that name the field."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest

from core.trials.track_csv import format_track_csv
from tests.core.trials.tracks import stepping_track
from tests.studio_process import StudioProcess, running_studio

CSV = format_track_csv(stepping_track((0.0085, 0.0085), 1))
TRIAL: dict[str, Any] = {"name": "on glass", "csv": CSV, "expected_cm": 1.0}


@pytest.fixture(scope="module")
def studio(tmp_path_factory: pytest.TempPathFactory) -> Iterator[StudioProcess]:
    with running_studio(tmp_path_factory.mktemp("data")) as running:
        yield running


def test_a_trial_is_kept_beside_its_gaits_plan_and_can_be_changed(studio: StudioProcess) -> None:
    answer = studio.ask("POST", "/api/trials", {**TRIAL, "gait": "walk"})
    assert answer.status == 201
    trial = answer.content
    assert trial["gait_name"] == "Walk 10 mm"
    assert trial["figures"]["net_distance"] == pytest.approx(1.2, abs=0.02)
    assert trial["plan"]["figures"]["net_distance"] == pytest.approx(1.0, abs=0.01)
    path = f"/api/trials/{trial['id']}"
    assert studio.ask("PUT", path, {"note": "new tape"}).content["note"] == "new tape"
    assert [line["id"] for line in studio.ask("GET", "/api/trials").content["trials"]] == [trial["id"]]
    assert studio.ask("DELETE", path).status == 200
    assert studio.ask("GET", "/api/trials").content["trials"] == []
    assert studio.ask("POST", f"{path}/restore").content["note"] == "new tape"


@pytest.mark.parametrize(
    ("changes", "status", "words"),
    [
        ({"csv": "X\n"}, 422, "line 1: the header"),
        ({"expected_cm": 0.0}, 422, "expected_cm"),
        ({"iterations": 40}, 422, "too few for 40 iterations"),
        ({"gait": "none"}, 404, "none"),
        ({"run": "none"}, 404, "none"),
    ],
)
def test_what_cannot_be_kept_is_refused_with_a_sentence(
    studio: StudioProcess, changes: dict[str, Any], status: int, words: str
) -> None:
    answer = studio.ask("POST", "/api/trials", {**TRIAL, **changes})
    assert answer.status == status
    assert words in answer.content["error"]


def test_an_unknown_trial_is_not_found(studio: StudioProcess) -> None:
    assert studio.ask("GET", "/api/trials/none").status == 404
