"""Manual gaits against the published planned trajectories, and what segment tables refuse."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from core.arrays import Floats
from core.checks.checked_plan import CheckedPlan
from core.checks.rules import check_plan
from core.errors import InputError
from core.gait.gait import Gait
from core.gait.manual_motion import manual_motion
from core.library.library import Group, default_vocabulary, group_ids, library, manual_entry
from core.motion.trajectory import quarter_turn
from core.robot.model import load_robot
from core.segments.segment_table import SegmentTable
from core.wire.waypoint_path import waypoints_from_trajectory
from tests.support.reference import reference_rows

MODEL = load_robot("deltawalker")
PUBLISHED_ROUNDING = 0.0003
"""Published feet went through motor strokes rounded to 0.1 mm, which moved them by up to 0.25 mm."""


PUBLISHED = {
    "A0": ("walk", 0),
    "A1": ("walk", 1),
    "B0": ("amble", 0),
    "C0": ("s-gait", 0),
    "C1": ("s-gait", 1),
}
"""Every planned trajectory that was published, by the letters of its file."""

BY_HAND = group_ids(Group.BY_HAND)


def from_own_modules(gait: Gait) -> Floats:
    """(n, legs, 3) feet from their modules' centres, x and y in robot axes, z from the actuators."""
    motion = manual_motion(gait, MODEL).trajectory
    plane = motion.pose(MODEL).position_world[:, None, :]
    return np.asarray(motion.feet_world - plane - MODEL.module_centres_robot)


def repeated(gait: Gait, iterations: int) -> Gait:
    assert gait.segment_table is not None
    implied = gait.segment_table.repeated(iterations).timeline(gait.timeline.sample_time)
    return replace(gait, iterations=iterations, timeline=implied)


@pytest.mark.parametrize("direction", [1, 2, 3, 4])
@pytest.mark.parametrize("letters", PUBLISHED)
def test_feet_go_where_the_published_ones_go(letters: str, direction: int) -> None:
    rows = reference_rows(f"simulation_manual/planned/traj{letters}_o1.csv")
    turns = direction - 1
    published = np.roll(rows[4:].T.reshape(-1, 4, 3) @ quarter_turn(turns).T, turns, axis=1)
    feet = from_own_modules(replace(manual_entry(*PUBLISHED[letters]).gait, direction=direction))
    assert feet.shape == published.shape
    assert np.abs(feet - published).max() < PUBLISHED_ROUNDING


@pytest.mark.parametrize("iterations", [1, 3])
@pytest.mark.parametrize("gait_id", [gait for gait in BY_HAND if not gait.startswith("s-gait")])
def test_the_body_advances_a_step_an_iteration(gait_id: str, iterations: int) -> None:
    body = manual_motion(repeated(library()[gait_id].gait, iterations), MODEL).trajectory.body_world
    assert body[-1, :2] == pytest.approx([iterations * 0.01 / np.sqrt(2)] * 2)


@pytest.mark.parametrize(("version", "leaning_feet"), [(0, 1), (1, 1), (2, 3)])
def test_leaning_feet_push_the_body_beyond_its_step(version: int, leaning_feet: int) -> None:
    gait = manual_entry("s-gait", version).gait
    for iterations in (1, 3):
        body = manual_motion(repeated(gait, iterations), MODEL).trajectory.body_world
        travel = iterations * 0.010 * (4 + leaning_feet) / 4
        assert body[-1] == pytest.approx([travel, 0.0, 0.073])


@pytest.mark.parametrize("iterations", [1, 3])
@pytest.mark.parametrize("gait_id", BY_HAND)
def test_positions_are_continuous_and_motors_reach_them(gait_id: str, iterations: int) -> None:
    gait = repeated(library()[gait_id].gait, iterations)
    motion = manual_motion(gait, MODEL).trajectory
    assert motion.knot_count == gait.timeline.sample_count
    assert (gait.timeline.stance == motion.contact.T).all()
    strokes = motion.strokes(MODEL)
    assert MODEL.stroke.lower - 1e-9 <= strokes.min() <= strokes.max() <= MODEL.stroke.upper
    jumps = np.linalg.norm(np.diff(from_own_modules(gait), axis=0), axis=-1)
    assert jumps.max() < 0.006
    assert (jumps[4::5] < 1e-12).all()


def test_two_feet_in_the_air_are_found() -> None:
    """S-Gait version 2, segment 7: the left foot steps while the right one lifts."""
    gait = manual_entry("s-gait", 2).gait
    motion = manual_motion(gait, MODEL).trajectory
    verdict = check_plan(CheckedPlan(MODEL, motion, waypoints_from_trajectory(MODEL, motion)))
    found = [finding for finding in verdict.findings if "stand alone" in finding.sentence]
    assert [(f.rule, f.sample) for f in found] == [("balance", 30)]
    assert "feet 1 and 3, which stand alone (12.0 to 13.6 s)" in found[0].sentence
    assert not verdict.passed


@pytest.mark.parametrize("gait_id", [gait for gait in BY_HAND if gait != "s-gait-manual-2"])
def test_every_other_gait_made_by_hand_keeps_three_feet_down(gait_id: str) -> None:
    timeline = repeated(library()[gait_id].gait, 3).timeline
    assert timeline.stance.sum(axis=0).min() == 3


def test_the_slip_that_remains_is_reported() -> None:
    slip = manual_motion(manual_entry("walk", 0).gait, MODEL).slip
    assert (slip > 0.005).all()


def test_directions_turn_the_same_motion() -> None:
    gait = manual_entry("walk", 1).gait
    first = manual_motion(gait, MODEL).trajectory
    third = manual_motion(replace(gait, direction=3), MODEL).trajectory
    half_turn = np.diag([-1.0, -1.0, 1.0])
    assert third.body_world == pytest.approx(first.body_world @ half_turn)
    assert third.feet_world == pytest.approx(np.roll(first.feet_world @ half_turn, 2, axis=1))


def test_the_implied_timeline_swings_with_lift_and_step() -> None:
    entry = library()["walk-manual-0"]
    table = entry.gait.segment_table
    assert table is not None
    swings = {(s.foot, s.first // 5, s.last // 5) for s in table.timeline(0.4).swings()}
    assert swings == {(2, 2, 3), (1, 4, 5), (3, 6, 7), (0, 8, 9)}


@pytest.mark.parametrize(
    ("rows", "message"),
    [
        ([("Push A", "Step A")], "starts at Home-None, but the foot is at Home-Base"),
        ([("Push A", "Hop A")], "there is no “Hop A”"),
        ([("Push A",), ("Push A", "Wait A")], "2 segments; it needs 1"),
    ],
)
def test_tables_that_make_no_motion_are_refused(rows: list[tuple[str, ...]], message: str) -> None:
    with pytest.raises(InputError, match=message):
        SegmentTable(tuple(rows), 5, 1, default_vocabulary())


def test_unknown_manual_gaits_are_refused_with_those_that_exist() -> None:
    with pytest.raises(InputError, match="no manual gait “hop”; choose one of walk"):
        manual_entry("hop", 0)
    with pytest.raises(InputError, match="walk has no version 7; choose one of 0, 1, 2"):
        manual_entry("walk", 7)
