"""How far one number can go: up to there it works, and a little further it does not."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from core.gait.gait import Gait, heading_step, motion_problem
from core.library.library import library
from core.robot.model import load_robot
from solver_jobs import SolveStatus, solve_live
from solver_jobs.remedies.limit import Limit, largest_value

MODEL = load_robot("deltawalker")
WALK = library()["walk"].gait.with_options(margin=0.006)


def works(gait: Gait) -> bool:
    return solve_live(motion_problem(gait, MODEL)).status is SolveStatus.SOLVED


def changed(gait: Gait, which: Limit, value: float) -> Gait:
    match which:
        case Limit.STEP:
            return replace(gait, step=heading_step(gait.orientation, value))
        case Limit.TURN:
            return replace(gait, step=(*gait.step[:2], value))
        case Limit.MARGIN:
            return gait.with_options(margin=value)
        case Limit.CLEARANCE:
            return gait.with_options(clearance=value)


@pytest.mark.parametrize(
    ("which", "further"),
    [
        (Limit.STEP, 0.0006),
        (Limit.TURN, np.radians(1.5)),
        (Limit.MARGIN, 0.0004),
        (Limit.CLEARANCE, 0.0004),
    ],
)
def test_the_limit_is_where_it_stops_to_work(which: Limit, further: float) -> None:
    value = largest_value(WALK, MODEL, which, lambda: True)
    assert value is not None
    assert value > 0
    assert works(changed(WALK, which, value))
    assert not works(changed(WALK, which, value + further))


def test_the_value_that_is_drawn_plays_no_part() -> None:
    short, long = (replace(WALK, step=heading_step(WALK.orientation, step)) for step in (0.001, 0.05))
    assert largest_value(short, MODEL, Limit.STEP, lambda: True) == pytest.approx(
        largest_value(long, MODEL, Limit.STEP, lambda: True), abs=1e-4
    )


def test_there_is_none_where_nothing_works_and_where_it_is_ended() -> None:
    stance = WALK.timeline.stance.copy()
    stance[:, 6:9] = False
    floating = replace(WALK, timeline=replace(WALK.timeline, stance=stance))
    assert largest_value(floating, MODEL, Limit.STEP, lambda: True) is None
    assert largest_value(WALK, MODEL, Limit.STEP, lambda: False) is None
