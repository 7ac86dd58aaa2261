"""The same frontier, for the same reason, on every processor."""

from __future__ import annotations

import pytest

from core.library.library import library
from core.robot.model import load_robot
from solver_jobs import FrontierSearch
from tests.support.shaken import shaken


@pytest.mark.heavy
@pytest.mark.parametrize("gait_id", ["walk", "c-gait", "s-gait", "hexapod-wave"])
def test_rounding_chooses_neither_the_step_nor_what_limits_it(gait_id: str) -> None:
    gait = library()[gait_id].gait
    model = load_robot(gait.robot)
    plain = FrontierSearch(gait, model, exact=False).run()
    with shaken():
        other = FrontierSearch(gait, model, exact=False).run()
    assert other.reach == pytest.approx(plain.reach, abs=1e-9)
    assert other.limited_by == plain.limited_by
    assert other.explanation == plain.explanation
