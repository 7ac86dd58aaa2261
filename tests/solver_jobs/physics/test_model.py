"""The compiled model against the parameters, the URDF, free fall and energy."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import mujoco
import numpy as np
import pytest

import robot_description
from core.arrays import Floats
from core.physics.masses import part_masses, physics_for
from core.physics.parameters import physics_set
from core.physics.problem import Rig
from core.robot.closed_chain import BODY, foot_joints, foot_link, knee_link, motor_joint
from core.robot.kinematics import BodyPose
from core.robot.model import ROBOT_NAMES, load_robot
from solver_jobs.physics.mjcf import arm_name, gravity_vector, mjcf_text
from tests.support.solvers.rigs import MODEL, SCALES

STEP = 0.001


def compiled(robot: str = "deltawalker", rig: Rig = Rig.WALKING) -> mujoco.MjModel:
    model = load_robot(robot)
    pose = BodyPose(np.zeros(3), np.asarray(0.0))
    return mujoco.MjModel.from_xml_string(mjcf_text(model, physics_for(model), rig, pose, STEP))


def urdf_places(robot: str) -> dict[str, Floats]:
    """Origin of every joint's frame in its parent's."""
    root = ElementTree.parse(Path(robot_description.__file__).parent / f"{robot}.urdf").getroot()
    places = {}
    for joint in root.iter("joint"):
        origin = joint.find("origin")
        assert origin is not None
        places[joint.attrib["name"]] = np.array(origin.attrib["xyz"].split(), dtype=np.float64)
    return places


@pytest.mark.parametrize("robot", ROBOT_NAMES)
def test_motors_and_feet_stand_where_the_urdf_has_them(robot: str) -> None:
    engine, places, model = compiled(robot), urdf_places(robot), load_robot(robot)
    for leg in range(model.leg_count):
        for motor in range(3):
            there = engine.body(knee_link(leg, motor)).pos
            np.testing.assert_allclose(there, places[motor_joint(leg, motor)], atol=1e-9)
            arm = engine.tendon(arm_name(leg, motor)).id
            assert engine.tendon_length0[arm] == pytest.approx(model.leg.link_length, abs=1e-12)
        foot = engine.body(foot_link(leg)).pos
        np.testing.assert_allclose(foot[:2], places[foot_joints(leg)[0]][:2], atol=1e-9)
        sole = engine.geom(foot_link(leg))
        assert sole.pos[2] - sole.size[0] == pytest.approx(-model.sole_depth)


@pytest.mark.parametrize("robot", ROBOT_NAMES)
def test_the_engine_weighs_what_the_parameters_say(robot: str) -> None:
    engine, model = compiled(robot), load_robot(robot)
    masses = part_masses(model, physics_for(model))
    assert engine.body_mass.sum() == pytest.approx(masses.total(model), abs=1e-4)
    assert engine.body(BODY).mass[0] == pytest.approx(masses.body)
    assert engine.body(BODY).ipos[2] == pytest.approx(model.com_height)


def dropped(height: float) -> tuple[mujoco.MjModel, mujoco.MjData]:
    """A robot with its motors held, in the air."""
    engine = compiled()
    data = mujoco.MjData(engine)
    data.qpos[2] = height
    mujoco.mj_forward(engine, data)
    return engine, data


def energy(engine: mujoco.MjModel, data: mujoco.MjData) -> float:
    """Of height, of motion and in the soft links, J."""
    mujoco.mj_energyPos(engine, data)
    mujoco.mj_energyVel(engine, data)
    yielded = data.actuator_length - data.ctrl
    return float(data.energy.sum() + SCALES.link_stiffness * (yielded**2).sum() / 2)


def test_a_dropped_robot_falls_freely_and_keeps_its_energy() -> None:
    engine, data = dropped(1.0)
    start = energy(engine, data)
    mujoco.mj_step(engine, data, 200)
    steps = 200
    fallen = SCALES.gravity * STEP**2 * steps * (steps + 1) / 2
    assert 1.0 - data.qpos[2] == pytest.approx(fallen, rel=1e-9)
    # A step of the integration moves the energy by m·g²·dt²/2, no more.
    assert energy(engine, data) == pytest.approx(start, abs=0.570 * SCALES.gravity**2 * STEP * 0.2)


def test_a_landing_robot_only_loses_energy() -> None:
    engine, data = dropped(0.048 + 0.005)
    start = before = energy(engine, data)
    # In free fall the integration adds m·g²·dt/2 a second.
    rounding = 1.05 * 0.570 * SCALES.gravity**2 * STEP / 2 * 0.02
    for _ in range(20):
        mujoco.mj_step(engine, data, 20)
        now = energy(engine, data)
        assert now < before + rounding
        before = now
    assert float(np.abs(data.qvel).max()) < 1e-3
    assert start - now == pytest.approx(0.570 * SCALES.gravity * 0.005, rel=0.01)


def test_gravity_on_sloping_ground_has_its_length_and_points_downhill() -> None:
    towards_x = gravity_vector(replace(SCALES, ground_tilt=(0.0, 0.1)))
    towards_y = gravity_vector(replace(SCALES, ground_tilt=(-0.1, 0.0)))
    np.testing.assert_allclose(towards_x, 9.81 * np.array([np.sin(0.1), 0, -np.cos(0.1)]), atol=1e-12)
    np.testing.assert_allclose(towards_y, 9.81 * np.array([0, np.sin(0.1), -np.cos(0.1)]), atol=1e-12)
    both = gravity_vector(replace(SCALES, ground_tilt=(0.3, -0.2)))
    assert np.linalg.norm(both) == pytest.approx(9.81)


def test_a_clamped_body_has_no_freedom_and_a_floating_one_no_ground() -> None:
    assert compiled(rig=Rig.CLAMPED).nv == 24
    floating = compiled(rig=Rig.FLOATING)
    assert floating.nv == 30
    floor = floating.geom("floor").id
    assert floor not in {*floating.pair_geom1.tolist(), *floating.pair_geom2.tolist()}
    assert not floating.opt.gravity.any()


def test_the_body_s_factor_changes_its_mass_alone() -> None:
    heavier = part_masses(MODEL, replace(physics_set("published"), body_mass_factor=1.1))
    usual = part_masses(MODEL, physics_set("published"))
    assert heavier.body == pytest.approx(1.1 * usual.body)
    assert (heavier.knee, heavier.foot) == (usual.knee, usual.foot)
