"""Poses of a whole plan against yourdfpy's forward kinematics of the same URDF."""

import json
import time
from importlib import resources
from typing import Any

import numpy as np
import pytest
import yourdfpy
from hypothesis import given
from hypothesis import strategies as st

from app.scene.overlay import FRAMES_A_SECOND, MOST_POSES, frames_a_second, plan_poses
from app.scene.poses import COM_NODE, ROBOT_ROOT, PoseBlob, node_names, pose_frames
from core.arrays import Floats
from core.errors import InputError
from core.gait.gait import motion_problem
from core.library.library import optimised_entry
from core.motion.trajectory import Trajectory
from core.problem.initial_guess import initial_guess
from core.robot.closed_chain import joint_values
from core.robot.coupled_strokes import real_strokes
from core.robot.kinematics import actuator_plane_pose, feet_in_modules, feet_in_world
from core.robot.leg import foot_from_strokes, strokes_from_foot
from core.robot.model import ROBOT_NAMES, RobotModel, load_robot


def matrix(pose: Floats) -> Floats:
    w, x, y, z = (float(value) for value in pose[:4])
    T = np.eye(4)
    T[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    T[:3, 3] = pose[4:]
    return T


def walk() -> tuple[RobotModel, Trajectory]:
    model = load_robot("deltawalker")
    return model, initial_guess(motion_problem(optimised_entry("walk").gait, model))


def header_of(data: bytes) -> tuple[dict[str, Any], int]:
    length = int.from_bytes(data[:4], "little")
    return json.loads(data[4 : 4 + length]), 4 + length


@pytest.mark.parametrize("name", ROBOT_NAMES)
def test_every_node_stands_where_the_urdf_puts_its_link(name: str) -> None:
    model = load_robot(name)
    random = np.random.default_rng(11)
    wanted = random.uniform(model.stroke.lower, model.stroke.upper, (1, model.leg_count, 3))
    strokes = real_strokes(model, wanted)
    com, heading = np.array([[0.02, -0.01, 0.075]]), np.array([0.4])
    feet_module = foot_from_strokes(model.leg, strokes)
    body = actuator_plane_pose(model, com, heading)
    asked = feet_in_world(model, foot_from_strokes(model.leg, wanted), body)
    blob = pose_frames(model, np.zeros(1), com, heading, asked)
    path = resources.files("robot_description").joinpath(f"{name}.urdf")
    urdf = yourdfpy.URDF.load(str(path), load_meshes=False)
    values = joint_values(model, strokes, feet_module)
    urdf.update_cfg({joint: float(column[0]) for joint, column in values.items()})
    T_world_body = matrix(blob.frames[0, 0].astype(float))
    for node, pose in zip(blob.names, blob.frames[0], strict=True):
        if node == COM_NODE:
            continue
        expected = T_world_body @ urdf.get_transform(node.removeprefix(f"{ROBOT_ROOT}/"), "body")
        assert np.abs(matrix(pose.astype(float)) - expected).max() < 1e-6, node


def test_body_hangs_the_height_of_the_mass_below_it_and_feet_are_where_the_plan_says() -> None:
    model, plan = walk()
    blob = pose_frames(model, plan.times, plan.body_world, plan.heading, plan.feet_world)
    frames = {name: blob.frames[:, index] for index, name in enumerate(blob.names)}
    body = plan.body_world[0] - [0, 0, model.com_height]
    assert np.allclose(frames["/robot/body"][0, 4:], body, atol=1e-7)
    assert np.allclose(frames["/robot/leg3_foot"][-1, 4:], plan.feet_world[-1, 2], atol=1e-7)
    assert np.allclose(frames[COM_NODE][:, 6], -model.sole_depth, atol=0.002)


@given(moment=st.floats(0.0, 1.0))
def test_frames_are_linear_between_knots(moment: float) -> None:
    model, plan = walk()
    blob = pose_frames(model, plan.times, plan.body_world, plan.heading, plan.feet_world, fps=20)
    index = round(moment * (len(blob.times) - 1))
    at = blob.names.index("/robot/leg2_foot")
    expected = [np.interp(blob.times[index], plan.times, plan.feet_world[:, 1, axis]) for axis in range(3)]
    assert np.allclose(blob.frames[index, at, 4:], expected, atol=1e-6)


def test_first_and_last_frame_are_the_first_and_last_knot() -> None:
    model, plan = walk()
    blob = pose_frames(model, plan.times, plan.body_world, plan.heading, plan.feet_world, fps=7.3)
    assert blob.times[0] == plan.times[0]
    assert blob.times[-1] == plan.times[-1]
    assert np.diff(blob.times).max() <= 1 / 7.3 + 1e-12


def test_a_foot_out_of_reach_is_drawn_and_not_hidden() -> None:
    model, plan = walk()
    feet = plan.feet_world.copy()
    feet[:, 0, 0] += 0.1
    blob = pose_frames(model, plan.times, plan.body_world, plan.heading, feet)
    assert np.isfinite(blob.frames).all()
    at = blob.names.index("/robot/leg1_foot")
    assert blob.frames[0, at, 4] == pytest.approx(feet[0, 0, 0], abs=1e-6)
    assert np.isnan(strokes_from_foot(model.leg, feet_in_modules(model, feet, plan.pose(model)))).any()


def test_feet_of_another_robot_are_refused() -> None:
    _, plan = walk()
    with pytest.raises(InputError, match="4 feet for a robot of 6 legs"):
        pose_frames(load_robot("hexapod"), plan.times, plan.body_world, plan.heading, plan.feet_world)


def test_counts_that_differ_are_refused() -> None:
    model, plan = walk()
    with pytest.raises(InputError, match="44 body"):
        pose_frames(model, plan.times, plan.body_world[1:], plan.heading, plan.feet_world)


def test_bytes_are_a_header_and_aligned_floats() -> None:
    model, plan = walk()
    blob = plan_poses(model, plan)
    data = blob.to_bytes()
    header, offset = header_of(data)
    assert offset % 4 == 0
    assert header["nodes"] == list(node_names(model))
    assert header["frames"] == len(blob.times)
    values = np.frombuffer(data[offset:], dtype="<f4").reshape(blob.frames.shape)
    assert np.array_equal(values, blob.frames)
    assert header["start"] + header["step"] * (header["frames"] - 1) == pytest.approx(plan.times[-1])


@pytest.mark.parametrize(
    ("robot", "samples", "sample_time"), [("dodecapod", 240, 0.4), ("deltawalker", 45, 0.4)]
)
def test_a_long_plan_of_many_feet_stays_small_and_keeps_its_samples(
    robot: str, samples: int, sample_time: float
) -> None:
    model = load_robot(robot)
    times = sample_time * np.arange(samples, dtype=np.float64)
    feet = np.zeros((samples, model.leg_count, 3))
    plan = Trajectory(times, np.zeros((samples, 3)), np.zeros(samples), feet, np.ones(feet.shape[:2], bool))
    wanted = frames_a_second(model, plan)
    frames = times[-1] * wanted + 1
    assert frames * len(node_names(model)) <= MOST_POSES + len(node_names(model))
    assert sample_time * wanted == pytest.approx(round(sample_time * wanted), abs=1e-9)
    assert wanted == FRAMES_A_SECOND or frames * len(node_names(model)) > MOST_POSES / 2


def test_overlay_says_what_stands_and_how_far_from_tipping() -> None:
    model, plan = walk()
    overlay = plan_poses(model, plan).overlay
    assert overlay is not None
    assert overlay["contact"] == plan.contact.tolist()
    assert len(overlay["margins"]) == plan.knot_count
    json.dumps(overlay, allow_nan=False)


def test_overlay_of_a_robot_in_the_air_is_still_json() -> None:
    model, plan = walk()
    flying = Trajectory(
        plan.times, plan.body_world, plan.heading, plan.feet_world, np.zeros_like(plan.contact)
    )
    assert isinstance(plan_poses(model, flying).to_bytes(), bytes)


def test_four_legs_need_at_most_fifty_moving_nodes() -> None:
    assert len(node_names(load_robot("deltawalker"))) <= 50


def test_a_plan_of_18_s_takes_less_than_30_ms() -> None:
    model, plan = walk()
    times = np.linspace(0, 18, plan.knot_count)
    taken = []
    for _ in range(5):
        began = time.thread_time()
        blob = pose_frames(model, times, plan.body_world, plan.heading, plan.feet_world)
        blob.to_bytes()
        taken.append(time.thread_time() - began)
    assert isinstance(blob, PoseBlob)
    assert min(taken) < 0.030
