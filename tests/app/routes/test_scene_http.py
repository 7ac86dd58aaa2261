"""Ghosts and reach over HTTP."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from tests.support.studio_process import StudioProcess, running_studio


@pytest.fixture(scope="module")
def studio(tmp_path_factory: pytest.TempPathFactory) -> Iterator[StudioProcess]:
    data: Path = tmp_path_factory.mktemp("data")
    with running_studio(data) as running:
        yield running


def header(blob: bytes) -> dict[str, Any]:
    content: dict[str, Any] = json.loads(blob[4 : 4 + int.from_bytes(blob[:4], "little")])
    return content


def span(blob: bytes) -> float:
    """Duration of a blob of poses, s."""
    head = header(blob)
    return float(head["step"] * (head["frames"] - 1))


def test_a_gait_that_was_never_changed_has_no_version_before(studio: StudioProcess) -> None:
    answer = studio.ask("GET", "/api/gaits/amble/ghost?of=before")
    assert answer.status == 409
    assert "was not changed yet" in answer.content["error"]
    assert not studio.ask("GET", "/api/gaits/amble/view").content["changed"]


def test_ghosts_are_of_the_versions_that_they_name(studio: StudioProcess) -> None:
    lasting = {}
    for phase_knots in (5, 6, 7):
        body = {"order": [3, 2, 4, 1], "phase_knots": phase_knots, "closing_knots": 5}
        assert studio.ask("POST", "/api/gaits/walk/redraw", body).status == 200
        lasting[phase_knots] = studio.ask("GET", "/api/gaits/walk/view").content["plan"]["duration"]
    ghosts = {of: studio.blob(f"/api/gaits/walk/ghost?of={of}") for of in ("saved", "before", "present")}
    expected = {"saved": lasting[5], "before": lasting[6], "present": lasting[7]}
    for of, blob in ghosts.items():
        assert span(blob) == pytest.approx(expected[of]), of
        assert len(header(blob)["overlay"]["lines"]) == len(header(blob)["nodes"]) == 17


@pytest.mark.parametrize(("query", "word"), [("of=tomorrow", "of"), ("", "of")])
def test_a_version_that_is_none_is_refused(studio: StudioProcess, query: str, word: str) -> None:
    answer = studio.ask("GET", f"/api/gaits/walk/ghost?{query}")
    assert answer.status == 422
    assert word in answer.content["error"]


def test_reach_is_of_a_plan_that_is_known(studio: StudioProcess) -> None:
    plan = studio.ask("GET", "/api/gaits/s-gait/view").content["plan"]
    path = f"/api/gaits/s-gait/reach?plan={plan['hash']}&workspace="
    stroke, cylinder = (studio.ask("GET", path + name).content for name in ("stroke", "cylinder"))
    assert len(stroke["planes"]) == len(stroke["radii"]) == len(plan["times"])
    assert stroke["radii"] != cylinder["radii"]
    assert studio.ask("GET", path + "box").status == 422
    assert studio.ask("GET", "/api/gaits/s-gait/reach?plan=0&workspace=stroke").status == 409
