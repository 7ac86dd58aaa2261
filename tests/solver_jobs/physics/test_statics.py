"""What a simulated robot must do that anybody can work out by hand."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from core.errors import InfeasibleError, InputError
from core.physics.masses import part_masses, physics_for
from core.physics.metrics import rotations, tilts
from core.physics.parameters import physics_set
from core.physics.problem import Rig
from core.robot.kinematics import feet_in_robot
from core.robot.leg import foot_from_strokes
from core.robot.model import load_robot
from solver_jobs import simulate
from tests.support.solvers.rigs import MIDDLE, MODEL, SCALES, problem_of_strokes, resting, strokes_of

GRAVITY = SCALES.gravity


def test_each_of_four_feet_carries_a_quarter_of_the_weight() -> None:
    motion = simulate(problem_of_strokes(resting()))
    np.testing.assert_allclose(motion.ground_forces[..., 2], 0.570 * GRAVITY / 4, rtol=1e-4)
    assert np.abs(motion.ground_forces[..., :2]).max() < 1e-3


def test_three_feet_carry_the_weight_by_the_levers_of_the_centre_of_mass() -> None:
    strokes = resting()
    strokes[:, 0] -= 0.004
    # Foot 1 hangs in the air, and the others lie so far ahead that the body's middle is amid them.
    leaned = feet_in_robot(MODEL, strokes)[0] + np.array([0.010, 0.0, 0.0])
    strokes = np.repeat(strokes_of(leaned)[None], 2, 0)
    motion = simulate(problem_of_strokes(strokes))
    assert motion.ground_forces[-1, 0, 2] == 0.0
    feet, centre = motion.feet_world[-1, 1:], motion.centre_world[-1]
    levers = np.vstack([feet[:, 0], feet[:, 1], np.ones(3)])
    expected = np.linalg.solve(levers, 0.570 * GRAVITY * np.array([centre[0], centre[1], 1.0]))
    np.testing.assert_allclose(motion.ground_forces[-1, 1:, 2], expected, rtol=0.01)


def test_the_robot_sags_by_what_its_links_yield_and_no_more() -> None:
    motion = simulate(problem_of_strokes(resting()))
    per_motor = part_masses(MODEL, SCALES).body * GRAVITY / 12
    sag = motion.strokes[-1] - MIDDLE
    assert np.abs(sag).max() < 1e-6
    lowered = problem_of_strokes(resting()).plan.body_world[0, 2] - motion.body_world[-1, 2]
    assert lowered == pytest.approx(per_motor / SCALES.link_stiffness, rel=0.08)


def test_softer_links_sag_in_proportion() -> None:
    soft = replace(SCALES, link_stiffness=SCALES.link_stiffness / 4)
    sags = []
    for physics in (SCALES, soft):
        problem = problem_of_strokes(resting(), physics=physics)
        sags.append(problem.plan.body_world[0, 2] - simulate(problem).body_world[-1, 2])
    assert sags[1] == pytest.approx(4 * sags[0], rel=0.05)


def test_nothing_moves_on_slightly_sloping_ground() -> None:
    tilted = replace(SCALES, ground_tilt=(0.0, np.radians(1.0)))
    motion = simulate(problem_of_strokes(resting(4), physics=tilted))
    assert np.abs(motion.feet_world - motion.feet_world[0]).max() < 1e-5
    sideways = motion.ground_forces[-1, :, 0].sum()
    assert sideways == pytest.approx(-0.570 * GRAVITY * np.sin(np.radians(1.0)), rel=1e-3)


def test_a_robot_on_smooth_steep_ground_slides() -> None:
    smooth = replace(SCALES, ground_tilt=(0.0, np.radians(8.0)), friction=0.05)
    motion = simulate(problem_of_strokes(resting(3), physics=smooth))
    assert motion.body_world[-1, 0] - motion.body_world[0, 0] > 0.01


@pytest.mark.parametrize("heading", [0.0, 0.7])
def test_a_run_begins_where_its_plan_does(heading: float) -> None:
    problem = problem_of_strokes(resting(), heading=heading)
    motion = simulate(problem)
    np.testing.assert_allclose(motion.body_world[0, :2], problem.plan.body_world[0, :2], atol=1e-12)
    turned = rotations(motion.attitude)[0]
    assert np.arctan2(turned[1, 0], turned[0, 0]) == pytest.approx(heading, abs=1e-9)
    np.testing.assert_allclose(motion.feet_world[0], problem.plan.feet_world[0], atol=1e-4)


def test_a_clamped_leg_goes_where_forward_kinematics_says() -> None:
    random = np.random.default_rng(7)
    strokes = np.concatenate([resting(1), random.uniform(0.002, 0.018, (5, 4, 3))])
    floating = replace(SCALES, gravity=1e-9)
    motion = simulate(problem_of_strokes(strokes, Rig.CLAMPED, physics=floating))
    feet = foot_from_strokes(MODEL.leg, motion.strokes[motion.arrivals])
    turned = np.einsum("lij,nlj->nli", MODEL.R_robot_from_module, feet) + MODEL.module_centres_robot
    body = motion.body_world[motion.arrivals] - (0.0, 0.0, MODEL.com_height)
    np.testing.assert_allclose(motion.feet_world[motion.arrivals], turned + body[:, None], atol=2e-5)
    assert motion.loop_error < 2e-5


def test_a_floating_robot_keeps_its_centre_of_mass() -> None:
    random = np.random.default_rng(3)
    strokes = np.concatenate([resting(1), random.uniform(0.004, 0.014, (4, 4, 3))])
    motion = simulate(problem_of_strokes(strokes, Rig.FLOATING))
    way = motion.centre_world - motion.centre_world[0]
    assert np.abs(way).max() < 1e-6
    assert np.abs(motion.body_world - motion.body_world[0]).max() > 1e-4
    assert not motion.ground_forces.any()


@pytest.mark.parametrize("robot", ["deltawalker9", "deltawalker5", "hexapod", "dodecapod"])
def test_every_robot_stands(robot: str) -> None:
    model = load_robot(robot)
    motion = simulate(problem_of_strokes(resting(model=model), model=model))
    weight = part_masses(model, physics_for(model)).total(model) * GRAVITY
    np.testing.assert_allclose(motion.ground_forces[-1, :, 2].sum(), weight, rtol=1e-3)
    assert np.degrees(tilts(rotations(motion.attitude)).max()) < 0.01


def test_the_sets_of_masses_weigh_what_they_say() -> None:
    totals = {"scales": 0.570, "published": 0.746, "model": 0.500}
    for name, total in totals.items():
        masses = part_masses(MODEL, physics_set(name))
        assert masses.total(MODEL) == pytest.approx(total)
        assert min(masses.body, masses.foot) > 0


def test_a_robot_s_own_physics_are_by_the_scales_where_it_was_weighed() -> None:
    assert physics_for(MODEL).masses == "scales"
    assert physics_for(load_robot("hexapod")).masses == "model"
    assert physics_for(load_robot("hexapod"), "published").masses == "published"
    with pytest.raises(InputError, match="moon"):
        physics_for(MODEL, "moon")


def test_a_robot_that_was_never_weighed_is_refused_under_the_scales_masses() -> None:
    model = load_robot("hexapod")
    with pytest.raises(InputError, match="model") as refused:
        simulate(problem_of_strokes(resting(model=model), model=model, physics=SCALES))
    assert refused.value.where == "physics"


def test_strokes_whose_rods_do_not_meet_are_refused() -> None:
    strokes = resting()
    problem = problem_of_strokes(strokes)
    apart = strokes.copy()
    apart[:, 2, 0] = 0.19
    with pytest.raises(InfeasibleError, match="Foot 3"):
        simulate(replace(problem, waypoints=replace(problem.waypoints, strokes=apart)))
