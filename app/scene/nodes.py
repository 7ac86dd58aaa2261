"""What is drawn for each link of a robot, read from its URDF and meshes."""

from dataclasses import dataclass
from functools import lru_cache
from importlib import resources

import numpy as np
import trimesh
import yourdfpy
from numpy.typing import NDArray

from app.scene.poses import ROBOT_ROOT
from core.data.tables import package_files
from core.errors import InputError
from core.robot.model import ROBOT_NAMES

Colour = tuple[int, int, int, int]


@dataclass(frozen=True, eq=False)
class Surface:
    """Triangles of one colour in their link's frame.

    Args:
        vertices: (v, 3) m; corners at edges are not shared, so that edges stay crisp.
        faces: (f, 3) indices.
        colour: red, green, blue and opacity, 0 to 255.
    """

    vertices: NDArray[np.float32]
    faces: NDArray[np.uint32]
    colour: Colour


@lru_cache(maxsize=len(ROBOT_NAMES))
def link_surfaces(robot_name: str) -> dict[str, tuple[Surface, ...]]:
    """Surfaces of each visible link by the scene path of its node.

    Raises:
        InputError: there is no robot of that name.
    """
    if robot_name not in ROBOT_NAMES:
        names = ", ".join(ROBOT_NAMES)
        raise InputError(f"There is no robot “{robot_name}”; choose one of {names}.", "robot")
    with resources.as_file(package_files("robot_description")) as folder:
        urdf = yourdfpy.URDF.load(
            str(folder / f"{robot_name}.urdf"), build_scene_graph=False, load_meshes=False
        )
        parts: dict[str, trimesh.Trimesh] = {}
        return {
            f"{ROBOT_ROOT}/{name}": _surfaces(link, str(folder), parts)
            for name, link in urdf.link_map.items()
            if link.visuals
        }


def _surfaces(link: yourdfpy.Link, folder: str, parts: dict[str, trimesh.Trimesh]) -> tuple[Surface, ...]:
    by_colour: dict[Colour, list[trimesh.Trimesh]] = {}
    for visual in link.visuals:
        path = f"{folder}/{visual.geometry.mesh.filename}"
        if path not in parts:
            parts[path] = trimesh.load_mesh(path)
        mesh = parts[path].copy()
        mesh.apply_transform(visual.origin)
        red, green, blue, opacity = (round(255 * float(channel)) for channel in visual.material.color.rgba)
        by_colour.setdefault((red, green, blue, opacity), []).append(mesh)
    return tuple(_surface(meshes, colour) for colour, meshes in by_colour.items())


def _surface(meshes: list[trimesh.Trimesh], colour: Colour) -> Surface:
    counts = np.cumsum([0, *(len(mesh.vertices) for mesh in meshes[:-1])])
    vertices = np.concatenate([mesh.vertices for mesh in meshes])
    faces = np.concatenate([mesh.faces + count for mesh, count in zip(meshes, counts, strict=True)])
    vertices, faces = crisp(vertices, faces)
    return Surface(vertices.astype(np.float32), faces.astype(np.uint32), colour)


def crisp(
    vertices: NDArray[np.float64], faces: NDArray[np.int64], sharp: float = np.radians(50)
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Splits vertices where faces meet at a sharp angle, so that averaged normals don't smear edges.

    A corner joins those at its place whose faces look the same way as the first of them, within `sharp`.

    Args:
        vertices: (v, 3) m.
        faces: (f, 3).
        sharp: angle from which an edge is kept, rad.
    """
    corners = vertices[faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-30)
    groups: dict[int, list[tuple[NDArray[np.float64], int]]] = {}
    points: list[NDArray[np.float64]] = []
    split = np.empty_like(faces)
    for face, corner in np.ndindex(*faces.shape):
        vertex = int(faces[face, corner])
        near = groups.setdefault(vertex, [])
        found = next((index for normal, index in near if normal @ normals[face] > np.cos(sharp)), None)
        if found is None:
            found = len(points)
            points.append(vertices[vertex])
            near.append((normals[face], found))
        split[face, corner] = found
    return np.array(points), split
