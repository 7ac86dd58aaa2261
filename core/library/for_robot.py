"""The gaits for the robot's clock that come with the program."""

import math
from dataclasses import replace
from functools import cache
from typing import Any

from core.data.tables import data_table
from core.gait.gait import Gait, heading_step
from core.gait.poses import FoundPoses, Poses
from core.pose_gaits.gait_poses import USUAL_STEP, gait_of_poses, new_pose_gait, pose_problem, with_poses
from core.robot.model import load_robot

CYCLES = 3
STOP_BOUND = 1.5
"""Stop bound of a new gait for the robot's clock, s: 1.0 s would cost nearly half of its speed."""
MARGIN = 0.006
ATLAS = "deltawalker-small"
"""The included atlas, of which most of these gaits have a number."""


def asked_gait(item: dict[str, Any], like: Gait) -> Gait:
    """An entry of for_robot.toml as a document without poses.

    Args:
        item: the entry.
        like: the gait that gives foot order and heading.
    """
    step, turn = item.get("step"), math.radians(item.get("turn", 0.0))
    dx, dy, _ = heading_step(like.orientation, USUAL_STEP if step is None else step)
    is_free = step is None or (step == 0.0 and not item.get("exact", False))
    number = f" Atlas gait {item['atlas']}." if "atlas" in item else ""
    options = replace(
        like.options,
        margin=item.get("margin", MARGIN),
        clearance=item.get("clearance", like.options.clearance),
        stop_bound=STOP_BOUND,
        merge=0.0,
    )
    asked = replace(
        like,
        order=tuple(item.get("order", like.order)),
        step=(dx, dy, turn),
        iterations=CYCLES,
        options=options,
        notes=f"{item['note']}{number}",
    )
    return new_pose_gait(item["name"], asked, Poses(free_step=is_free), load_robot(like.robot))


def gait_for_robot(item: dict[str, Any], like: Gait) -> Gait:
    """An entry as a document with its poses, where they were found for exactly it; else without."""
    gait = asked_gait(item, like)
    found = found_poses().get(item["id"])
    if found is None:
        return gait
    solved = gait_of_poses(pose_problem(gait, load_robot(gait.robot)), found)
    return with_poses(gait, solved)


@cache
def found_poses() -> dict[str, FoundPoses]:
    """The poses of poses.toml by the id of their gait."""
    return {gait_id: FoundPoses(**content) for gait_id, content in data_table("poses.toml").items()}
