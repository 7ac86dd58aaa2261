"""How near the arms of neighbouring legs come: what docs/checks.md says of the library and of long steps."""

from __future__ import annotations

import re
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from app.plans.sequence_plan import plan_of
from core.arrays import Floats
from core.checks.arms import check_arms
from core.checks.checked_plan import CheckedPlan
from core.gait.gait import Gait, heading_step
from core.library.library import Group, group_ids, library
from core.robot.arms import ARM_GAP, arm_gaps
from core.wire.executed_path import STEPS
from solver_jobs import solve_live
from tests.support.studio_process import PROJECT


def strokes_on_way(strokes: Floats) -> Floats:
    """(m, legs, 3) strokes at the first waypoint and along every move, straight in motor space, m."""
    shares = np.arange(1, STEPS + 1)[:, None, None] / STEPS
    ways = strokes[:-1, None] + shares * np.diff(strokes, axis=0)[:, None]
    return np.concatenate([strokes[:1], ways.reshape(-1, *strokes.shape[1:])])


def least_gap(gait: Gait) -> float:
    """Along everything that would be sent, mm."""
    plan = plan_of(gait, lambda motion: None, lambda asked: solve_live)
    assert plan.way is not None
    assert plan.trajectory is not None
    least = float(arm_gaps(plan.model, strokes_on_way(plan.way.waypoints.strokes)).min())
    (judged,) = check_arms(CheckedPlan(plan.model, plan.trajectory, plan.way.waypoints, way=plan.way))
    margin = judged.margin.margin
    assert margin is not None
    # The rule leaves out moves on which the arms cannot come within its limit.
    assert margin == pytest.approx(least) if least < ARM_GAP else margin >= ARM_GAP
    return least * 1000


@cache
def said() -> dict[str, float]:
    """Figures of the documentation by what they are of, mm."""
    text = (PROJECT / "docs" / "checks.md").read_text()
    return {
        name: float(mm.replace("−", "-"))
        for name, mm in re.findall(r"^\| arms: (.+?) \| (−?[\d.]+) mm \|$", text, re.M)
    }


@pytest.mark.parametrize("robot", ["deltawalker", "hexapod", "dodecapod"])
def test_the_least_gap_of_the_library_s_gaits_is_the_documented_one(robot: str) -> None:
    entries = {
        name: entry.gait
        for name, entry in library().items()
        if entry.gait.robot == robot and entry.walks and entry.group not in (Group.SEQUENCES, Group.FOR_ROBOT)
    }
    least = min(least_gap(gait) for gait in entries.values())
    drawn = "drawn gaits" if robot == "deltawalker" else "gaits"
    assert least == pytest.approx(said()[f"{drawn} of the {robot}"], abs=0.06)


def test_the_least_gap_of_the_gaits_for_the_robot_is_the_documented_one() -> None:
    least = min(least_gap(library()[gait_id].gait) for gait_id in group_ids(Group.FOR_ROBOT))
    assert least == pytest.approx(said()["gaits for this robot"], abs=0.06)


def test_the_sequence_s_gap_is_the_documented_one() -> None:
    assert least_gap(library()["walk-turn-s-gait"].gait) == pytest.approx(
        said()["walk-turn-s-gait"], abs=0.06
    )


@pytest.mark.parametrize("step", [20, 25])
def test_long_steps_bring_arms_into_each_other_as_documented(step: int) -> None:
    walk = library()["walk"].gait
    asked = replace(walk, step=heading_step(walk.orientation, step / 1000))
    assert least_gap(asked) == pytest.approx(said()[f"walk of {step} mm"], abs=0.06)
