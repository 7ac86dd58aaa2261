"""What the check says of robots whose motors share actuators."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from core.checks.checked_plan import CheckedPlan
from core.checks.made_plan import is_made, made_plan, unmade_words
from core.checks.rules import check_plan, check_waypoints
from core.findings import Severity, Verdict
from core.gait.gait import motion_problem
from core.gait.manual_motion import manual_motion
from core.library.library import manual_entry, optimised_entry
from core.motion.trajectory import Trajectory
from core.robot.model import load_robot
from core.wire.waypoint_path import waypoints_from_trajectory
from solver_jobs import solve_live

ROBOTS = {12: load_robot("deltawalker"), 9: load_robot("deltawalker9"), 5: load_robot("deltawalker5")}
GAITS = ("walk", "amble", "s-gait", "c-gait")


@cache
def motion(gait: str) -> Trajectory:
    return solve_live(motion_problem(optimised_entry(gait).gait, ROBOTS[12])).trajectory


def verdict(motors: int, trajectory: Trajectory) -> Verdict:
    model = ROBOTS[motors]
    return check_plan(CheckedPlan(model, trajectory, waypoints_from_trajectory(model, trajectory)))


def errors(of: Verdict) -> set[tuple[str, int | None]]:
    return {(found.rule, found.foot) for found in of.findings if found.severity is Severity.ERROR}


@pytest.mark.parametrize("gait", GAITS)
def test_with_twelve_motors_every_motion_is_made_and_nothing_is_said(gait: str) -> None:
    walk = motion(gait)
    assert is_made(ROBOTS[12], walk)
    assert unmade_words(ROBOTS[12], walk) == ""
    assert "coupling" not in {margin.rule for margin in verdict(12, walk).margins}


def test_with_nine_motors_the_walk_lifts_its_feet_slides_and_has_to_be_simulated() -> None:
    of = verdict(9, motion("walk"))
    assert errors(of) == {("made_travel", next(f.foot for f in of.findings if f.rule == "made_travel"))}
    assert "simulate: physics knows it more exactly" in of.findings[0].sentence
    warned = {(found.rule, found.foot) for found in of.warnings}
    assert {("slip", foot) for foot in range(4)} <= warned
    lost = next(found for found in of.warnings if found.rule == "coupling")
    assert lost.value is not None
    assert lost.value > 0.0025
    assert "The robot makes another motion: it goes" in lost.sentence
    assert "every foot lifts" in lost.sentence


@pytest.mark.parametrize("gait", ["amble", "s-gait", "c-gait"])
def test_with_nine_motors_gaits_that_do_not_get_on_do_not_pass(gait: str) -> None:
    of = verdict(9, motion(gait))
    assert not of.passed
    assert {rule for rule, _ in errors(of)} & {"made_travel", "lean", "clearance"}


@pytest.mark.parametrize("gait", GAITS)
def test_with_five_motors_no_foot_lifts_as_the_thesis_found(gait: str) -> None:
    of = verdict(5, motion(gait))
    assert {("clearance", foot) for foot in range(4)} <= errors(of)
    words = [found.sentence for found in of.findings if found.rule == "clearance"]
    assert all("does not lift" in sentence and "slides" in sentence for sentence in words)
    assert "feet 1, 2, 3 and 4 do not lift" in unmade_words(ROBOTS[5], motion(gait))


@pytest.mark.parametrize("gait", GAITS)
@pytest.mark.parametrize("motors", [9, 5])
def test_waypoints_alone_pass_only_where_their_motion_does(motors: int, gait: str) -> None:
    model = ROBOTS[motors]
    sent = waypoints_from_trajectory(model, motion(gait))
    assert check_waypoints(model, sent).passed <= verdict(motors, motion(gait)).passed


@pytest.mark.parametrize("motors", [9, 5])
def test_the_margin_is_that_of_the_motion_that_is_made(motors: int) -> None:
    margins = {margin.rule: margin.margin for margin in verdict(motors, motion("walk")).margins}
    assert margins["balance"] is not None
    assert 0.0 <= margins["balance"] < 0.001
    assert "contact" not in margins


@pytest.mark.parametrize("version", [0, 1, 2])
@pytest.mark.parametrize("family", ["walk", "amble", "s-gait"])
def test_no_gait_by_hand_lifts_a_foot_with_five_motors(family: str, version: int) -> None:
    plan = manual_motion(manual_entry(family, version).gait, ROBOTS[5]).trajectory
    assert max(swing.rise for swing in made_plan(ROBOTS[5], plan).swings) < 0.001


def test_waypoints_that_shared_motors_cannot_make_are_told_of() -> None:
    sent = waypoints_from_trajectory(ROBOTS[12], motion("walk"))
    rules = [found.rule for found in check_waypoints(ROBOTS[9], sent).findings]
    assert "coupling" in rules


def test_what_is_made_stands_at_the_knots_where_it_is_asked_for() -> None:
    made = made_plan(ROBOTS[9], motion("walk"))
    heights = made.poses.at(motion("walk").times, made.poses.motion.heights)
    assert heights.shape == (motion("walk").knot_count, 4)
    assert np.nanmax(heights) == pytest.approx(np.nanmax(made.poses.motion.heights), abs=5e-4)
