"""What a start finds: a file that somebody broke by hand spoils nothing but its own gait."""

from __future__ import annotations

import json
from dataclasses import asdict
from pathlib import Path

import pytest

from app.documents.gait_json import gait_content, motion_hash
from app.documents.trajectory_json import trajectory_content
from app.gaits.service import GaitService
from app.plans.provenance import result_provenance
from app.store.database import Database
from app.store.gait_files import GaitFiles
from app.store.tables.job_store import JobStore
from app.studio.studio import Studio
from core.gait.gait import SequencePart, motion_problem
from core.library.library import library
from core.library.sequence import sequence_gait
from core.robot.model import load_robot
from solver_jobs import solve_live


def put(folder: Path, gait_id: str, text: str) -> None:
    (folder / "gaits").mkdir(exist_ok=True)
    (folder / "gaits" / f"{gait_id}.json").write_text(text)


def test_a_job_of_a_gait_whose_file_is_damaged_is_shown_as_out_of_date(tmp_path: Path) -> None:
    put(tmp_path, "mine", "{ damaged")
    database = Database(tmp_path / "studio.sqlite3")
    JobStore(database).put(
        {"kind": "optimise", "id": "one", "created": 1.0, "gait": "mine", "motion": "0" * 64, "state": "done"}
    )
    database.close()
    studio = Studio(tmp_path, "emulator")
    try:
        greeting = studio.call(studio.hello).result(20)
    finally:
        studio.close()
    assert [(job["id"], job["fresh"]) for job in greeting["jobs"]] == [("one", False)]
    assert [line["id"] for line in greeting["gaits"] if line["problem"]] == ["mine"]


def test_a_greeting_opens_no_gait_for_its_jobs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    database = Database(tmp_path / "studio.sqlite3")
    walk = motion_hash(library()["walk"].gait)
    JobStore(database).put(
        {"kind": "optimise", "id": "one", "created": 1.0, "gait": "walk", "motion": walk, "state": "done"}
    )
    database.close()
    studio = Studio(tmp_path, "emulator")
    monkeypatch.delattr(GaitService, "open_gait")
    try:
        greeting = studio.call(studio.hello).result(20)
    finally:
        studio.close()
    assert [job["fresh"] for job in greeting["jobs"]] == [True]


def test_a_sequence_that_runs_too_often_keeps_no_result_from_another_gait(tmp_path: Path) -> None:
    walk = library()["walk"].gait
    content = gait_content(sequence_gait("Long", [SequencePart(walk, 2, "walk")]))
    content["sequence"][0]["gait"]["iterations"] = 20
    put(tmp_path, "long", json.dumps(content))
    database = Database(tmp_path / "studio.sqlite3")
    try:
        service = GaitService(GaitFiles(tmp_path), database, lambda gait: solve_live)
        assert "at most 20 follow each other" in str(service.plan("long").refusal)
        service.open_gait("walk")
        solved = solve_live(motion_problem(walk, load_robot(walk.robot)))
        result = {
            "solve_seconds": 0.5,
            "status": "solved",
            "trajectory": trajectory_content(solved.trajectory),
        }
        provenance = asdict(result_provenance(motion_hash(walk), result))
        assert service.delivery.on_result({**result, "provenance": provenance}, "long") is None
    finally:
        database.close()
