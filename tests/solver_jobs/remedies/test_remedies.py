"""Remedies: each walks as it says, keeps what it can, and the best one comes first."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from app.bench.common.random_drawings import random_drawing
from core.checks.arms import check_arms_of_waypoints
from core.gait.gait import Gait, heading_step, motion_problem
from core.gait.held_feet import HeldFeet
from core.library.library import library
from core.motion.contact_timeline import ContactTimeline
from core.problem.motion_check import check_motion
from core.robot.model import load_robot
from core.wire.waypoint_merging import plan_waypoints
from solver_jobs import Remedy, RemedyKind, SolveStatus, solve_live
from solver_jobs.remedies.layout import items_of, longer, one_after_the_other, with_single_swings
from solver_jobs.remedies.remedy import MOST_REMEDIES, is_one_by_one, order_words
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
    assert len(search.remedies) <= MOST_REMEDIES
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
    (same_time,) = (remedy for remedy in found if remedy.label == "One foot after the other")
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
    steps = [remedy.gait for remedy in found if remedy.kind is RemedyKind.STEP]
    step = max(steps, key=lambda gait: float(np.hypot(*gait.step[:2])))
    further = replace(step, step=heading_step(WALK.orientation, float(np.hypot(*step.step[:2])) + 0.0008))
    assert solve_live(motion_problem(further, load_robot("deltawalker"))).status is SolveStatus.INFEASIBLE


def test_a_step_whose_arms_touch_says_so_and_comes_after_the_largest_whose_arms_keep_clear() -> None:
    long = replace(WALK.with_options(margin=0.006), step=heading_step(WALK.orientation, 0.030))
    found = remedies_of(long)
    cautions = {remedy.label: remedy.caution for remedy in found}
    assert cautions["Step 28.5 mm"] == "The arms of legs 2 and 3 touch: 4.2 mm in one another."
    assert found[-1].label == "Step 28.5 mm"
    (clear,) = (one for one in found if one.kind is RemedyKind.STEP and not one.caution)
    assert clear.label == "Step 23.8 mm"
    for remedy in found:
        assert is_warned_of_arms(remedy) == bool(remedy.caution), remedy.label


def is_warned_of_arms(remedy: Remedy) -> bool:
    """Whether the check warns of the arms in a remedy's motion as sent."""
    model, options = load_robot(remedy.gait.robot), remedy.gait.options
    way = plan_waypoints(model, remedy.motion.trajectory, options.merge, options.stop_bound)
    (outcome,) = check_arms_of_waypoints(model, way.waypoints)
    return bool(outcome.findings)


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


@pytest.mark.heavy
@pytest.mark.parametrize("number", range(12))
def test_random_drawings_have_a_remedy(number: int) -> None:
    assert remedies_of(random_drawing(5, number).gait)


def test_of_two_swings_of_a_foot_the_one_beside_others_is_removed() -> None:
    twice = painted(WALK, 1, 20, 26)
    single = with_single_swings(twice)
    swings = [swing for swing in single.timeline.swings() if swing.foot == 0]
    assert len(swings) == 1
    assert with_single_swings(WALK) is WALK
    assert (with_single_swings(locked(twice, 1)).timeline.stance == twice.timeline.stance).all()


def test_swings_have_room_beside_a_foot_that_is_held_at_one_end() -> None:
    raised = replace(painted(WALK.with_options(margin=0.0), 4, 0, 12), held=HeldFeet(start=(4,)))
    (swing, *_) = (swing for swing in raised.timeline.swings() if swing.foot == 3)
    laid = one_after_the_other(raised, items_of(raised), 2)
    longest = longer(raised, items_of(raised), 3)
    assert longest is not None
    for gait in (laid, longest):
        if gait is None:
            continue
        first = min(one.first for one in gait.timeline.swings() if one.first > 0)
        assert first > swing.last
        assert not gait.timeline.stance[3, : swing.last + 1].any()


@pytest.mark.parametrize(
    ("swings", "words"),
    [
        ([(1, 2, 5), (3, 6, 9), (2, 10, 12)], "Feet 1, 3, 2"),
        ([(1, 2, 5), (4, 4, 8), (2, 8, 12), (3, 20, 22)], "Feet 1 + 4 + 2, 3"),
        ([(1, k, k) for k in range(1, 30, 3)], "10 swings, one after the other"),
        ([(foot, k, k) for k in range(1, 30, 5) for foot in (1, 2)], "12 swings, in 6 groups"),
    ],
)
def test_the_order_of_swings_in_words(swings: list[tuple[int, int, int]], words: str) -> None:
    gait = replace(WALK, timeline=replace(WALK.timeline, stance=np.ones_like(WALK.timeline.stance)))
    for foot, first, last in swings:
        gait = painted(gait, foot, first, last)
    assert order_words(gait) == words


@pytest.mark.heavy
def test_swings_of_six_legs_that_stay_beside_each_other_are_called_groups() -> None:
    found = [remedy for number in range(30) for remedy in _remedies_of_six_legs(number)]
    grouped = [remedy for remedy in found if not is_one_by_one(remedy.gait)]
    assert grouped
    assert all(remedy.label != "One foot after the other" for remedy in grouped)


def _remedies_of_six_legs(number: int) -> tuple[Remedy, ...]:
    gait = random_drawing(5, number).gait
    return remedies_of(gait) if gait.timeline.leg_count == 6 else ()
