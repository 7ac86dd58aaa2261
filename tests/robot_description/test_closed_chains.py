"""The drawn chains are closed: measured with yourdfpy's own forward kinematics."""

from importlib import resources

import numpy as np
import pytest
import yourdfpy

from core.arrays import Floats
from core.robot.closed_chain import TWINS, foot_link, joint_values, rod_link
from core.robot.leg import foot_from_strokes, vertex_directions
from core.robot.model import ROBOT_NAMES, RobotModel, load_robot

CLOSED = 1e-9


@pytest.fixture(scope="module", params=ROBOT_NAMES)
def robot(request: pytest.FixtureRequest) -> tuple[RobotModel, yourdfpy.URDF]:
    path = str(resources.files("robot_description").joinpath(f"{request.param}.urdf"))
    urdf = yourdfpy.URDF.load(path, build_scene_graph=True, load_meshes=False)
    return load_robot(request.param), urdf


def reachable_strokes(model: RobotModel, seed: int, count: int) -> Floats:
    """Random strokes of every motor, the first poses at the corners of the motors' range."""
    low, high = model.stroke.lower, model.stroke.upper
    strokes = np.random.default_rng(seed).uniform(low, high, (count, model.leg_count, 3))
    corners = np.array([[low, low, low], [high, high, high], [low, high, low], [high, low, high]])
    strokes[: len(corners)] = corners[:, None, :]
    return strokes


def pose(urdf: yourdfpy.URDF, values: dict[str, Floats], index: int) -> None:
    urdf.update_cfg({name: float(column[index]) for name, column in values.items()})


def platform_anchor(model: RobotModel, motor: int, side: float) -> Floats:
    outwards = vertex_directions()[motor]
    tangential = np.array([-outwards[1], outwards[0]])
    at = model.leg.platform_radius * outwards + side * model.shape.rod_spacing / 2 * tangential
    return np.array([*at, 0.0, 1.0])


def worst_gaps(model: RobotModel, urdf: yourdfpy.URDF) -> tuple[float, float]:
    knee_gap, platform_gap = 0.0, 0.0
    bottom = np.array([0, 0, -model.leg.link_length, 1.0])
    for leg in range(model.leg_count):
        T_body_foot = urdf.get_transform(foot_link(leg), "body")
        for motor in range(3):
            T_body_knee = urdf.get_transform(f"leg{leg + 1}_knee{motor + 1}", "body")
            for twin, side in zip(TWINS, (-1.0, 1.0), strict=True):
                T_body_rod = urdf.get_transform(rod_link(leg, motor, twin), "body")
                knee = T_body_knee @ np.array([0, side * model.shape.rod_spacing / 2, 0, 1.0])
                knee_gap = max(knee_gap, float(np.linalg.norm(T_body_rod[:, 3] - knee)))
                gap = T_body_rod @ bottom - T_body_foot @ platform_anchor(model, motor, side)
                platform_gap = max(platform_gap, float(np.linalg.norm(gap)))
    return knee_gap, platform_gap


def test_both_ends_of_every_rod_lie_on_their_anchors_in_reachable_poses(
    robot: tuple[RobotModel, yourdfpy.URDF],
) -> None:
    model, urdf = robot
    count = 40 if model.leg_count == 4 else 8
    strokes = reachable_strokes(model, seed=7, count=count)
    values = joint_values(model, strokes, foot_from_strokes(model.leg, strokes))
    for index in range(count):
        pose(urdf, values, index)
        knee_gap, platform_gap = worst_gaps(model, urdf)
        assert knee_gap < CLOSED
        assert platform_gap < CLOSED


def test_a_wrong_stroke_opens_the_chain() -> None:
    model = load_robot("deltawalker")
    urdf = yourdfpy.URDF.load(
        str(resources.files("robot_description").joinpath("deltawalker.urdf")), load_meshes=False
    )
    strokes = reachable_strokes(model, seed=1, count=5)
    values = joint_values(model, strokes, foot_from_strokes(model.leg, strokes) + [0.0, 0.0, 0.001])
    pose(urdf, values, 4)
    assert worst_gaps(model, urdf)[1] > 1e-4


def test_every_joint_of_the_file_gets_a_value_within_its_limits(
    robot: tuple[RobotModel, yourdfpy.URDF],
) -> None:
    model, urdf = robot
    strokes = reachable_strokes(model, seed=3, count=50)
    values = joint_values(model, strokes, foot_from_strokes(model.leg, strokes))
    assert set(values) == set(urdf.actuated_joint_names)
    for name, column in values.items():
        limit = urdf.joint_map[name].limit
        assert column.min() >= limit.lower
        assert column.max() <= limit.upper


def test_the_drawn_foot_is_where_forward_kinematics_says(robot: tuple[RobotModel, yourdfpy.URDF]) -> None:
    model, urdf = robot
    strokes = reachable_strokes(model, seed=5, count=5)
    feet = foot_from_strokes(model.leg, strokes)
    pose(urdf, joint_values(model, strokes, feet), 4)
    for leg in range(model.leg_count):
        expected = model.module_centres_robot[leg] + model.R_robot_from_module[leg] @ feet[4, leg]
        found = urdf.get_transform(foot_link(leg), "body")[:3, 3]
        assert np.abs(found - expected).max() < CLOSED
