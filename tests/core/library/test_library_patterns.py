"""The library's patterns: kept rules, optima that a new search finds again, and motions."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest

from core.gait.gait import motion_problem
from core.library.library import Group, group_ids, library, library_patterns
from core.patterns.check import check_pattern, scored, weighted_sum
from core.patterns.problem import PatternStatus
from core.problem.motion_check import check_motion
from solver_jobs import PatternSolver, SolveStatus, solve_live

PATTERNS = library_patterns()

LIMBS_UP = {
    "quadruped-wave-1": "",
    "quadruped-wave-2": "",
    "hexapod-tripod": "",
    "hexapod-ripple": "",
    "hexapod-wave": "",
    "hexapod-five": "L1",
    "hexapod-front-up": "L1 R1",
    "hexapod-middle-up": "L2 R2",
    "dodecapod-nine-1": "L3 R2 R6",
    "dodecapod-nine-2": "L1 L4 R5",
    "dodecapod-middle-up": "L3 L4 R3 R4",
    "dodecapod-three-up": "L1 L6 R1",
}
"""Which limbs each pattern holds up, counted from the front on either side."""

TOGETHER = {"hexapod-tripod": 3, "hexapod-ripple": 2, "hexapod-wave": 1, "quadruped-wave-1": 1}
"""How many feet swing at once."""


@pytest.fixture(scope="module")
def solver() -> Iterator[PatternSolver]:
    """A process of its own, as patterns are sought in."""
    solver = PatternSolver()
    yield solver
    solver.close()


def test_the_library_has_the_gaits_of_the_footfall_pattern_thesis() -> None:
    assert group_ids(Group.PATTERNS) == tuple(PATTERNS) == tuple(LIMBS_UP)


@pytest.mark.parametrize("gait_id", LIMBS_UP)
def test_the_limbs_that_are_up_are_where_the_thesis_says(gait_id: str) -> None:
    gait = library()[gait_id].gait
    up = {gait.roles[foot - 1] for foot in gait.held.start}
    assert up == set(LIMBS_UP[gait_id].split())
    assert gait.held.start == gait.held.end
    assert gait.notes.startswith(("F 4.1.", "F Figure 4."))


@pytest.mark.parametrize(("gait_id", "most"), TOGETHER.items())
def test_as_many_feet_swing_at_once_as_the_name_says(gait_id: str, most: int) -> None:
    assert (~PATTERNS[gait_id].stance).sum(axis=0).max() == most


def test_the_two_waves_differ_in_the_order_of_their_feet() -> None:
    first, second = (PATTERNS[f"quadruped-wave-{number}"].gait.order for number in (1, 2))
    assert all(first != second[shift:] + second[:shift] for shift in range(4))


@pytest.mark.parametrize("gait_id", LIMBS_UP)
def test_a_pattern_keeps_every_rule_that_was_asked(gait_id: str, solver: PatternSolver) -> None:
    pattern = PATTERNS[gait_id]
    asked = replace(pattern.problem, fixed=pattern.stance.astype(np.int8))
    witness = solver.solve(asked).patterns[0].body_xy
    assert check_pattern(pattern.problem, pattern.stance, witness) == ()


@pytest.mark.heavy
@pytest.mark.parametrize("gait_id", LIMBS_UP)
def test_a_new_search_finds_nothing_better(gait_id: str, solver: PatternSolver) -> None:
    pattern = PATTERNS[gait_id]
    result = solver.solve(pattern.problem, seconds=120.0)
    assert result.status is PatternStatus.OPTIMAL
    found = weighted_sum(pattern.problem, scored(pattern.problem, pattern.stance))
    assert found == weighted_sum(pattern.problem, result.patterns[0]) == result.bound


@pytest.mark.parametrize("iterations", [1, 3])
@pytest.mark.parametrize("gait_id", [gait_id for gait_id in LIMBS_UP if gait_id != "hexapod-front-up"])
def test_a_pattern_walks_with_balance(gait_id: str, iterations: int) -> None:
    pattern = PATTERNS[gait_id]
    problem = motion_problem(pattern.used(iterations), pattern.model)
    result = solve_live(problem)
    assert problem.limits.margin == 0.003
    assert result.status is SolveStatus.SOLVED
    assert check_motion(problem, result.trajectory).confirmed


def test_four_neighbouring_feet_of_a_ring_of_six_have_no_motion_and_the_note_says_so() -> None:
    gait = library()["hexapod-front-up"].gait
    result = solve_live(motion_problem(gait, PATTERNS["hexapod-front-up"].model))
    assert result.status is SolveStatus.INFEASIBLE
    assert any("Balance is" in sentence for sentence in result.explanation)
    assert "can't balance" in gait.notes
