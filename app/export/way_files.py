"""Waypoint files with their companions."""

from dataclasses import dataclass
from pathlib import Path

from app.common.json import Json
from app.export.trajectory_files import companion_path, read_text
from app.store.plain_file import write_atomically
from core.errors import InputError
from core.motion.trajectory import Trajectory
from core.pose_gaits.pose_gait import PoseGait
from core.robot.model import RobotModel, load_robot
from core.wire.waypoint_companion import (
    WaypointCompanion,
    format_waypoint_companion,
    parse_waypoint_companion,
    require_same_strokes,
)
from core.wire.waypoints import (
    Waypoints,
    format_waypoint_csv,
    is_waypoint_text,
    parse_waypoint_csv,
    waypoint_legs,
)

ROBOT = "deltawalker"


@dataclass(frozen=True, eq=False)
class WayFile:
    """A waypoint file with what its companion says.

    Args:
        model: the robot.
        waypoints: the file's.
        motion: body, feet and contact at each waypoint; None where no companion says.
        assumptions: sentences on what was assumed.
    """

    model: RobotModel
    waypoints: Waypoints
    motion: Trajectory | None
    assumptions: tuple[str, ...] = ()


def is_way_file(path: Path) -> bool:
    """Whether a file is a waypoint CSV."""
    return path.suffix != ".json" and is_waypoint_text(read_text(path))


def read_way_file(path: Path, robot: str | None = None) -> WayFile:
    """Reads a waypoint CSV and its companion where there is one.

    Args:
        path: the CSV.
        robot: name of the robot; None for the companion's, else the DeltaWalker.

    Raises:
        InputError: it is malformed, or its companion contradicts it.
    """
    text = read_text(path)
    waypoints = parse_waypoint_csv(text, waypoint_legs(text, path.name), path.name)
    companion: WaypointCompanion | str | None = None
    if companion_path(path).exists():
        companion = parse_waypoint_companion(read_text(companion_path(path)), text, path.name)
    said = companion.robot if isinstance(companion, WaypointCompanion) else None
    model = load_robot(robot or said or ROBOT)
    if waypoints.strokes.shape[1] != model.leg_count:
        raise InputError(
            f"{path.name} has the strokes of {waypoints.strokes.shape[1]} feet; {model.title} has "
            f"{model.leg_count}. Name its robot with --robot.",
            path.name,
        )
    if isinstance(companion, WaypointCompanion):
        if companion.motion is not None:
            require_same_strokes(model, companion.motion, waypoints, path.name)
        return WayFile(model, waypoints, companion.motion)
    assumptions = () if companion is None else (companion,)
    return WayFile(model, waypoints, None, assumptions)


def write_pose_gait(path: Path, gait: PoseGait, origin: Json) -> None:
    """Writes a pose gait's waypoints and their companion, each whole or not at all.

    Args:
        path: the CSV.
        gait: the gait.
        origin: what it was asked for, for the companion.
    """
    problem = gait.problem
    text = format_waypoint_csv(gait.waypoints)
    companion = WaypointCompanion(problem.model.name, problem.bounds.stop_bound, origin, gait.trajectory)
    write_atomically(path, text)
    write_atomically(companion_path(path), format_waypoint_companion(companion, text))
