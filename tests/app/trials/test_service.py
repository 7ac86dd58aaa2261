"""Trials that were kept: figures beside the plan, ends by hand, deleting, tables."""

from __future__ import annotations

import csv
import io
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from app.store.database import Database
from app.store.tables.trial_store import TrialStore
from app.trials.planned import PlannedFeet
from app.trials.service import TrialDescription, TrialService, compared
from app.trials.tables import COLUMNS, table_csv, table_latex
from core.errors import InputError, NotFoundError, StateError
from core.vision.track import FootTrack
from core.vision.track_csv import format_track_csv
from tests.support.trials.tracks import STANCE, stepping_track

WORDS = TrialDescription("first", "Ada", 3.0, 3, gait="walk", gait_name="Walk 10 mm")
TRACK = stepping_track((0.012, 0.0), 3)


@pytest.fixture
def service(database: Database) -> TrialService:
    return TrialService(database)


def straight_plan(turn: bool = False) -> PlannedFeet:
    """Feet that all go 30 mm along x, or along y of a frame that lies turned by 90°."""
    feet = np.repeat(STANCE[None], 2, axis=0)
    feet[1, :, 0] += 0.03
    quarter = np.array([[0.0, 1.0], [-1.0, 0.0]]) if turn else np.eye(2)
    return PlannedFeet(np.array([0.0, 60.0]), feet @ quarter)


@pytest.mark.parametrize("turn", [False, True])
def test_a_trial_stands_beside_its_plan_however_the_robot_stood(service: TrialService, turn: bool) -> None:
    summary = service.add(TRACK, WORDS, straight_plan(turn))
    assert summary["figures"]["distance"] == pytest.approx(3.6)
    assert summary["figures"]["error_percent"] == pytest.approx(20.0)
    assert summary["plan"]["figures"]["distance"] == pytest.approx(3.0, abs=1e-3)
    assert summary["plan"]["turn_deg"] == pytest.approx(-90.0 if turn else 0.0, abs=1e-3)
    ways = service.paths(summary["id"])
    assert ways["plan"]["feet"][0]["x"][-1] == pytest.approx(7.0, abs=1e-2)
    assert ways["track"]["feet"][0]["x"][-1] == pytest.approx(7.6, abs=1e-2)


def test_a_trial_outlasts_the_program(service: TrialService, database: Database) -> None:
    trial = service.add(TRACK, WORDS, None)["id"]
    again = TrialService(database).summary(trial)
    assert (again["name"], again["by"], again["iterations"], again["plan"]) == ("first", "Ada", 3, None)
    assert [part["net_distance"] for part in again["parts"]] == pytest.approx([1.2] * 3, abs=1e-3)


def test_ends_that_were_set_by_hand_count_until_they_are_found_again(service: TrialService) -> None:
    summary = service.add(TRACK, WORDS, None)
    moved = [summary["parts"][0]["end"] - 40, *summary["found_ends"][1:]]
    changed = service.change(summary["id"], 1, {"ends": moved})
    assert changed["ends_by_hand"]
    assert changed["parts"][0]["end"] == moved[0]
    assert not service.change(summary["id"], 2, {"ends": None})["ends_by_hand"]


@pytest.mark.parametrize("changes", [{"ends": [400, 300, 900]}, {"ends": [10, 20]}, {"iterations": 50}])
def test_a_change_that_does_not_fit_leaves_the_trial_as_it_was(
    service: TrialService, changes: dict[str, Any]
) -> None:
    before = service.add(TRACK, WORDS, None)
    with pytest.raises(InputError):
        service.change(before["id"], 1, changes)
    assert service.summary(before["id"]) == before


def test_a_deleted_trial_comes_back(service: TrialService) -> None:
    trial = service.add(TRACK, WORDS, None)["id"]
    service.delete(trial)
    assert service.lines() == []
    service.restore(trial)
    assert [line["id"] for line in service.lines()] == [trial]


def test_a_change_of_an_old_revision_is_refused_and_changes_nothing(service: TrialService) -> None:
    trial = service.add(TRACK, WORDS, None)["id"]
    assert service.change(trial, 1, {"note": "one"})["revision"] == 2
    with pytest.raises(StateError, match="has revision 2, and you changed 1"):
        service.change(trial, 1, {"note": "two"})
    assert service.summary(trial)["note"] == "one"


def test_a_deleted_trial_takes_no_changes(service: TrialService) -> None:
    trial = service.add(TRACK, WORDS, None)["id"]
    service.delete(trial)
    with pytest.raises(StateError, match="Bring it back first"):
        service.change(trial, 1, {"note": "lost"})
    service.restore(trial)
    assert service.change(trial, 1, {"note": "kept"})["note"] == "kept"


def test_whoever_listens_is_told_of_each_trial_that_is_another_now(database: Database) -> None:
    told: list[tuple[int, bool]] = []
    service = TrialService(database, lambda change: told.append((change["revision"], change["deleted"])))
    trial = service.add(TRACK, WORDS, None)["id"]
    service.change(trial, 1, {"note": "one"})
    service.delete(trial)
    service.restore(trial)
    assert told == [(1, False), (2, False), (2, True), (2, False)]


def test_an_unknown_trial_is_refused(service: TrialService) -> None:
    with pytest.raises(NotFoundError, match="There is no trial"):
        service.summary("none")


@pytest.mark.parametrize(
    ("degrees", "words"), [(38, "38° to the left"), (-20, "20° to the right"), (10, None)]
)
def test_a_trial_that_went_far_to_a_side_of_its_plan_is_remarked_on(
    service: TrialService, degrees: float, words: str | None
) -> None:
    angle = np.radians(degrees)
    track = stepping_track((0.012 * np.cos(angle), 0.012 * np.sin(angle)), 3)
    plan = service.add(track, WORDS, straight_plan())["plan"]
    assert plan["astray_deg"] == pytest.approx(degrees, abs=0.5)
    assert (plan["astray_sentence"] is None) if words is None else words in plan["astray_sentence"]


def test_a_plan_tells_the_step_that_trials_are_compared_by_and_a_mistyped_distance_does_not(
    service: TrialService,
) -> None:
    service.add(TRACK, WORDS, straight_plan())
    service.add(TRACK, replace(WORDS, expected_cm=30.0), straight_plan())
    service.add(TRACK, replace(WORDS, expected_cm=4.5), None)
    groups = [(group["step_cm"], len(group["trials"])) for group in compared(service.lines())]
    assert groups == [(1.0, 2), (1.5, 1)]


def test_trials_of_one_gait_and_step_stand_in_one_row_of_the_tables(service: TrialService) -> None:
    for step in (0.010, 0.012):
        service.add(stepping_track((step, 0.0), 3), WORDS, None)
    service.add(TRACK, TrialDescription("other", "Ada", 4.5, 3, gait_name="Amble & more"), None)
    groups = compared(service.lines())
    assert [(group["gait_name"], len(group["trials"])) for group in groups] == [
        ("Amble & more", 1),
        ("Walk 10 mm", 2),
    ]
    assert groups[1]["distance"] == pytest.approx(3.3, abs=1e-3)
    assert groups[1]["distances"] == pytest.approx([3.0, 3.6], abs=1e-3)
    rows = list(csv.reader(io.StringIO(table_csv(groups))))
    assert rows[0] == list(COLUMNS.values())
    assert rows[2][:5] == ["Walk 10 mm", "1.00", "2", "3.00", "3.30"]
    named = [{**groups[0], "gait_name": name, "angle_deg": -1.5} for name in ("=1+1", "Walk, -1", "-2")]
    rows = list(csv.reader(io.StringIO(table_csv(named))))
    assert [row[0] for row in rows[1:]] == ["'=1+1", "Walk, -1", "-2"]
    assert {row[list(COLUMNS).index("angle_deg")] for row in rows[1:]} == {"-1.50"}
    assert r"Amble \& more & 1.50 & 1 & 4.50" in table_latex(groups)


def in_one_point(track: FootTrack) -> FootTrack:
    """The track with all feet where the first one is, so that no direction is known."""
    return replace(track, feet=np.repeat(track.feet[:, :1], track.foot_count, axis=1))


def test_a_trial_without_figures_is_refused_and_not_kept(service: TrialService, database: Database) -> None:
    with pytest.raises(InputError, match="one point"):
        service.add(in_one_point(TRACK), WORDS, straight_plan())
    assert TrialStore(database).listed(lambda row: row).rows == ()
    assert service.lines() == []


def test_a_kept_trial_without_figures_is_marked_and_the_list_goes_on(
    service: TrialService, database: Database
) -> None:
    good = service.add(TRACK, WORDS, straight_plan())["id"]
    row = TrialStore(database).listed(lambda row: row).rows[0]
    bad = {**row.content, "id": "bad", "name": "all in one point"}
    TrialStore(database).add(bad, format_track_csv(in_one_point(TRACK)))
    assert [line["id"] for line in service.lines()] == [good]
    (marked,) = service.unreadable()
    assert (marked["id"], marked["name"]) == ("bad", bad["name"])
    assert "one point" in marked["sentence"]
    service.delete("bad")
    assert service.unreadable() == []
    with pytest.raises(InputError, match="one point"):
        service.restore("bad")
    assert [line["id"] for line in service.lines()] == [good]
