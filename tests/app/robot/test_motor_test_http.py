"""The guided motor test over HTTP: begun, followed, ended early, stopped, and refused with a sentence."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest

from tests.support.studio_process import Answer, StudioProcess, running_studio, wait_for

LONG = 90.0
ADA = {"X-Footfall-Page": "page-a", "X-Footfall-Name": "Ada"}
GRACE = {"X-Footfall-Page": "page-g", "X-Footfall-Name": "Grace"}
WAY = "/api/robot/motor-test"


@pytest.fixture(scope="module")
def studio(tmp_path_factory: pytest.TempPathFactory) -> Iterator[StudioProcess]:
    with running_studio(tmp_path_factory.mktemp("data")) as running:
        yield running


@pytest.fixture
def armed(studio: StudioProcess) -> Iterator[StudioProcess]:
    """A connected robot that Ada armed; disconnected afterwards."""
    assert studio.ask("POST", "/api/robot/connect", None, ADA).status == 200
    wait_for(lambda: studio.robot()["robot"] == "disarmed", "the robot is up", LONG)
    assert studio.ask("POST", "/api/robot/arm", None, ADA).status == 200
    yield studio
    studio.ask("POST", "/api/robot/disconnect", None, ADA)
    wait_for(lambda: studio.robot()["link"] == "disconnected", "the line is closed", LONG)


def begin(studio: StudioProcess, who: dict[str, str] = ADA, **content: Any) -> Answer:
    return studio.ask("POST", WAY, content, who)


def shown(studio: StudioProcess) -> dict[str, Any]:
    content: dict[str, Any] = studio.ask("GET", WAY).content
    return content


def test_a_robot_that_is_not_armed_is_not_tested(studio: StudioProcess) -> None:
    refused = begin(studio)
    assert refused.status == 409
    assert "Connect it" in refused.content["error"]
    assert shown(studio)["state"] is None
    assert studio.robot()["lease"]["page"] is None


@pytest.mark.parametrize(
    ("robot", "status", "sentence"),
    [
        ("deltawalker9", 409, "cannot drive this robot, so it cannot test its motors"),
        ("deltawalker5", 409, "cannot drive this robot, so it cannot test its motors"),
        ("nobody", 422, "There is no robot “nobody”"),
    ],
)
def test_a_robot_that_no_cable_leads_to_is_refused(
    studio: StudioProcess, robot: str, status: int, sentence: str
) -> None:
    refused = begin(studio, robot=robot)
    assert (refused.status, sentence in refused.content["error"]) == (status, True), refused.content


def test_the_answer_has_its_schema_and_an_unknown_field_is_refused(studio: StudioProcess) -> None:
    ways = studio.ask("GET", "/openapi.json").content["paths"]
    for way, method in ((WAY, "get"), (WAY, "post"), (f"{WAY}/cancel", "post")):
        schema = ways[way][method]["responses"]["200"]["content"]["application/json"]["schema"]
        assert schema == {"$ref": "#/components/schemas/MotorTestView"}
    assert begin(studio, robots="deltawalker").status == 422


def test_nobody_else_begins_it_and_anybody_ends_it_early(armed: StudioProcess) -> None:
    refused = begin(armed, GRACE)
    assert (refused.status, "Ada is in control" in refused.content["error"]) == (409, True)
    armed.ask("POST", "/api/robot/fault", {"name": "stuck-motor", "motors": [1]})
    begun = begin(armed)
    assert (begun.status, begun.content["state"], begun.content["by"]) == (200, "running", "Ada")
    assert begun.content["motor"] == 1
    assert begin(armed).status == 409
    wait_for(lambda: shown(armed)["findings"], "the first motor was tested", LONG)
    assert armed.ask("POST", f"{WAY}/cancel", None, GRACE).status == 200
    wait_for(lambda: shown(armed)["state"] == "cancelled", "the test is over", LONG)
    wait_for(lambda: armed.robot()["robot"] == "armed", "the robot is armed", LONG)
    first = shown(armed)["findings"][0]
    assert (first["motor"], first["foot"], first["verdict"]) == (1, 1, "no answer")
    assert first["remedy"]
    assert shown(armed)["sentence"].startswith("The motor test was ended early. ")
    again = armed.ask("POST", f"{WAY}/cancel", None, ADA)
    assert (again.status, again.content["error"]) == (409, "No motor test is on.")


def test_stop_ends_it_whoever_presses_it(armed: StudioProcess) -> None:
    assert begin(armed).status == 200
    assert armed.robot()["stop_seconds"] < 2.0
    assert armed.ask("POST", "/api/robot/stop?by=Grace", None, GRACE).status == 200
    wait_for(lambda: armed.robot()["robot"] == "stopped", "the robot is stopped", LONG)
    assert shown(armed)["state"] == "stopped"
