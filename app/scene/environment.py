"""What stands in the scene beside the robot: light, floor, camera, and the marks that the page draws with.

The page fills the marks itself (points, colours, visibility), so each browser shows its own plan.
"""

import itertools

import numpy as np
import viser
from numpy.typing import NDArray

from app.scene.poses import COM_NODE, FLOOR_GAP, ROBOT_ROOT
from core.arrays import Floats
from core.robot.closed_chain import BODY
from core.robot.model import RobotModel

Colour = tuple[int, int, int]

INK: Colour = (22, 27, 34)
PAPER: Colour = (255, 255, 255)
GOOD: Colour = (11, 116, 112)
BAD: Colour = (179, 20, 95)
ACCENT: Colour = (75, 72, 200)

COP_NODE = "/overlay/cop"
"""Scene path of the marker on the floor at the centre of pressure."""

COM_RADIUS = 0.0045
"""Of the mark at the centre of mass, m."""

SHADOW_NODE = "/overlay/contact_shadow"
"""Scene path of the soft shadows under standing feet; the page makes their discs."""

REACH_NODE = f"{ROBOT_ROOT}/{BODY}/reach"
"""Scene path of the lines round each foot's reach; it moves along with the body."""

GHOST_NODES = ("/ghost/before", "/ghost/saved", "/ghost/measured", "/ghost/simulated", "/ghost/jog")
"""Scene paths of other versions of the gait, each drawn with the lines of one node."""

CONTACT_NODE, SLIP_NODE = "/ghost/contact", "/ghost/slip"
"""Scene paths of what the simulated robot's feet do to the ground."""

TRACK_NODES = ("/tracks/ways", "/tracks/marks")
"""Scene paths of a trial's foot tracks on the ground, and of the marks that follow the playhead."""

FLOOR_THEMES: dict[str, tuple[Colour, Colour]] = {
    "light": ((212, 219, 228), (246, 248, 250)),
    "dark": ((84, 96, 114), (38, 44, 54)),
}
"""Colours of the floor's lines near and far, by the page's theme."""

SHADOW = 0.2
"""Darkness of the shadows on the floor, 0 to 1."""

CELL = 0.02
"""Distance of the floor's lines, m."""

FLOOR_RADIUS = 3.0
"""Of the drawn floor, in radii of the robot."""

VIEW_DIRECTION = (0.42, -1.0, 0.40)
"""From the robot to the camera at first sight."""

VIEW_DISTANCE = 4.6
"""Of the camera, in radii of the robot."""

FIELD_OF_VIEW = np.radians(32)


def add_light(server: viser.ViserServer) -> None:
    """Soft light from above and one lamp; environment map and shadows cost too much without a GPU."""
    server.scene.configure_environment_map(hdri=None)
    server.scene.configure_default_lights(enabled=False, cast_shadow=False)
    server.scene.add_light_hemisphere(
        "/light/sky", sky_color=(255, 255, 255), ground_color=(205, 212, 222), intensity=2.6
    )
    server.scene.add_light_directional("/light/lamp", intensity=2.0, position=(0.5, -1.0, 2.0))


def add_floor(server: viser.ViserServer, model: RobotModel) -> None:
    """Lines `sole_depth` under the standing platforms, fading outwards, once for each theme.

    What shadows fall on is hidden; pages with a GPU show it.
    """
    reach = _reach(model) * FLOOR_RADIUS
    points = _grid_points(reach, -model.sole_depth)
    distance = np.linalg.norm(points[..., :2], axis=-1, keepdims=True)
    fade = np.clip(distance / reach, 0, 1)
    for theme, (near, far) in FLOOR_THEMES.items():
        seen = np.array(near) * (1 - fade) + np.array(far) * fade
        # The client takes colours of single points as linear light.
        colours = 255 * (seen / 255) ** 2.2
        server.scene.add_line_segments(
            f"/floor/{theme}",
            points,
            colours.astype(np.uint8),
            thickness=1.0,
            thickness_units="screen",
            visible=theme == "light",
        )
    server.scene.add_grid(
        "/floor/shadow",
        width=2 * reach,
        height=2 * reach,
        cell_thickness=0.0,
        section_thickness=0.0,
        shadow_opacity=SHADOW,
        position=(0.0, 0.0, -model.sole_depth - FLOOR_GAP),
        visible=False,
    )


def add_overlay(server: viser.ViserServer, model: RobotModel) -> None:
    """Hidden marks: shadows, support polygon, points of balance, swings, footholds, reach, and ghosts."""
    floor = -model.sole_depth
    _add_contact_shadow(server, floor)
    triangle = np.array([[0, 0, floor], [1e-3, 0, floor], [0, 1e-3, floor]], dtype=np.float32)
    server.scene.add_mesh_simple(
        "/overlay/polygon",
        triangle,
        np.array([[0, 1, 2]], dtype=np.uint32),
        color=GOOD,
        opacity=0.16,
        side="double",
        cast_shadow=False,
        receive_shadow=False,
        visible=False,
    )
    _add_lines(server, "/overlay/polygon_edge", GOOD, 2.5)
    _add_lines(server, "/overlay/com_trace", INK, 2.0)
    _add_lines(server, "/overlay/cop_trace", ACCENT, 1.5)
    _add_lines(server, "/overlay/trouble", BAD, 3.5)
    # A colour for each end from the first: the client makes no lines of many colours of lines of one.
    many_colours = np.full((1, 2, 3), INK, dtype=np.uint8)
    _add_lines(server, REACH_NODE, many_colours, 1.5)
    for node in TRACK_NODES:
        _add_lines(server, node, many_colours, 2.5)
    for node in GHOST_NODES:
        _add_lines(server, node, INK, 1.25)
    _add_lines(server, CONTACT_NODE, GOOD, 2.5)
    _add_lines(server, SLIP_NODE, BAD, 3.0)
    for leg, colour in enumerate(model.colours):
        rgb = (int(colour[1:3], 16), int(colour[3:5], 16), int(colour[5:7], 16))
        _add_lines(server, f"/overlay/swing{leg + 1}", rgb, 2.5)
        _add_lines(server, f"/overlay/foothold{leg + 1}", rgb, 2.0)
    _add_point(server, COM_NODE, COM_RADIUS, 24, INK, floor + 3 * FLOOR_GAP)
    _add_quarters(server, COM_RADIUS * 0.8)
    _add_point(server, COP_NODE, 0.0034, 4, ACCENT, floor + 4 * FLOOR_GAP)


def set_camera(server: viser.ViserServer, model: RobotModel) -> None:
    """Looks at the robot from the front right, so that it fills the view."""
    direction = np.array(VIEW_DIRECTION) / np.linalg.norm(VIEW_DIRECTION)
    target = np.array([0.0, 0.0, 0.034])
    camera = server.initial_camera
    camera.fov = float(FIELD_OF_VIEW)
    camera.near, camera.far = 0.01, 20.0
    camera.look_at = target
    camera.position = target + direction * _reach(model) * VIEW_DISTANCE


def _reach(model: RobotModel) -> float:
    # Outermost shoe and plate.
    return max(model.radius + model.shape.sole_diameter, model.shape.plate_across / 2) + 0.01


def _grid_points(reach: float, height: float) -> Floats:
    """(k, 2, 3) the lines of a round grid, in pieces so that their colour can fade along them."""
    count = int(reach / CELL)
    pieces = []
    for line in range(-count, count + 1):
        offset = line * CELL
        half = np.sqrt(max(reach**2 - offset**2, 0.0))
        along = np.linspace(-half, half, 5)
        for start, end in itertools.pairwise(along):
            pieces.append([[start, offset, height], [end, offset, height]])
            pieces.append([[offset, start, height], [offset, end, height]])
    return np.array(pieces)


def _add_lines(
    server: viser.ViserServer, path: str, colour: Colour | NDArray[np.uint8], thickness: float
) -> None:
    server.scene.add_line_segments(
        path,
        np.zeros((1, 2, 3), dtype=np.float32),
        colour,
        thickness=thickness,
        thickness_units="screen",
        visible=False,
    )


def _add_point(
    server: viser.ViserServer, path: str, radius: float, corners: int, colour: Colour, height: float
) -> None:
    disc, faces = _disc(radius, corners)
    server.scene.add_mesh_simple(
        path,
        disc,
        faces,
        color=colour,
        side="double",
        cast_shadow=False,
        receive_shadow=False,
        position=(0, 0, height),
        visible=False,
    )


def _add_contact_shadow(server: viser.ViserServer, floor: float) -> None:
    # Before the support polygon: what is clear is drawn in the order in which it was made.
    server.scene.add_mesh_simple(
        SHADOW_NODE,
        np.array([[0, 0, floor], [1e-3, 0, floor], [0, 1e-3, floor]], dtype=np.float32),
        np.array([[0, 1, 2]], dtype=np.uint32),
        color=(0, 0, 0),
        opacity=0.09,
        side="double",
        cast_shadow=False,
        receive_shadow=False,
        visible=False,
    )


def _add_quarters(server: viser.ViserServer, radius: float) -> None:
    """Two light quarters on the mark of the centre of mass, which move along with it."""
    rim = [np.linspace(start, start + np.pi / 2, 7) for start in (0, np.pi)]
    points = [np.stack([np.cos(angles), np.sin(angles), np.zeros(7)], axis=-1) for angles in rim]
    corners = radius * np.vstack([*points, np.zeros(3)])
    faces = [[14, first + at, first + at + 1] for first in (0, 7) for at in range(6)]
    server.scene.add_mesh_simple(
        f"{COM_NODE}/quarters",
        corners.astype(np.float32),
        np.array(faces, dtype=np.uint32),
        color=PAPER,
        side="double",
        cast_shadow=False,
        receive_shadow=False,
        position=(0.0, 0.0, FLOOR_GAP / 2),
    )


def _disc(radius: float, sections: int) -> tuple[NDArray[np.float32], NDArray[np.uint32]]:
    angles = np.linspace(0, 2 * np.pi, sections, endpoint=False)
    rim = np.stack([radius * np.cos(angles), radius * np.sin(angles), np.zeros(sections)], axis=-1)
    index = np.arange(sections)
    faces = np.stack([np.full(sections, sections), index, np.roll(index, -1)], axis=-1)
    return np.vstack([rim, np.zeros(3)]).astype(np.float32), faces.astype(np.uint32)
