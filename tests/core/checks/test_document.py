"""Rules on what the document says: where it goes, how high, how it begins, and what it was made from."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from core.checks.checked_plan import Asked, CheckedPlan, asked_of
from core.checks.rules import check_plan
from core.findings import Finding, Severity
from core.gait.held_feet import HeldFeet
from core.library.library import library, manual_entry
from core.motion.trajectory import Trajectory
from core.robot.model import load_robot
from core.wire.waypoint_path import waypoints_from_trajectory

MODEL = load_robot("deltawalker")
HEIGHT = 0.0535


def still(turn: float = 0.0, up: tuple[int, ...] = ()) -> CheckedPlan:
    """A body that stands and turns, feet of `up` in the air at the first of five knots."""
    knots = 5
    contact = np.ones((knots, 4), dtype=np.bool_)
    contact[0, [foot - 1 for foot in up]] = False
    feet = np.tile(MODEL.module_centres_robot, (knots, 1, 1))
    feet[0, [foot - 1 for foot in up], 2] = 0.003
    body = np.tile([0.0, 0.0, HEIGHT + MODEL.com_height], (knots, 1))
    heading = np.linspace(0.0, turn, knots)
    trajectory = Trajectory(np.linspace(0.0, 1.6, knots), body, heading, feet, contact)
    return CheckedPlan(MODEL, trajectory, waypoints_from_trajectory(MODEL, trajectory))


def found(plan: CheckedPlan, rule: str) -> list[Finding]:
    return [finding for finding in check_plan(plan).findings if finding.rule == rule]


@pytest.mark.parametrize(("gap", "count"), [(0.0009, 0), (0.001, 0), (0.0011, 1)])
def test_the_body_ends_where_the_document_says(gap: float, count: int) -> None:
    assert len(found(replace(still(), expected_displacement=np.array([gap, 0.0])), "travel")) == count


@pytest.mark.parametrize(("turn_deg", "count"), [(9.1, 0), (10.9, 0), (8.9, 1), (11.1, 1)])
def test_the_body_ends_turned_as_the_document_says(turn_deg: float, count: int) -> None:
    plan = replace(still(np.deg2rad(turn_deg)), asked=Asked(turn=np.deg2rad(10.0)))
    findings = found(plan, "turn")
    assert [f.severity for f in findings] == [Severity.ERROR] * count
    assert all(f.sample == 4 and f.remedy == "Optimise again, or correct the turn." for f in findings)


def test_a_turn_in_the_other_direction_is_found() -> None:
    assert (
        "20.0° from what the gait says"
        in found(replace(still(np.deg2rad(10.0)), asked=Asked(turn=np.deg2rad(-10.0))), "turn")[0].sentence
    )


@pytest.mark.parametrize("end", [0, 1])
def test_the_body_begins_and_ends_as_high_as_the_document_says(end: int) -> None:
    heights = [HEIGHT, HEIGHT]
    heights[end] += 0.0009
    assert found(replace(still(), asked=Asked(heights=(heights[0], heights[1]))), "height") == []
    heights[end] += 0.0002
    finding = found(replace(still(), asked=Asked(heights=(heights[0], heights[1]))), "height")[0]
    assert finding.sample == (0, 4)[end]
    assert f"The body {('begins', 'ends')[end]} 53.5 mm high, where the gait says 54.6 mm" in finding.sentence


def test_a_run_begins_on_three_feet_and_those_in_the_air_are_so_on_purpose() -> None:
    assert found(still(), "start_pose") == []
    forgotten = found(still(up=(2,)), "start_pose")
    assert [(f.severity, f.foot) for f in forgotten] == [(Severity.WARNING, 1)]
    assert found(replace(still(up=(2,)), asked=Asked(held=HeldFeet(start=(2,)))), "start_pose") == []
    assert found(still(up=(2, 4)), "start_pose")[0].severity is Severity.ERROR


def test_a_margin_that_the_document_asks_for_is_a_warning_where_it_is_not_kept() -> None:
    plan = still()
    inner = np.array(plan.trajectory.contact)
    inner[2, 0] = False
    moved = np.array(plan.trajectory.body_world)
    moved[2, 0] = -0.002
    plan = replace(plan, trajectory=replace(plan.trajectory, contact=inner, body_world=moved))
    assert found(plan, "balance") == []
    asked = replace(plan, asked=Asked(margin=0.003))
    finding = found(asked, "balance")[0]
    assert (finding.severity, finding.limit) == (Severity.WARNING, 0.003)
    assert "less than the 3.0 mm that the gait asks for" in finding.sentence
    assert found(replace(plan, asked=Asked(margin=0.002)), "balance") == []


def test_a_plan_of_another_version_is_an_error() -> None:
    assert found(still(), "fresh") == []
    finding = found(replace(still(), is_fresh=False), "fresh")[0]
    assert (finding.severity, finding.remedy) == (Severity.ERROR, "Check again.")


def test_only_what_is_computed_is_held_to_the_options_of_the_optimiser() -> None:
    computed, by_hand = library()["walk"].gait, manual_entry("walk", 0).gait
    limited = computed.with_options(margin=0.003, motor_speed=0.01, motor_acceleration=0.02)
    asked = asked_of(limited)
    assert (asked.margin, asked.motor_speed, asked.motor_acceleration) == (0.003, 0.01, 0.02)
    assert asked.heights == (0.0535, 0.0535)
    assert asked_of(by_hand.with_options(margin=0.003)) == Asked(turn=0.0)
