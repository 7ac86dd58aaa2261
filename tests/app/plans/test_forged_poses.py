"""Poses that somebody edited by hand, each within reach of the motors: the check refuses them."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from app.cli import gait_motion
from app.documents.gait_json import gait_content, gait_from_content
from app.export.way_files import checked_way, read_way_file
from app.plans.make_plan import make_plan
from app.plans.plan import PlanSource
from core.arrays import Bools
from core.checks.checked_plan import checked_plan
from core.checks.rules import check_plan
from core.errors import FootfallError, InputError
from core.gait.gait import Gait
from core.library.library import library
from core.motion.trajectory import Trajectory
from core.pose_gaits.gait_poses import asked_of, found_gait, pose_problem
from core.pose_gaits.pose_check import check_poses
from core.pose_gaits.pose_gait import PoseGait
from core.problem.motion_problem import MotionProblem
from core.robot.model import load_robot
from core.wire.waypoint_companion import WaypointCompanion, format_waypoint_companion
from core.wire.waypoints import Waypoints, format_waypoint_csv
from solver_jobs import MotionResult, PoseResult

WALK = library()["fast-walk"].gait
MODEL = load_robot(WALK.robot)


def never_solve(problem: MotionProblem) -> MotionResult:
    raise AssertionError("poses need no live tier")


def found() -> PoseGait:
    """The walk's own poses."""
    gait = found_gait(WALK, MODEL)
    assert gait is not None
    return gait


POSES = found()
AIRBORNE: Bools = POSES.problem.airborne
POSE, FOOT = (int(i) for i in np.argwhere(AIRBORNE)[len(np.argwhere(AIRBORNE)) // 2])
"""A pose in the middle of the walk, and the foot that swings at it."""
STANDING = int(np.nonzero(~AIRBORNE[POSE])[0][0])
Forge = Callable[[dict[str, Any]], object]


def body(axis: int, metres: float, *poses: int) -> Forge:
    """Moves the body at some poses."""

    def forge(content: dict[str, Any]) -> None:
        for pose in poses:
            content["poses"]["found"]["bodies"][pose][axis] += metres

    return forge


def foot(foot: int, axis: int, metres: float, pose: int = POSE) -> Forge:
    """Moves a foot at a pose."""

    def forge(content: dict[str, Any]) -> None:
        content["poses"]["found"]["feet"][pose][foot][axis] += metres

    return forge


def pose_again(content: dict[str, Any]) -> None:
    """Leaves a move out, so that the next one is longer."""
    poses = content["poses"]["found"]
    for key in ("bodies", "feet"):
        poses[key][POSE] = poses[key][POSE - 1]


def reverse(content: dict[str, Any]) -> None:
    """Goes backwards."""
    for key in ("bodies", "feet"):
        content["poses"]["found"][key].reverse()


def another(**changes: Any) -> Forge:
    """Changes the document and says that the poses were found for it as it is now."""

    def forge(content: dict[str, Any]) -> None:
        for key, value in changes.items():
            place = next(one for one in (content["options"], content["poses"], content) if key in one)
            place[key] = value
        problem = pose_problem(gait_from_content(content), MODEL)
        content["poses"]["found"]["answers"] = asked_of(problem)

    return forge


FORGERIES: dict[str, tuple[Forge, str]] = {
    "the body lifts a foot less": (body(1, 0.004, POSE), "clearance"),
    "a swing in the ground": (foot(FOOT, 2, -0.004), "clearance"),
    "a swing that drags": (foot(FOOT, 2, -float(POSES.feet[POSE, FOOT, 2])), "clearance"),
    "a standing foot in the air": (foot(STANDING, 2, 0.003), "footholds"),
    "a standing foot in the ground": (foot(STANDING, 2, -0.002), "footholds"),
    "a foothold that moves": (foot(STANDING, 0, 0.002), "slip"),
    "arms in one another": (lambda content: [foot(FOOT, i, 0.012)(content) for i in (0, 1)], "arm distance"),
    "a shorter step": (lambda content: content["poses"]["found"].update(step=0.02), "step"),
    "a start beside the stance": (body(2, 0.001, 0), "ends"),
    "the other direction": (reverse, "margin"),
    "a move left out": (pose_again, "stop bound"),
    "more margin than there is": (another(margin=0.0062), "margin"),
    "more clearance than there is": (another(clearance=0.012), "clearance"),
    "less slip than there is": (another(slip=0.00005), "slip"),
    "shoes nearer than asked": (another(shoe_distance=0.05), "shoe distance"),
    "arms nearer than asked": (another(arm_distance=0.01), "arm distance"),
    "a longer move than asked": (another(stop_bound=1.0), "stop bound"),
    "another order of feet": (another(order=[4, 1, 3, 2]), "footholds"),
}
"""By what was done: how, and a limit that the check names."""


def forged(name: str) -> Gait:
    content = json.loads(json.dumps(gait_content(WALK)))
    FORGERIES[name][0](content)
    return gait_from_content(content)


@pytest.mark.parametrize("name", FORGERIES)
def test_the_check_refuses_forged_poses(name: str) -> None:
    gait = forged(name)
    poses = found_gait(gait, MODEL)
    assert poses is not None
    limits = {finding.limit for finding in check_poses(poses).findings}
    assert FORGERIES[name][1] in limits


@pytest.mark.parametrize("name", FORGERIES)
def test_forged_poses_are_no_plan_that_may_be_approved(name: str) -> None:
    gait = forged(name)
    plan = make_plan(gait, None, never_solve)
    assert plan.is_draft
    if plan.way is not None and plan.trajectory is not None:
        checked = checked_plan(gait, MODEL, plan.trajectory, plan.way, is_draft=plan.is_draft)
        assert "computed" in {finding.rule for finding in check_plan(checked).errors}


@pytest.mark.parametrize("name", FORGERIES)
def test_a_command_searches_instead_of_taking_forged_poses(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    def nothing(problem: object) -> PoseResult:
        raise InputError("a search", "poses")

    monkeypatch.setattr(gait_motion, "solve_poses", nothing)
    with pytest.raises(FootfallError, match="a search"):
        gait_motion.poses_of(forged(name))


def test_a_timeline_that_hides_feet_in_the_air_is_refused() -> None:
    content = gait_content(WALK)
    content["timeline"] = {**content["timeline"], "feet": ["1" * len(AIRBORNE)] * MODEL.leg_count}
    gait = gait_from_content(content)
    plan = make_plan(gait, None, never_solve)
    assert plan.source is PlanSource.DRAFT
    assert "other feet in the air than its poses" in plan.note
    with pytest.raises(InputError, match="other feet in the air than its poses"):
        gait_motion.poses_of(gait)


def test_a_stored_result_of_forged_poses_is_no_plan() -> None:
    poses = forged("a foothold that moves").poses
    bare = replace(WALK, poses=replace(WALK.poses, found=None)) if WALK.poses else WALK
    kept = gait_content(replace(bare, poses=poses))["poses"]["found"]
    assert make_plan(bare, {"found": kept}, never_solve).is_draft


def write_way(folder: Path, way: Waypoints, motion: Trajectory | None, **origin: Any) -> Path:
    """A waypoint file with its companion."""
    path, text = folder / "way.csv", format_waypoint_csv(way)
    path.write_text(text)
    companion = WaypointCompanion(MODEL.name, 1.5, origin, motion)
    (folder / "way.footfall.json").write_text(format_waypoint_companion(companion, text))
    return path


MOTION = POSES.trajectory
UP = np.array([0.0, 0.0, 0.01])


def contact(value: int, *places: tuple[int, int]) -> Trajectory:
    """The motion whose companion says something else of some feet."""
    told = MOTION.contact.copy()
    for place in places:
        told[place] = bool(value)
    return replace(MOTION, contact=told)


COMPANIONS: dict[str, tuple[Trajectory, str]] = {
    "a foot in the air stands": (contact(1, (POSE, FOOT)), "contact"),
    "all feet stand always": (replace(MOTION, contact=np.ones_like(MOTION.contact)), "contact"),
    "a foot that stands swings": (contact(0, (POSE, STANDING)), "balance"),
    "a foot never stands": (contact(0, *((i, FOOT) for i in range(len(AIRBORNE)))), "balance"),
    "everything is higher": (
        replace(MOTION, body_world=MOTION.body_world + UP, feet_world=MOTION.feet_world + UP),
        "contact",
    ),
}


@pytest.mark.parametrize("name", COMPANIONS)
def test_a_companion_that_says_other_contacts_than_its_strokes_is_an_error(name: str, tmp_path: Path) -> None:
    motion, rule = COMPANIONS[name]
    read = read_way_file(write_way(tmp_path, POSES.waypoints, motion))
    verdict = check_plan(checked_way(MODEL, motion, read))
    assert rule in {finding.rule for finding in verdict.errors}


def test_a_companion_of_another_robot_or_other_strokes_is_refused(tmp_path: Path) -> None:
    other = replace(POSES.waypoints, strokes=POSES.waypoints.strokes + 0.0005)
    with pytest.raises(InputError, match="ask for strokes that differ"):
        read_way_file(write_way(tmp_path, other, MOTION))
    path = write_way(tmp_path, POSES.waypoints, MOTION)
    companion = tmp_path / "way.footfall.json"
    companion.write_text(json.dumps({**json.loads(companion.read_text()), "robot": "hexapod"}))
    with pytest.raises(InputError, match="has the strokes of 4 feet"):
        read_way_file(path)


def test_no_pause_ends_where_a_companion_has_all_feet_down_and_the_strokes_have_not(tmp_path: Path) -> None:
    everywhere = list(range(POSES.waypoints.count))
    read = read_way_file(write_way(tmp_path, POSES.waypoints, None, all_feet_down=everywhere))
    assert read.hold_ok == tuple(not row.any() for row in AIRBORNE)
    assert "No pause ends there" in read.assumptions[-1]
