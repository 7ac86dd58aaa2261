"""Waypoint files with their companions."""

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from app.common.clipped import clipped_content, clipped_from_content
from app.common.json import Json
from app.export.trajectory_files import companion_path, finds_companion, read_text, write_with_companion
from core.arrays import Floats
from core.checks.checked_plan import Beyond, CheckedPlan
from core.errors import InputError
from core.motion.balance import STANDING_DEPTH
from core.motion.trajectory import Trajectory
from core.pose_gaits.pose_gait import PoseGait
from core.robot.kinematics import feet_in_robot, walker_feet
from core.robot.model import RobotModel, load_robot
from core.wire.waypoint_companion import (
    WaypointCompanion,
    format_waypoint_companion,
    parse_waypoint_companion,
    require_same_strokes,
)
from core.wire.waypoint_merging import WaypointPlan, plan_of_knots
from core.wire.waypoints import (
    Waypoints,
    format_waypoint_csv,
    is_waypoint_text,
    read_waypoint_csv,
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
        clipped: (count, legs, 3) how far strokes were clipped, m, each foot's largest; None where none were.
        hold_ok: for each waypoint whether all feet are known to be down there, so that a pause may end at it.
    """

    model: RobotModel
    waypoints: Waypoints
    motion: Trajectory | None
    assumptions: tuple[str, ...] = ()
    clipped: Floats | None = None
    hold_ok: tuple[bool, ...] = ()


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
    file = read_waypoint_csv(text, path.name)
    waypoints = file.waypoints
    companion: WaypointCompanion | str | None = None
    if finds_companion(path):
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
        cut = clipped_from_content(companion.origin.get("clipped_mm", []), waypoints.strokes.shape)
        named = _all_feet_down(companion, waypoints.count, path.name)
        down, notes = _truly_down(model, waypoints, named, path.name)
        return WayFile(model, waypoints, companion.motion, (*file.notes, *notes), cut, down)
    assumptions = () if companion is None else (companion,)
    return WayFile(model, waypoints, None, (*file.notes, *assumptions), hold_ok=(False,) * waypoints.count)


def _all_feet_down(companion: WaypointCompanion, count: int, name: str) -> tuple[bool, ...]:
    if companion.motion is not None:
        contact = companion.motion.contact
        walking = contact.any(axis=0)
        return tuple(bool(row.any() and row[walking].all()) for row in contact)
    down = companion.origin.get("all_feet_down", [])
    if not isinstance(down, list) or not all(type(i) is int and 0 <= i < count for i in down):
        raise InputError(
            f"all_feet_down in the companion of {name} must be numbers of waypoints, from 0 to {count - 1}.",
            "all_feet_down",
        )
    return tuple(i in down for i in range(count))


def _truly_down(
    model: RobotModel, waypoints: Waypoints, said: tuple[bool, ...], name: str
) -> tuple[tuple[bool, ...], tuple[str, ...]]:
    """Waypoints at which a companion has all feet down and the strokes too, and a note on the others.

    A foot that is in the air at every waypoint is held up on purpose.
    """
    heights = feet_in_robot(model, waypoints.strokes)[..., 2]
    deepest = np.where(np.isnan(heights), np.inf, heights).min(axis=1, keepdims=True)
    up = ~(heights <= deepest + STANDING_DEPTH)
    is_up = up[:, ~up.all(axis=0)].any(axis=1)
    lifted = [number for number, down in enumerate(said) if down and is_up[number]]
    if not lifted:
        return said, ()
    note = (
        f"The companion of {name} says that all feet are down at {len(lifted)} waypoints (the first is "
        f"number {lifted[0]}, counted from 0) where the strokes have a foot in the air. No pause ends there."
    )
    down = tuple(down and not up for down, up in zip(said, is_up.tolist(), strict=True))
    return down, (note,)


def checked_way(model: RobotModel, motion: Trajectory, file: WayFile) -> CheckedPlan:
    """A waypoint file as every rule judges it, by the motion of its companion.

    Args:
        model: the robot.
        motion: the companion's.
        file: the file.
    """
    sent = plan_of_knots(model, motion, file.waypoints)
    return CheckedPlan(model, motion, sent.waypoints, way=sent, beyond=Beyond(file.clipped))


def write_way(
    path: Path, model: RobotModel, motion: Trajectory, way: WaypointPlan, clipped: Floats | None, source: str
) -> None:
    """Writes what is sent of a motion, and its companion (see `write_with_companion`).

    The companion has the motion too where each sample is a waypoint.

    Args:
        path: the CSV.
        model: the robot.
        motion: what is sent.
        way: as which waypoints.
        clipped: (n, legs, 3) how far each stroke of the motion was clipped, m; None where none was.
        source: name of the file that the motion was read from, for the companion.
    """
    text = format_waypoint_csv(way.waypoints)
    cut = None if clipped is None else clipped[list(way.kept)]
    down = [number for number, is_down in enumerate(way.hold_ok) if is_down]
    origin = {"trajectory": source, "clipped_mm": clipped_content(cut), "all_feet_down": down}
    # Where waypoints were merged or cut, the motion at them is not that of a sample.
    is_whole = way.waypoints.count == motion.knot_count and not way.merge
    feet = walker_feet(model, way.waypoints.strokes, motion.pose(model)) if is_whole else None
    there = None if feet is None else replace(motion, feet_world=feet, feet_velocity=None)
    companion = WaypointCompanion(model.name, way.stop_bound, origin, there)
    write_with_companion(path, text, format_waypoint_companion(companion, text))


def write_pose_gait(path: Path, gait: PoseGait, origin: Json) -> None:
    """Writes a pose gait's waypoints and their companion (see `write_with_companion`).

    Args:
        path: the CSV.
        gait: the gait.
        origin: what it was asked for, for the companion.
    """
    problem = gait.problem
    text = format_waypoint_csv(gait.waypoints)
    companion = WaypointCompanion(problem.model.name, problem.bounds.stop_bound, origin, gait.trajectory)
    write_with_companion(path, text, format_waypoint_companion(companion, text))
