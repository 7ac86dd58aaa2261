"""Faults of the emulated robot on request, over HTTP."""

from collections.abc import Iterator

import pytest

from tests.support.studio_process import StudioProcess, running_studio, wait_for

READY_SECONDS = 40.0


@pytest.fixture(scope="module")
def studio(tmp_path_factory: pytest.TempPathFactory) -> Iterator[StudioProcess]:
    with running_studio(tmp_path_factory.mktemp("data")) as running:
        yield running


def test_faults_are_of_the_emulated_robot_while_it_is_connected(studio: StudioProcess) -> None:
    refused = studio.ask("POST", "/api/robot/fault", {"name": "drop"})
    assert refused.status == 409
    assert "Only the emulated robot" in refused.content["error"]


def test_an_unknown_fault_is_refused_with_its_field(studio: StudioProcess) -> None:
    refused = studio.ask("POST", "/api/robot/fault", {"name": "earthquake"})
    assert refused.status == 422
    assert "name" in str(refused.content)


@pytest.mark.heavy
def test_a_fault_strikes_what_lasts_is_mended_and_unplugging_loses_the_link(studio: StudioProcess) -> None:
    assert studio.ask("POST", "/api/robot/connect").status == 200
    wait_for(lambda: studio.robot()["robot"] == "disarmed", "the robot is up", READY_SECONDS)
    for name in ("split", "noise", "none", "unplug"):
        answer = studio.ask("POST", "/api/robot/fault", {"name": name})
        assert answer.status == 200
        assert answer.content["emulated"]
    wait_for(lambda: studio.robot()["link"] == "lost", "the line has hung up", READY_SECONDS)
    assert "hung up" in studio.robot()["sentence"]


@pytest.mark.parametrize("device", ["socket://127.0.0.1:9?logging=debug", "socket://nowhere", "loop://"])
def test_an_address_that_is_no_line_is_bad_input(studio: StudioProcess, device: str) -> None:
    answer = studio.ask("POST", "/api/robot/connect", {"device": device})
    assert (answer.status, answer.content["where"]) == (422, "device")
