"""Robots of lines, and the reach of the feet, as the page gets them."""

import numpy as np
import pytest

from app.scene.ghost import ghost_blob, part_lines
from app.scene.reach import LAYERS, RAYS, reach_table
from core.arrays import Floats
from core.gait.gait import motion_problem
from core.library.library import optimised_entry
from core.motion.trajectory import Trajectory
from core.problem.initial_guess import initial_guess
from core.problem.motion_problem import Workspace
from core.robot.kinematics import feet_in_modules
from core.robot.leg import strokes_from_foot
from core.robot.model import ROBOT_NAMES, RobotModel, load_robot

MOVING_NODES = 50


def walk() -> tuple[RobotModel, Trajectory]:
    model = load_robot("deltawalker")
    return model, initial_guess(motion_problem(optimised_entry("walk").gait, model))


def placed(pose: Floats, points: Floats) -> Floats:
    w, q, at = float(pose[0]), np.asarray(pose[1:4], dtype=float), np.asarray(pose[4:], dtype=float)
    return np.asarray(points + 2 * np.cross(q, np.cross(q, points) + w * points) + at)


def test_every_rod_of_a_ghost_ends_at_its_platforms_bar() -> None:
    model, plan = walk()
    blob = ghost_blob(model, plan)
    frames = dict(zip(blob.names, np.swapaxes(blob.frames, 0, 1), strict=True))
    rod = part_lines(model)["/robot/leg2_rod1a"][0]
    for frame, foot in zip(frames["/robot/leg2_rod1a"], frames["/robot/leg2_foot"], strict=True):
        end = placed(frame, rod[1])
        assert np.linalg.norm(end - foot[4:]) == pytest.approx(model.leg.platform_radius, abs=1e-5)
        assert end[2] == pytest.approx(foot[6], abs=1e-5)


def test_a_ghost_stands_where_the_plan_says_from_its_first_to_its_last_knot() -> None:
    model, plan = walk()
    blob = ghost_blob(model, plan)
    foot = blob.frames[:, blob.names.index("/robot/leg3_foot"), 4:]
    assert foot[[0, -1]] == pytest.approx(plan.feet_world[[0, -1], 2], abs=1e-6)
    assert blob.times[-1] == pytest.approx(plan.times[-1])


@pytest.mark.parametrize("name", ROBOT_NAMES)
def test_a_ghosts_lines_are_few_and_finite(name: str) -> None:
    lines = part_lines(load_robot(name))
    assert sum(len(pieces) for pieces in lines.values()) < 500
    assert all(np.isfinite(pieces).all() and pieces.shape[1:] == (2, 3) for pieces in lines.values())


@pytest.mark.parametrize("workspace", list(Workspace))
def test_the_reach_of_every_knot_lies_round_the_standing_feet(workspace: Workspace) -> None:
    model, plan = walk()
    table = reach_table(model, plan, workspace)
    radii = np.array(table["radii"])
    assert radii.shape == (plan.knot_count, len(LAYERS), RAYS)
    feet = feet_in_modules(model, plan.feet_world, plan.pose(model))
    inside = np.linalg.norm(feet[..., :2], axis=-1) <= radii[:, :1].max(axis=-1)
    strokes = strokes_from_foot(model.leg, feet)
    assert np.isfinite(strokes).all()
    assert inside[plan.contact].all()
