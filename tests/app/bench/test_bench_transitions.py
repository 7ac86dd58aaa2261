"""The benchmark of transitions: both methods beside F's table, and random transitions that walk."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from app.bench import BENCHMARKS
from app.bench.patterns.transitions import (
    PUBLISHED,
    RuleSet,
    Solvers,
    compared,
    random_transitions,
    share,
    solvers,
)
from core.library.library import library
from core.patterns.problem import FREE

pytestmark = pytest.mark.heavy


@pytest.fixture(scope="module")
def both() -> Iterator[Solvers]:
    """The pattern solver and the live optimiser, each in its process."""
    with solvers() as found:
        yield found


def test_the_table_has_f_s_transitions_and_the_command_knows_it() -> None:
    assert {(a, b) for a in "456" for b in "456" if a != b} == set(PUBLISHED)
    assert "transitions" in BENCHMARKS


def test_five_limbs_to_six_walks_by_optimising_and_tips_by_interpolating(both: Solvers) -> None:
    row = compared("5", "6", both)
    assert (row["F interpolation cm/s"], row["F optimised cm/s"]) == (5.2, 5.9)
    assert row["confirmed"] == row["solved"] == "4 of 4"
    assert row["optimised falls"] == 0 < row["interpolation falls"]
    assert row["optimised margin mm"] > 0 > row["interpolation margin mm"]
    assert row["optimised tilt °"] == 0 < row["interpolation tilt °"]
    assert row["optimised mm/s"] > row["interpolation mm/s"] > 0
    assert row["optimised cm/s"] == pytest.approx(row["optimised mm/s"] / 10, abs=0.001)


def test_with_the_front_pair_up_a_ring_of_six_tips_and_nothing_is_confirmed(both: Solvers) -> None:
    row = compared("5", "4", both)
    assert row["confirmed"] == "0 of 4"
    assert row["optimised margin mm"] < 0
    assert row["optimised falls"] > 0


@pytest.mark.parametrize("robot", ["deltawalker", "hexapod", "dodecapod"])
def test_random_transitions_are_the_same_for_a_seed_and_fit_together(robot: str) -> None:
    first, again, other = ([*random_transitions(robot, 12, seed)] for seed in (3, 3, 4))
    assert [vars(a) for a in first] == [vars(b) for b in again]
    assert [vars(a) for a in first] != [vars(b) for b in other]
    for draw in first:
        problem = draw.problem(RuleSet.BALANCE)
        assert 20 <= problem.sample_count == draw.samples <= 40
        assert (problem.fixed[:, 0] == draw.first.timeline.stance[:, draw.at]).all()
        assert (draw.problem(RuleSet.F).fixed[problem.walking][:, 1:-1] == FREE).all()
        assert draw.first.robot == draw.second.robot == robot


def test_most_gaits_of_the_library_are_drawn_and_none_that_has_no_motion() -> None:
    names = {draw.first.name for draw in random_transitions("hexapod", 60, 1)}
    patterns = {
        library()[f"hexapod-{name}"].gait.name for name in ("tripod", "ripple", "wave", "five", "middle-up")
    }
    assert names == patterns


def test_a_share_counts_what_is_feasible_and_what_walks(both: Solvers) -> None:
    row = share("dodecapod", RuleSet.BALANCE, 4, 7, both)
    assert row["transitions"] == 4 == row["infeasible"] + row["no answer"] + row["feasible"]
    assert row["walk"] == row["feasible"] > 0
    assert row["share %"] == 100.0
