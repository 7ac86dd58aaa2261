"""Shoes have a size: two of them never overlap, at a knot or on the way, and little room is a warning."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from core.arrays import Floats
from core.checks.checked_plan import CheckedPlan
from core.checks.rules import check_plan, check_waypoints
from core.findings import Finding, Severity, Verdict
from core.motion.trajectory import Trajectory
from core.robot.kinematics import walker_strokes
from core.robot.model import FootEnd, RobotModel, load_robot
from core.robot.shoes import SHOE_GAP, foot_distances, foot_pairs, neighbour_pairs
from core.wire.waypoint_merging import plan_waypoints
from core.wire.waypoint_path import waypoints_from_trajectory
from core.wire.waypoints import Waypoints

MODEL = load_robot("deltawalker")
SHOE = 0.025
PLANE = 0.0565


def brought_together(distances: Floats, model: RobotModel = MODEL) -> Trajectory:
    """Feet 1 and 2 standing so far apart at each sample, the others under their modules."""
    count, legs = len(distances), model.leg_count
    feet = np.tile(model.module_centres_robot, (count, 1, 1))
    between = feet[0, 1] - feet[0, 0]
    inwards = (np.linalg.norm(between) - distances)[:, None] / 2 * between / np.linalg.norm(between)
    feet[:, 0] += inwards
    feet[:, 1] -= inwards
    body = np.tile([0.0, 0.0, PLANE + model.com_height], (count, 1))
    contact = np.ones((count, legs), dtype=np.bool_)
    times = np.arange(count, dtype=np.float64) * 0.4
    return Trajectory(times, body, np.zeros(count), feet, contact)


def verdict(motion: Trajectory, merge: float = 0.0, model: RobotModel = MODEL) -> Verdict:
    way = plan_waypoints(model, motion, merge)
    return check_plan(CheckedPlan(model, motion, way.waypoints, way=way))


def of_shoes(given: Verdict) -> list[Finding]:
    return [finding for finding in given.findings if finding.rule == "shoe_distance"]


def test_overlapping_shoes_are_an_error_that_names_feet_sample_distance_and_a_remedy() -> None:
    given = verdict(brought_together(np.array([0.050, 0.035, 0.023, 0.035, 0.050])))
    (finding,) = of_shoes(given)
    assert (finding.severity, finding.sample, finding.foot, finding.limit) == (Severity.ERROR, 2, 0, SHOE)
    assert finding.value == pytest.approx(0.023)
    assert finding.sentence == (
        "At sample 3 (0.8 s) the shoes of feet 1 and 2 overlap: their middles are 23.0 mm apart, and a shoe "
        "is 25.0 mm across. Shorten the step, or move the footholds apart."
    )
    assert [m.margin for m in given.margins if m.rule == "shoe_distance"] == [pytest.approx(-0.002)]


@pytest.mark.parametrize(
    ("distance", "severities"),
    [
        (SHOE - 2e-6, [Severity.ERROR]),
        (SHOE, [Severity.WARNING]),
        (SHOE + SHOE_GAP - 2e-6, [Severity.WARNING]),
        (SHOE + SHOE_GAP, []),
    ],
)
def test_shoes_that_touch_warn_and_three_millimetres_of_room_are_enough(
    distance: float, severities: list[Severity]
) -> None:
    found = of_shoes(verdict(brought_together(np.full(3, distance))))
    assert [finding.severity for finding in found] == severities


def test_a_lifted_shoe_does_not_pass_over_another() -> None:
    motion = brought_together(np.full(3, 0.024))
    feet, contact = np.array(motion.feet_world), np.array(motion.contact)
    feet[1, 0, 2], contact[1, 0] = 0.004, False
    found = of_shoes(verdict(replace(motion, feet_world=feet, contact=contact)))
    assert [finding.severity for finding in found] == [Severity.ERROR]


def test_what_only_the_way_between_waypoints_brings_together_is_found_there() -> None:
    # Feet 1 and 2 change sides: straight in motor space they pass one another in the middle.
    apart = brought_together(np.array([0.027, 0.027]))
    between = apart.feet_world[0, 1] - apart.feet_world[0, 0]
    across = np.array([-between[1], between[0], 0.0]) / np.linalg.norm(between) * 0.008
    feet = np.array(apart.feet_world)
    feet[0, 0], feet[0, 1] = feet[0, 0] + across, feet[0, 1] - across
    feet[1, 0], feet[1, 1] = feet[1, 0] - across, feet[1, 1] + across
    assert foot_distances(feet)[:, 0].min() > SHOE + SHOE_GAP
    motion = replace(apart, feet_world=feet)
    found = [finding for finding in of_shoes(verdict(motion)) if finding.foot == 0]
    assert len(found) == 1
    words = "Between waypoints 1 and 2 the shoes of feet 1 and 2 come within 3 mm of each other"
    assert found[0].sentence.startswith(words)
    assert found[0].sample == 1


def test_what_merging_brings_together_asks_for_less_merging() -> None:
    # The feet make a bend round each other, which a coarse merging leaves out.
    motion = brought_together(np.array([0.0278, 0.0286, 0.0290, 0.0286, 0.0278]))
    between = motion.feet_world[0, 1] - motion.feet_world[0, 0]
    across = np.array([-between[1], between[0], 0.0]) / np.linalg.norm(between)
    feet = np.array(motion.feet_world)
    feet[:, 0] += np.linspace(0.002, -0.002, 5)[:, None] * across
    feet[:, 1] -= np.linspace(0.002, -0.002, 5)[:, None] * across
    bend = replace(motion, feet_world=feet)
    (finding,) = of_shoes(verdict(bend, merge=0.002))
    assert finding.remedy.startswith("Merge less")
    assert of_shoes(verdict(bend)) == []


def test_opposite_feet_are_judged_too() -> None:
    motion = brought_together(np.full(2, 0.040))
    feet = np.array(motion.feet_world)
    feet[:, [0, 2]] = [[0.013, 0.0, 0.005], [-0.013, 0.0, 0.005]]
    low = Waypoints(walker_strokes(MODEL, feet, motion.pose(MODEL)), np.full(2, 0.4))
    found = of_shoes(check_waypoints(MODEL, low))
    assert any("feet 1 and 3" in finding.sentence for finding in found)


def test_waypoints_alone_show_it_by_forward_kinematics() -> None:
    waypoints = waypoints_from_trajectory(MODEL, brought_together(np.array([0.040, 0.024])))
    (finding,) = of_shoes(check_waypoints(MODEL, waypoints))
    assert (finding.severity, finding.sample, finding.time) == (Severity.ERROR, 1, None)
    assert "Between waypoints 1 and 2 the shoes of feet 1 and 2 overlap" in finding.sentence
    single = Waypoints(waypoints.strokes[1:], waypoints.durations[1:])
    assert "At waypoint 1 the shoes" in of_shoes(check_waypoints(MODEL, single))[0].sentence


@pytest.mark.parametrize("name", ["deltawalker9", "deltawalker5"])
def test_a_robot_without_shoes_has_no_such_rule(name: str) -> None:
    bare = load_robot(name)
    assert bare.shoe_diameter is None
    still = brought_together(np.full(2, 0.040), bare)
    given = check_plan(CheckedPlan(bare, still, waypoints_from_trajectory(bare, still)))
    assert "shoe_distance" not in {margin.rule for margin in given.margins}


def test_other_shoes_are_other_parameters_and_another_colour_is_not() -> None:
    wide = replace(MODEL, shape=replace(MODEL.shape, sole_diameter=0.030))
    bare = replace(MODEL, shape=replace(MODEL.shape, foot_end=FootEnd.BARE))
    painted = replace(MODEL, shape=replace(MODEL.shape, rod_colour="#000000"))
    hashes = {model.parameters_hash for model in (MODEL, wide, bare, painted)}
    assert len(hashes) == 3
    assert painted.parameters_hash == MODEL.parameters_hash


def test_every_two_feet_are_a_pair_and_neighbours_stand_round_the_ring() -> None:
    assert foot_pairs(4).tolist() == [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]]
    assert neighbour_pairs(4).tolist() == [[0, 1], [1, 2], [2, 3], [3, 0]]
    assert neighbour_pairs(2).tolist() == [[0, 1]]
    centres = foot_distances(MODEL.module_centres_robot)
    side, across = 0.04 * np.sqrt(2), 0.08
    assert centres == pytest.approx(np.array([side, across, side, side, across, side]))
