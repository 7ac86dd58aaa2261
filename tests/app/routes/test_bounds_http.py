"""Numbers and days beyond what can be stored or computed are refused, and name their field."""

from __future__ import annotations

from typing import Any

import pytest

from tests.support.studio_process import StudioProcess


@pytest.fixture(scope="module")
def studio(lent_studio: StudioProcess) -> StudioProcess:
    return lent_studio


@pytest.mark.parametrize("number", [2**63, 2**70])
@pytest.mark.parametrize(
    ("method", "path", "content", "field"),
    [
        ("GET", "/api/runs?offset={}", None, "offset"),
        ("GET", "/api/setups/none?revision={}", None, "revision"),
        ("PUT", "/api/setups/none", {"revision": "{}", "setup": {"name": "a"}}, "revision"),
        ("PUT", "/api/trials/none", {"revision": "{}"}, "revision"),
        ("POST", "/api/learning/sets/delete", {"name": "a", "version": "{}"}, "version"),
        ("POST", "/api/learning/sets/restore", {"name": "a", "version": "{}"}, "version"),
    ],
)
def test_a_number_that_cannot_be_stored_is_refused(
    studio: StudioProcess, method: str, path: str, content: dict[str, Any] | None, field: str, number: int
) -> None:
    body = (
        None
        if content is None
        else {key: number if value == "{}" else value for key, value in content.items()}
    )
    answer = studio.ask(method, path.format(number), body)
    assert (answer.status, answer.content["where"].split(".")[-1]) == (422, field), answer


@pytest.mark.parametrize(
    ("query", "count"),
    [
        ("since=0001-01-01", 0),
        ("since=9999-12-31", 0),
        ("until=0001-01-01", 0),
        ("until=9999-12-31", 0),
        ("since=0001-01-01&until=9999-12-31", 0),
    ],
)
def test_runs_of_the_first_and_the_last_day_can_be_asked_for(
    studio: StudioProcess, query: str, count: int
) -> None:
    answer = studio.ask("GET", f"/api/runs?gait=none&{query}")
    assert (answer.status, len(answer.content["runs"])) == (200, count)


@pytest.mark.parametrize("field", ["x", "y", "heading"])
def test_a_ghost_beyond_the_scene_is_refused(studio: StudioProcess, field: str) -> None:
    target = {"steps": [], "from_mm": [5.5] * 12, field: 1e300}
    answer = studio.ask("POST", "/api/robot/jog/ghost", target)
    assert (answer.status, answer.content["where"]) == (422, f"body.{field}")
