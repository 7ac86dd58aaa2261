"""The independent checker: each family finds its own hand-made violation, and statics pass."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from core.errors import InputError
from core.gait.gait import heading_step, motion_problem
from core.gait.options import GaitOptions
from core.library.library import library
from core.motion.contact_timeline import ContactTimeline
from core.motion.support_polygon import GRAVITY
from core.motion.trajectory import Trajectory
from core.problem.motion_check import FAMILIES, OPTIONAL_FAMILIES, check_motion
from core.problem.motion_problem import Boundary, MotionProblem, Workspace
from core.robot.model import FootEnd, load_robot
from core.wire.trajectory_csv import parse_trajectory_csv
from tests.support.reference import reference_path

MODEL = load_robot("deltawalker")
KNOTS = 6


def standing_problem(swinging_foot: int | None = None) -> MotionProblem:
    """Stay where you are; perhaps with one foot in the air in the middle."""
    gait = replace(library()["walk"].gait, step=heading_step(library()["walk"].gait.orientation, 0.0))
    stance = np.ones((4, KNOTS), dtype=np.bool_)
    if swinging_foot is not None:
        stance[swinging_foot, 2:4] = False
    timeline = ContactTimeline(stance, np.zeros_like(stance), 0.4)
    problem = motion_problem(replace(gait, timeline=timeline), MODEL)
    return replace(problem, limits=GaitOptions().motion_limits())


def standing(problem: MotionProblem, **changes: np.ndarray) -> Trajectory:
    """Standing still on four feet, with some arrays exchanged."""
    forces = np.zeros((KNOTS, 4, 3))
    forces[:, :, 2] = MODEL.total_model_mass * GRAVITY / 4
    values = {
        "times": problem.timeline.times,
        "body_world": np.tile(problem.start.body_world, (KNOTS, 1)),
        "heading": np.zeros(KNOTS),
        "feet_world": np.tile(problem.start.feet_world, (KNOTS, 1, 1)),
        "contact": problem.timeline.contact,
        "body_velocity": np.zeros((KNOTS, 3)),
        "feet_velocity": np.zeros((KNOTS, 4, 3)),
        "contact_forces": forces,
    }
    return Trajectory(**{**values, **changes})


def test_standing_still_keeps_every_constraint() -> None:
    problem = standing_problem()
    check = check_motion(problem, standing(problem))
    assert check.confirmed
    assert check.max_violation < 1e-12
    assert check.min_margin == pytest.approx(0.04 / np.sqrt(2))
    assert check.min_cop_margin == pytest.approx(check.min_margin)


def shift(values: np.ndarray, index: tuple[int, ...], by: float) -> np.ndarray:
    changed = np.array(values)
    changed[index] += by
    return changed


def body(index: tuple[int, ...], by: float) -> Callable[[Trajectory], Trajectory]:
    return lambda t: replace(t, body_world=shift(t.body_world, index, by))


def feet(index: tuple[int, ...], by: float) -> Callable[[Trajectory], Trajectory]:
    return lambda t: replace(t, feet_world=shift(t.feet_world, index, by))


def feet_speed(index: tuple[int, ...], by: float) -> Callable[[Trajectory], Trajectory]:
    return lambda t: replace(t, feet_velocity=shift(np.array(t.feet_velocity), index, by))


def force(index: tuple[int, ...], by: float) -> Callable[[Trajectory], Trajectory]:
    return lambda t: replace(t, contact_forces=shift(np.array(t.contact_forces), index, by))


HAND_MADE = [
    ("boundary", body((0, 0), 0.001), 0.001),
    ("boundary", feet((KNOTS - 1, 2, 1), -0.002), 0.002),
    ("dynamics", body((2, 0), 0.001), 0.001),
    ("dynamics", force((2, 0, 2), 0.5), 0.5),
    ("body_height", body((3, 2), 0.0535), 0.0535 + 0.0535 - 0.0605),
    ("foot_height", feet((2, 1, 2), -0.003), 0.003),
    ("foot_speed", feet_speed((2, 1, 0), 0.020), 0.005),
    ("grounded_velocity", feet_speed((2, 1, 0), 0.001), 0.001),
    ("grounded_height", feet((2, 1, 2), 0.002), 0.00175),
    ("contact_force", force((1, 3, 2), -3.0), 3.0 - MODEL.total_model_mass * GRAVITY / 4),
    ("body_torque", force((1, 0, 2), 1.0), 0.04),
    ("workspace", feet((2, 0, 2), 0.007), None),
]


@pytest.mark.parametrize(("family", "break_it", "size"), HAND_MADE)
def test_a_hand_made_violation_is_found_in_its_family(
    family: str, break_it: Callable[[Trajectory], Trajectory], size: float | None
) -> None:
    problem = standing_problem()
    check = check_motion(problem, break_it(standing(problem)))
    assert not check.confirmed
    assert check.violations[family] > 1e-4
    if size is not None:
        assert check.violations[family] == pytest.approx(size, rel=1e-6)


def test_a_thrown_body_is_too_fast() -> None:
    problem = standing_problem()
    velocity = np.zeros((KNOTS, 3))
    velocity[2, 1] = 0.020
    check = check_motion(problem, standing(problem, body_velocity=velocity))
    assert check.violations["body_speed"] == pytest.approx(0.005)


def test_a_dragged_swing_lacks_clearance_and_a_pushing_foot_in_the_air_is_found() -> None:
    problem = standing_problem(swinging_foot=1)
    check = check_motion(problem, standing(problem))
    assert check.violations["clearance"] == pytest.approx(0.003)
    assert check.violations["floating_force"] == pytest.approx(MODEL.total_model_mass * GRAVITY / 4)


def test_a_margin_that_is_not_kept_counts_as_balance() -> None:
    problem = standing_problem()
    strict = replace(problem, limits=replace(problem.limits, margin=0.030))
    assert check_motion(strict, standing(strict)).violations["body_torque"] == pytest.approx(
        0.030 - 0.04 / np.sqrt(2)
    )


def test_the_cylinder_has_its_own_edge() -> None:
    problem = standing_problem()
    cylinder = replace(problem, limits=replace(problem.limits, workspace=Workspace.CYLINDER))
    assert check_motion(cylinder, standing(cylinder)).confirmed
    moved = feet((2, 0, 0), 0.014)(standing(cylinder))
    assert check_motion(cylinder, moved).violations["workspace"] == pytest.approx(0.0005)


OPTIONAL = [
    ("friction", 0.5, force((2, 1, 0), 1.0), 1.0 - 0.5 * MODEL.total_model_mass * GRAVITY / 4),
    ("motor_speed", 0.015, feet_speed((2, 1, 2), 0.020), 0.005),
    ("motor_acceleration", 0.015, feet_speed((2, 1, 2), 0.020), 0.020 / 0.4 - 0.015),
]


@pytest.mark.parametrize(("family", "limit", "break_it", "size"), OPTIONAL)
def test_an_optional_family_counts_only_where_it_is_asked_for(
    family: str, limit: float, break_it: Callable[[Trajectory], Trajectory], size: float
) -> None:
    problem = standing_problem()
    changes: dict[str, Any] = {family: limit}
    asked = replace(problem, limits=replace(problem.limits, **changes))
    broken = break_it(standing(problem))
    assert family not in check_motion(problem, broken).violations
    assert check_motion(asked, standing(asked)).confirmed
    assert check_motion(asked, broken).violations[family] == pytest.approx(size, rel=1e-6)


@pytest.mark.parametrize("feet_of_pair", [(0, 1), (3, 0), (0, 2)])
def test_shoes_that_are_too_near_are_found_for_any_two_feet(feet_of_pair: tuple[int, int]) -> None:
    problem = standing_problem()
    first, second = feet_of_pair
    places = standing(problem).feet_world.copy()
    places[2, first] = places[2, second] + [0.012, -0.016, 0.004]
    near = standing(problem, feet_world=places)
    assert check_motion(problem, near).violations["shoe_distance"] == pytest.approx(0.008)
    bare = replace(MODEL, shape=replace(MODEL.shape, foot_end=FootEnd.BARE))
    assert "shoe_distance" not in check_motion(replace(problem, model=bare), near).violations


def test_motor_speed_is_seen_from_the_turning_body() -> None:
    problem = standing_problem()
    turning = np.linspace(0.0, 0.5, KNOTS)
    limits = replace(problem.limits, motor_speed=0.001)
    turned = replace(problem, heading_profile=turning, limits=limits)
    # Standing feet move sideways in the module's frame at rate · radius, and motors 2 and 3 follow.
    found = check_motion(turned, standing(problem, heading=turning)).violations
    assert found["motor_speed"] > 0.001
    assert found["boundary"] == 0.0
    at_rest = replace(problem, limits=limits)
    assert check_motion(at_rest, standing(problem)).violations["motor_speed"] == 0.0


def test_a_heading_other_than_the_given_one_breaks_the_boundary() -> None:
    problem = standing_problem()
    check = check_motion(problem, standing(problem, heading=np.full(KNOTS, 0.01)))
    assert check.violations["boundary"] == pytest.approx(0.01)


def test_the_module_turns_with_the_body() -> None:
    problem = standing_problem()
    heading = np.full(KNOTS, 0.5)
    limits = replace(problem.limits, workspace=Workspace.CYLINDER)
    turned = replace(problem, heading_profile=heading, limits=limits)
    wanted = 2 * MODEL.radius * np.sin(0.25) - 0.0135
    found = check_motion(turned, standing(problem, heading=heading)).violations["workspace"]
    assert found == pytest.approx(wanted)


def test_uneven_knots_count_in_the_dynamics() -> None:
    problem = standing_problem()
    uneven = replace(problem, durations=np.array([0.1, 0.2, 0.3, 0.4, 0.5]))
    motion = standing(problem, times=uneven.times)
    assert check_motion(uneven, motion).confirmed
    velocity = np.zeros((KNOTS, 3))
    velocity[2, 0] = 0.001
    moved = check_motion(uneven, replace(motion, body_velocity=velocity))
    assert moved.violations["dynamics"] == pytest.approx(
        max(0.001 / 0.2 * MODEL.masses.body, 0.001 / 0.3 * MODEL.masses.body)
    )


@pytest.mark.parametrize(
    ("break_it", "size"),
    [
        (body((0, 0), 0.001), 0.001),
        (feet((KNOTS - 1, 2, 1), -0.002), 0.002),
        (feet_speed((0, 1, 0), 0.003), 0.003),
    ],
)
def test_a_cycle_that_does_not_close_breaks_the_boundary(
    break_it: Callable[[Trajectory], Trajectory], size: float
) -> None:
    problem = replace(standing_problem(), boundary=Boundary.PERIODIC)
    check = check_motion(problem, break_it(standing(problem)))
    assert check.violations["boundary"] == pytest.approx(size)


def test_a_cycle_may_pass_its_ends_at_speed_and_with_other_feet() -> None:
    problem = standing_problem()
    cycle = replace(problem, boundary=Boundary.PERIODIC)
    motion = standing(problem, body_velocity=np.full((KNOTS, 3), 0.001))
    motion = feet((0, 1, 0), 0.001)(feet((KNOTS - 1, 1, 0), 0.001)(motion))
    assert check_motion(cycle, motion).violations["boundary"] == 0.0
    assert check_motion(problem, motion).violations["boundary"] == pytest.approx(0.001)


def test_every_family_has_a_hand_made_violation() -> None:
    covered = {family for family, _, _ in HAND_MADE} | {"body_speed", "clearance", "floating_force"}
    assert covered == set(FAMILIES)
    assert {family for family, *_ in OPTIONAL} | {"shoe_distance"} == set(OPTIONAL_FAMILIES)


def test_the_published_walk_starts_below_the_body_height_bound() -> None:
    path = reference_path("trajectories/direction1/walk_a.csv")
    read = parse_trajectory_csv(path.read_text(), path.name).trajectory
    walk = library()["walk"].gait
    stance = np.array(read.contact.T)
    stance[:, -1] = True
    timeline = ContactTimeline(stance, np.zeros_like(stance), 0.4)
    problem = motion_problem(replace(walk, timeline=timeline), MODEL)
    forces = np.zeros((read.knot_count, 4, 3))
    check = check_motion(
        replace(problem, limits=GaitOptions(workspace=Workspace.CYLINDER).motion_limits()),
        replace(read, contact_forces=forces),
    )
    # Published start and goal lie below the body height bound (docs/sources.md).
    assert check.violations["body_height"] == pytest.approx(0.0003, abs=1e-5)
    assert not check.confirmed


def test_a_number_that_is_none_is_a_violation() -> None:
    problem = standing_problem()
    motion = standing(problem)
    broken = motion.body_velocity.copy() if motion.body_velocity is not None else np.zeros((KNOTS, 3))
    broken[2, 0] = np.nan
    # A frozen trajectory refuses nan; the checker must not depend on that.
    object.__setattr__(motion, "body_velocity", broken)
    assert check_motion(problem, motion).max_violation == float("inf")


def test_a_motion_with_other_times_is_not_the_problems() -> None:
    problem = standing_problem()
    slower = standing(problem, times=problem.times * 1.5)
    assert check_motion(problem, slower).violations["dynamics"] == pytest.approx(0.2 * (KNOTS - 1))


def test_a_motion_with_other_contact_is_refused() -> None:
    problem = standing_problem(swinging_foot=1)
    with pytest.raises(InputError, match="contact"):
        check_motion(problem, standing(problem, contact=np.ones((KNOTS, 4), dtype=np.bool_)))
