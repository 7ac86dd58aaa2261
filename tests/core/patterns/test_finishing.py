"""Swings and stances that a cursor cuts."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from core.errors import InputError
from core.gait.gait import Gait
from core.library.library import library
from core.motion.contact_timeline import timeline_from_rows
from core.patterns.problem import FREE, PatternProblem, PatternRules
from core.patterns.sides import PatternSide
from core.patterns.sources import finished_phases, finishing_length, transition_problem

WALK, AMBLE = library()["walk"].gait, library()["amble"].gait


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
