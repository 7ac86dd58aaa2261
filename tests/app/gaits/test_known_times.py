"""How long gaits last stands in the list without planning them anew."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest

from app.gaits.live_plans import LivePlans
from app.gaits.service import GaitService
from app.gaits.summaries import GaitSummaries
from app.store.database import DATABASE, Database
from app.store.gait_files import GaitFiles
from core.library.library import library
from core.library.robot_times import library_times
from solver_jobs import SolveStatus
from tests.support.command import run_json
from tests.support.live_tiers import FixedTier

MANUAL = "walk-manual-0"


@pytest.fixture
def service(tmp_path: Path, database: Database) -> GaitService:
    return GaitService(GaitFiles(tmp_path), database, LivePlans(FixedTier(SolveStatus.INFEASIBLE)).solve_for)


def times_of(service: GaitService, gait_id: str) -> tuple[float | None, ...]:
    line = next(line for line in GaitSummaries(service).lines() if line["id"] == gait_id)
    return line["plan_seconds"], line["robot_seconds"], line["speed"]


def test_the_library_s_are_known_before_any_plan_was_made(service: GaitService) -> None:
    for gait_id in ("fast-c-gait", "walk", MANUAL):
        assert times_of(service, gait_id) == tuple(vars(library_times()[gait_id]).values())
    assert times_of(service, "textbook-trot") == (None, None, None)


def test_an_edited_gait_s_are_known_once_its_plan_was_made_and_stay_after_a_restart(
    service: GaitService, tmp_path: Path, database: Database
) -> None:
    gait = library()["fast-c-gait"].gait
    service.edit("fast-c-gait", gait.with_options(margin=0.007), "Margin", None)
    assert times_of(service, "fast-c-gait") == (None, None, None)
    service.plan("fast-c-gait")  # the last poses, adapted: nothing that is sent
    assert times_of(service, "fast-c-gait") == (None, None, None)
    turned = replace(library()[MANUAL].gait, iterations=2)
    service.edit(MANUAL, turned, "Iterations", None)
    before = times_of(service, MANUAL)
    service.plan(MANUAL)
    after = times_of(service, MANUAL)
    assert before == (None, None, None)
    assert after[1] is not None
    again = GaitService(GaitFiles(tmp_path), database, LivePlans(FixedTier(SolveStatus.INFEASIBLE)).solve_for)
    assert times_of(again, MANUAL) == after


def test_a_failed_write_hides_no_gait(service: GaitService, database: Database) -> None:
    database.take_damage("The database is damaged.")
    service.plan(MANUAL)
    assert times_of(service, MANUAL) == tuple(vars(library_times()[MANUAL]).values())


def test_the_command_lists_what_the_studio_found(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    database = Database(tmp_path / DATABASE)
    service = GaitService(
        GaitFiles(tmp_path), database, LivePlans(FixedTier(SolveStatus.INFEASIBLE)).solve_for
    )
    made = service.create(replace(library()[MANUAL].gait, name="Mine"))
    service.plan(made.id)
    database.close()
    status, answer = run_json(capsys, "gaits", "--data", str(tmp_path))
    assert status == 0
    saved = answer["gaits"][-1]
    assert saved["id"] == made.id
    assert saved["robot_seconds"] == library_times()[MANUAL].robot_seconds
    path = tmp_path / "gaits" / f"{made.id}.json"
    content = json.loads(path.read_text())
    content["iterations"] = 2
    path.write_text(json.dumps(content))
    assert run_json(capsys, "gaits", "--data", str(tmp_path))[1]["gaits"][-1]["robot_seconds"] is None
