"""The simulated robot as the page gets it: level where it is level, leaning as a whole where it leans."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from app.scene.ghost import ghost_blob
from app.scene.simulated_ghost import FRAMES_A_SECOND, simulated_blob
from app.simulation.view import motion_content
from core.physics.metrics import report
from core.physics.motion import SimulatedMotion
from tests.support.simulated_walk import BEHIND, followed, walk_problem, walk_report

PROBLEM = walk_problem()
MODEL = PROBLEM.model


def content(motion: SimulatedMotion | None = None) -> dict[str, Any]:
    shown = motion or followed(PROBLEM)
    return motion_content(PROBLEM, shown, report(PROBLEM, shown))


def test_a_robot_that_follows_the_plan_is_drawn_as_the_plan() -> None:
    plan = ghost_blob(MODEL, PROBLEM.plan, FRAMES_A_SECOND)
    ghost = simulated_blob(MODEL, content())
    assert ghost.names == plan.names
    aside = np.array([0.0, BEHIND, 0.0])
    assert ghost.frames[..., 4:] == pytest.approx(plan.frames[..., 4:] + aside, abs=1e-5)
    assert ghost.frames[..., :4] == pytest.approx(plan.frames[..., :4], abs=1e-4)


def test_a_robot_that_leans_keeps_its_shape() -> None:
    upright, half = followed(PROBLEM), np.radians(20.0) / 2
    count = len(upright.times)
    turned = np.array(
        [[1, 0, 0], [0, np.cos(2 * half), -np.sin(2 * half)], [0, np.sin(2 * half), np.cos(2 * half)]]
    )
    leaning = replace(
        upright,
        attitude=np.tile([np.cos(half), np.sin(half), 0.0, 0.0], (count, 1)),
        body_world=upright.body_world @ turned.T,
        feet_world=upright.feet_world @ turned.T,
    )
    level, ghost = (simulated_blob(MODEL, content(motion)).frames for motion in (upright, leaning))
    assert ghost[..., 4:] == pytest.approx(level[..., 4:] @ turned.T, abs=1e-5)
    assert np.linalg.norm(ghost[..., :4], axis=-1) == pytest.approx(1.0, abs=1e-5)


def test_feet_that_carry_load_and_slides_are_marked() -> None:
    slips = np.zeros((PROBLEM.waypoints.count, MODEL.leg_count))
    slips[4, 2] = 0.003
    motion = followed(PROBLEM)
    shown = motion_content(PROBLEM, motion, walk_report(slip_samples=slips))
    overlay = simulated_blob(MODEL, shown).overlay
    assert overlay is not None
    assert overlay["contacts"][0] == "1111"
    assert {len(row) for row in overlay["contacts"]} == {4}
    assert any("0" in row for row in overlay["contacts"])
    (line,) = overlay["slips"]
    ends = motion.feet_world[motion.arrivals[[3, 4]], 2]
    assert np.array(line)[:, :2] == pytest.approx(ends[:, :2], abs=1e-5)
    assert np.array(line)[:, 2] == pytest.approx(-MODEL.sole_depth)


def test_a_leaning_robot_slides_where_its_soles_are() -> None:
    slips = np.zeros((PROBLEM.waypoints.count, MODEL.leg_count))
    slips[4, 2] = 0.003
    upright, lean = followed(PROBLEM), np.radians(3.0)
    attitude = np.tile([np.cos(lean / 2), 0.0, np.sin(lean / 2), 0.0], (len(upright.times), 1))
    leaning = replace(upright, attitude=attitude)
    (mark,) = motion_content(PROBLEM, leaning, walk_report(slip_samples=slips))["slips"]
    platforms = upright.feet_world[upright.arrivals[[3, 4]], 2, :2]
    aside = [MODEL.sole_depth * np.sin(lean), 0.0]
    assert np.array(mark["way"])[:, :2] == pytest.approx(platforms - aside, abs=1e-5)


def test_a_run_that_broke_off_is_drawn_as_far_as_it_went() -> None:
    motion = followed(PROBLEM, moves=6)
    ghost = simulated_blob(MODEL, content(replace(motion, ended_early="It fell.")))
    assert ghost.times[-1] == pytest.approx(PROBLEM.times[6])
