"""The companion of a waypoint file: its robot, stop bound, origin and motion, bound to it by hash.

The CSV holds strokes alone. Where the companion has the motion too, every rule can be checked; else contact
and body have to be found from the strokes.
"""

import hashlib
import json
from dataclasses import dataclass
from typing import Any, TypeVar

import numpy as np

from core.errors import InputError
from core.motion.trajectory import Trajectory
from core.robot.model import RobotModel
from core.text.documents import NotJsonError, json_content, json_numbers, json_truths
from core.wire.waypoints import Waypoints

Kind = TypeVar("Kind")
FORMAT = "footfall-waypoints"
SAME_STROKES = 1e-6
"""Strokes of file and motion differ by no more than what four decimals of a millimetre round, m."""


@dataclass(frozen=True, eq=False)
class WaypointCompanion:
    """What a waypoint file does not say itself.

    Args:
        robot: name of the robot.
        stop_bound: that its moves keep, s; None where no bound was asked for.
        origin: what the waypoints are of, as JSON content.
        motion: body, feet and contact at each waypoint; None where it is not known.
    """

    robot: str
    stop_bound: float | None
    origin: dict[str, Any]
    motion: Trajectory | None = None


def format_waypoint_companion(companion: WaypointCompanion, csv_text: str) -> str:
    """The companion's JSON text, bound to the waypoint file's text by hash."""
    motion = companion.motion
    content = {
        "format": FORMAT,
        "version": 1,
        "csv_sha256": _digest(csv_text),
        "robot": companion.robot,
        "stop_bound": companion.stop_bound,
        "origin": companion.origin,
        "motion": None
        if motion is None
        else {
            "times": motion.times.tolist(),
            "heading": motion.heading.tolist(),
            "contact": motion.contact.astype(int).tolist(),
            "body": motion.body_world.tolist(),
            "feet": motion.feet_world.tolist(),
        },
    }
    return json.dumps(content, allow_nan=False) + "\n"


def parse_waypoint_companion(text: str, csv_text: str, name: str) -> WaypointCompanion | str:
    """Reads a companion; a sentence where it is none of this file.

    Args:
        text: of the companion.
        csv_text: of the waypoint file.
        name: the waypoint file's name, for the sentence.

    Raises:
        InputError: it is bound to this file, and damaged.
    """
    try:
        content = json_content(text, f"The companion of {name}")
        is_known = content.get("format") == FORMAT and content.get("version") == 1
    except (NotJsonError, AttributeError):
        return f"The companion of {name} is no JSON object, so it is left aside."
    if not is_known:
        return f"The companion of {name} is of an unknown format, so it is left aside."
    if content.get("csv_sha256") != _digest(csv_text):
        return f"The companion of {name} belongs to another version of it, so it is left aside."
    try:
        return WaypointCompanion(
            robot=_of_kind(content, "robot", str, "a name"),
            stop_bound=_bound(content),
            origin=_of_kind(content, "origin", dict, "an object"),
            motion=_motion(content),
        )
    except (ValueError, OverflowError) as error:
        raise InputError(
            f"The companion of {name} is damaged: {error}. Write the file anew, or delete the companion.",
            name,
        ) from error


def require_same_strokes(model: RobotModel, motion: Trajectory, waypoints: Waypoints, name: str) -> None:
    """The companion's motion asks for the very strokes of the file.

    Raises:
        InputError: it does not, or is of another number of waypoints.
    """
    strokes = motion.strokes(model)
    if strokes.shape != waypoints.strokes.shape:
        raise InputError(
            f"The companion of {name} has {len(strokes)} poses, the file {waypoints.count}. Write the file "
            "anew, or delete the companion.",
            name,
        )
    difference = float(np.abs(strokes - waypoints.strokes).max())
    if difference > SAME_STROKES:
        raise InputError(
            f"The poses in the companion of {name} ask for strokes that differ by {difference * 1000:.3f} mm "
            "from the file's. Write the file anew, or delete the companion.",
            name,
        )


def _of_kind(content: dict[str, Any], key: str, kind: type[Kind], words: str) -> Kind:
    value = content.get(key)
    if not isinstance(value, kind):
        raise ValueError(f"“{key}” must be {words}")
    return value


def _bound(content: dict[str, Any]) -> float | None:
    if content.get("stop_bound", "") is None:
        return None
    bound = json_numbers(content, "stop_bound")
    if bound.ndim:
        raise ValueError("“stop_bound” must be one number or null")
    return float(bound)


def _motion(content: dict[str, Any]) -> Trajectory | None:
    if content.get("motion", "") is None:
        return None
    motion = _of_kind(content, "motion", dict, "an object or null")
    times, body, heading, feet = (json_numbers(motion, key) for key in ("times", "body", "heading", "feet"))
    return Trajectory(times, body, heading, feet, json_truths(motion, "contact"))


def _digest(text: str) -> str:
    """SHA-256 of the text with line ends of any system, which copying a file may change."""
    return hashlib.sha256(text.replace("\r\n", "\n").encode()).hexdigest()
