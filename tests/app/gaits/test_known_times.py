"""How long gaits last stands in the list without planning them anew."""

from __future__ import annotations

import json
import sqlite3
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from app.gaits.live_plans import LivePlans
from app.gaits.service import GaitService
from app.gaits.summaries import GaitSummaries
from app.store.database import DATABASE, Database
from app.store.gait_files import GaitFiles
from app.store.schema import NEWEST
from app.store.tables.times_store import TimesStore, read_times
from core.library.library import library
from core.library.robot_times import RobotTimes, library_times
from solver_jobs import SolveStatus
from tests.support.command import run_json
from tests.support.live_tiers import FixedTier

MANUAL = "walk-manual-0"


@pytest.fixture
def service(tmp_path: Path, database: Database) -> GaitService:
    return GaitService(GaitFiles(tmp_path), database, LivePlans(FixedTier(SolveStatus.INFEASIBLE)).solve_for)


def times_of(service: GaitService, gait_id: str) -> tuple[float | None, ...]:
    line = next(line for line in GaitSummaries(service).lines() if line["id"] == gait_id)
    return line["plan_seconds"], line["robot_seconds"], line["speed"], line["turn_rate"]


def test_the_library_s_are_known_before_any_plan_was_made(service: GaitService) -> None:
    for gait_id in ("fast-c-gait", "fast-turn", "walk", MANUAL):
        assert times_of(service, gait_id) == tuple(vars(library_times()[gait_id]).values())
    assert times_of(service, "textbook-trot") == (None,) * 4


def test_an_edited_gait_s_are_known_once_its_plan_was_made_and_stay_after_a_restart(
    service: GaitService, tmp_path: Path, database: Database
) -> None:
    gait = library()["fast-c-gait"].gait
    service.edit("fast-c-gait", gait.with_options(margin=0.007), "Margin", None)
    assert times_of(service, "fast-c-gait") == (None,) * 4
    service.plan("fast-c-gait")  # the last poses, adapted: nothing that is sent
    assert times_of(service, "fast-c-gait") == (None,) * 4
    turned = replace(library()[MANUAL].gait, iterations=2)
    service.edit(MANUAL, turned, "Iterations", None)
    before = times_of(service, MANUAL)
    service.plan(MANUAL)
    after = times_of(service, MANUAL)
    assert before == (None,) * 4
    assert after[1] is not None
    again = GaitService(GaitFiles(tmp_path), database, LivePlans(FixedTier(SolveStatus.INFEASIBLE)).solve_for)
    assert times_of(again, MANUAL) == after


@pytest.mark.parametrize(("gait_id", "degrees"), [("fast-turn", 4.5), ("rotate", 0.6)])
def test_a_gait_that_only_turns_has_a_rate_in_place_of_a_speed(gait_id: str, degrees: float) -> None:
    times = library_times()[gait_id]
    assert (times.speed, np.degrees(times.turn_rate)) == (0.0, pytest.approx(degrees, abs=0.05))


def test_times_of_an_earlier_database_are_found_anew(tmp_path: Path) -> None:
    path = tmp_path / DATABASE
    Database(path).close()
    connection = sqlite3.connect(path)
    with connection:
        connection.execute("ALTER TABLE times DROP COLUMN turn_rate")
        connection.execute("INSERT INTO times VALUES('mine', 'sent', 1.0, 2.0, 0.001)")
        connection.execute("ALTER TABLE open_gait DROP COLUMN revoked")
        connection.execute("ALTER TABLE history DROP COLUMN edit")
        connection.execute("DROP TABLE set_aside")
        connection.execute("DROP TABLE published")
        connection.execute(f"PRAGMA user_version = {NEWEST - 5}")
    connection.close()
    assert read_times(tmp_path) == {}
    database = Database(path)
    times = RobotTimes(plan_seconds=1.0, robot_seconds=2.0, speed=0.0, turn_rate=-0.1)
    assert TimesStore(database).all() == {}
    TimesStore(database).put("mine", "sent", times)
    assert TimesStore(database).all() == read_times(tmp_path) == {"mine": ("sent", times)}
    database.close()


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
