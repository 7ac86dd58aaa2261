"""The server as a real process: documents, jobs, refusals, restarts and the whole robot's way by HTTP."""

from __future__ import annotations

import json
import socket
import sqlite3
from pathlib import Path
from typing import Any

import pytest

from app.bridge.delivery import ARRIVAL_MM
from app.emulator.emulated_robot import EmulatedRobot
from tests.support.patience import patient_robot
from tests.support.studio_process import StudioProcess, footfall, running_studio, wait_for

SPEED = 15.0
"""Seconds of the emulated robot in a second."""


def optimised(studio: StudioProcess, gait: str) -> dict[str, Any]:
    job_id = studio.ask("POST", "/api/jobs", {"kind": "optimise", "gait": gait}).content["id"]

    def ended() -> bool:
        return studio.ask("GET", f"/api/jobs/{job_id}").content["ended"] is not None

    wait_for(ended, "the job ended")
    job: dict[str, Any] = studio.ask("GET", f"/api/jobs/{job_id}").content
    return job


def test_the_page_the_api_and_its_description_are_served(studio: StudioProcess) -> None:
    assert studio.ask("GET", "/api/health").content["status"] == "ok"
    paths = studio.ask("GET", "/openapi.json").content["paths"]
    assert studio.ask("GET", "/api/schema/gait").content["title"] == "GaitDocument"
    assert {"/api/gaits", "/api/jobs", "/api/robot/stop", "/api/gaits/{gait_id}/approve"} <= set(paths)


def test_a_document_can_be_read_changed_and_put_back(studio: StudioProcess) -> None:
    document = studio.ask("GET", "/api/gaits/amble").content
    document["step"] = [0.006, 0.006, 0.0]
    view = studio.ask("PUT", "/api/gaits/amble?label=Shorter%20step", document).content
    assert view["undo"] == "Shorter step"
    assert view["edited"]
    assert studio.ask("PUT", "/api/gaits/amble?revision=1", document | {"notes": "x"}).status == 409
    assert studio.ask("POST", "/api/gaits/amble/undo").content["edited"] is False


def test_a_gait_for_six_legs_is_drawn_too(studio: StudioProcess) -> None:
    document = studio.ask("GET", "/api/gaits/walk").content
    rows = ["1" * 40] * 6
    rows[1] = "1" * 10 + "0" * 5 + "1" * 25
    document |= {"name": "Six", "robot": "hexapod", "order": [1, 2, 3, 4, 5, 6], "step": [0.0, 0.0, 0.0]}
    document["timeline"] = {"sample_time": 0.4, "feet": rows}
    view = studio.ask("POST", "/api/gaits", document).content
    assert view["plan"]["refusal"] is None
    assert len(view["plan"]["strokes_mm"][0]) == 18
    poses = studio.blob(f"/api/gaits/{view['id']}/poses?plan={view['plan']['hash']}")
    assert len(poses) > 100_000
    assert optimised(studio, view["id"])["state"] == "done"


@pytest.mark.parametrize(
    ("method", "path", "body", "status", "sentence"),
    [
        ("GET", "/api/gaits/nope", None, 404, "no gait “nope”"),
        ("PUT", "/api/gaits/walk", {"format": "other"}, 422, "footfall-gait"),
        ("PUT", "/api/gaits/walk", b"{", 422, "is not JSON"),
        ("PUT", "/api/gaits/walk", b'{"format":"footfall-gait","version":9}', 422, "version 9"),
        ("POST", "/api/jobs", {"kind": "hop", "gait": "walk"}, 422, "kind"),
        ("POST", "/api/jobs", {"kind": "optimise", "gait": "walk-manual-0"}, 409, "made by hand"),
        ("DELETE", "/api/jobs/nope", None, 404, "no job"),
        ("POST", "/api/gaits/walk/approve", {"by": "Ada"}, 409, "Check this gait first"),
        ("POST", "/api/robot/arm", None, 409, "onnect"),
        ("POST", "/api/robot/send", {"gait": "walk"}, 409, "not approved"),
        ("POST", "/api/robot/connect", {"device": "/dev/none"}, 409, "/dev/none"),
    ],
)
def test_what_cannot_be_done_gets_a_status_and_a_sentence(
    studio: StudioProcess, method: str, path: str, body: Any, status: int, sentence: str
) -> None:
    answer = studio.ask(method, path, body)
    if path.endswith("connect"):
        status = 503
    assert (answer.status, sentence in answer.content["error"]) == (status, True), answer


def test_a_foreign_page_is_refused(studio: StudioProcess) -> None:
    assert studio.ask("POST", "/api/robot/stop", headers={"Origin": "http://evil.example"}).status == 403
    assert studio.ask("GET", "/api/health", headers={"Host": "evil.example"}).status == 403


def test_a_gait_goes_all_the_way_and_the_robot_parses_exactly_what_was_approved(
    studio: StudioProcess, robot: EmulatedRobot
) -> None:
    job = optimised(studio, "s-gait")
    assert job["state"] == "done"
    assert job["result"]["max_violation"] < 1e-6
    assert len(job["progress"]) == job["result"]["iterations"] + 1
    assert studio.ask("POST", "/api/gaits/s-gait/check").content["passed"]
    approval = studio.ask("POST", "/api/gaits/s-gait/approve", {"by": "Ada", "accept_warnings": True}).content
    studio.ask("POST", "/api/robot/connect", {"device": robot.device})
    wait_for(lambda: studio.robot()["robot"] == "disarmed", "the robot is up")
    studio.ask("POST", "/api/robot/arm", {"by": "Ada"})
    summary = studio.ask("GET", "/api/gaits/s-gait/run").content
    assert summary["robot_ready"]
    assert summary["waypoints_hash"] == approval["waypoints_hash"]
    plan = studio.ask("GET", "/api/gaits/s-gait/view").content["plan"]
    assert summary["checked_stop_seconds"] == plan["stop_seconds"]
    first = len(robot.firmware.messages)
    studio.ask("POST", "/api/robot/send", {"gait": "s-gait", "by": "Ada"})
    wait_for(lambda: studio.robot()["robot"] in ("done", "fault"), "the run ended", 60)
    assert studio.robot()["robot"] == "done"
    view = studio.ask("GET", "/api/gaits/s-gait/view").content
    messages = [m for m in robot.firmware.messages[first:] if m.strokes_mm is not None]
    # The board keeps numbers in single precision; four decimals come through.
    parsed = [[round(h, 4) for h in m.strokes_mm or ()] for m in messages]
    assert parsed[summary["start_moves"] :] == view["plan"]["waypoint_strokes_mm"]
    assert len(messages) == len(robot.firmware.messages[first:])
    assert all(done.worst_mm <= ARRIVAL_MM for done in robot.firmware.completions)


def test_stop_needs_no_body_latches_and_clears(studio: StudioProcess, robot: EmulatedRobot) -> None:
    wait_for(lambda: studio.robot()["robot"] in ("done", "disarmed"), "the robot stands still")
    studio.ask("POST", "/api/robot/arm", {"by": "Ada"})
    assert studio.ask("POST", "/api/robot/send", {"gait": "s-gait", "by": "Ada"}).status == 200
    wait_for(lambda: (studio.robot()["run"] or {}).get("sent", 0) > 2, "some waypoints are out")
    assert studio.ask("POST", "/api/robot/stop").status == 200
    wait_for(lambda: studio.robot()["robot"] == "stopped", "the robot stands still")
    sent = len(robot.firmware.messages)
    assert studio.ask("POST", "/api/robot/arm", {"by": "Ada"}).status == 409
    assert len(robot.firmware.messages) == sent
    studio.ask("POST", "/api/robot/clear", {"by": "Ada"})
    wait_for(lambda: studio.robot()["robot"] == "disarmed", "the stop is cleared")
    assert studio.ask("POST", "/api/robot/arm", {"by": "Ada"}).content["robot"] == "armed"


def test_stop_waits_for_no_body(studio: StudioProcess) -> None:
    host, port = studio.url.removeprefix("http://").rstrip("/").split(":")
    with socket.create_connection((host, int(port)), timeout=60) as line:
        head = f"POST /api/robot/stop HTTP/1.1\r\nHost: {host}:{port}\r\nContent-Length: 10\r\n\r\n{{"
        line.sendall(head.encode())
        assert line.recv(64).startswith(b"HTTP/1.1 200")


@pytest.mark.heavy
def test_a_job_is_cancelled_and_the_next_one_runs(studio: StudioProcess) -> None:
    document = studio.ask("GET", "/api/gaits/amble").content
    document["step"] = [0.0177, 0.0177, 0.0]
    document["options"]["workspace"] = "cylinder"
    document["iterations"] = 6
    studio.ask("PUT", "/api/gaits/amble?label=Too%20far", document)
    job = studio.ask("POST", "/api/jobs", {"gait": "amble"}).content["id"]
    wait_for(lambda: bool(studio.ask("GET", f"/api/jobs/{job}").content["progress"]), "the job runs")
    studio.ask("DELETE", f"/api/jobs/{job}")
    wait_for(lambda: studio.ask("GET", f"/api/jobs/{job}").content["ended"] is not None, "the job ended")
    cancelled = studio.ask("GET", f"/api/jobs/{job}").content
    assert cancelled["state"] == "cancelled"
    assert cancelled["progress"]
    studio.ask("POST", "/api/gaits/amble/undo")
    assert optimised(studio, "amble")["state"] == "done"


def test_a_refused_connect_leaves_the_robot_its_name(studio: StudioProcess, robot: EmulatedRobot) -> None:
    assert studio.ask("POST", "/api/robot/connect", {"device": "/dev/no-such-robot"}).status in (409, 503)
    assert studio.robot()["device"] == robot.device


def test_a_gait_without_a_standing_foot_leaves_the_page_alive(studio: StudioProcess) -> None:
    document = studio.ask("GET", "/api/gaits/c-gait").content
    feet = document["timeline"]["feet"]
    document["timeline"]["feet"] = [row[:20] + "0" + row[21:] for row in feet]
    view = studio.ask("PUT", "/api/gaits/c-gait?label=Hop", document).content
    assert None in view["plan"]["margin"]
    assert optimised(studio, "c-gait")["state"] in ("infeasible", "failed")
    assert studio.ask("POST", "/api/gaits/c-gait/check").content["passed"] is False
    assert b"Infinity" not in studio.blob("/api/jobs")


@pytest.mark.heavy
def test_the_end_of_the_studio_stops_a_run_first(tmp_path: Path) -> None:
    with (
        patient_robot(4.0, booted=True) as robot,
        running_studio(tmp_path, "--robot", robot.device) as studio,
    ):
        optimised(studio, "walk")
        studio.ask("POST", "/api/gaits/walk/check")
        studio.ask("POST", "/api/gaits/walk/approve", {"by": "Ada", "accept_warnings": True})
        studio.ask("POST", "/api/robot/connect")
        wait_for(lambda: studio.robot()["robot"] == "disarmed", "the robot is up")
        studio.ask("POST", "/api/robot/arm")
        studio.ask("POST", "/api/robot/send", {"gait": "walk"})
        wait_for(lambda: (studio.robot()["run"] or {}).get("sent", 0) > 2, "some waypoints are out")
    assert robot.firmware.messages[-1].payload == "s,1"
    database = sqlite3.connect(tmp_path / "studio.sqlite3")
    first = database.execute(
        "SELECT data FROM run_bytes WHERE direction='to robot' ORDER BY number"
    ).fetchone()
    state = json.loads(database.execute("SELECT content FROM run").fetchone()[0])["state"]
    database.close()
    assert first[0].startswith(b"<p,1,")
    assert state in ("stopping", "stopped", "lost", "fault")


@pytest.mark.heavy
def test_results_edits_and_the_job_list_survive_a_restart(tmp_path: Path) -> None:
    with running_studio(tmp_path) as studio:
        optimised(studio, "walk")
        studio.ask("POST", "/api/gaits/walk/save")
        document = studio.ask("GET", "/api/gaits/c-gait").content
        studio.ask("PUT", "/api/gaits/c-gait?label=Notes", document | {"notes": "kept"})
    assert json.loads((tmp_path / "gaits" / "walk.json").read_text())["format"] == "footfall-gait"
    with running_studio(tmp_path) as studio:
        assert studio.ask("GET", "/api/gaits/walk/view").content["plan"]["source"] == "optimised"
        assert studio.ask("GET", "/api/gaits/c-gait/view").content["undo"] == "Notes"
        job = studio.ask("GET", "/api/jobs").content["jobs"][0]
        assert (job["state"], job["course"]) == ("done", 0)
        gone = studio.ask("GET", f"/api/jobs/{job['id']}/course/0")
        assert gone.status == 409
        assert "not kept any more" in gone.content["error"]


@pytest.mark.heavy
def test_an_approved_live_plan_is_still_approved_after_a_restart(tmp_path: Path) -> None:
    with running_studio(tmp_path) as studio:
        plan = studio.ask("GET", "/api/gaits/walk/view").content["plan"]
        assert plan["source"] == "live"
        assert studio.ask("POST", "/api/gaits/walk/check").content["passed"]
        word = {"by": "Ada", "accept_warnings": True}
        approval = studio.ask("POST", "/api/gaits/walk/approve", word).content
    with running_studio(tmp_path) as studio:
        view = studio.ask("GET", "/api/gaits/walk/view").content
        assert view["plan"]["hash"] == plan["hash"]
        assert view["approval"] == approval
        document = view["document"] | {"step": [0.0069, 0.0069, 0.0]}
        assert studio.ask("PUT", "/api/gaits/walk?label=Step", document).content["approval"] is None
        # What was approved comes back with undo as a plan, and not as an approval.
        undone = studio.ask("POST", "/api/gaits/walk/undo").content
        assert (undone["plan"]["hash"], undone["approval"]) == (plan["hash"], None)


@pytest.mark.heavy
def test_a_busy_port_is_exit_2_and_names_the_option(tmp_path: Path) -> None:
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = taken.getsockname()[1]
        ended = footfall("serve", "--port", str(port), "--data", str(tmp_path), "--no-browser")
    assert ended.returncode == 2
    assert "--port" in ended.stderr
    assert ended.stdout == ""


def test_a_second_studio_on_a_data_folder_is_refused_and_names_the_first(studio: StudioProcess) -> None:
    data = studio.data
    ended = footfall("serve", "--port", "0", "--data", str(data), "--no-browser", "--json")
    answer = json.loads(ended.stdout)
    assert (ended.returncode, answer["where"]) == (2, "--data")
    for word in (f"process {studio.pid}", studio.url, str(data)):
        assert word in answer["error"]
    assert studio.ask("GET", "/api/health").status == 200


@pytest.mark.heavy
def test_the_other_commands_go_on_beside_a_studio(studio: StudioProcess, tmp_path: Path) -> None:
    data = str(studio.data)
    way, trajectory = tmp_path / "way.csv", tmp_path / "walk.csv"
    rows = ["0.4," + ",".join([f"{h}.0000"] * 12) for h in (5, 6, 5)]
    way.write_text("\n".join(["duration_s," + ",".join(f"h{i}" for i in range(1, 13)), *rows]) + "\n")
    before = studio.ask("GET", "/api/runs").content["total"]
    for words in (
        ("send", str(way), "--robot", "emulator", "--yes", "--data", data),
        ("gaits", "--data", data),
        ("export", "walk", "--format", "csv", "--data", data, "-o", str(trajectory)),
        ("import", str(trajectory), "-o", str(Path(data, "gaits", "imported.json"))),
    ):
        ended = footfall(*words)
        assert ended.returncode == 0, ended.stderr
    assert studio.ask("GET", "/api/runs").content["total"] == before + 1
    assert "imported" in [line["id"] for line in studio.ask("GET", "/api/gaits").content["gaits"]]
    unknown = footfall("simulate", str(trajectory), "--physics", "Lab floor, version 1", "--data", data)
    assert (unknown.returncode, "Lab floor" in unknown.stderr) == (2, True)


def test_a_live_answer_follows_a_document_and_leaves_the_gait_alone(studio: StudioProcess) -> None:
    before = studio.ask("GET", "/api/gaits/walk/view").content
    document = before["document"] | {"step": [0.0085, 0.0085, 0.0]}
    answer = studio.ask("POST", "/api/gaits/walk/live", {"document": document}).content
    assert (answer["status"], answer["method"]) == ("solved", "live")
    assert answer["check"]["max_violation"] <= 1e-6
    poses = studio.blob(f"/api/gaits/walk/poses?plan={answer['plan']['hash']}")
    assert len(poses) > 100_000
    after = studio.ask("GET", "/api/gaits/walk/view").content
    assert after["revision"] == before["revision"]
    assert after["plan"]["hash"] == before["plan"]["hash"]
    assert studio.ask("POST", "/api/gaits/walk/live").content["plan"]["hash"]


@pytest.mark.soak
def test_an_infeasible_gait_is_explained_and_its_remedies_work(studio: StudioProcess) -> None:
    document = studio.ask("GET", "/api/gaits/s-gait").content | {"step": [0.03, 0.0, 0.0]}
    answer = studio.ask("POST", "/api/gaits/s-gait/live", {"document": document}).content
    assert answer["status"] == "infeasible"
    assert answer["evidence"] in ("proven", "diagnosed")
    worst = answer["lacks"][0]
    assert worst["amount"] > 0
    assert 0 <= worst["first"] <= worst["last"] < 45
    assert worst["sentence"]
    last = studio.lines("/api/gaits/s-gait/remedies", {"document": document})[-1]
    assert last["remedies"]
    assert last["remedies"][0]["physics"]["walks"]
    for remedy in last["remedies"]:
        cured = studio.ask("POST", "/api/gaits/s-gait/live", {"document": remedy["document"]}).content
        assert cured["status"] == "solved", remedy["label"]


@pytest.mark.parametrize(
    ("body", "words"),
    [
        (b"[1]", "body"),
        (b'{"document": {"format": "x"}}', "not a gait document"),
        (b'{"documents": {}}', "documents"),
        (b"{", "body"),
    ],
)
def test_bad_live_questions_are_422_with_a_sentence(studio: StudioProcess, body: bytes, words: str) -> None:
    refused = studio.ask("POST", "/api/gaits/walk/live", body)
    assert refused.status == 422
    assert words in refused.content["error"]


def test_the_iterations_of_a_job_can_be_looked_at(studio: StudioProcess) -> None:
    job = optimised(studio, "s-gait")
    assert job["course"] == len(job["progress"])
    first = studio.ask("GET", f"/api/jobs/{job['id']}/course/0").content
    assert first["source"] == "iterate"
    assert len(first["times"]) == 45
    assert len(studio.blob(f"/api/gaits/s-gait/poses?plan={first['hash']}")) > 100_000
    beyond = studio.ask("GET", f"/api/jobs/{job['id']}/course/{job['course']}")
    assert beyond.status == 422
    assert "iterations 0 to" in beyond.content["error"]
    assert studio.ask("GET", "/api/jobs/none/course/0").status == 404
