"""Writes the URDF files and meshes of all robots: `python -m robot_description.builder [folder]`."""

import sys
from collections.abc import Iterable
from pathlib import Path

import trimesh

from core.robot.model import ROBOT_NAMES, RobotModel, load_robot
from robot_description import parts, urdf
from robot_description.drive import yoke


def meshes(models: Iterable[RobotModel]) -> dict[str, trimesh.Trimesh]:
    """Every mesh that the models' URDF files name, by name; parts are shared where sizes are."""
    found: dict[str, trimesh.Trimesh] = {}
    for model in models:
        for make in (parts.board, parts.board_parts, parts.motor, parts.rod):
            found.setdefault(make.__name__, make(model))
        found.setdefault(urdf.foot_mesh(model), parts.foot(model))
        for make in (parts.plate, parts.plate_rim):
            found[urdf.plate_mesh(model, make.__name__)] = make(model)
        found = _knee_meshes(model) | found
    return found


def _knee_meshes(model: RobotModel) -> dict[str, trimesh.Trimesh]:
    """Knees with their own shafts, and what those need that share an actuator."""
    arms = [yoke(model, motor) for motor in range(model.motor_count)]
    found = {arm.mesh: parts.yoke(model, arm.length) for arm in arms if arm is not None}
    if found:
        found |= {"knee_bar": parts.knee_bar(model), "shaft": parts.shaft(model)}
    return found | ({"knee": parts.knee(model)} if None in arms else {})


def built_files() -> dict[str, bytes]:
    """Content of every file that the builder makes, by its path in this folder."""
    models = [load_robot(name) for name in ROBOT_NAMES]
    files = {f"{model.name}.urdf": urdf.urdf_text(model).encode() for model in models}
    for name, mesh in meshes(models).items():
        files[f"meshes/{name}.stl"] = bytes(trimesh.exchange.stl.export_stl(mesh))
    return files


def main(arguments: list[str]) -> int:
    """Writes the files into the named folder, or beside this module."""
    folder = Path(arguments[0]) if arguments else Path(__file__).parent
    for path, content in built_files().items():
        target = folder / path
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(content)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
