"""Shoes of neighbouring feet collide in physics, and change nothing where they do not meet."""

from __future__ import annotations

from dataclasses import replace

import mujoco
import numpy as np
import pytest

from core.arrays import Floats
from core.physics.masses import physics_for
from core.physics.problem import Rig
from core.robot.kinematics import BodyPose
from core.robot.model import RobotModel, load_robot
from core.robot.shoes import foot_distances, neighbour_pairs
from solver_jobs import simulate
from solver_jobs.physics.mjcf import mjcf_text, shoe_name
from tests.support.solvers.cases import BARE
from tests.support.solvers.rigs import MODEL, problem_of_strokes, strokes_of, walk

SHOE = 0.025


def passing_through(apart: float) -> Floats:
    """Strokes that bring feet 1 and 2 from where they stand to so far from each other, m."""
    stand = MODEL.module_centres_robot + [0.0, 0.0, -0.0565]
    between = stand[1] - stand[0]
    inwards = (np.linalg.norm(between) - apart) / 2 * between / np.linalg.norm(between)
    near = stand.copy()
    near[0] += inwards
    near[1] -= inwards
    return np.stack([strokes_of(stand), strokes_of(near)])


def compiled(model: RobotModel) -> mujoco.MjModel:
    pose = BodyPose(np.zeros(3), np.asarray(0.0))
    return mujoco.MjModel.from_xml_string(mjcf_text(model, physics_for(model), Rig.WALKING, pose, 0.001))


@pytest.mark.parametrize("rig", [Rig.WALKING, Rig.CLAMPED])
def test_feet_that_are_sent_into_each_other_stop_at_their_shoes(rig: Rig) -> None:
    problem = problem_of_strokes(passing_through(0.022), rig)
    shod, bare = (simulate(replace(problem, model=model)) for model in (MODEL, BARE))
    assert foot_distances(bare.feet_world)[-1, 0] < 0.0235
    assert foot_distances(shod.feet_world)[-1, 0] == pytest.approx(SHOE, abs=0.0003)
    assert np.abs(shod.motor_forces[-1, :2]).max() > 1.5 * np.abs(bare.motor_forces[-1, :2]).max()


@pytest.mark.heavy
def test_shoes_that_keep_apart_feel_nothing_of_each_other() -> None:
    problem = walk("walk", step=0.010)
    shod, bare = (simulate(replace(problem, model=model)) for model in (MODEL, BARE))
    for name in ("body_world", "feet_world", "motor_forces", "ground_forces"):
        np.testing.assert_array_equal(getattr(shod, name), getattr(bare, name))


@pytest.mark.parametrize("name", ["deltawalker", "hexapod", "dodecapod"])
def test_shoes_are_as_wide_and_tall_as_the_robot_s_and_meet_their_neighbours(name: str) -> None:
    model = load_robot(name)
    engine = compiled(model)
    for leg in range(model.leg_count):
        shoe = engine.geom(shoe_name(leg))
        assert 2 * shoe.size[0] == pytest.approx(model.shoe_diameter)
        assert shoe.pos[2] - shoe.size[1] == pytest.approx(-model.sole_depth)
        assert shoe.pos[2] + shoe.size[1] == pytest.approx(0.0)
    names = [engine.geom(shoe_name(leg)).id for leg in range(model.leg_count)]
    met = {frozenset((int(a), int(b))) for a, b in zip(engine.pair_geom1, engine.pair_geom2, strict=True)}
    for first, second in neighbour_pairs(model.leg_count).tolist():
        assert frozenset((names[first], names[second])) in met
    assert len(met) == 2 * model.leg_count


@pytest.mark.parametrize("name", ["deltawalker9", "deltawalker5"])
def test_a_robot_without_shoes_has_none_in_physics(name: str) -> None:
    engine = compiled(load_robot(name))
    assert engine.npair == load_robot(name).leg_count
