"""What a search starts from: two gaits and their cursors, limbs to walk on, a drawing."""

from __future__ import annotations

from dataclasses import replace
from itertools import product
from typing import Any

import numpy as np
import pytest

from core.errors import InputError
from core.gait.gait import Gait, Orientation
from core.library.library import library
from core.library.new_gait import with_robot
from core.motion.contact_timeline import timeline_from_rows
from core.patterns.limits import body_reach, needed_swing, walking_rules
from core.patterns.problem import FREE, PatternKind, PatternProblem, PatternRules
from core.patterns.sides import PatternSide, locked_limbs
from core.patterns.sources import (
    LimbState,
    completion_problem,
    finished_phases,
    finishing_length,
    foot_sides,
    hint_of_groups,
    periodic_problem,
    require_own_timeline,
    transition_problem,
)
from core.robot.leg import strokes_from_foot
from core.robot.model import ROBOT_NAMES, load_robot

WALK, AMBLE = library()["walk"].gait, library()["amble"].gait
HEXAPOD = load_robot("hexapod")


def six(*rows: str) -> Gait:
    """A gait of six limbs with these rows."""
    return replace(with_robot(WALK, HEXAPOD), timeline=timeline_from_rows(rows, 0.4))


FRONT_UP = six("000000", "000000", "111001", "111111", "100111", "111111")
ONE_UP = six("000000", "110011", "111001", "111111", "100111", "111001")


def test_a_transition_begins_and_ends_as_the_gaits_are_at_their_cursors() -> None:
    problem = transition_problem(WALK, 6, AMBLE, 17, 12)
    assert problem.kind is PatternKind.TRANSITION
    assert problem.fixed.shape == (4, 12)
    assert (problem.fixed[:, 0] == WALK.timeline.stance[:, 6]).all()
    assert (problem.fixed[:, -1] == AMBLE.timeline.stance[:, 17]).all()
    assert (problem.fixed[:, 1:-1] == FREE).all()
    assert problem.walking.all()
    assert problem.sample_time == WALK.timeline.sample_time


def test_a_limb_is_locked_where_it_does_not_walk_in_either_gait() -> None:
    assert locked_limbs(FRONT_UP, ONE_UP).tolist() == [True, False, False, True, False, False]
    problem = transition_problem(FRONT_UP, 2, ONE_UP, 3, 10)
    assert problem.walking.tolist() == [False, True, True, False, True, True]
    assert (problem.fixed[0] == 0).all()
    assert (problem.fixed[3] == 1).all()


def test_a_limb_that_is_up_in_one_gait_and_stands_in_the_other_is_not_locked() -> None:
    standing = six(*["111111"] * 6)
    assert not locked_limbs(standing, FRONT_UP)[:2].any()


@pytest.mark.parametrize("robot", ROBOT_NAMES)
@pytest.mark.parametrize("orientation", Orientation)
@pytest.mark.parametrize("direction", [1, 2, 3, 4])
def test_sides_are_those_that_roles_name(robot: str, orientation: Orientation, direction: int) -> None:
    model = load_robot(robot)
    gait = replace(with_robot(WALK, model), orientation=orientation, direction=direction)
    left, right = foot_sides(model, orientation, direction)
    for role, on_left, on_right in zip(gait.roles, left, right, strict=True):
        assert (on_left, on_right) == ("R" not in role, "L" not in role)


@pytest.mark.parametrize(
    ("other", "at", "to", "words"),
    [
        ({}, 45, 0, "cursor is at sample 46"),
        ({}, 0, -1, "cursor is at sample 0"),
        ({"robot": "deltawalker9"}, 0, 0, "different robots, .* Choose two gaits of one robot"),
        ({"orientation": Orientation.FBS}, 0, 0, "differ in orientation, FB and FBS"),
        ({"direction": 3}, 0, 0, "directions 1 and 3"),
        ({"timeline": replace(AMBLE.timeline, sample_time=0.5)}, 0, 0, "every 0.4 s and every 0.5 s"),
    ],
)
def test_gaits_that_do_not_fit_are_refused(other: dict[str, Any], at: int, to: int, words: str) -> None:
    with pytest.raises(InputError, match=words):
        transition_problem(WALK, at, replace(AMBLE, **other), to, 12)


def test_a_sequence_is_no_side_of_a_transition() -> None:
    with pytest.raises(InputError, match="is a sequence; choose the gait of one of its parts"):
        transition_problem(library()["walk-turn-s-gait"].gait, 0, WALK, 0, 12)


def test_a_gait_for_the_robots_clock_is_no_side_of_a_transition_and_keeps_its_timeline() -> None:
    gait = library()["fast-walk"].gait
    with pytest.raises(InputError, match="made for the robot's clock; choose a gait whose timeline is drawn"):
        transition_problem(gait, 0, WALK, 0, 12)
    with pytest.raises(InputError, match="made for the robot's clock, so its timeline cannot be drawn anew"):
        require_own_timeline(gait)


def test_locked_cells_are_kept_and_contradictions_are_named() -> None:
    cells = np.full((4, 12), FREE, dtype=np.int8)
    cells[2, 5] = 0
    assert transition_problem(WALK, 0, AMBLE, 0, 12, cells=cells).fixed[2, 5] == 0
    cells[2, 0] = 0
    with pytest.raises(InputError, match="Limb 3 is locked in swing at sample 1, but the gaits fix it in st"):
        transition_problem(WALK, 0, AMBLE, 0, 12, cells=cells)
    with pytest.raises(InputError, match="locked cells are 4 × 11"):
        transition_problem(WALK, 0, AMBLE, 0, 12, cells=cells[:, :11])


def test_a_gait_of_some_limbs_holds_the_others() -> None:
    limbs = [LimbState.HELD, LimbState.STANDS, *[LimbState.WALKS] * 4]
    problem = periodic_problem(HEXAPOD, limbs, 20, orientation=Orientation.FB)
    assert problem.kind is PatternKind.PERIODIC
    assert problem.walking.tolist() == [False, False, True, True, True, True]
    assert (problem.fixed[0] == 0).all()
    assert (problem.fixed[1] == 1).all()
    assert (problem.fixed[2:] == FREE).all()


@pytest.mark.parametrize(
    ("limbs", "words"),
    [([LimbState.WALKS] * 5, "5 states of limbs; .* has 6"), ([LimbState.HELD] * 6, "No limb walks")],
)
def test_limbs_that_make_no_gait_are_refused(limbs: list[LimbState], words: str) -> None:
    with pytest.raises(InputError, match=words):
        periodic_problem(HEXAPOD, limbs, 20, orientation=Orientation.FB)


@pytest.mark.parametrize("samples", [-5, 0, 1, 241, 10**10, 10**30])
def test_a_length_that_no_pattern_has_is_refused_before_room_is_made_for_it(samples: int) -> None:
    with pytest.raises(InputError, match="2 to 240 samples"):
        transition_problem(WALK, 0, WALK, 0, samples)
    with pytest.raises(InputError, match="2 to 240 samples"):
        periodic_problem(HEXAPOD, [LimbState.WALKS] * 6, samples, orientation=Orientation.FBS)


def test_a_drawing_is_completed_round_what_is_locked_or_painted() -> None:
    locked = np.zeros((4, 45), dtype=np.bool_)
    locked[1, 10:20] = True
    painted = np.zeros_like(locked)
    painted[3] = True
    gait = replace(WALK, timeline=replace(WALK.timeline, locked=locked))
    problem = completion_problem(gait, painted)
    stays = problem.fixed != FREE
    assert (stays == (locked | painted | np.isin(np.arange(45), [0, 44]))).all()
    assert (problem.fixed[stays] == gait.timeline.stance[stays]).all()
    assert problem.drawing is not None
    assert (problem.drawing == gait.timeline.stance).all()
    assert problem.walking.all()


@pytest.mark.parametrize("gait_id", ["walk-manual-0", "walk-turn-s-gait"])
def test_a_timeline_that_follows_from_something_else_is_not_completed(gait_id: str) -> None:
    with pytest.raises(InputError, match="cannot be drawn anew"):
        completion_problem(library()[gait_id].gait)


def test_a_painting_of_another_size_is_refused() -> None:
    with pytest.raises(InputError, match="painted cells"):
        completion_problem(WALK, np.zeros((4, 12), dtype=np.bool_))


@pytest.mark.parametrize("height", [0.0535, 0.058])
def test_the_body_reaches_as_far_as_every_foot_does_in_every_direction(height: float) -> None:
    reach = body_reach(HEXAPOD, height)
    angles = np.linspace(0, 2 * np.pi, 24, endpoint=False)

    def within(radius: float) -> bool:
        feet = np.stack([radius * np.cos(angles), radius * np.sin(angles), np.full(24, -height)], axis=-1)
        strokes = strokes_from_foot(HEXAPOD.leg, feet)
        return bool(((strokes >= HEXAPOD.stroke.lower) & (strokes <= HEXAPOD.stroke.upper)).all())

    assert within(reach)
    assert not within(reach + 0.0005)


def test_balance_is_judged_about_the_mean_of_the_feet_and_leaves_room_for_half_a_step() -> None:
    problem: PatternProblem = transition_problem(WALK, 0, AMBLE, 0, 12, rules=PatternRules(balance=0.003))
    model = problem.balance_model
    assert model is not None
    assert np.abs(model.feet_xy.mean(axis=0)).max() < 1e-12
    assert model.reach == pytest.approx(body_reach(load_robot("deltawalker"), 0.0535) - 0.005)
    assert model.speed == WALK.options.body_speed


def test_groups_swing_in_turn_for_equal_times() -> None:
    hint = hint_of_groups(HEXAPOD, [[1, 4], [3, 6], [2, 5]], 24)
    assert (~hint).sum(axis=1).tolist() == [8] * 6
    assert (~hint[0]).nonzero()[0].tolist() == list(range(8))
    assert (hint[0] == hint[3]).all()


@pytest.mark.parametrize(("step", "swing"), [(0.0, 3), (0.010, 3), (0.020, 5), (0.030, 7)])
def test_swings_are_long_enough_for_the_step(step: float, swing: int) -> None:
    rules = walking_rules(WALK, replace(AMBLE, step=(step, 0.0, 0.0)))
    assert (rules.shortest_swing, rules.least_swing) == (swing, swing)
    assert rules.balance == max(WALK.options.margin, AMBLE.options.margin)
    assert replace(rules, shortest_swing=2, least_swing=2, balance=None) == PatternRules()


@pytest.mark.parametrize(
    ("foot_speeds", "swing"), [((0.03, 0.03), 4), ((0.03, 0.0075), 14), ((0.03, 0.1), 4), ((0.1, 0.1), 3)]
)
def test_swings_are_as_long_as_the_slower_gait_needs(foot_speeds: tuple[float, float], swing: int) -> None:
    gaits = (
        replace(gait.with_options(foot_speed=speed), step=(0.030, 0.0, 0.0))
        for gait, speed in zip((WALK, AMBLE), foot_speeds, strict=True)
    )
    assert walking_rules(*gaits).least_swing == swing


def test_a_step_that_takes_whole_samples_takes_no_more() -> None:
    for speed, samples in product(range(1, 41), range(3, 16)):
        gait = WALK.with_options(foot_speed=speed / 1000)
        step = 0.75 * samples * speed * 0.4 / 1000
        assert needed_swing(replace(gait, step=(step, 0.0, 0.0))) == samples, (speed, samples)


def drawn(foot_1: str) -> Gait:
    """A gait whose other feet stand."""
    return replace(WALK, timeline=timeline_from_rows([foot_1, *["1" * len(foot_1)] * 3], 0.4))


def shown(problem: PatternProblem) -> list[str]:
    """The cells of a problem, ? where they are free."""
    return ["".join("?" if cell == FREE else str(cell) for cell in row) for row in problem.fixed]


def test_a_swing_that_a_cursor_cuts_is_finished_on_the_side_of_the_transition() -> None:
    rows = ["1111001111", "1111111111", "1100000011", "1111111001"]
    gait = replace(WALK, timeline=timeline_from_rows(rows, 0.4))
    rules = PatternRules(shortest_swing=4, shortest_stance=3)
    problem = transition_problem(gait, 4, gait, 7, 12, rules=rules, finish_phases=True)
    # Foot 1 has swung for one sample at the cursor, foot 3 for three; at the second cursor foot 3 has one
    # sample to go and foot 4 two. Foot 1 stands there to the end of its gait, which asks for nothing, and
    # foot 2 does not walk.
    assert shown(problem) == ["0000???????1", "111111111111", "00??????0000", "1????????000"]


@pytest.mark.parametrize("finish", [True, False])
def test_only_where_it_is_asked_for(finish: bool) -> None:
    problem = transition_problem(WALK, 5, AMBLE, 5, 12, finish_phases=finish)
    assert ((problem.fixed[:, 1:-1] != FREE).any()) == finish


def test_rules_that_are_off_finish_nothing() -> None:
    sides = PatternSide(WALK, 5, "from"), PatternSide(AMBLE, 5, "to")
    cells = np.full((4, 12), FREE, dtype=np.int8)
    rules = PatternRules(shortest_swing=None, shortest_stance=None)
    assert (finished_phases(cells, *sides, rules) == FREE).all()


def test_two_phases_of_a_limb_need_room_for_both() -> None:
    # It has stood for one sample of three at the first cursor, and swings for the last one of three after it.
    gait, rules = drawn("1110001111"), PatternRules(shortest_swing=3, shortest_stance=3)
    assert finishing_length(PatternSide(gait, 6, "from"), PatternSide(gait, 5, "to"), rules) == 6
    with pytest.raises(InputError, match="need 6 to be finished"):
        transition_problem(gait, 6, gait, 5, 5, rules=rules, finish_phases=True)
    assert shown(transition_problem(gait, 6, gait, 5, 6, rules=rules, finish_phases=True))[0] == "111000"
    assert transition_problem(gait, 6, gait, 5, 5, rules=rules).sample_count == 5


def test_a_limb_that_is_alike_at_both_cursors_may_have_one_phase_of_them() -> None:
    gait, rules = drawn("1110001111"), PatternRules(shortest_swing=5)
    sides = PatternSide(gait, 3, "from"), PatternSide(gait, 5, "to")
    assert finishing_length(*sides, rules) == 5
    with pytest.raises(InputError, match="need 5 to be finished"):
        transition_problem(gait, 3, gait, 5, 4, rules=rules, finish_phases=True)
    assert shown(transition_problem(gait, 3, gait, 5, 5, rules=rules, finish_phases=True))[0] == "00000"
    longer = transition_problem(gait, 3, gait, 5, 12, rules=rules, finish_phases=True)
    assert shown(longer)[0] == "00000??00000"


def test_gaits_that_do_not_fit_have_no_length() -> None:
    hexapod = library()["hexapod-tripod"].gait
    with pytest.raises(InputError, match="different robots"):
        finishing_length(PatternSide(WALK, 0, "from"), PatternSide(hexapod, 0, "to"), PatternRules())
