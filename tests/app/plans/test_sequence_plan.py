"""Sequences over HTTP, on the way to the robot, and on the command line."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest

from app.documents.gait_json import gait_content
from app.emulator.emulated_robot import EmulatedRobot
from app.plans.make_plan import make_plan
from app.plans.plan import verdict_of
from app.plans.sequence_plan import sequence_plan
from core.gait.gait import Gait, SequencePart
from core.gait.recording import RecordingFit, WithinStroke
from core.library.library import library
from core.library.sequence import sequence_gait
from core.recorded.fit_choices import refitted
from core.wire.trajectory_csv import parse_trajectory_csv
from solver_jobs import solve_live
from tests.support.beyond_range import recorded_gait
from tests.support.command import run, run_json
from tests.support.studio_process import StudioProcess, wait_for

SPEED = 40.0
"""Seconds of the emulated robot in a second."""


def gait(name: str) -> Gait:
    return library()[name].gait


@pytest.mark.heavy
def test_the_way_over_http(studio: StudioProcess) -> None:
    parts = [{"gait": "walk", "times": 2}, {"gait": "rotate"}]
    made = studio.ask("POST", "/api/sequences", {"name": "HTTP tour", "parts": parts})
    assert made.status == 201
    assert made.content["source"] == "sequence"
    assert made.content["sources"] == ["same", "same"]
    path = f"/api/gaits/{made.content['id']}"
    document = studio.ask("GET", path).content
    document["sequence"].reverse()
    edited = studio.ask("PUT", f"{path}?label=Move+Rotate+up", document)
    assert edited.status == 200
    assert edited.content["undo"] == "Move Rotate up"
    walk = studio.ask("GET", "/api/gaits/walk").content
    studio.ask("PUT", "/api/gaits/walk", {**walk, "step": [0.004, 0.004, 0.0]})
    assert studio.ask("GET", f"{path}/view").content["sources"] == ["same", "changed"]
    fresh = studio.ask("POST", f"{path}/sequence/refresh")
    assert fresh.status == 200
    assert fresh.content["sources"] == ["same", "same"]
    assert fresh.content["document"]["sequence"][1]["gait"]["step"][0] == 0.004
    assert studio.ask("POST", f"{path}/check").content["passed"] is True
    assert studio.ask("POST", f"{path}/approve", {"by": "Ada", "accept_warnings": True}).status == 200
    assert studio.ask("POST", "/api/jobs", {"kind": "optimise", "gait": made.content["id"]}).status == 422


def test_parts_with_other_sample_times_are_resampled_in_one_step(studio: StudioProcess) -> None:
    parts = [{"gait": "walk"}, {"gait": "rotate"}]
    made = studio.ask("POST", "/api/sequences", {"name": "Resampled", "parts": parts}).content
    path = f"/api/gaits/{made['id']}"
    document = studio.ask("GET", path).content
    slow = studio.ask("GET", "/api/gaits/s-gait").content
    slow["timeline"]["sample_time"] = 0.5
    document["sequence"].append({"gait": slow, "times": 2, "source": None})
    refused = studio.ask("PUT", path, document)
    assert (refused.status, refused.content["where"]) == (422, "sample_time")
    asked = {"sequence": document["sequence"], "label": "Add S-Gait", "revision": made["revision"]}
    answer = studio.ask("POST", f"{path}/sequence/resample", asked)
    assert answer.status == 200
    assert answer.content["undo"] == "Add S-Gait"
    (sentence,) = answer.content["resampled"]
    assert "Part 3, “S-Gait 10 mm”: a sample every 0.4 s instead of 0.5 s" in sentence
    assert answer.content["document"]["sequence"][2]["gait"]["timeline"]["sample_time"] == 0.4
    assert studio.ask("POST", f"{path}/sequence/resample", asked).status == 409
    finer = studio.ask("POST", f"{path}/sequence/resample", {"sample_time": 0.2}).content
    assert finer["document"]["timeline"]["sample_time"] == 0.2
    assert len(finer["resampled"]) == 3
    studio.ask("POST", f"{path}/undo")
    undone = studio.ask("POST", f"{path}/undo").content
    names = [part["gait"]["name"] for part in undone["document"]["sequence"]]
    assert names == ["Walk 10 mm", "Rotate 15°, as in the thesis"]
    assert studio.ask("POST", "/api/gaits/walk/sequence/resample", {}).status == 422
    assert studio.ask("POST", f"{path}/sequence/resample", {"sample_time": 0}).status == 422


def test_the_list_says_which_gaits_cannot_be_parts(studio: StudioProcess) -> None:
    lines = {line["id"]: line["part_refusal"] for line in studio.ask("GET", "/api/gaits").content["gaits"]}
    assert lines["walk"] is None
    assert "made for the robot's clock" in lines.values()


def test_each_part_is_optimised_for_itself(studio: StudioProcess) -> None:
    parts = [{"gait": "s-gait"}, {"gait": "walk-manual-0"}, {"gait": "s-gait"}]
    made = studio.ask("POST", "/api/sequences", {"name": "Exact", "parts": parts}).content
    path = f"/api/gaits/{made['id']}"
    started = studio.ask("POST", f"{path}/sequence/optimise")
    assert started.status == 202
    assert len(started.content["jobs"]) == 1
    job = f"/api/jobs/{started.content['jobs'][0]}"
    wait_for(lambda: studio.ask("GET", job).content["state"] == "done", "the part is optimised", 60.0)
    assert studio.ask("GET", job).content["fresh"] is True
    shown = [
        part
        for part in studio.ask("GET", f"{path}/view").content["plan"]["parts"]
        if not part["is_transition"]
    ]
    assert [part["source"] for part in shown] == ["optimised", "manual", "optimised"]
    again = studio.ask("POST", f"{path}/sequence/optimise")
    assert again.status == 409
    assert "no part to optimise" in again.content["error"]


@pytest.mark.heavy
def test_a_sequence_is_sent_like_any_gait(studio: StudioProcess, robot: EmulatedRobot) -> None:
    parts = [{"gait": "s-gait"}, {"gait": "rotate"}]
    path = (
        f"/api/gaits/{studio.ask('POST', '/api/sequences', {'name': 'Sent', 'parts': parts}).content['id']}"
    )
    assert studio.ask("POST", f"{path}/check").content["passed"]
    approval = studio.ask("POST", f"{path}/approve", {"by": "Ada", "accept_warnings": True}).content
    studio.ask("POST", "/api/robot/connect", {"device": robot.device})
    wait_for(lambda: studio.robot()["robot"] == "disarmed", "the robot is up")
    studio.ask("POST", "/api/robot/arm", {"by": "Ada"})
    summary = studio.ask("GET", f"{path}/run").content
    assert summary["waypoints_hash"] == approval["waypoints_hash"]
    first = len(robot.firmware.messages)
    assert studio.ask("POST", "/api/robot/send", {"gait": path.split("/")[-1], "by": "Ada"}).status == 200
    wait_for(lambda: studio.robot()["robot"] in ("done", "fault"), "the run ended", 90)
    assert studio.robot()["robot"] == "done"
    sent = [[round(h, 4) for h in m.strokes_mm or ()] for m in robot.firmware.messages[first:]]
    plan = studio.ask("GET", f"{path}/view").content["plan"]
    assert sent[summary["start_moves"] :] == plan["waypoint_strokes_mm"]
    assert len(sent) - summary["start_moves"] == plan["waypoint_count"]
    assert len(plan["strokes_mm"]) == 45 + 44


@pytest.mark.parametrize(
    ("asked", "status", "words"),
    [
        ({"name": "x", "parts": []}, 422, "parts"),
        ({"name": "x", "parts": [{"gait": "walk", "times": 0}]}, 422, "times"),
        ({"name": "x", "parts": [{"gait": "nowhere"}]}, 404, "nowhere"),
        ({"name": " ", "parts": [{"gait": "walk"}]}, 422, "name"),
    ],
)
def test_bad_sequences_are_refused(
    studio: StudioProcess, asked: dict[str, object], status: int, words: str
) -> None:
    answer = studio.ask("POST", "/api/sequences", asked)
    assert answer.status == status
    assert words in answer.content["error"]


def test_only_a_sequence_takes_gaits_over(studio: StudioProcess) -> None:
    answer = studio.ask("POST", "/api/gaits/walk/sequence/refresh")
    assert answer.status == 422
    assert "is no sequence" in answer.content["error"]


@pytest.mark.heavy
def test_the_command_line_checks_and_exports_a_sequence(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    tour = sequence_gait("Tour", [SequencePart(gait("walk")), SequencePart(gait("rotate"))])
    path = tmp_path / "tour.json"
    path.write_text(json.dumps(gait_content(tour)))
    status, verdict = run_json(capsys, "check", str(path))
    assert (status, verdict["passed"]) == (0, True)
    out = tmp_path / "tour.csv"
    assert run(capsys, "export", str(path), "--format", "csv", "--method", "live", "-o", str(out))[0] == 0
    assert parse_trajectory_csv(out.read_text(), out.name).trajectory.knot_count == 45 + 44


def test_a_file_whose_timeline_is_not_that_of_its_parts_is_said(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    content = gait_content(sequence_gait("Tour", [SequencePart(gait("walk-manual-0"))]))
    content["sequence"][0]["times"] = 2
    path = tmp_path / "tour.json"
    path.write_text(json.dumps(content))
    status, _, err = run(capsys, "check", str(path))
    assert status == 2
    assert "timeline or step is not that of its parts" in err


def test_the_command_line_says_which_part_has_no_motion(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    far = replace(gait("walk"), name="Far", step=(0.06, 0.06, 0.0))
    tour = sequence_gait("Tour", [SequencePart(gait("walk-manual-0")), SequencePart(far)])
    path = tmp_path / "tour.json"
    path.write_text(json.dumps(gait_content(tour)))
    status, _, err = run(capsys, "check", str(path))
    assert status == 3
    assert "Part 2, “Far”, has no motion" in err


def test_strokes_that_were_clipped_in_a_part_are_said_of_the_sequence() -> None:
    gait = recorded_gait(0.002)
    assert gait.recorded is not None
    clipped = refitted(gait, RecordingFit(within_stroke=WithinStroke.CLIP))
    alone = make_plan(clipped, None, solve_live)
    twice = sequence_gait("Twice", [SequencePart(clipped, 2)])
    plan = sequence_plan(twice, lambda run: make_plan(run, None, solve_live), solve_live)
    assert plan.clipped is not None
    assert alone.clipped is not None
    assert plan.clipped.max() == alone.clipped.max()
    assert (plan.clipped > 0).sum() == 2 * (alone.clipped > 0).sum()
    assert any("were clipped" in finding.sentence for finding in verdict_of(plan, twice).findings)
