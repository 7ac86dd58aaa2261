"""A pattern's problem, relaxed in one place."""

from __future__ import annotations

import numpy as np
import pytest

from core.errors import InputError
from core.patterns.problem import FREE, PatternProblem, Relaxation, Rule
from core.patterns.relaxation import relaxed, with_samples
from tests.support.solvers.conflicts import drawn, periodic, transition


def fixed(problem: PatternProblem) -> list[str]:
    return ["".join("·" if cell == FREE else str(cell) for cell in row) for row in problem.fixed.tolist()]


def test_a_rule_gets_its_new_number_and_the_rest_stays() -> None:
    problem = transition("1101", "1101", 5, (3,))
    changed = relaxed(problem, Relaxation(Rule.FEET_DOWN, 2.0, (), ""))
    assert (changed.rules.feet_down, changed.rules.workload) == (2, 2)
    assert isinstance(changed.rules.feet_down, int)
    assert np.array_equal(changed.fixed, problem.fixed)
    assert relaxed(problem, Relaxation(Rule.FEET_DOWN, None, (), "")).rules.feet_down is None


def test_a_freed_limb_walks_between_the_ends() -> None:
    cells = tuple((2, sample) for sample in range(1, 4))
    changed = relaxed(transition("1101", "1101", 5, (3,)), Relaxation(Rule.FIXED, None, cells, ""))
    assert fixed(changed) == ["1···1", "1···1", "0···0", "1···1"]
    assert changed.walking.all()


def test_more_samples_keep_ends_and_locked_limbs() -> None:
    changed = relaxed(transition("1101", "1001", 4, (3,)), Relaxation(Rule.FIXED, None, (), "", 6))
    assert fixed(changed) == ["1····1", "1····0", "000000", "1····1"]
    assert fixed(with_samples(periodic(4, 5, {2: 1}), 3)) == ["···", "111", "···", "···"]


def test_changes_that_go_together_are_both_made() -> None:
    further = Relaxation(Rule.FIXED, None, (), "", 8)
    changed = relaxed(periodic(4, 6), Relaxation(Rule.FEET_DOWN, 2, (), "", also=(further,)))
    assert (changed.rules.feet_down, changed.sample_count) == (2, 8)


def test_drawn_cells_have_no_place_in_another_length() -> None:
    problem = drawn(transition("1111", "1111", 9), 2, range(4, 6), 0)
    with pytest.raises(InputError, match="number of samples cannot change"):
        with_samples(problem, 12)


@pytest.mark.parametrize("cell", [(4, 0), (0, 9), (-1, 0)])
def test_cells_outside_the_pattern_are_refused(cell: tuple[int, int]) -> None:
    with pytest.raises(InputError, match="lies outside the pattern"):
        relaxed(transition("1111", "1111", 9), Relaxation(Rule.FIXED, None, (cell,), ""))
