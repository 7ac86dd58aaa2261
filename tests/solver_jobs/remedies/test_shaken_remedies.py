"""The same remedies, in the same order, on every processor."""

from __future__ import annotations

import pytest

from app.bench.common.random_drawings import Family, random_drawing
from core.robot.model import load_robot
from solver_jobs.remedies.search import find_remedies
from tests.support.shaken import shaken


@pytest.mark.heavy
@pytest.mark.parametrize("family", Family)
@pytest.mark.parametrize("number", range(3))
def test_rounding_chooses_no_remedy(family: Family, number: int) -> None:
    gait = random_drawing(2, number, family).gait
    model = load_robot(gait.robot)
    plain = find_remedies(gait, model, lambda: True)
    with shaken():
        other = find_remedies(gait, model, lambda: True)
    assert [(r.label, r.gait) for r in other.remedies] == [(r.label, r.gait) for r in plain.remedies]
    assert [r.sentence for r in other.remedies] == [r.sentence for r in plain.remedies]
