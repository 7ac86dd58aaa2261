"""How near the arms of neighbouring legs come: what docs/checks.md says of the library and of long steps."""

from __future__ import annotations

import re
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from app.plans.sequence_plan import plan_of
from core.gait.gait import Gait, heading_step
from core.library.library import Group, library
from core.robot.model import load_robot
from solver_jobs import solve_live
from tests.support.arm_gaps import arm_bars, arm_gaps, segment_distances, strokes_on_way
from tests.support.studio_process import PROJECT

MODEL = load_robot("deltawalker")


def least_gap(gait: Gait) -> float:
    """Along everything that would be sent, mm."""
    plan = plan_of(gait, lambda motion: None, lambda asked: solve_live)
    assert plan.waypoints is not None
    return float(arm_gaps(plan.model, strokes_on_way(plan.waypoints.strokes)).min()) * 1000


@cache
def said() -> dict[str, float]:
    """Figures of the documentation by what they are of, mm."""
    text = (PROJECT / "docs" / "checks.md").read_text()
    return {
        name: float(mm.replace("−", "-"))
        for name, mm in re.findall(r"^\| arms: (.+?) \| (−?[\d.]+) mm \|$", text, re.M)
    }


def test_rods_are_as_long_as_the_robot_s_and_parallel() -> None:
    strokes = np.random.default_rng(3).uniform(0.004, 0.012, (20, 4, 3))
    bars = arm_bars(MODEL, strokes)
    rods = bars[..., :2, 1, :] - bars[..., :2, 0, :]
    np.testing.assert_allclose(np.linalg.norm(rods, axis=-1), MODEL.leg.link_length, atol=1e-12)
    np.testing.assert_allclose(rods[..., 0, :], rods[..., 1, :], atol=1e-12)


def test_segments_are_as_far_apart_as_their_nearest_points() -> None:
    rng = np.random.default_rng(4)
    first, second = rng.uniform(-1.0, 1.0, (2, 300, 2, 3))
    shares = np.linspace(0.0, 1.0, 101)
    on_first, on_second = (
        one[:, None, 0] + shares[:, None] * (one[:, 1] - one[:, 0])[:, None] for one in (first, second)
    )
    sampled = np.linalg.norm(on_first[:, :, None] - on_second[:, None], axis=-1).min(axis=(1, 2))
    exact = segment_distances(first, second)
    assert (exact <= sampled + 1e-12).all()
    np.testing.assert_allclose(exact, sampled, atol=0.02)


@pytest.mark.parametrize("robot", ["deltawalker", "hexapod", "dodecapod"])
def test_the_least_gap_of_the_library_s_gaits_is_the_documented_one(robot: str) -> None:
    entries = {
        name: entry.gait
        for name, entry in library().items()
        if entry.gait.robot == robot and entry.walks and entry.group is not Group.SEQUENCES
    }
    least = min(least_gap(gait) for gait in entries.values())
    assert least == pytest.approx(said()[f"gaits of the {robot}"], abs=0.06)


def test_the_sequence_s_gap_is_the_documented_one() -> None:
    assert least_gap(library()["walk-turn-s-gait"].gait) == pytest.approx(
        said()["walk-turn-s-gait"], abs=0.06
    )


@pytest.mark.parametrize("step", [20, 25])
def test_long_steps_bring_arms_into_each_other_as_documented(step: int) -> None:
    walk = library()["walk"].gait
    asked = replace(walk, step=heading_step(walk.orientation, step / 1000))
    assert least_gap(asked) == pytest.approx(said()[f"walk of {step} mm"], abs=0.06)
