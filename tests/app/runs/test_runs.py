"""Runs that were kept: figures, filter, notes, deleting, files, and one by HTTP from sending on."""

from __future__ import annotations

import csv
import io
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from mcap.reader import make_reader

from app.bridge.states import Direction, LinkState, RobotState, Transition
from app.emulator.emulated_robot import EmulatedRobot
from app.robot.run_recorder import RunRecorder
from app.runs.export import run_csv, run_mcap
from app.runs.motion import measured_trajectory
from app.runs.service import RunService
from app.store.database import Database
from app.store.tables.run_store import RunFilter, RunStore
from core.errors import NotFoundError, StateError
from tests.support.newest_run import newest_run
from tests.support.ran_robot import STARTED, keep_run, ran
from tests.support.studio_process import StudioProcess, wait_for

SPEED = 40.0
"""Seconds of the emulated robot in a second."""

EVERY = RunFilter()


@pytest.fixture
def service(database: Database) -> RunService:
    return RunService(database)


def found(service: RunService, wanted: RunFilter = EVERY, offset: int = 0, most: int = 50) -> list[str]:
    return [run["id"] for run in service.found(wanted, offset, most)["runs"]]


def test_a_run_is_listed_with_its_largest_error(service: RunService, database: Database) -> None:
    run = keep_run(database)
    line = service.found(EVERY, 0, 50)["runs"][0]
    assert (line["id"], line["by"], line["state"], line["note"]) == (run, "Ada", "done", "")
    errors = line["errors"]
    assert 0.1 < errors["largest_mm"] == max(errors["motor_largest_mm"]) <= 1.2
    assert errors["motor_largest_mm"][errors["largest_motor"]] == errors["largest_mm"]
    assert errors["arrived"] == ran().way.waypoints.count
    assert RunStore(database).figures(run) == errors  # computed once


def test_runs_are_filtered_by_gait_operator_state_and_day(service: RunService, database: Database) -> None:
    first = keep_run(database)
    second = keep_run(database, by="Bob", gait="amble", day=1)
    third = keep_run(database, by="Bob", day=2)
    assert found(service) == [third, second, first]
    assert found(service, RunFilter(gait="amble")) == [second]
    assert found(service, RunFilter(by="Bob", gait="walk")) == [third]
    assert found(service, RunFilter(state="stopped")) == []
    assert found(service, RunFilter(since=STARTED + 1, until=STARTED + 1.5 * 86400)) == [second]
    assert found(service, EVERY, offset=1, most=1) == [second]
    page = service.found(RunFilter(by="Bob"), 0, 1)
    assert page["total"] == 2
    assert page["operators"] == ["Ada", "Bob"]
    assert [gait["id"] for gait in page["gaits"]] == ["amble", "walk"]


def test_a_note_survives_the_end_of_its_run(service: RunService, database: Database) -> None:
    run = keep_run(database)
    assert service.note(run, "Slipped on the mat.")["note"] == "Slipped on the mat."
    RunStore(database).put(dict(newest_run(database)))  # what the recorder does when a run ends
    assert service.summary(run)["note"] == "Slipped on the mat."


def test_a_deleted_run_is_gone_from_the_list_and_comes_back(service: RunService, database: Database) -> None:
    run = keep_run(database)
    service.delete(run)
    assert found(service) == []
    assert service.restore(run)["deleted"] is False
    assert found(service) == [run]


def test_strokes_are_thinned_and_keep_every_arrival(service: RunService, database: Database) -> None:
    run = keep_run(database)
    whole, thin = service.strokes(run, 100_000), service.strokes(run, 10)
    assert whole["count"] == len(whole["times"])
    assert len(thin["times"]) < len(whole["times"])
    arrived = {round(arrival["arrived"], 4) for arrival in thin["arrivals"]}
    assert arrived <= set(thin["times"])
    at_arrival = thin["times"].index(max(arrived))
    assert thin["plan_times"][at_arrival] == pytest.approx(ran().way.times[-1])
    np.testing.assert_allclose(thin["commanded_mm"][at_arrival], ran().way.waypoints.strokes_mm[-1])
    assert thin["plan_times"][0] is None  # on the way to the start pose
    assert thin["foot_heights_mm"][0] == [None] * 4
    heights = np.array([row for row in whole["foot_heights_mm"] if None not in row])
    assert heights.max() == pytest.approx(ran().trajectory.feet_world[..., 2].max() * 1000, abs=2.0)


def test_states_have_their_causes(service: RunService, database: Database) -> None:
    states = service.summary(keep_run(database))["states"]
    assert [state["robot"] for state in states] == ["moving", "done"]
    assert "sent by Ada" in states[0]["cause"]


def test_the_csv_holds_every_telemetry(service: RunService, database: Database) -> None:
    run = keep_run(database)
    rows = list(csv.DictReader(io.StringIO(run_csv(service.record(run)))))
    assert len(rows) == service.strokes(run, 10)["count"]
    last = rows[-1]
    assert list(last)[:3] == ["t", "state", "commanded_h1"]
    assert [float(last[f"commanded_h{m + 1}"]) for m in range(12)] == pytest.approx(
        ran().way.waypoints.strokes_mm[-1]
    )
    assert {row["state"] for row in rows} <= {"moving", "done"}


def read_mcap(content: bytes) -> dict[str, list[dict[str, Any]]]:
    messages: dict[str, list[dict[str, Any]]] = {}
    for schema, channel, message in make_reader(io.BytesIO(content)).iter_messages():
        assert schema is not None
        assert set(json.loads(schema.data)["required"]) <= set(json.loads(message.data))
        messages.setdefault(channel.topic, []).append(json.loads(message.data))
    return messages


def test_the_mcap_file_opens_in_the_standard_reader(service: RunService, database: Database) -> None:
    run = keep_run(database)
    content = run_mcap(service.record(run))
    messages = read_mcap(content)
    assert set(messages) == {"/run/measured", "/run/commanded", "/run/state", "/run/bytes"}
    assert len(messages["/run/measured"]) == service.strokes(run, 10)["count"]
    assert messages["/run/commanded"][-1]["waypoint"] == ran().way.waypoints.count
    assert len(messages["/run/bytes"]) == len(ran().robot.pieces)
    metadata = next(iter(make_reader(io.BytesIO(content)).iter_metadata()))
    assert metadata.metadata["by"] == "Ada"


def test_the_measured_motion_stays_near_the_plan(service: RunService, database: Database) -> None:
    motion = measured_trajectory(service.record(keep_run(database)))
    planned = ran().trajectory
    np.testing.assert_allclose(motion.times, planned.times)
    assert np.abs(motion.feet_world - planned.feet_world).max() < 0.005
    assert np.abs(motion.body_world - planned.body_world).max() < 0.005
    assert np.abs(motion.body_world - planned.body_world).max() > 1e-4


def test_a_run_without_its_plan_says_so_and_is_still_listed(service: RunService, database: Database) -> None:
    run = keep_run(database)
    with database.writing() as connection:
        connection.execute("DELETE FROM run_plan")
    assert service.found(EVERY, 0, 50)["runs"][0]["errors"] is None
    with pytest.raises(StateError, match="older program"):
        service.strokes(run, 100)
    with pytest.raises(NotFoundError, match="no run “nope”"):
        service.summary("nope")


def test_the_recorder_keeps_each_change_of_state_once(database: Database) -> None:
    recorder = RunRecorder(database)
    record = {"id": "r", "started": 1.0, "started_monotonic": 10.0}
    changes = [
        Transition(time, LinkState.READY, RobotState.MOVING, f"change {number}", number)
        for number, time in ((1, 9.0), (2, 11.0), (3, 12.0), (4, 12.0))
    ]
    recorder.begin(record, {"robot": "deltawalker"}, after=1)
    recorder.log(Direction.TO_ROBOT, b"<r>", 11.0)
    recorder.note(changes[:2])
    recorder.note(changes)
    recorder.end(record)
    recorder.note(changes)
    recorder.close()
    causes = [state.cause for state in RunStore(database).states_of("r")]
    assert causes == ["change 2", "change 3", "change 4"]
    [piece] = RunStore(database).bytes_of("r")
    assert (piece.time, piece.direction, piece.data) == (11.0, "to robot", b"<r>")


@pytest.fixture(scope="module")
def sent(studio: StudioProcess, robot: EmulatedRobot) -> str:
    """The id of a run that was sent by HTTP and has ended."""
    assert robot.device
    studio.ask("POST", "/api/gaits/walk-manual-0/check")
    word = {"by": "Ada", "accept_warnings": True}
    assert studio.ask("POST", "/api/gaits/walk-manual-0/approve", word).status == 200
    studio.ask("POST", "/api/robot/connect")
    wait_for(lambda: studio.robot()["robot"] == "disarmed", "the robot is up")
    assert studio.ask("POST", "/api/robot/arm", {"by": "Ada"}).status == 200
    answer = studio.ask("POST", "/api/robot/send", {"gait": "walk-manual-0", "by": "Ada"})
    assert answer.status == 200, answer.content
    wait_for(lambda: studio.robot()["robot"] == "done", "the run is done", 60)
    wait_for(lambda: studio.ask("GET", "/api/runs").content["runs"][0]["ended"] is not None, "it is kept")
    run: str = studio.ask("GET", "/api/runs").content["runs"][0]["id"]
    return run


def test_a_run_that_was_sent_is_kept_with_all_that_belongs_to_it(studio: StudioProcess, sent: str) -> None:
    run = studio.ask("GET", f"/api/runs/{sent}").content
    assert run["state"] == "done"
    assert run["reached"] == run["count"] == run["errors"]["arrived"]
    assert run["approval"]["by"] == "Ada"
    assert run["approval"]["waypoints_hash"] == run["waypoints_hash"]
    assert [state["robot"] for state in run["states"]] == ["moving", "done"]
    assert run["errors"]["largest_mm"] < 1.2
    strokes = studio.ask("GET", f"/api/runs/{sent}/strokes?most=100").content
    assert strokes["arrivals"][-1]["waypoint"] == run["count"] - 1
    assert studio.text(f"/api/runs/{sent}/run.csv").startswith("t,state,commanded_h1,")
    assert "/run/measured" in read_mcap(studio.blob(f"/api/runs/{sent}/run.mcap"))


def test_notes_filter_and_deleting_by_http(studio: StudioProcess, sent: str) -> None:
    assert studio.ask("PUT", f"/api/runs/{sent}/note", {"note": " On foam. "}).content["note"] == "On foam."
    assert studio.ask("GET", "/api/runs?operator=Bob").content["total"] == 0
    assert studio.ask("GET", "/api/runs?operator=Ada&state=done").content["total"] == 1
    assert studio.ask("GET", "/api/runs?until=2020-01-01").content["total"] == 0
    assert studio.ask("DELETE", f"/api/runs/{sent}").content["deleted"] is True
    assert studio.ask("GET", "/api/runs").content["total"] == 0
    assert studio.ask("POST", f"/api/runs/{sent}/restore").content["note"] == "On foam."


@pytest.mark.parametrize(
    ("method", "path", "body", "status", "sentence"),
    [
        ("GET", "/api/runs/nope", None, 404, "no run “nope”"),
        ("GET", "/api/runs/nope/run.csv", None, 404, "no run “nope”"),
        ("GET", "/api/runs?since=yesterday", None, 422, "since"),
        ("GET", "/api/runs?most=0", None, 422, "most"),
        ("PUT", "/api/runs/nope/note", {"note": "x" * 4001}, 422, "4000"),
        ("DELETE", "/api/runs/nope", None, 404, "no run “nope”"),
    ],
)
def test_refusals_name_what_is_wrong(
    studio: StudioProcess, method: str, path: str, body: Any, status: int, sentence: str
) -> None:
    answer = studio.ask(method, path, body)
    assert answer.status == status
    assert sentence in answer.content["error"]


def test_an_old_database_gets_its_runs_listed(tmp_path: Path) -> None:
    path = tmp_path / "studio.sqlite3"
    database = Database(path)
    run = keep_run(database)
    database.close()
    database = Database(path)
    assert found(RunService(database)) == [run]
    database.close()


def test_two_runs_are_aligned_by_waypoint(service: RunService, database: Database) -> None:
    whole, part = keep_run(database), keep_run(database, "Bob", share=0.4)
    both = service.comparison(whole, part)
    one, other = both["runs"]
    assert (one["id"], other["id"], other["state"]) == (whole, part, "stopped")
    count = len(both["waypoints"])
    assert 3 < count < ran().way.waypoints.count
    assert both["apart_mm"] == 0.0
    assert one["seconds"] == other["seconds"]
    assert {len(run[key]) for run in (one, other) for key in ("move_seconds", "error_mm", "measured_mm")} == {
        count
    }
    assert one["figures"]["seconds"] == pytest.approx(one["seconds"][-1], abs=1e-3)
    assert one["figures"]["start_seconds"] == service.summary(whole)["errors"]["start_seconds"]
    with pytest.raises(NotFoundError):
        service.comparison(whole, "nowhere")
