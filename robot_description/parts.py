"""The robot's parts as triangle meshes, each made from the parameters file; at most 500 triangles a part.

Every part is drawn in its link's frame: metres, z up. One mesh serves all legs and all robots of a size.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import trimesh

from core.leg import vertex_directions
from core.robot import RobotModel

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
    shape = model.shape
    thick = 0.8 * shape.rod_diameter
    bar = _box((thick, shape.rod_spacing + shape.rod_diameter, thick), (0, 0, 0))
    radius, top = 0.002, model.stroke.travel + 0.002
    shaft = _lathe([(0, 0), (radius, 0), (radius, top), (0, top)], 8)
    return _joined([bar, shaft])


def rod(model: RobotModel) -> trimesh.Trimesh:
    """One beam of an arm, from its upper end at the origin down to z = −l, with rounded ends."""
    radius, low = model.shape.rod_diameter / 2, -model.leg.link_length
    outline = [
        (0, low - 0.9 * radius), (0.7 * radius, low - 0.6 * radius), (radius, low),
        (radius, 0), (0.7 * radius, 0.6 * radius), (0, 0.9 * radius),
    ]  # fmt: skip
    return _lathe(outline, 10)


def foot(model: RobotModel) -> trimesh.Trimesh:
    """Platform with its three bars, foot and shoe; the platform's centre is the origin, the sole lowest."""
    shape, sole = model.shape, model.sole_depth
    stem, shoe = shape.foot_diameter / 2, shape.shoe_diameter / 2
    outline = [
        (0, -sole), (shoe - 0.001, -sole), (shoe, -sole + 0.001), (shoe, -sole + 0.006),
        (shoe - 0.0015, -sole + 0.0075), (stem, -sole + 0.009), (stem, -0.003), (shoe - 0.002, -0.001),
        (shoe - 0.002, 0.0015), (0, 0.0015),
    ]  # fmt: skip
    bars = [_platform_bar(model, direction) for direction in vertex_directions()]
    return _joined([_lathe(outline, 20), *bars])


def _platform_bar(model: RobotModel, direction: np.ndarray) -> trimesh.Trimesh:
    thick = 0.8 * model.shape.rod_diameter
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
