from importlib import resources
from io import BytesIO
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
import trimesh

from core.robot.model import ROBOT_NAMES, load_robot
from robot_description.builder import built_files, main, meshes
from robot_description.drive import actuator_places, motor_places, motor_yaws, yoke
from robot_description.parts import MOST_TRIANGLES
from robot_description.urdf import urdf_text

FOLDER = resources.files("robot_description")


def test_rebuilt_files_equal_the_committed_ones() -> None:
    for path, content in built_files().items():
        committed = FOLDER.joinpath(path).read_bytes()
        if path.endswith(".urdf"):
            assert content == committed, f"{path} is stale: run python -m robot_description.builder"
            continue
        new = trimesh.load_mesh(BytesIO(content), file_type="stl", process=False)
        old = trimesh.load_mesh(BytesIO(committed), file_type="stl", process=False)
        assert new.triangles.shape == old.triangles.shape, path
        assert np.abs(new.triangles - old.triangles).max() < 1e-9, path


def test_no_mesh_is_committed_that_the_builder_does_not_make() -> None:
    made = {path.removeprefix("meshes/") for path in built_files() if path.startswith("meshes/")}
    assert {entry.name for entry in FOLDER.joinpath("meshes").iterdir()} == made


def test_the_command_writes_all_files(tmp_path: Path) -> None:
    assert main([str(tmp_path)]) == 0
    written = {str(path.relative_to(tmp_path)) for path in tmp_path.rglob("*") if path.is_file()}
    assert written == set(built_files())


def test_no_part_has_too_many_triangles() -> None:
    for name, mesh in meshes(load_robot(robot) for robot in ROBOT_NAMES).items():
        assert len(mesh.faces) <= MOST_TRIANGLES, name


@pytest.mark.parametrize("name", ROBOT_NAMES)
def test_numbers_of_the_urdf_are_those_of_the_parameters_file(name: str) -> None:
    model = load_robot(name)
    robot = ElementTree.fromstring(urdf_text(model))
    joints = {joint.get("name"): joint for joint in robot.findall("joint")}
    for leg in range(model.leg_count):
        for motor in range(3):
            joint = joints[f"leg{leg + 1}_motor{motor + 1}"]
            limit = joint.find("limit")
            assert limit is not None
            assert float(limit.attrib["upper"]) == model.stroke.travel
            assert float(limit.attrib["velocity"]) == model.stroke.speed
            at = origin(joint)
            centre = model.module_centres_robot[leg]
            assert np.linalg.norm(at - centre) == pytest.approx(model.leg.base_radius, abs=1e-11)
        assert np.linalg.norm(origin(joints[f"leg{leg + 1}_foot_x"])) == pytest.approx(
            model.radius, abs=1e-11
        )


def origin(joint: ElementTree.Element) -> np.ndarray:
    element = joint.find("origin")
    assert element is not None
    return np.array([float(number) for number in element.attrib["xyz"].split()])


def test_sole_is_as_far_under_the_platform_as_the_floor() -> None:
    model = load_robot("deltawalker")
    foot = meshes([model])["foot"]
    assert foot.bounds[0][2] == pytest.approx(-model.sole_depth, abs=1e-6)
    assert np.hypot(*foot.vertices[:, :2].T).max() < 0.02


def test_rod_is_as_long_as_the_link() -> None:
    model = load_robot("deltawalker")
    rod = meshes([model])["rod"]
    radius = model.shape.rod_diameter / 2
    assert rod.bounds[0][2] == pytest.approx(-model.leg.link_length - 0.9 * radius, abs=1e-6)


@pytest.mark.parametrize(("name", "end"), [("deltawalker9", "foot_bare"), ("deltawalker5", "foot_fingertip")])
def test_feet_without_shoes_end_in_what_the_parameters_say(name: str, end: str) -> None:
    model = load_robot(name)
    foot = meshes([model])[end]
    assert foot.bounds[0][2] == pytest.approx(-model.sole_depth, abs=1e-6)
    below = foot.vertices[foot.vertices[:, 2] < -0.004]
    assert np.hypot(*below[:, :2].T).max() == pytest.approx(model.shape.foot_diameter / 2, abs=1e-6)
    sole = foot.vertices[foot.vertices[:, 2] < -model.sole_depth + 1e-6]
    assert np.hypot(*sole[:, :2].T).max() <= model.shape.sole_diameter / 2 + 1e-9
    assert f"meshes/{end}.stl" in urdf_text(model)


@pytest.mark.parametrize("name", ROBOT_NAMES)
def test_every_actuator_is_drawn_once_amid_the_motors_that_it_drives(name: str) -> None:
    model = load_robot(name)
    text = urdf_text(model)
    assert text.count("meshes/motor.stl") == model.actuator_count
    shared = int((model.coupling.sum(axis=0) > 1).sum())
    assert text.count("meshes/shaft.stl") == shared
    assert text.count("meshes/knee.stl") == model.actuator_count - shared
    assert text.count("meshes/yoke_") == model.motor_count - (model.actuator_count - shared)


@pytest.mark.parametrize("name", ["deltawalker9", "deltawalker5"])
def test_the_arms_of_an_actuator_meet_at_its_shaft(name: str) -> None:
    model = load_robot(name)
    places, yaws = motor_places(model), motor_yaws(model)
    for motor in range(model.motor_count):
        arm = yoke(model, motor)
        if arm is None:
            continue
        turn = np.array([np.cos(yaws[motor] + arm.yaw), np.sin(yaws[motor] + arm.yaw), 0.0])
        expected = actuator_places(model)[model.coupling[motor].argmax()]
        assert places[motor] + arm.length * turn == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize("name", ROBOT_NAMES)
def test_modules_of_a_ring_do_not_overlap(name: str) -> None:
    motors = motor_places(load_robot(name))
    gaps = np.linalg.norm(motors[:, None] - motors[None, :], axis=-1)
    np.fill_diagonal(gaps, np.inf)
    assert gaps.min() > 0.010 * np.sqrt(2)


@pytest.mark.parametrize("name", ["hexapod", "dodecapod"])
def test_larger_robots_are_not_wired_and_share_the_leg(name: str) -> None:
    model, walker = load_robot(name), load_robot("deltawalker")
    assert not model.wired
    assert walker.wired
    assert (model.leg, model.stroke) == (walker.leg, walker.stroke)
    assert model.colours[:4] == walker.colours
    assert len(set(model.colours)) == model.leg_count
