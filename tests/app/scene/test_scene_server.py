import socket
from collections.abc import Iterator

import numpy as np
import pytest

from app.scene import Scenes
from app.scene.nodes import crisp, link_surfaces
from app.scene.poses import node_names
from app.scene.server import SceneServer
from core.errors import InputError, StateError
from core.robot.model import load_robot


@pytest.fixture
def scene() -> Iterator[SceneServer]:
    scene = SceneServer("deltawalker")
    scene.start()
    yield scene
    scene.stop()


def test_viser_listens_on_loopback_only(scene: SceneServer) -> None:
    with socket.create_connection(("127.0.0.1", scene.port), timeout=60) as link:
        # Viser may not stop while it is about to take a connection, or that one is never closed.
        link.shutdown(socket.SHUT_WR)
        while link.recv(4096):
            pass
    with socket.socket(socket.AF_INET, socket.SOCK_STREAM) as other:
        other.settimeout(60)
        with pytest.raises(OSError, match="refused"):
            other.connect(("127.0.0.2", scene.port))


def test_two_scenes_get_different_ports(scene: SceneServer) -> None:
    second = SceneServer("deltawalker")
    second.start()
    try:
        assert second.port != scene.port
    finally:
        second.stop()


def test_starting_writes_nothing_on_standard_output(capfd: pytest.CaptureFixture[str]) -> None:
    scene = SceneServer("deltawalker")
    scene.start()
    scene.stop()
    assert capfd.readouterr().out == ""


def test_stopping_twice_is_harmless_and_the_port_is_gone(scene: SceneServer) -> None:
    scene.stop()
    scene.stop()
    with pytest.raises(StateError, match="not running"):
        _ = scene.port


@pytest.mark.parametrize("name", ["deltawalker", "dodecapod"])
def test_every_moving_node_of_the_robot_exists(name: str) -> None:
    scene = SceneServer(name)
    scene.start()
    try:
        nodes = node_names(load_robot(name))
        scene.place(nodes, np.tile(np.array([1, 0, 0, 0, 0, 0, 0.1], dtype=np.float32), (len(nodes), 1)))
    finally:
        scene.stop()


def test_each_robot_has_a_scene_of_its_own_which_is_started_once() -> None:
    scenes = Scenes()
    try:
        first, other = scenes.of("deltawalker"), scenes.of("hexapod")
        assert first is scenes.of("deltawalker")
        assert first.port != other.port
    finally:
        scenes.stop()
    with pytest.raises(StateError, match="not running"):
        _ = first.port


def test_an_unknown_robot_has_no_scene() -> None:
    with pytest.raises(InputError, match="no robot “spot”"):
        Scenes().of("spot")


@pytest.mark.parametrize("poses", [np.zeros((1, 6)), np.zeros((2, 7)), np.full((1, 7), np.nan)])
def test_poses_that_do_not_fit_are_refused(scene: SceneServer, poses: np.ndarray) -> None:
    with pytest.raises(InputError, match="give seven finite ones each"):
        scene.place(["/robot/body"], poses.astype(np.float32))


def test_links_of_the_robot_are_drawn_in_their_colours() -> None:
    surfaces = link_surfaces("deltawalker")
    assert set(surfaces) == {name for name in node_names(load_robot("deltawalker")) if "/robot/" in name}
    assert [surfaces[f"/robot/leg{leg}_foot"][0].colour[:3] for leg in (1, 2)] == [
        (46, 158, 91),
        (214, 69, 69),
    ]
    assert len(surfaces["/robot/body"]) == 5


def test_an_edge_keeps_its_corners_apart_and_a_flat_face_shares_them() -> None:
    vertices = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1.0], [1, 0, 1]])
    flat_and_wall = np.array([[0, 1, 2], [0, 2, 3], [0, 5, 1], [0, 4, 5]])
    points, faces = crisp(vertices, flat_and_wall)
    assert len(points) == 8
    assert np.array_equal(points[faces], vertices[flat_and_wall])
