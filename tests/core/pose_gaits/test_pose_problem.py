"""The poses of a pose gait, and what is refused."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from core.errors import InputError
from core.pose_gaits.pose_problem import PoseBounds, PoseProblem, swing_shares
from core.robot.model import load_robot

WALK, C_GAIT = (3, 2, 4, 1), (1, 2, 3, 4)


def problem(order: tuple[int, ...] = WALK, robot: str = "deltawalker", **asked: Any) -> PoseProblem:
    return PoseProblem(load_robot(robot), order, 0.0, **asked)


@pytest.mark.parametrize(
    ("order", "moves"), [(C_GAIT, 8), ((1, 4, 3, 2), 8), (WALK, 10), ((3, 1, 4, 2), 10), ((1, 2, 4, 3), 10)]
)
def test_between_opposite_feet_the_body_moves_alone(order: tuple[int, ...], moves: int) -> None:
    asked = problem(order)
    assert asked.move_count == moves
    assert asked.moves_a_cycle == moves
    assert (asked.airborne.sum(axis=1) <= 1).all()


@pytest.mark.parametrize(("order", "moves"), [(C_GAIT, (10, 26)), (WALK, (11, 31))])
def test_a_walk_from_rest_begins_and_ends_with_all_feet_down(
    order: tuple[int, ...], moves: tuple[int, int]
) -> None:
    assert tuple(problem(order, cycles=cycles).move_count for cycles in (1, 3)) == moves
    asked = problem(order, cycles=2)
    assert not asked.airborne[[0, 1, -1]].any()


def test_six_feet_need_no_move_of_the_body_alone() -> None:
    assert problem((1, 4, 2, 5, 3, 6), robot="hexapod").move_count == 12


def test_three_poses_in_the_air_rise_to_the_clearance_and_sink() -> None:
    airborne = np.array([[False], [True], [True], [True], [False]])
    assert swing_shares(airborne)[:, 0].tolist() == [0.0, 0.5, 1.0, 0.5, 0.0]
    asked = problem(parts=2)
    assert asked.floor.max() == pytest.approx(0.003)
    assert asked.move_count == 20


def test_short_stop_bounds_try_moves_in_two_parts() -> None:
    assert problem().parts_to_try == (1,)
    assert problem(bounds=PoseBounds(stop_bound=1.0)).parts_to_try == (1, 2)
    assert problem(bounds=PoseBounds(stop_bound=10.0)).largest_move == pytest.approx(0.015)


@pytest.mark.parametrize(
    ("asked", "words"),
    [
        ({"order": (1, 2, 3, 3)}, "--order is 1,2,3,3; it must name each foot 1 to 4 once"),
        ({"order": (1, 2, 3)}, "--order is 1,2,3"),
        ({"step": 0.5}, "--step is 500 mm"),
        ({"step": -0.01}, "--step is -10 mm"),
        ({"cycles": 0}, "--cycles is 0"),
        ({"parts": 9}, "parts is 9"),
    ],
)
def test_what_cannot_be_asked_is_refused(asked: dict[str, Any], words: str) -> None:
    with pytest.raises(InputError, match=words):
        problem(**asked)


@pytest.mark.parametrize(
    ("name", "value"),
    [("margin", -0.001), ("clearance", 0.0), ("slip", 0.1), ("shoe_distance", 1.0), ("stop_bound", 0.5)],
)
def test_limits_outside_their_range_are_refused_by_their_option(name: str, value: float) -> None:
    make: Any = PoseBounds
    with pytest.raises(InputError, match=f"--{name.replace('_', '-')} is"):
        make(**{name: value})
    with pytest.raises(InputError):
        make(**{name: float("nan")})
