"""Where the largest value is looked for, and how the largest margin is foreseen."""

from __future__ import annotations

from dataclasses import dataclass, field

import pytest

from core.gait.gait import Gait
from core.library.library import library
from core.robot.model import load_robot
from solver_jobs.remedies.trial import Trial

UNIT = 1e-4
MODEL = load_robot("deltawalker")
WALK = library()["walk"].gait


@dataclass(frozen=True, eq=False)
class UpTo(Trial):
    """Margins up to a limit work; nothing is solved."""

    limit: float = 0.0
    tries: list[float] = field(default_factory=list)

    def works(self, gait: Gait) -> bool:
        self.tries.append(gait.options.margin)
        return gait.options.margin <= self.limit


def up_to(limit: float) -> UpTo:
    return UpTo(MODEL, lambda: True, limit=limit)


def found(trial: Trial, least: float, most: float, near: float | None) -> float | None:
    return trial.largest(least, most, lambda value: WALK.with_options(margin=value), UNIT, near)


@pytest.mark.parametrize("limit", [-1.0, 0.00599, 0.006, 0.01234, 0.02595, 0.026, 0.0263, 1.0])
@pytest.mark.parametrize("near", [0.0, 0.006, 0.0123, 0.0124, 0.02, 0.026, 0.03])
def test_wherever_it_is_expected_the_same_is_found(limit: float, near: float) -> None:
    least, most = 0.006, 0.02634
    plain = found(up_to(limit), least, most, None)
    assert found(up_to(limit), least, most, near) == plain
    if limit < least:
        assert plain is None
    else:
        assert plain is not None
        assert plain <= limit
        assert plain == most or plain + UNIT > min(limit, most) - 1e-9


def test_two_tries_do_where_it_is_expected_rightly() -> None:
    trial = up_to(0.0165)
    assert found(trial, 0.0, 0.03, 0.01657) == pytest.approx(0.0165)
    assert len(trial.tries) == 2


@pytest.mark.parametrize("name", ["walk", "amble", "s-gait", "rotate", "hexapod-tripod"])
def test_the_largest_margin_is_foreseen(name: str) -> None:
    gait = library()[name].gait
    trial = Trial(load_robot(gait.robot), lambda: True)
    searched = trial.largest(0.0, 0.03, lambda value: gait.with_options(margin=value), UNIT)
    foreseen = trial.best_margin(gait, 0.03)
    assert searched is not None
    assert foreseen is not None
    assert searched - UNIT <= foreseen <= searched + 2 * UNIT


def test_no_margin_is_foreseen_where_nothing_walks() -> None:
    assert Trial(MODEL, lambda: True).best_margin(library()["textbook-bound"].gait, 0.03) is None
