"""The built-in gaits: what they ask, and names that lead nowhere."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from core.errors import InputError
from core.gait.gait import Gait, drawn_timeline, motion_problem, with_return
from core.gait.options import GaitOptions
from core.library.library import (
    SAMPLE_TIME,
    Group,
    appendix_orders,
    group_ids,
    library,
    manual_entry,
    optimised_entry,
)
from core.motion.contact_timeline import rows_from_bits
from core.motion.heading_profile import HeadingProfile
from core.problem.motion_check import check_motion
from core.robot.model import load_robot
from solver_jobs import Evidence, SolveStatus, solve_live

MODEL = load_robot("deltawalker")

DRAWN_PHASES = {
    "textbook-trot": 4,
    "textbook-bound": 4,
    "textbook-pronk": 3,
    "textbook-jog": 4,
    "textbook-hop": 22,
    "textbook-jump": 5,
}
"""Phases of five knots of the gaits in which feet move together."""

POSSIBLE = {("textbook-crawl", 0.003), ("textbook-crawl", 0.0), ("textbook-trot", 0.0)}
"""Textbook gaits and stability margins, m, for which this robot has a motion: a trot balances on a line."""

REASONS = {
    ("textbook-trot", 0.003): "no stability margin of 3 mm",
    ("textbook-bound", 0.003): "no stability margin of 3 mm",
    ("textbook-bound", 0.0): "the body would have to be faster than 15 mm/s",
    ("textbook-jog", 0.003): "no stability margin of 3 mm",
    ("textbook-jog", 0.0): "the body would have to be faster than 15 mm/s",
}
"""What is in the way; where nothing is said, that no foot stands for a while."""


def turned_by(degrees: float) -> Gait:
    gait = optimised_entry("rotate").gait
    return with_return(replace(gait, step=(0.0, 0.0, float(np.radians(degrees)))), MODEL)


def test_rotation_steps_in_place_and_turns_in_its_closing_stance() -> None:
    gait = optimised_entry("rotate").gait
    assert gait.name == "Rotate 15°, as in the thesis"
    assert list(gait.step) == pytest.approx([0.0, 0.0, np.radians(15)])
    assert gait.options.turning is HeadingProfile.RETURN
    heading = motion_problem(gait, MODEL).heading
    last_swing = max(swing.last for swing in gait.timeline.swings())
    assert (heading[: last_swing + 2] == 0).all()
    assert heading[-1] == pytest.approx(np.radians(15))


def test_a_larger_turn_gets_a_longer_return() -> None:
    counts = [turned_by(degrees).options.closing_knots for degrees in (15, 25, 30)]
    assert counts == sorted(counts)
    assert counts[0] == 5 < counts[-1]
    assert turned_by(30).timeline == drawn_timeline(turned_by(30))


@pytest.mark.parametrize("gait_id", group_ids(Group.OPTIMISED))
def test_every_built_in_gait_is_a_motion_that_the_checker_confirms(gait_id: str) -> None:
    problem = motion_problem(optimised_entry(gait_id).gait, MODEL)
    assert problem.limits.margin >= 0.003
    assert check_motion(problem, solve_live(problem).trajectory).confirmed


OTHERS = (Group.FOR_ROBOT, Group.PATTERNS, Group.SEQUENCES)
"""Groups whose timelines follow from something else."""


@pytest.mark.parametrize("gait_id", [e.id for e in library().values() if e.group not in OTHERS])
def test_every_entry_has_the_timeline_that_it_implies(gait_id: str) -> None:
    entry = library()[gait_id]
    gait, table = entry.gait, entry.gait.segment_table
    assert (table is None) is (entry.manual is None) is (entry.group is not Group.BY_HAND)
    assert (gait.direction, gait.iterations) == (1, 1)
    assert not gait.timeline.locked.any()
    if table is not None:
        assert gait.timeline == table.timeline(SAMPLE_TIME)
        assert gait.timeline.sample_count == 5 * table.segment_count
    elif gait_id in DRAWN_PHASES:
        assert gait.timeline.sample_count == 5 * DRAWN_PHASES[gait_id]
    else:
        assert gait.timeline == drawn_timeline(gait)
        assert gait.timeline.sample_count == 45
    assert gait.timeline.stance[:, -1].all()
    assert {swing.foot for swing in gait.timeline.swings()} == {0, 1, 2, 3}


def test_entries_stand_together_by_group() -> None:
    groups = [entry.group for entry in library().values()]
    assert list(dict.fromkeys(groups)) == list(Group)
    assert groups == sorted(groups, key=list(Group).index)
    assert {group: groups.count(group) for group in Group} == {
        Group.FOR_ROBOT: 11,
        Group.OPTIMISED: 5,
        Group.BY_HAND: 9,
        Group.APPENDIX: 16,
        Group.TEXTBOOK: 7,
        Group.PATTERNS: 12,
        Group.SEQUENCES: 1,
    }
    names = [entry.gait.name for entry in library().values()]
    assert len(set(names)) == len(names)


@pytest.mark.parametrize("gait_id", [e.id for e in library().values() if e.group is not Group.OPTIMISED])
def test_an_entry_says_in_one_line_what_it_is(gait_id: str) -> None:
    notes = library()[gait_id].gait.notes
    assert notes.endswith(".")
    assert "\n" not in notes
    assert len(notes) <= 120


@pytest.mark.parametrize("gait_id", group_ids(Group.APPENDIX))
def test_every_order_of_the_appendix_is_a_motion_that_the_checker_confirms(gait_id: str) -> None:
    problem = motion_problem(optimised_entry(gait_id).gait, MODEL)
    assert check_motion(problem, solve_live(problem).trajectory).confirmed


@pytest.mark.parametrize("margin", [0.003, 0.0])
@pytest.mark.parametrize("gait_id", group_ids(Group.TEXTBOOK))
def test_a_textbook_gait_is_solved_or_refused_with_reasons(gait_id: str, margin: float) -> None:
    gait = optimised_entry(gait_id).gait
    problem = motion_problem(replace(gait, options=replace(gait.options, margin=margin)), MODEL)
    result = solve_live(problem)
    assert len(result.trajectory.times) == gait.timeline.sample_count
    if (gait_id, margin) in POSSIBLE:
        assert result.status is SolveStatus.SOLVED
        assert check_motion(problem, result.trajectory).confirmed
    else:
        assert result.status is SolveStatus.INFEASIBLE
        assert result.evidence is Evidence.PROVEN
        assert REASONS.get((gait_id, margin), "No foot stands") in result.explanation[0]
        assert all(sentence.endswith((".", ")")) for sentence in result.explanation)


def test_a_crawl_is_a_walk_with_a_lower_body() -> None:
    crawl, walk = (library()[name].gait for name in ("textbook-crawl", "walk"))
    assert (crawl.order, crawl.timeline, crawl.step) == (walk.order, walk.timeline, walk.step)
    assert motion_problem(crawl, MODEL).limits.plane_height[0] == crawl.options.plane_height
    assert crawl.options.plane_height < walk.options.plane_height


@pytest.mark.parametrize(
    ("gait_id", "together"),
    [
        ("textbook-trot", [{"FR", "BL"}, {"FL", "BR"}]),
        ("textbook-bound", [{"FR", "FL"}, {"BR", "BL"}]),
        ("textbook-jog", [{"FL", "BL"}, {"FR", "BR"}]),
        ("textbook-hop", [{"FR", "BL"}, {"FL", "BR"}]),
        ("textbook-pronk", [{"FR", "FL", "BL", "BR"}]),
        ("textbook-jump", [{"FR", "FL"}, {"BR", "BL"}]),
    ],
)
def test_feet_move_together_as_table_1_2_says(gait_id: str, together: list[set[str]]) -> None:
    gait = library()[gait_id].gait
    rows = rows_from_bits(gait.timeline.stance)
    found = [{role for role, other in zip(gait.roles, rows, strict=True) if other == row} for row in rows]
    assert all(found.count(feet) == len(feet) for feet in together)


def test_a_hop_swaps_pairs_after_five_landings() -> None:
    """The last landing of the second pair is that of all four feet."""
    swings = library()["textbook-hop"].gait.timeline.swings()
    counts = {foot: [s.last - s.first + 1 for s in swings if s.foot == foot] for foot in range(4)}
    first, second = [5, 5, 5, 5, 5, 50], [55, 5, 5, 5, 5]
    assert counts == {0: first, 1: second, 2: first, 3: second}


def test_a_gait_that_does_not_return_is_left_alone() -> None:
    walk = optimised_entry("walk").gait
    assert with_return(walk, MODEL) is walk
    steady = replace(turned_by(15), options=GaitOptions())
    assert with_return(steady, MODEL) is steady


def test_the_appendix_lists_four_orders_of_each_gait() -> None:
    orders = appendix_orders()
    assert {gait: len(found) for gait, found in orders.items()} == dict.fromkeys(
        ("walk", "amble", "s-gait", "c-gait"), 4
    )
    for gait, found in orders.items():
        assert optimised_entry(gait).gait.order in found
        assert len(set(found)) == 4
        assert all(sorted(order) == [1, 2, 3, 4] for order in found)


@pytest.mark.parametrize("name", ["hop", "walk-manual-0", "amble-manual-2", ""])
def test_a_name_without_a_gait_to_optimise_is_refused(name: str) -> None:
    with pytest.raises(InputError, match="choose one of walk, amble, s-gait, c-gait, rotate"):
        optimised_entry(name)


@pytest.mark.parametrize(("family", "version"), [("hop", 0), ("walk", 7)])
def test_a_manual_gait_that_is_not_there_is_refused(family: str, version: int) -> None:
    with pytest.raises(InputError, match="choose one of"):
        manual_entry(family, version)


def test_a_module_on_an_axis_stands_exactly_there() -> None:
    centres = MODEL.module_centres_robot[:, :2] / MODEL.radius
    assert centres.tolist() == [[1, 0], [0, 1], [-1, 0], [0, -1]]


@pytest.mark.parametrize("direction", [2, 3, 4])
def test_a_direction_is_direction_1_turned_to_the_last_bit(direction: int) -> None:
    gait = optimised_entry("s-gait").gait
    turned = replace(gait, direction=direction)
    turned = replace(turned, timeline=drawn_timeline(turned))
    back = motion_problem(turned, MODEL).turned(1 - direction)
    first = motion_problem(gait, MODEL)
    for pose, other in ((first.start, back.start), (first.goal, back.goal)):
        assert (pose.body_world == other.body_world).all()
        assert (pose.feet_world == other.feet_world).all()
    assert back.timeline == first.timeline
