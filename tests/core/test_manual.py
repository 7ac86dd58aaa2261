"""Manual gaits against the published planned trajectories, and what segment tables refuse."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from core.errors import InputError
from core.library import default_vocabulary, library, manual_entry
from core.manual import manual_motion
from core.robot import load_robot
from core.segments import SegmentTable
from tests.reference import reference_rows

MODEL = load_robot("deltawalker")
PUBLISHED_ROUNDING = 0.0003
"""Published feet went through motor strokes rounded to 0.1 mm, which moved them by up to 0.25 mm."""


@pytest.mark.parametrize("version", [0, 1])
def test_the_walk_puts_its_feet_where_the_published_one_does(version: int) -> None:
    rows = reference_rows(f"simulation_manual/planned/trajA{version}_o1.csv")
    published = rows[4:].T.reshape(-1, 4, 3)
    motion = manual_motion(manual_entry("walk", version).gait, MODEL).trajectory
    plane = motion.pose(MODEL).position_world[:, None, :]
    from_centres = motion.feet_world - plane - MODEL.module_centres_robot
    assert from_centres.shape == published.shape
    assert np.abs(from_centres - published).max() < PUBLISHED_ROUNDING


@pytest.mark.parametrize("version", [0, 1, 2])
def test_the_body_advances_a_step_an_iteration(version: int) -> None:
    gait = replace(manual_entry("walk", version).gait, iterations=2)
    assert gait.segment_table is not None
    implied = gait.segment_table.repeated(2).timeline(0.4)
    body = manual_motion(replace(gait, timeline=implied), MODEL).trajectory.body_world
    assert body[-1, :2] == pytest.approx([0.02 / np.sqrt(2)] * 2)


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
