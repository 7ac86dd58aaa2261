"""Rules on motors and firmware: what is too fast, too small or too long, and what is just allowed."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from core.checks.checked_plan import Asked, CheckedPlan
from core.checks.motors import (
    DEAF_LIMIT,
    acceleration_note,
    check_deafness,
    check_motor_acceleration,
    check_motor_speed,
    check_move_size,
    check_strokes,
    still_note,
)
from core.findings import Severity
from core.library.library import library
from core.motion.trajectory import Trajectory
from core.robot.model import load_robot
from core.wire.waypoint_merging import plan_waypoints
from core.wire.waypoint_path import waypoints_from_trajectory
from core.wire.waypoints import Waypoints

MODEL = load_robot("deltawalker")


def bobbing(step: float, knots: int = 6) -> CheckedPlan:
    """A body that goes up by `step` from each knot to the next, the last but one apart, 0.4 s apart."""
    heights = 0.0735 + step * np.arange(knots)
    body = np.stack([np.zeros(knots), np.zeros(knots), heights], axis=1)
    feet = np.tile(MODEL.module_centres_robot, (knots, 1, 1))
    contact = np.ones((knots, 4), dtype=np.bool_)
    trajectory = Trajectory(np.linspace(0.0, 0.4 * (knots - 1), knots), body, np.zeros(knots), feet, contact)
    return CheckedPlan(MODEL, trajectory, waypoints_from_trajectory(MODEL, trajectory))


def pose(*strokes: float) -> Waypoints:
    return Waypoints(np.tile(np.array(strokes)[:, None, None], (1, 4, 3)), np.full(len(strokes), 0.4))


def test_a_stroke_may_pass_its_range_by_rounding_and_no_more() -> None:
    assert check_strokes(MODEL, pose(0.0195 + 0.9e-6)).findings == ()
    found = check_strokes(MODEL, pose(0.0195 + 2e-6)).findings
    assert [(f.foot, f.sample) for f in found] == [(0, 0), (1, 0), (2, 0), (3, 0)]
    assert {f.severity for f in found} == {Severity.ERROR}


def test_deafness_counts_from_its_limit_on() -> None:
    assert check_deafness(pose(0.001, 0.016)).findings == ()
    finding = check_deafness(pose(0.0005, 0.0195)).findings[0]
    assert finding.severity is Severity.ERROR
    assert finding.value is not None
    assert finding.value > DEAF_LIMIT


def test_moves_within_the_firmware_threshold_are_counted_and_waits_are_not() -> None:
    finding = check_move_size(bobbing(0.0006)).findings[0]
    assert "At 3 of 6 waypoints, first at waypoint 2" in finding.sentence
    assert finding.remedy == "Merge waypoints within 1.0 mm."
    assert (finding.sample, finding.time) == (1, 0.4)
    assert check_move_size(bobbing(0.0)).findings == ()
    assert check_move_size(bobbing(0.0011)).findings == ()


def test_what_merging_leaves_of_small_moves_is_told_and_no_finding() -> None:
    plan = bobbing(0.0006)
    way = plan_waypoints(MODEL, plan.trajectory, merge=0.001)
    merged = replace(plan, waypoints=way.waypoints, way=way)
    assert check_move_size(merged).findings == ()
    assert still_note(merged) == ""
    tiny = replace(merged, waypoints=pose(0.005, 0.0055))
    assert check_move_size(tiny).findings == ()
    assert still_note(tiny).startswith(
        "At 1 of 2 waypoints, first at waypoint 2, no motor has more than 1.0 mm"
    )


@pytest.mark.parametrize(("step", "found"), [(0.0059, 0), (0.0061, 1)])
def test_motors_are_held_to_the_speed_of_the_robot(step: float, found: int) -> None:
    findings = check_motor_speed(bobbing(step, 3)).findings
    assert len(findings) == found
    assert all("motors make 15 mm/s" in f.sentence for f in findings)


def test_motors_are_held_to_the_speed_that_the_document_allows() -> None:
    plan = bobbing(0.003, 3)
    assert check_motor_speed(plan).findings == ()
    assert check_motor_speed(replace(plan, asked=Asked(motor_speed=0.008))).findings == ()
    finding = check_motor_speed(replace(plan, asked=Asked(motor_speed=0.007))).findings[0]
    assert "would need 7.5 mm/s" in finding.sentence
    assert "the gait allows 7 mm/s" in finding.sentence


def test_acceleration_is_a_finding_where_the_document_sets_a_limit_and_else_a_note() -> None:
    plan = bobbing(0.003, 3)
    assert check_motor_acceleration(plan) == []
    assert "of up to 18.8 mm/s², the robot's motors make 15 mm/s²" in acceleration_note(plan)
    assert acceleration_note(bobbing(0.002, 3)) == ""
    allowed = check_motor_acceleration(replace(plan, asked=Asked(motor_acceleration=0.019)))
    assert [len(outcome.findings) for outcome in allowed] == [0]
    [broken] = check_motor_acceleration(replace(plan, asked=Asked(motor_acceleration=0.018)))
    assert broken.findings[0].value == pytest.approx(0.01875)
    assert "the gait allows 18 mm/s²" in broken.findings[0].sentence


def test_every_gait_of_the_library_is_cut_so_that_it_may_be_sent() -> None:
    bounds = [entry.gait.options.stop_bound for entry in library().values()]
    assert all(bound is not None and bound <= DEAF_LIMIT for bound in bounds)
