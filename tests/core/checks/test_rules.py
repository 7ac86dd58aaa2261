"""Checks: each rule finds what breaks it, and a good plan passes."""

from __future__ import annotations

from dataclasses import replace
from datetime import UTC, datetime

import numpy as np
import pytest

from core.arrays import Floats
from core.checks.checked_plan import CheckedPlan
from core.checks.rules import check_plan, check_waypoints
from core.checks.simulation import NOT_SIMULATED
from core.errors import StateError
from core.findings import Severity, Verdict, approve
from core.gait.manual_motion import manual_motion
from core.library.library import manual_entry
from core.motion.trajectory import Trajectory
from core.robot.model import load_robot
from core.wire.waypoint_path import waypoints_from_trajectory
from core.wire.waypoints import Waypoints

MODEL = load_robot("deltawalker")
NOON = datetime(2026, 11, 21, 12, tzinfo=UTC)


def standing(knots: int = 5) -> Trajectory:
    body = np.tile([0.0, 0.0, 0.0735], (knots, 1))
    feet = np.tile(MODEL.module_centres_robot, (knots, 1, 1))
    return Trajectory(
        np.linspace(0.0, 1.6, knots), body, np.zeros(knots), feet, np.ones((knots, 4), dtype=np.bool_)
    )


def plan_of(trajectory: Trajectory, travel: Floats | None = None) -> CheckedPlan:
    return CheckedPlan(MODEL, trajectory, waypoints_from_trajectory(MODEL, trajectory), travel)


def errors(verdict: Verdict) -> set[str]:
    return {f.rule for f in verdict.findings if f.severity is Severity.ERROR}


def warnings(verdict: Verdict) -> set[str]:
    return {f.rule for f in verdict.findings if f.severity is Severity.WARNING}


def test_standing_still_passes_and_is_told_that_it_was_not_simulated() -> None:
    verdict = check_plan(plan_of(standing(), np.zeros(2)))
    assert verdict.passed
    assert verdict.findings == ()
    assert NOT_SIMULATED in verdict.notes
    assert all(m.margin is None or m.margin >= 0 for m in verdict.margins)


def test_each_set_of_too_few_standing_feet_is_found() -> None:
    still = standing(8)
    contact = np.array(still.contact)
    contact[2:4, [1, 3]] = False
    contact[4, [0, 2]] = False
    contact[5] = False
    contact[6, 1:] = False
    body = still.body_world + [0.002, 0.0, 0.0]
    motion = replace(still, times=np.linspace(0.0, 2.8, 8), contact=contact, body_world=body)
    found = [f for f in check_plan(plan_of(motion)).findings if f.rule == "balance"]
    assert [(f.sample, f.severity) for f in found] == [
        (4, Severity.ERROR),
        (5, Severity.ERROR),
        (6, Severity.ERROR),
        (2, Severity.WARNING),
    ]
    assert "2.00 mm from the line between feet 2 and 4, which stand alone (1.6 to 1.6 s)" in found[0].sentence
    assert "no foot stands (2.0 to 2.0 s)" in found[1].sentence
    assert "38.00 mm from foot 1, which stands alone (2.4 to 2.4 s)" in found[2].sentence
    assert "0.00 mm from the line between feet 1 and 3, which stand alone (0.8 to 1.2 s)" in found[3].sentence


def test_a_body_outside_its_feet_tips() -> None:
    still = standing()
    contact = np.array(still.contact)
    contact[2, 0] = False
    body = np.array(still.body_world)
    body[2, 0] = 0.004
    verdict = check_plan(plan_of(replace(still, contact=contact, body_world=body)))
    assert errors(verdict) == {"balance"}
    finding = verdict.findings[0]
    assert finding.sample == 2
    assert finding.value == pytest.approx(-0.004)
    assert "4.00 mm outside the edge of the support polygon of feet 2, 3, 4" in finding.sentence


def test_a_sliding_foot_and_a_dragged_swing_are_warnings() -> None:
    still = standing()
    feet = np.array(still.feet_world)
    feet[3:, 1, 0] += 0.003
    contact = np.array(still.contact)
    contact[1:3, 2] = False
    verdict = check_plan(plan_of(replace(still, feet_world=feet, contact=contact)))
    assert warnings(verdict) >= {"slip", "clearance"}


def test_motors_that_cannot_follow_in_time_are_a_warning() -> None:
    still = standing()
    body = np.array(still.body_world)
    body[2, 2] += 0.008
    assert "motor_speed" in warnings(check_plan(plan_of(replace(still, body_world=body))))


def test_ending_elsewhere_than_the_document_says_is_an_error() -> None:
    assert errors(check_plan(plan_of(standing(), np.array([0.01, 0.0])))) == {"travel"}


def test_a_drawing_cannot_be_approved() -> None:
    verdict = check_plan(replace(plan_of(standing()), is_draft=True))
    assert errors(verdict) == {"computed"}
    with pytest.raises(StateError, match="only drawn"):
        approve(verdict, "Ada", NOON)


def test_strokes_out_of_range_are_named_by_motor() -> None:
    strokes = np.full((3, 4, 3), 0.0055)
    strokes[1, 2, 0] = 0.0198
    verdict = check_waypoints(MODEL, Waypoints(strokes, np.full(3, 0.4)))
    finding = next(f for f in verdict.findings if f.rule == "stroke")
    assert (finding.sample, finding.foot, finding.actuator) == (1, 2, 0)
    assert "Motor 1 of foot 3 would go to 19.80 mm at sample 2" in finding.sentence


def test_long_moves_say_how_long_the_robot_is_deaf() -> None:
    strokes = np.full((2, 4, 3), 0.0005)
    strokes[1] = 0.0195
    verdict = check_waypoints(MODEL, Waypoints(strokes, np.full(2, 0.4)))
    assert errors(verdict) == {"deafness"}
    assert not verdict.passed
    finding = next(f for f in verdict.findings if f.rule == "deafness")
    assert (finding.sample, finding.limit) == (1, 2.5)


@pytest.mark.parametrize("duration", [0.0, 0.009, 999.1, 1e9])
def test_a_duration_that_no_message_can_carry_is_an_error_where_it_is(duration: float) -> None:
    durations = np.array([0.4, 0.01, duration, 999.0])
    verdict = check_waypoints(MODEL, Waypoints(np.full((4, 4, 3), 0.0055), durations))
    assert errors(verdict) == {"duration"}
    finding = verdict.findings[0]
    assert (finding.sample, finding.value) == (2, duration)
    assert "Waypoint 3 has" in finding.sentence


def test_waypoints_alone_show_a_robot_on_two_feet() -> None:
    strokes = np.full((1, 4, 3), 0.0055)
    strokes[0, :2] = 0.0005
    assert errors(check_waypoints(MODEL, Waypoints(strokes, np.full(1, 0.4)))) == {"balance"}


def test_an_approval_binds_a_name_to_a_verdict() -> None:
    plan = plan_of(standing())
    verdict = check_plan(plan)
    approval = approve(verdict, " Ada ", NOON, accept_warnings=True)
    assert (approval.by, approval.waypoints_hash) == ("Ada", plan.waypoints.content_hash)
    assert approval.verdict_hash == verdict.content_hash
    assert approval.robot_hash == MODEL.parameters_hash
    with pytest.raises(StateError, match="name"):
        approve(verdict, " ", NOON, accept_warnings=True)


def test_warnings_stand_in_the_approval_and_block_it_until_they_are_accepted() -> None:
    verdict = check_plan(plan_of(manual_motion(manual_entry("walk", 0).gait, MODEL).trajectory))
    with pytest.raises(StateError, match=r"\d warnings are not accepted yet, the first: "):
        approve(verdict, "Ada", NOON)
    approval = approve(verdict, "Ada", NOON, accept_warnings=True)
    assert approval.warnings == tuple(f.sentence for f in verdict.warnings)
    assert check_waypoints(MODEL, plan_of(standing()).waypoints).warnings == ()


def test_other_parameters_of_the_robot_make_another_verdict() -> None:
    plan = plan_of(standing())
    heavier = replace(MODEL, masses=replace(MODEL.masses, foot=0.026))
    renamed = replace(MODEL, title="The old one")
    verdicts = [check_plan(replace(plan, model=model)) for model in (MODEL, heavier, renamed)]
    assert verdicts[0].content_hash != verdicts[1].content_hash
    assert verdicts[0].content_hash == verdicts[2].content_hash


def test_every_finding_has_its_remedy_at_the_end_of_its_sentence_and_most_their_time() -> None:
    verdict = check_plan(plan_of(manual_motion(manual_entry("walk", 2).gait, MODEL).trajectory))
    assert {f.rule for f in verdict.findings} == {"balance", "slip", "move_size"}
    for finding in verdict.findings:
        assert finding.remedy
        assert finding.sentence.endswith(finding.remedy)
    assert all(f.time is not None for f in verdict.findings)


def test_the_published_manual_walk_slips_and_its_version_2_tips() -> None:
    verdicts = [
        check_plan(plan_of(manual_motion(manual_entry("walk", version).gait, MODEL).trajectory))
        for version in (0, 2)
    ]
    assert warnings(verdicts[0]) == {"balance", "slip", "move_size"}
    assert verdicts[0].passed
    assert errors(verdicts[1]) == {"balance"}


def test_a_foot_that_is_said_to_stand_must_be_on_the_ground() -> None:
    still = standing()
    feet = np.array(still.feet_world)
    feet[2, 1, 2] = 0.004
    verdict = check_plan(plan_of(replace(still, feet_world=feet)))
    assert errors(verdict) == {"contact"}
    assert "Foot 2 should stand at 0.8 s but is 4.0 mm above the ground" in verdict.findings[0].sentence


def test_a_robot_without_a_standing_foot_falls_and_has_no_margin() -> None:
    still = standing()
    contact = np.array(still.contact)
    contact[2] = False
    verdict = check_plan(plan_of(replace(still, contact=contact)))
    finding = next(f for f in verdict.findings if f.rule == "balance")
    assert finding.value is None
    assert "no foot stands" in finding.sentence
    assert next(m for m in verdict.margins if m.rule == "balance").margin is None
