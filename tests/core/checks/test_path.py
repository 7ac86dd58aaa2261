"""The path between waypoints: what merging may break is found, and what it costs is said."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from core.arrays import Floats
from core.checks.checked_plan import CheckedPlan
from core.checks.path import check_path
from core.checks.rules import check_plan
from core.findings import Severity, Verdict
from core.gait.manual_motion import manual_motion
from core.library.library import library
from core.motion.trajectory import Trajectory
from core.robot.model import load_robot
from core.wire.robot_time import OVERRUN
from core.wire.waypoint_merging import WaypointPlan, cut_plan, plan_of_knots, plan_waypoints
from core.wire.waypoint_path import waypoints_from_trajectory
from core.wire.waypoints import Waypoints

MODEL = load_robot("deltawalker")


@cache
def walk() -> Trajectory:
    return manual_motion(library()["walk-manual-0"].gait, MODEL).trajectory


def verdict(trajectory: Trajectory, merge: float, bound: float | None = None) -> Verdict:
    way = plan_waypoints(MODEL, trajectory, merge, bound)
    return check_plan(CheckedPlan(MODEL, trajectory, way.waypoints, way=way))


def standing(body_xy: Floats) -> Trajectory:
    """A robot that stands on feet 1, 2 and 3, with foot 4 in the air between, while its body goes about."""
    count = len(body_xy)
    feet = np.tile(MODEL.module_centres_robot, (count, 1, 1))
    contact = np.ones((count, 4), dtype=np.bool_)
    contact[1:-1, 3] = False
    feet[1:-1, 3, 2] = 0.003
    body = np.concatenate([body_xy, np.full((count, 1), 0.0735)], axis=1)
    return Trajectory(np.arange(count, dtype=np.float64) * 0.4, body, np.zeros(count), feet, contact)


def merged_too_far(trajectory: Trajectory, kept: list[int], merge: float) -> WaypointPlan:
    """A plan whose merging left out more than its tolerance allows."""
    whole = plan_of_knots(MODEL, trajectory, waypoints_from_trajectory(MODEL, trajectory))
    strokes = whole.knots.strokes[kept]
    spans = zip([0, *kept[:-1]], kept, strict=True)
    return replace(
        whole,
        waypoints=Waypoints(strokes, np.full(len(kept), 0.4)),
        kept=tuple(kept),
        times=whole.times[kept],
        contact=whole.contact[kept],
        standing=np.array([whole.contact[a : b + 1].all(axis=0) for a, b in spans]),
        merge=merge,
    )


def test_a_good_walk_passes_merged_and_says_its_seconds() -> None:
    found = verdict(walk(), 0.001, 1.0)
    assert found.passed
    assert {"path_balance", "path_ground", "path_clearance"} <= {m.rule for m in found.margins}
    assert [cost.stop_bound for cost in found.costs] == [None, 1.0, 0.8]
    assert [cost.is_chosen for cost in found.costs] == [False, True, False]
    free, one, short = found.costs
    assert free.merged_seconds < 0.5 * free.every_seconds
    assert free.merged_seconds < one.merged_seconds < short.merged_seconds
    # What the page says is what a person waits for: ramps last longer than the law that the bound goes by.
    assert 1.0 < one.stop_seconds <= 1.0 + OVERRUN
    assert 0.8 < short.stop_seconds <= 0.8 + OVERRUN
    assert any("up to 1.0 mm from its waypoint" in note for note in found.notes)


def test_another_chosen_bound_stands_in_the_table_too() -> None:
    assert [cost.stop_bound for cost in verdict(walk(), 0.0, 1.5).costs] == [None, 1.5, 1.0, 0.8]


def test_what_merging_breaks_is_an_error_with_a_tolerance_that_does_not() -> None:
    # The body goes out of the lifted foot's way before it lifts; the straight way does not.
    toward = MODEL.module_centres_robot[3, :2] / np.linalg.norm(MODEL.module_centres_robot[3, :2])
    swerve = standing(np.outer([0.0015, -0.001, -0.001, -0.001, -0.001, -0.001, 0.0015], toward))
    contact, feet = np.array(swerve.contact), np.array(swerve.feet_world)
    contact[[1, 5], 3], feet[[1, 5], 3, 2] = True, 0.0
    swerve = replace(swerve, contact=contact, feet_world=feet)
    plan = merged_too_far(swerve, [0, 3, 6], 0.001)
    (finding,) = next(o for o in check_path(MODEL, swerve, plan) if o.margin.rule == "path_balance").findings
    assert finding.severity is Severity.ERROR
    # At its height the swerve is half a millimetre too far; nearer to its ends foot 4 still touches.
    assert finding.value == pytest.approx(-0.0006, abs=2e-4)
    assert "outside every foot near the ground" in finding.sentence
    assert "merge within 0.75 mm at most" in finding.sentence


@pytest.mark.parametrize("outside", [0.0004, 0.004])
def test_a_path_on_which_the_robot_tips_is_an_error_however_it_is_merged(outside: float) -> None:
    toward = MODEL.module_centres_robot[3, :2] / np.linalg.norm(MODEL.module_centres_robot[3, :2])
    tipping = standing(np.outer([0.0, outside, outside, outside, 0.0], toward))
    way = plan_waypoints(MODEL, tipping, 0.001)
    (finding,) = next(o for o in check_path(MODEL, tipping, way) if o.margin.rule == "path_balance").findings
    assert finding.severity is Severity.ERROR
    assert "one waypoint a sample as well" in finding.sentence
    assert finding.value == pytest.approx(-outside, abs=2e-4)


def test_a_finding_on_a_part_of_a_move_is_at_the_knot_of_its_own_time() -> None:
    toward = MODEL.module_centres_robot[3, :2] / np.linalg.norm(MODEL.module_centres_robot[3, :2])
    coming = standing(np.outer([0.012, 0.006, 0.0, -0.006, -0.012], toward))
    way = cut_plan(merged_too_far(coming, [0, 4], 0.001), 0.8)
    (finding,) = next(o for o in check_path(MODEL, coming, way) if o.margin.rule == "path_balance").findings
    assert finding.sample is not None
    assert finding.time is not None
    assert coming.times[finding.sample - 1] < finding.time <= coming.times[finding.sample] < coming.times[-1]


def test_feet_that_hand_over_within_a_move_are_a_warning() -> None:
    still = standing(np.zeros((5, 2)))
    contact, feet = np.array(still.contact), np.array(still.feet_world)
    contact[2:-1, 3], feet[2:-1, 3, 2] = True, 0.0
    contact[2:-1, 0], feet[2:-1, 0, 2] = False, 0.0009
    swapping = replace(still, contact=contact, feet_world=feet)
    way = plan_waypoints(MODEL, swapping, 0.0)
    (finding,) = next(o for o in check_path(MODEL, swapping, way) if o.margin.rule == "path_balance").findings
    assert finding.severity is Severity.WARNING
    assert "while feet hand over" in finding.sentence


def test_a_swing_that_merging_flattens_is_an_error() -> None:
    still = standing(np.zeros((5, 2)))
    plan = merged_too_far(still, [0, 4], 0.001)
    (finding,) = next(o for o in check_path(MODEL, still, plan) if o.margin.rule == "path_clearance").findings
    assert finding.severity is Severity.ERROR
    assert "foot 4 rises only" in finding.sentence
    assert "merge within 0.75 mm at most" in finding.sentence


def test_a_standing_foot_that_leaves_the_ground_on_the_way_is_an_error() -> None:
    still = standing(np.zeros((5, 2)))
    still = replace(
        still,
        contact=np.ones((5, 4), dtype=np.bool_),
        feet_world=np.tile(MODEL.module_centres_robot, (5, 1, 1)),
    )
    plan = plan_waypoints(MODEL, still, 0.001)
    strokes = np.array(plan.waypoints.strokes)
    strokes[-1, 3] -= 0.006
    plan = replace(plan, waypoints=Waypoints(strokes, plan.waypoints.durations))
    (finding,) = next(o for o in check_path(MODEL, still, plan) if o.margin.rule == "path_ground").findings
    assert finding.severity is Severity.ERROR
    assert "off the plane of the standing feet, more than 1.0 mm" in finding.sentence


def test_coupled_motors_are_judged_by_their_own_rule() -> None:
    model = load_robot("deltawalker5")
    motion = manual_motion(replace(library()["walk-manual-0"].gait, robot="deltawalker5"), model).trajectory
    assert check_path(model, motion, plan_waypoints(model, motion, 0.001)) == []
