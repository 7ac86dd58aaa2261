"""The 3D scenes: one for each robot that somebody looks at, so that pages on different robots don't meet.

Viser and trimesh, which take longer to load than the rest of the studio, are loaded with the first scene.
"""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from app.scene.server import SceneServer

FIRST_ROBOT = "deltawalker"
"""Of the scene that a page asks for without naming a robot."""


class Scenes:
    """Starts a robot's scene when it is first asked for, and keeps it."""

    def __init__(self) -> None:
        self._scenes: dict[str, SceneServer] = {}
        self._lock = threading.Lock()

    def of(self, robot_name: str) -> SceneServer:
        """The running scene of a robot; the first call takes about a second.

        Raises:
            InputError: there is no robot of that name.
        """
        with self._lock:
            if robot_name not in self._scenes:
                from app.scene.server import SceneServer

                scene = SceneServer(robot_name)
                scene.start()
                self._scenes[robot_name] = scene
            return self._scenes[robot_name]

    def stop(self) -> None:
        """Stops every scene; doing it twice does no harm."""
        with self._lock:
            for scene in self._scenes.values():
                scene.stop()
            self._scenes.clear()
