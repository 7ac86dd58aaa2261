"""Merging and cutting: what is kept, how near the path stays, and how long the robot is deaf."""

from __future__ import annotations

import itertools
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.arrays import SAME, Floats
from core.errors import InputError
from core.gait.manual_motion import manual_motion
from core.library.library import library
from core.motion.trajectory import Trajectory
from core.robot.kinematics import feet_in_robot
from core.robot.model import load_robot
from core.wire.robot_time import (
    ARRIVAL_THRESHOLD,
    estimate_seconds,
    largest_moves,
    least_stop_bound,
    longest_move,
)
from core.wire.waypoint_merging import (
    WaypointPlan,
    kept_knots,
    needed_knots,
    plan_of_knots,
    plan_waypoints,
)
from core.wire.waypoints import Waypoints

MODEL = load_robot("deltawalker")


@cache
def walk() -> Trajectory:
    return manual_motion(library()["walk-manual-0"].gait, MODEL).trajectory


@cache
def planned(merge: float = 0.0, stop_bound: float | None = None) -> WaypointPlan:
    return plan_waypoints(MODEL, walk(), merge, stop_bound)


def random_plan(rows: Floats, merge: float, stop_bound: float | None) -> WaypointPlan:
    """A standing robot whose motors are told any strokes."""
    count = len(rows)
    feet = np.tile(MODEL.module_centres_robot, (count, 1, 1))
    body = np.tile([0.0, 0.0, 0.0735], (count, 1))
    contact = np.ones((count, 4), dtype=np.bool_)
    still = Trajectory(np.arange(count, dtype=np.float64) * 0.4, body, np.zeros(count), feet, contact)
    knots = Waypoints(rows.reshape(count, 4, 3), np.full(count, 0.4))
    return plan_of_knots(MODEL, still, knots, merge, stop_bound)


def distance_to_path(path: Floats, points: Floats) -> float:
    """Largest distance of any point from a path, of any motor, m; the path is sampled."""
    fractions = np.linspace(0.0, 1.0, 401)[:, None]
    dense = np.concatenate([path[:1], *(a + fractions * (b - a) for a, b in itertools.pairwise(path))])
    return float(np.abs(dense[:, None] - points).max(axis=-1).min(axis=0).max())


walks = st.integers(0, 2**32 - 1).map(
    lambda seed: np.clip(
        0.01 + np.cumsum(np.random.default_rng(seed).normal(0.0, 0.0007, (12, 12)), axis=0), 0.0005, 0.0195
    )
)


def test_a_foot_that_never_stands_hinders_no_pause() -> None:
    contact = np.array([[1, 1, 1, 0], [1, 1, 1, 0], [0, 1, 1, 0], [1, 1, 1, 0]], dtype=np.bool_)
    plan = random_plan(np.full((4, 12), 0.01) + np.arange(4)[:, None] * 0.002, 0.0, None)
    assert replace(plan, contact=contact).hold_ok == (True, True, False, True)
    assert replace(plan, contact=np.zeros_like(contact)).hold_ok == (False,) * 4


@given(walks, st.floats(1e-5, 0.003))
def test_merging_keeps_ends_time_and_path(rows: Floats, merge: float) -> None:
    plan = random_plan(rows, merge, None)
    sent = plan.waypoints.strokes.reshape(-1, 12)
    assert np.array_equal(sent[[0, -1]], rows[[0, -1]])
    assert plan.waypoints.durations.sum() == pytest.approx(0.4 * len(rows))
    assert plan.times.tolist() == (np.array(plan.kept) * 0.4).tolist()
    assert distance_to_path(sent, rows) <= merge + 0.019 / 800


@given(walks, st.floats(least_stop_bound(), 3.0), st.sampled_from([0.0, 0.001]))
def test_cut_moves_keep_the_bound_and_every_part_moves(rows: Floats, bound: float, merge: float) -> None:
    whole, cut = random_plan(rows, merge, None), random_plan(rows, merge, bound)
    assert largest_moves(cut.waypoints).max() <= longest_move(bound) + SAME + 1e-9
    assert cut.waypoints.durations.sum() == pytest.approx(whole.waypoints.durations.sum())
    assert (
        distance_to_path(whole.waypoints.strokes.reshape(-1, 12), cut.waypoints.strokes.reshape(-1, 12))
        < 1e-4
    )
    moves = largest_moves(cut.waypoints)
    is_part = np.array(
        [cut.kept[i] == cut.kept[i + 1] or cut.kept[i + 1] in cut.kept[: i + 1] for i in range(len(moves))]
    )
    assert (moves[is_part] > ARRIVAL_THRESHOLD).all()
    assert np.isin(cut.kept, whole.kept).all()


def test_without_merging_and_bound_every_knot_is_sent_as_it_is() -> None:
    plan = planned()
    assert plan.waypoints is plan.knots
    assert plan.kept == tuple(range(walk().knot_count))
    assert plan.times.tolist() == walk().times.tolist()


def test_a_merged_walk_is_less_than_half_as_long_and_keeps_every_swing() -> None:
    plan, every = planned(0.001), planned()
    assert estimate_seconds(plan.waypoints) < 0.5 * estimate_seconds(every.waypoints)
    swings = [foot for foot in range(4) if not walk().contact[:, foot].all()]
    for foot in swings:
        # Down, up and down again: lift-off, highest knot and touch-down are all sent.
        flags = plan.contact[:, foot].tolist()
        assert False in flags
        assert flags[0]
        assert flags[-1]
    feet = feet_in_robot(MODEL, every.knots.strokes)
    assert plan.hold_ok[0]
    assert plan.hold_ok[-1]
    assert sum(plan.hold_ok) >= 5
    highest = feet[..., 2].max()
    assert feet_in_robot(MODEL, plan.waypoints.strokes)[..., 2].max() == pytest.approx(highest, abs=1e-9)


def test_needed_knots_are_lift_off_top_and_touch_down() -> None:
    contact = np.ones((9, 4), dtype=np.bool_)
    contact[3:6, 1] = False
    feet = np.tile(MODEL.module_centres_robot, (9, 1, 1))
    feet[3:6, 1, 2] = [0.002, 0.003, 0.001]
    assert needed_knots(feet, contact) == (0, 2, 4, 6, 8)


def test_a_needed_knot_that_the_firmware_would_not_move_to_is_left_out() -> None:
    rows = np.array([0.0, 0.004, 0.0045, 0.009])[:, None] * np.ones((1, 12)) + 0.001
    knots = Waypoints(rows.reshape(-1, 4, 3), np.full(4, 0.4))
    contact = np.ones((4, 4), dtype=np.bool_)
    assert kept_knots(knots, contact, (0, 1, 2, 3), 0.001) == [0, 1, 3]
    contact[2, 0] = False
    assert kept_knots(knots, contact, (0, 1, 2, 3), 0.001) == [0, 1, 2, 3]
    contact[2, 0] = True
    assert kept_knots(knots, contact, (0, 1, 2, 3), 0.0001) == [0, 1, 2, 3]


def test_parts_of_a_move_with_all_feet_down_are_poses_to_hold() -> None:
    way = np.array([0.001, 0.009])[:, None] * np.ones((1, 12))
    plan = random_plan(way, 0.0, 0.8)
    assert plan.waypoints.count > 3
    assert all(plan.hold_ok)
    moving = planned(0.001, 0.8)
    parts = [i for i in range(1, moving.waypoints.count) if moving.kept[i] == moving.kept[i - 1]]
    assert {moving.hold_ok[i - 1] for i in parts} == {True, False}


@pytest.mark.parametrize("bound", [0.4, 0.76, float("nan")])
def test_a_bound_below_what_moves_anything_is_refused(bound: float) -> None:
    with pytest.raises(InputError, match=r"must be at least 0\.77 s"):
        planned(0.001, bound)


@pytest.mark.parametrize("merge", [-0.001, float("nan")])
def test_a_tolerance_that_is_none_is_refused(merge: float) -> None:
    with pytest.raises(InputError, match="must be at least 0"):
        planned(merge)
