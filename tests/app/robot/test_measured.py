"""The robot by its measured strokes, as the 3D view shows it while a run is on."""

from __future__ import annotations

import struct

import pytest

from app.emulator.emulated_robot import EmulatedRobot
from tests.support.studio_process import StudioProcess, wait_for

SPEED = 5.0


@pytest.mark.heavy
def test_the_measured_robot_is_there_while_a_run_is_on(studio: StudioProcess, robot: EmulatedRobot) -> None:
    refused = studio.ask("GET", "/api/robot/poses")
    assert refused.status == 409
    assert "No run of a gait is on" in refused.content["error"]
    studio.ask("POST", "/api/gaits/walk/check")
    assert studio.ask("POST", "/api/gaits/walk/approve", {"by": "Ada", "accept_warnings": True}).status == 200
    assert studio.ask("POST", "/api/robot/connect").status == 200
    wait_for(lambda: studio.robot()["robot"] == "disarmed", "the robot is up")
    assert studio.ask("POST", "/api/robot/arm", {"by": "Ada"}).status == 200
    assert studio.ask("POST", "/api/robot/send", {"gait": "walk", "by": "Ada"}).status == 200
    wait_for(lambda: (studio.robot()["run"] or {}).get("reached", 0) > 2, "the robot walks", 60)
    run = studio.robot()["run"]
    assert 0 < run["seconds_left"] < studio.ask("GET", "/api/gaits/walk/run").content["estimated_seconds"]
    measured = studio.blob("/api/robot/poses")
    plan = studio.ask("GET", "/api/gaits/walk/view").content["plan"]["hash"]
    planned = studio.blob(f"/api/gaits/walk/poses?plan={plan}")
    assert nodes(measured) == nodes(planned)
    assert studio.ask("POST", "/api/robot/stop").status == 200


def nodes(blob: bytes) -> str:
    """The names of a blob's nodes, as its header has them."""
    (length,) = struct.unpack_from("<I", blob)
    header = blob[4 : 4 + length].decode()
    return header[header.index('"nodes"') : header.index("]", header.index('"nodes"'))]
