"""Gaits out of trials and of the published table: what the robot did, and exactly what it was sent."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from app.learning.published_trials import walks_of_table
from app.learning.walks import SentTrial, walks_of
from app.runs.plan_json import sent_content
from app.store.database import Database
from app.trials.planned import PlannedFeet
from app.trials.service import TrialDescription, TrialService
from core.errors import InputError
from core.robot.model import load_robot
from core.trials.alignment import repeated_motion
from core.vision.track import FootTrack
from core.wire.trajectory_csv import format_trajectory_csv
from tests.support.reference import reference_path
from tests.support.simulated_walk import walk_plan
from tests.support.trials.tracks import stepping_track

ROBOT = load_robot("deltawalker")
WORDS = TrialDescription("first", "Ada", 3.0, 3, gait="walk", gait_name="Walk 10 mm")
TABLE = "Traj, +x, -x, dx, +y, -y, dy, dist, angle, % err\n"
ROW = "TrajAa_o1,3.6,0.1,3.5,0.5,0.2,0.4,3.7,8.5,22.0\n"


def planned(laps: int = 3) -> PlannedFeet:
    plan = walk_plan()
    assert plan.trajectory is not None
    assert plan.way is not None
    motion = plan.trajectory
    sent = sent_content(plan.model, plan.way.waypoints, plan.way.times, motion)
    return PlannedFeet(*repeated_motion(motion.times, motion.feet_world[..., :2], laps), laps, sent)


def trial(
    database: Database, track: FootTrack, feet: PlannedFeet | None, words: TrialDescription = WORDS
) -> SentTrial:
    service = TrialService(database)
    kept = service.add(track, words, feet)["id"]
    return SentTrial(service.record(kept), service.sent(kept))


def test_trials_of_the_same_waypoints_are_one_gait_with_their_mean_and_spread(database: Database) -> None:
    steps = [(0.0084, 0.0084), (0.0088, 0.0088)]
    trials = [trial(database, stepping_track(step, 3), planned()) for step in steps]
    (walk,) = walks_of(trials)
    assert walk.measured.trials == 2
    assert walk.laps == 3
    assert walk.heading == pytest.approx(math.pi / 4, abs=1e-6)
    assert walk.measured.displacement.distance == pytest.approx(3 * 0.0086 * math.sqrt(2), rel=0.02)
    assert walk.measured.displacement.angle == pytest.approx(0.0, abs=0.02)
    assert walk.measured.spread is not None
    assert walk.measured.spread[0] == pytest.approx(3 * 0.0004, rel=0.05)


def test_a_robot_that_stood_turned_goes_the_same_way(database: Database) -> None:
    straight = stepping_track((0.0086, 0.0086), 3)
    quarter = np.array([[0.0, -1.0], [1.0, 0.0]])
    turned = FootTrack(straight.times, straight.feet @ quarter.T, straight.filled)
    angles = [
        walks_of([trial(database, track, planned())])[0].measured.displacement.angle
        for track in (straight, turned)
    ]
    assert angles[0] == pytest.approx(angles[1], abs=1e-6)


def test_trials_of_other_iterations_are_another_gait(database: Database) -> None:
    once = replace(WORDS, expected_cm=1.0, iterations=1)
    trials = [
        trial(database, stepping_track((0.0085, 0.0085), 3), planned()),
        trial(database, stepping_track((0.0085, 0.0085), 1), planned(1), once),
    ]
    names = [walk.measured.name for walk in walks_of(trials)]
    assert len(set(names)) == 2


def test_a_trial_of_unknown_waypoints_is_refused_with_its_name(database: Database) -> None:
    with pytest.raises(InputError, match="“first” are not known") as refused:
        walks_of([trial(database, stepping_track((0.0085, 0.0085), 3), None)])
    assert refused.value.where == "trials"


def test_a_row_and_its_trajectory_make_a_gait_in_the_wanted_direction() -> None:
    plan = walk_plan()
    assert plan.trajectory is not None
    (walk,) = walks_of_table(TABLE + ROW, {"walk_a.csv": format_trajectory_csv(plan.trajectory)}, ROBOT)
    assert walk.measured.displacement.distance == pytest.approx(0.037)
    assert walk.measured.displacement.angle == pytest.approx(math.atan2(0.4, 3.5))
    assert walk.measured.wanted == pytest.approx(0.03, abs=1e-3)
    assert walk.heading == pytest.approx(math.pi / 4, abs=1e-3)


@pytest.mark.parametrize(
    ("table", "words"),
    [
        ("", "no column Traj"),
        ("a,b\n1,2\n", "no column Traj"),
        (TABLE + "Other,1,1,1,1,1,1,1,1,1\n", "none of TrajAa to TrajDd"),
        (TABLE + ROW.replace("Aa", "Bb"), r"needs the trajectory ambl_b\.csv"),
        (TABLE + ROW.replace("3.7", "far"), "table:2, column 8: “far” is not a number"),
        (TABLE + ROW.replace("3.5", "inf"), "table:2, column 4: inf is not a finite"),
    ],
)
def test_a_table_that_cannot_be_used_is_refused_with_a_sentence(table: str, words: str) -> None:
    plan = walk_plan()
    assert plan.trajectory is not None
    with pytest.raises(InputError, match=words):
        walks_of_table(table, {"walk_a.csv": format_trajectory_csv(plan.trajectory)}, ROBOT)


@pytest.mark.parametrize(
    "change",
    [
        lambda t: t.replace(",", ";").replace(".", ","),
        lambda t: t.replace(",", "\t"),
        lambda t: "sep=;\n" + t.replace(",", ";"),
        lambda t: "".join(f"{at - 1 if at else ''},{line}\n" for at, line in enumerate(t.splitlines())),
        lambda t: "\ufeff" + t + ",,,\n",
        lambda t: t.replace("TrajAa_o1", '"TrajAa_o1"'),
    ],
    ids=["decimal commas", "tabs", "sep", "count", "mark and padding", "quotes"],
)
def test_a_table_in_another_form_says_the_same(change: Callable[[str], str]) -> None:
    plan = walk_plan()
    assert plan.trajectory is not None
    files = {"walk_a.csv": format_trajectory_csv(plan.trajectory)}
    usual, found = (walks_of_table(text, files, ROBOT) for text in (TABLE + ROW, change(TABLE + ROW)))
    assert found[0].measured == usual[0].measured


def test_the_published_robot_is_off_by_0_96_cm_where_it_is_taken_to_walk_as_planned() -> None:
    table = reference_path("robot_trials/trajectory_averages.csv").read_text()
    folder = reference_path("trajectories/direction1")
    walks = walks_of_table(table, {path.name: path.read_text() for path in folder.glob("*.csv")}, ROBOT)
    assert len(walks) == 16
    assert max(walk.cut for walk in walks) > 0.001
    off = [abs(walk.measured.displacement.distance - walk.measured.wanted) for walk in walks]
    assert np.mean(off) == pytest.approx(0.0096, abs=0.00005)
