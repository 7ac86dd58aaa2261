"""Remedies: each walks as it says, keeps what it can, and the best one comes first."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from app.bench.common.random_drawings import random_drawing
from core.gait.gait import Gait, heading_step, motion_problem
from core.library.library import library
from core.motion.contact_timeline import ContactTimeline
from core.problem.motion_check import check_motion
from core.robot.model import load_robot
from solver_jobs import Remedy, RemedyKind, SolveStatus, solve_live
from solver_jobs.remedies.remedy import MOST
from solver_jobs.remedies.search import find_remedies

WALK = library()["walk"].gait


def painted(gait: Gait, foot: int, first: int, last: int, *, stance: bool = False) -> Gait:
    """A stroke on the row of a foot, counted from 1, over samples counted from 0."""
    cells = gait.timeline.stance.copy()
    cells[foot - 1, first : last + 1] = stance
    return replace(gait, timeline=replace(gait.timeline, stance=cells))


def locked(gait: Gait, foot: int) -> Gait:
    cells = np.zeros(gait.timeline.stance.shape, dtype=np.bool_)
    cells[foot - 1] = True
    return replace(gait, timeline=ContactTimeline(gait.timeline.stance, cells, gait.timeline.sample_time))


def remedies_of(gait: Gait) -> tuple[Remedy, ...]:
    search = find_remedies(gait, load_robot(gait.robot), lambda: True)
    assert search.complete
    assert len(search.remedies) <= MOST
    for remedy in search.remedies:
        problem = motion_problem(remedy.gait, load_robot(gait.robot))
        result = solve_live(problem)
        assert result.status is SolveStatus.SOLVED, remedy.label
        assert check_motion(problem, result.trajectory).confirmed
    return search.remedies


def kinds(remedies: tuple[Remedy, ...]) -> list[RemedyKind]:
    return [remedy.kind for remedy in remedies]


def test_overlapping_swings_are_laid_one_after_the_other_or_in_a_longer_gait() -> None:
    overlapping = painted(WALK.with_options(margin=0.006), 1, 6, 12)
    found = remedies_of(overlapping)
    assert {RemedyKind.ONE_BY_ONE, RemedyKind.LONGER} <= set(kinds(found))
    for remedy in (one for one in found if not one.caution):
        assert remedy.gait.options.margin == 0.006
        assert (~remedy.gait.timeline.stance).sum(axis=0).max() == 1
    (same_time,) = (remedy for remedy in found if remedy.kind is RemedyKind.ONE_BY_ONE)
    assert same_time.gait.timeline.sample_count == overlapping.timeline.sample_count


def test_every_remedy_asks_for_the_robots_own_margin_and_says_so() -> None:
    found = remedies_of(painted(WALK.with_options(margin=0.002), 1, 6, 12))
    assert found[0].gait.options.margin == load_robot("deltawalker").margin
    assert "Margin 6 mm" in found[0].sentence


def test_a_step_that_is_too_long_keeps_its_way_in_more_iterations() -> None:
    long = replace(WALK.with_options(margin=0.006), step=heading_step(WALK.orientation, 0.034))
    found = remedies_of(long)
    assert {RemedyKind.STEP, RemedyKind.ITERATIONS} <= set(kinds(found))
    (twice,) = (remedy.gait for remedy in found if remedy.kind is RemedyKind.ITERATIONS)
    assert np.hypot(*twice.step[:2]) * twice.iterations == pytest.approx(0.034)
    (step,) = (remedy.gait for remedy in found if remedy.kind is RemedyKind.STEP)
    further = replace(step, step=heading_step(WALK.orientation, float(np.hypot(*step.step[:2])) + 0.0008))
    assert solve_live(motion_problem(further, load_robot("deltawalker"))).status is SolveStatus.INFEASIBLE


def test_a_margin_that_nobody_can_keep_has_a_largest() -> None:
    found = remedies_of(WALK.with_options(margin=0.020))
    assert kinds(found)[0] is RemedyKind.MARGIN
    assert 0.010 < found[0].gait.options.margin < 0.020


def test_a_drawing_that_ends_in_the_air_is_mended_first() -> None:
    found = remedies_of(painted(WALK.with_options(margin=0.006), 3, 40, 44))
    assert found
    for remedy in found:
        assert remedy.gait.timeline.stance[:, -1].all()


def test_a_foot_without_a_swing_gets_one() -> None:
    found = remedies_of(painted(WALK.with_options(margin=0.006), 2, 0, 44, stance=True))
    assert found
    assert {swing.foot for swing in found[0].gait.timeline.swings()} == {0, 1, 2, 3}


def test_locked_cells_stay_as_they_are() -> None:
    drawing = locked(painted(WALK.with_options(margin=0.006), 1, 6, 12), 3)
    found = remedies_of(drawing)
    assert found
    for remedy in found:
        assert remedy.gait.timeline.sample_count == drawing.timeline.sample_count
        assert np.array_equal(remedy.gait.timeline.stance[2], drawing.timeline.stance[2])


def test_what_asks_for_no_margin_comes_last_and_warns() -> None:
    found = remedies_of(painted(WALK.with_options(margin=0.006), 1, 6, 12))
    assert [bool(remedy.caution) for remedy in found] == [False] * (len(found) - 1) + [True]
    assert found[-1].kind is RemedyKind.NO_MARGIN


def test_the_better_a_remedy_keeps_what_was_asked_the_earlier_it_comes() -> None:
    long = replace(WALK.with_options(margin=0.006), step=heading_step(WALK.orientation, 0.028))
    found = remedies_of(long)
    margins = [remedy.gait.options.margin >= 0.006 for remedy in found]
    assert margins == sorted(margins, reverse=True)


@pytest.mark.parametrize("number", range(12))
def test_random_drawings_have_a_remedy(number: int) -> None:
    assert remedies_of(random_drawing(5, number).gait)
