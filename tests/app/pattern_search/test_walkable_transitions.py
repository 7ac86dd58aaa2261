"""A transition that is asked for so that the robot's feet can take its steps."""

from __future__ import annotations

from app.routes.patterns.problems import Posed, posed
from app.routes.patterns.schema import TransitionBody
from core.library.library import library
from core.patterns.problem import FREE, PatternRules


def asked(walkable: bool, samples: int | None = 12, to_sample: int = 9) -> Posed:
    question = TransitionBody(
        kind="transition",
        gait="walk",
        sample=5,
        to="amble",
        to_sample=to_sample,
        samples=samples,
        walkable=walkable,
    )
    return posed(question, lambda gait_id: library()[gait_id].gait)


def test_swings_are_long_enough_and_those_that_a_cursor_cuts_are_finished() -> None:
    problem = asked(walkable=True).problem()
    assert (problem.rules.shortest_swing, problem.rules.least_swing) == (3, 3)
    # Foot 3 has swung for one sample at the first cursor.
    assert problem.fixed[2, :4].tolist() == [0, 0, 0, FREE]


def test_without_it_f_s_rules_hold_as_they_are() -> None:
    problem = asked(walkable=False).problem()
    assert problem.rules == PatternRules()
    assert (problem.fixed[:, 1:-1] == FREE).all()


def test_every_length_that_is_tried_is_walkable() -> None:
    question = asked(walkable=True, samples=None)
    assert question.lengths is not None
    for length in question.lengths:
        problem = question.problem(length)
        assert problem.sample_count == length
        assert problem.fixed[2, 1] == 0


def test_a_length_in_which_a_cut_swing_cannot_be_finished_leads_to_longer_ones() -> None:
    short = asked(walkable=True, samples=3, to_sample=10)
    assert (short.too_few, short.lengths) == (3, range(4, 61))
    whole = asked(walkable=True, samples=4, to_sample=10)
    assert (whole.too_few, whole.lengths) == (None, None)
    assert asked(walkable=False, samples=3, to_sample=10).too_few is None
    assert asked(walkable=True, samples=1, to_sample=10).lengths is None
