"""How far gaits get: found on the live tier, confirmed by the exact one, and what is lacking just above."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from core.gait.gait import Gait, drawn_timeline, heading_step, motion_problem, with_return
from core.library.library import library
from core.problem.motion_check import FAMILIES, OPTIONAL_FAMILIES, check_motion
from core.problem.motion_problem import Workspace
from core.robot.model import load_robot
from solver_jobs import FrontierSearch, SolveStatus, solve_motion
from tests.support.solvers.cases import BARE

MODEL = load_robot("deltawalker")


def gait_with(gait_id: str, **options: Any) -> Gait:
    gait = library()[gait_id].gait
    return replace(gait, options=replace(gait.options, **{"margin": 0.0, **options}))


@pytest.mark.heavy
def test_the_exact_tier_confirms_the_frontier_and_finds_nothing_a_millimetre_above() -> None:
    found = FrontierSearch(gait_with("amble", workspace=Workspace.CYLINDER), MODEL).run()
    assert found.confirmed
    assert found.reach >= found.live_reach > 0.015
    assert found.reach == pytest.approx(np.hypot(*found.gait.step[:2]))
    assert found.motion is not None
    assert check_motion(motion_problem(found.gait, MODEL), found.motion).confirmed
    above = replace(found.gait, step=heading_step(found.gait.orientation, found.reach + 0.001))
    assert solve_motion(motion_problem(above, MODEL)).status is SolveStatus.INFEASIBLE


def test_what_limits_the_step_is_named_as_in_the_contract() -> None:
    found = FrontierSearch(gait_with("walk"), BARE, exact=False).run()
    assert found.limited_by == ("foot_speed",)
    assert set(found.limited_by) <= set(FAMILIES) | set(OPTIONAL_FAMILIES)
    assert "faster than 15 mm/s" in found.explanation[0]
    assert not found.confirmed


def test_shoes_end_the_walk_s_step_where_a_foot_comes_up_to_its_neighbour() -> None:
    found = FrontierSearch(gait_with("walk"), MODEL, exact=False).run()
    assert found.limited_by == ("shoe_distance",)
    assert found.reach == pytest.approx(0.04 * np.sqrt(2) - 0.028, abs=1e-4)
    assert "Shoes need" in found.explanation[0]


@pytest.mark.heavy
def test_a_margin_and_the_cylinder_shorten_the_step() -> None:
    wide, narrow, safe = (
        FrontierSearch(gait, MODEL, exact=False).run().reach
        for gait in (
            gait_with("s-gait"),
            gait_with("s-gait", workspace=Workspace.CYLINDER),
            gait_with("s-gait", margin=0.003),
        )
    )
    assert wide > safe > narrow > 0.01


@pytest.mark.heavy
def test_free_heights_get_at_least_as_far_as_the_given_one() -> None:
    high = gait_with("s-gait", plane_height=0.060)
    given = FrontierSearch(high, MODEL, heights=(), exact=False).run()
    free = FrontierSearch(high, MODEL, exact=False).run()
    assert given.gait.options.plane_height == 0.060
    assert free.reach > given.reach
    assert free.gait.options.plane_height < 0.060


@pytest.mark.heavy
def test_longer_phases_get_further_where_foot_speed_is_the_limit() -> None:
    found = FrontierSearch(gait_with("walk"), BARE, free_phases=True, exact=False).run()
    fixed = FrontierSearch(gait_with("walk"), BARE, exact=False).run()
    assert found.reach > fixed.reach + 0.005
    assert found.gait.options.phase_knots > 5
    assert found.gait.timeline == drawn_timeline(found.gait)


@pytest.mark.heavy
@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_a_rotation_is_asked_how_far_it_turns(sense: float) -> None:
    rotate = replace(gait_with("rotate"), step=(0.0, 0.0, sense * 0.2))
    found = FrontierSearch(rotate, MODEL, free_return=True, exact=False).run()
    assert found.turns
    assert np.radians(25) < found.reach < np.radians(40)
    assert np.sign(found.gait.step[2]) == sense
    assert found.gait.timeline == with_return(found.gait, MODEL).timeline


@pytest.mark.heavy
@pytest.mark.parametrize(
    ("options", "family"),
    [({"margin": 0.020}, "body_torque"), ({"motor_speed": 0.0005}, "motor_speed")],
)
def test_a_gait_that_cannot_step_at_all_says_why(options: dict[str, float], family: str) -> None:
    found = FrontierSearch(gait_with("walk", **options), MODEL, heights=()).run()
    assert (found.reach, found.confirmed, found.motion) == (0.0, False, None)
    assert family in found.limited_by
    assert found.explanation
