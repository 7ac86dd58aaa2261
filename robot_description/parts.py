"""The robot's parts as triangle meshes, each made from the parameters file; at most 500 triangles a part.

Every part is drawn in its link's frame: metres, z up. One mesh serves all legs and all robots of a size.
"""

from collections.abc import Sequence

import numpy as np
import trimesh

from core.robot.leg import vertex_directions
from core.robot.model import FootEnd, RobotModel

MOST_TRIANGLES = 500
"""Of one part: more is too much for drawing without a GPU."""


RIM = 0.0016
"""Width of the plates' edge, which is drawn apart because light gathers there in clear acrylic, m."""


def plate(model: RobotModel) -> trimesh.Trimesh:
    """Both faces of an octagon for four legs, 2n sides for more, flats at the modules; underside at z = 0."""
    sides, corner, thick = _plate_sizes(model)
    faces = [_lathe([(0, z), (corner - RIM, z)][::way], sides) for z, way in ((0.0, 1), (thick, -1))]
    return _turned(_joined(faces), np.pi / sides)


def plate_rim(model: RobotModel) -> trimesh.Trimesh:
    """The edge around a plate."""
    sides, corner, thick = _plate_sizes(model)
    inner, bevel = corner - RIM, 0.0004
    outline = [
        (inner, 0), (corner - bevel, 0), (corner, bevel), (corner, thick - bevel), (corner - bevel, thick),
        (inner, thick),
    ]  # fmt: skip
    return _turned(_lathe(outline, sides), np.pi / sides)


def _plate_sizes(model: RobotModel) -> tuple[int, float, float]:
    sides = 2 * model.leg_count
    return sides, model.shape.plate_across / 2 / np.cos(np.pi / sides), model.shape.plate_thickness


def board(model: RobotModel) -> trimesh.Trimesh:
    """The circuit board without its parts; underside at z = 0."""
    return _box(model.shape.board, (0, 0, model.shape.board[2] / 2))


def board_parts(model: RobotModel) -> trimesh.Trimesh:
    """Processor, motor drivers and connectors on the board; drawn, not measured."""
    length, width, thick = model.shape.board
    drivers = [
        _box((0.007, 0.005, 0.0014), ((column - 1) * 0.014, side * 0.3 * width, thick + 0.0007))
        for side in (-1, 1)
        for column in range(3)
    ]
    processor = _box((0.014, 0.014, 0.0016), (0, 0, thick + 0.0008))
    connectors = [
        _box((0.006, 0.6 * width, 0.006), (side * 0.42 * length, 0, thick + 0.003)) for side in (-1, 1)
    ]
    return _joined([*drivers, processor, *connectors])


def motor(model: RobotModel) -> trimesh.Trimesh:
    """A linear actuator's body standing on the actuator plane, with its collar below."""
    shape = model.shape
    body = _box(
        (shape.motor_width, shape.motor_width, shape.motor_length - 0.003),
        (0, 0, 0.003 + (shape.motor_length - 0.003) / 2),
    )
    radius = 0.4 * shape.motor_width
    collar = _lathe([(0, 0), (radius, 0), (radius, 0.003), (0, 0.003)], 12)
    return _joined([body, collar])


def knee(model: RobotModel) -> trimesh.Trimesh:
    """The motor's shaft, as long as its travel, and the bar along y that carries both rods' upper ends."""
    return _joined([knee_bar(model), shaft(model)])


def knee_bar(model: RobotModel) -> trimesh.Trimesh:
    """The bar alone, of a knee that hangs on a yoke."""
    thick = _bar_thickness(model)
    return _box((thick, model.shape.rod_spacing + model.shape.rod_diameter, thick), (0, 0, 0))


def shaft(model: RobotModel) -> trimesh.Trimesh:
    """A motor's shaft standing on its knee or yoke."""
    radius, top = 0.002, model.stroke.travel + 0.002
    return _lathe([(0, 0), (radius, 0), (radius, top), (0, top)], 8)


def yoke(model: RobotModel, length: float) -> trimesh.Trimesh:
    """The arm along x from a knee to the shaft of the actuator that it shares; drawn, not measured."""
    thick = _bar_thickness(model)
    return _box((length, thick, 0.5 * thick), (length / 2, 0, 0))


def _bar_thickness(model: RobotModel) -> float:
    return 0.8 * model.shape.rod_diameter


def rod(model: RobotModel) -> trimesh.Trimesh:
    """One beam of an arm, from its upper end at the origin down to z = −l, with rounded ends."""
    radius, low = model.shape.rod_diameter / 2, -model.leg.link_length
    outline = [
        (0, low - 0.9 * radius), (0.7 * radius, low - 0.6 * radius), (radius, low),
        (radius, 0), (0.7 * radius, 0.6 * radius), (0, 0.9 * radius),
    ]  # fmt: skip
    return _lathe(outline, 10)


def foot(model: RobotModel) -> trimesh.Trimesh:
    """Platform with its three bars, and what the leg ends in; the platform's centre is the origin."""
    bars = [_platform_bar(model, direction) for direction in vertex_directions()]
    return _joined([_lathe(_foot_outline(model), 20), *bars])


def _foot_outline(model: RobotModel) -> list[tuple[float, float]]:
    """(radius, height) from the sole's middle up to the platform's: shoe, bare foot or fingertip, m."""
    shape, sole = model.shape, model.sole_depth
    stem, end = shape.foot_diameter / 2, shape.sole_diameter / 2
    platform = [(stem, -0.003), (0.0105, -0.001), (0.0105, 0.0015), (0, 0.0015)]
    if shape.foot_end is FootEnd.SHOE:
        return [
            (0, -sole), (end - 0.001, -sole), (end, -sole + 0.001), (end, -sole + 0.006),
            (end - 0.0015, -sole + 0.0075), (stem, -sole + 0.009), *platform,
        ]  # fmt: skip
    if shape.foot_end is FootEnd.BARE:
        # Rounded from the small sole to the whole foot within 3 mm, T 2.1.1.
        return [(0, -sole), (end, -sole), (0.85 * stem, -sole + 0.001), (stem, -sole + 0.003), *platform]
    turns = np.linspace(0, np.pi / 2, 6)
    round_tip = [(end * np.sin(turn), -sole + end * (1 - np.cos(turn))) for turn in turns]
    return [*round_tip, (stem, -0.005), *platform]


def _platform_bar(model: RobotModel, direction: np.ndarray) -> trimesh.Trimesh:
    thick = _bar_thickness(model)
    bar = _box(
        (thick, model.shape.rod_spacing + model.shape.rod_diameter, thick), (model.leg.platform_radius, 0, 0)
    )
    return _turned(bar, float(np.arctan2(direction[1], direction[0])))


def _box(size: Sequence[float], centre: Sequence[float]) -> trimesh.Trimesh:
    box: trimesh.Trimesh = trimesh.creation.box(extents=size)
    box.apply_translation(centre)
    return box


def _lathe(outline: Sequence[tuple[float, float]], sections: int) -> trimesh.Trimesh:
    """Turns (radius, height) points about z, from the lower end of the axis to the upper."""
    turned: trimesh.Trimesh = trimesh.creation.revolve(np.array(outline, dtype=np.float64), sections=sections)
    return turned


def _turned(mesh: trimesh.Trimesh, angle: float) -> trimesh.Trimesh:
    turn = np.eye(4)
    turn[:2, :2] = [[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]
    mesh.apply_transform(turn)
    return mesh


def _joined(meshes: Sequence[trimesh.Trimesh]) -> trimesh.Trimesh:
    counts = np.cumsum([0, *(len(mesh.vertices) for mesh in meshes[:-1])])
    vertices = np.concatenate([mesh.vertices for mesh in meshes])
    faces = np.concatenate([mesh.faces + count for mesh, count in zip(meshes, counts, strict=True)])
    return trimesh.Trimesh(vertices, faces, process=False)
