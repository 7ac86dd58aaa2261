"""The same plan on every processor: rounding chooses no waypoints, statuses, findings or sentences."""

from __future__ import annotations

import re

import numpy as np
import pytest

from app.bench.common.random_drawings import Family, random_drawing
from app.bench.common.random_gaits import random_gait
from app.plans.plan import Plan, verdict_of
from app.plans.sequence_plan import plan_of
from core.arrays import SAME
from core.gait.gait import Gait
from core.library.library import library
from core.library.robot_times import library_times
from core.wire.robot_time import estimate_seconds
from core.wire.waypoint_merging import plan_of_knots
from core.wire.waypoints import Waypoints
from solver_jobs import solve_live
from tests.support.shaken import NOISE, shaken

SEED = 11
RANDOM = range(50)
MERGED = [gait_id for gait_id in library_times() if library()[gait_id].gait.poses is None]


def plan(gait: Gait) -> Plan:
    return plan_of(gait, lambda motion: None, lambda single: solve_live)


def require_same(gait: Gait) -> None:
    """The plan of a gait, and the one from shaken programs, are the same to a person and to the robot."""
    plain = plan(gait)
    with shaken():
        other = plan(gait)
    assert other.source is plain.source
    assert _untimed(other.note) == _untimed(plain.note)
    if plain.live is not None and other.live is not None:
        assert other.live.status is plain.live.status
        assert other.live.explanation == plain.live.explanation
        assert other.live.result.evidence is plain.live.result.evidence
    if plain.trajectory is not None and other.trajectory is not None:
        assert np.abs(other.trajectory.body_world - plain.trajectory.body_world).max() < SAME
        assert np.abs(other.trajectory.feet_world - plain.trajectory.feet_world).max() < SAME
    assert (other.way is None) == (plain.way is None)
    if plain.way is not None and other.way is not None:
        assert other.way.kept == plain.way.kept
        assert np.array_equal(other.way.contact, plain.way.contact)
        assert np.array_equal(other.way.standing, plain.way.standing)
        seconds = estimate_seconds(plain.way.waypoints)
        assert estimate_seconds(other.way.waypoints) == pytest.approx(seconds, abs=1e-3)
        if not plain.is_draft:
            assert findings(other, gait) == findings(plain, gait)


def findings(a_plan: Plan, gait: Gait) -> list[tuple[object, ...]]:
    """Which rules are broken, and where; not by how much."""
    return [(f.rule, f.severity, f.foot, f.actuator, f.sample) for f in verdict_of(a_plan, gait).findings]


def _untimed(note: str) -> str:
    return re.sub(r"\d+ ms", "… ms", note)


@pytest.mark.parametrize("gait_id", library())
def test_a_gait_of_the_library_has_the_same_plan_on_another_processor(gait_id: str) -> None:
    require_same(library()[gait_id].gait)


@pytest.mark.parametrize("number", RANDOM)
def test_a_random_gait_has_the_same_plan_on_another_processor(number: int) -> None:
    require_same(random_gait(SEED, number).gait)


@pytest.mark.parametrize("number", range(15))
@pytest.mark.parametrize("family", Family)
def test_a_drawing_without_a_motion_has_the_same_explanation_on_another_processor(
    family: Family, number: int
) -> None:
    require_same(random_drawing(SEED, number, family).gait)


@pytest.mark.parametrize("gait_id", MERGED)
def test_strokes_that_differ_by_rounding_merge_to_the_same_waypoints(gait_id: str) -> None:
    found = plan(library()[gait_id].gait)
    assert found.way is not None
    assert found.trajectory is not None
    knots, random = found.way.knots, np.random.default_rng(0)
    for _ in range(5):
        noise = random.uniform(-NOISE, NOISE, knots.strokes.shape)
        off = Waypoints(knots.strokes + noise, knots.durations)
        way = plan_of_knots(found.model, found.trajectory, off, found.way.merge, found.way.stop_bound)
        assert way.kept == found.way.kept
        assert np.array_equal(way.contact, found.way.contact)


@pytest.mark.parametrize("gait_id", ["walk", "s-gait", "hexapod-ripple", "hexapod-wave"])
def test_a_swing_that_rises_just_as_far_as_it_has_to_drags_nowhere(gait_id: str) -> None:
    gait = library()[gait_id].gait.with_options(clearance=0.001)
    rules = [f.rule for f in verdict_of(plan(gait), gait).findings]
    assert "path_clearance" not in rules
    require_same(gait)
