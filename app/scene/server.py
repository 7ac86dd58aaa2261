"""The Viser server that holds the 3D scene; only the relay behind our own port may talk to it."""

import secrets
import threading
from collections.abc import Mapping, Sequence

import numpy as np
import rich
import viser
from numpy.typing import NDArray

from app.scene.environment import add_floor, add_light, add_overlay, set_camera
from app.scene.nodes import Surface, link_surfaces
from app.scene.poses import ROBOT_ROOT, PoseBlob, pose_frames
from app.scene.viser_guard import RELAY_HEADER, guarded_viser
from core.errors import InputError, StateError
from core.problem.motion_problem import standing_pose
from core.robot.model import RobotModel, load_robot

OPAQUE = 255


class SceneServer:
    """Starts and stops Viser with one robot in its scene.

    Every client sees the same nodes; what a plan looks like at a time is played in each browser.

    Args:
        robot_name: of the robot in the scene.

    Raises:
        InputError: there is no robot of that name.
    """

    def __init__(self, robot_name: str) -> None:
        self._model = load_robot(robot_name)
        self._surfaces = link_surfaces(robot_name)
        self._secret = secrets.token_urlsafe(32)
        self._server: viser.ViserServer | None = None
        self._lock = threading.Lock()

    def start(self) -> None:
        """Starts listening on any free port of the loopback interface, with the robot standing.

        Raises:
            StateError: the installed Viser's port cannot be guarded.
        """
        with self._lock:
            if self._server is not None:
                return
            # Viser prints a table on standard output, which is the command line's alone.
            rich.get_console().quiet = True
            server = guarded_viser("Footfall Studio", self._secret)
            server.gui.configure_theme(show_logo=False, show_share_button=False)
            with server.atomic():
                self._furnish(server)
            self._server = server

    def _furnish(self, server: viser.ViserServer) -> None:
        add_light(server)
        add_floor(server, self._model)
        set_camera(server, self._model)
        _add_robot(server, self._surfaces)
        add_overlay(server, self._model)
        standing = standing_blob(self._model)
        _place(server, standing.names, standing.frames[0])

    def stop(self) -> None:
        """Stops listening; a scene that was never started is left alone."""
        with self._lock:
            if self._server is not None:
                self._server.stop()
            self._server = None

    @property
    def port(self) -> int:
        """Port that Viser listens on.

        Raises:
            StateError: the scene is not running.
        """
        return self._running().get_port()

    @property
    def relay_headers(self) -> Mapping[str, str]:
        """What a request to that port must carry; for the relay alone."""
        return {RELAY_HEADER: self._secret}

    def place(self, names: Sequence[str], poses: NDArray[np.float32]) -> None:
        """Moves nodes in every client: the slow way, for pages that can't reach into their client.

        Args:
            names: scene paths; those that the scene lacks are passed over.
            poses: (nodes, 7) quaternion wxyz and position xyz, m.

        Raises:
            InputError: the numbers are not seven a node, or not finite.
            StateError: the scene is not running.
        """
        if poses.shape != (len(names), 7) or not np.isfinite(poses).all():
            raise InputError(
                f"{poses.size} numbers for {len(names)} nodes; give seven finite ones each.", "poses"
            )
        with self._lock:
            server = self._running()
            with server.atomic():
                _place(server, names, poses)

    def _running(self) -> viser.ViserServer:
        if self._server is None:
            raise StateError("The 3D scene is not running; start the studio first.", "scene")
        return self._server


def standing_blob(model: RobotModel) -> PoseBlob:
    """One frame of the robot standing still in the middle of its strokes' range."""
    depth = model.leg.link_length**2 - model.leg.reach_radius**2
    rest = standing_pose(model, float(np.sqrt(depth)) + model.stroke.travel / 2, (0.0, 0.0))
    return pose_frames(model, np.zeros(1), rest.body_world[None], np.zeros(1), rest.feet_world[None])


def _add_robot(server: viser.ViserServer, surfaces: dict[str, tuple[Surface, ...]]) -> None:
    server.scene.add_frame(ROBOT_ROOT, show_axes=False)
    for path, parts in surfaces.items():
        if len(parts) == 1:
            _add_surface(server, path, parts[0])
            continue
        server.scene.add_frame(path, show_axes=False)
        for index, part in enumerate(parts):
            _add_surface(server, f"{path}/part{index}", part)


def _add_surface(server: viser.ViserServer, path: str, part: Surface) -> None:
    *colour, opacity = part.colour
    server.scene.add_mesh_simple(
        path,
        part.vertices,
        part.faces,
        color=(colour[0], colour[1], colour[2]),
        opacity=None if opacity == OPAQUE else opacity / OPAQUE,
        cast_shadow=False,
        receive_shadow=False,
    )


def _place(server: viser.ViserServer, names: Sequence[str], poses: NDArray[np.float32]) -> None:
    for name, pose in zip(names, poses, strict=True):
        node = server.scene.get_handle_by_name(name)
        if node is not None:
            node.wxyz, node.position = pose[:4], pose[4:]
