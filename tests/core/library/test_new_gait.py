"""New gaits: drawn for any robot, in orders that the live tier solves, and carried over to other robots."""

from __future__ import annotations

from typing import Any

import pytest

from core.errors import InputError
from core.gait.foot_orders import named_orders
from core.gait.gait import Orientation, drawn_timeline, motion_problem
from core.library.library import library, manual_entry, optimised_entry
from core.library.new_gait import DEFAULT_STEP, default_phase_knots, drawn_gait, with_robot
from core.problem.motion_check import check_motion
from core.robot.model import ROBOT_NAMES, load_robot
from solver_jobs import SolveStatus, solve_live

LARGE = ("hexapod", "dodecapod")


@pytest.mark.parametrize("orientation", Orientation)
@pytest.mark.parametrize("robot", ROBOT_NAMES)
def test_the_live_tier_solves_every_order_that_is_offered(robot: str, orientation: Orientation) -> None:
    model = load_robot(robot)
    for order in named_orders(model, orientation):
        knots = default_phase_knots(model)
        gait = drawn_gait(model, order.name, orientation, order.feet, DEFAULT_STEP, phase_knots=knots)
        problem = motion_problem(gait, model)
        result = solve_live(problem)
        assert result.status is SolveStatus.SOLVED, order
        assert check_motion(problem, result.trajectory).confirmed, order


@pytest.mark.parametrize("name", ["walk", "amble", "s-gait", "c-gait"])
def test_the_orders_of_four_legs_are_those_of_the_optimised_gaits(name: str) -> None:
    gait = optimised_entry(name).gait
    orders = named_orders(load_robot("deltawalker"), gait.orientation)
    assert gait.order in [order.feet for order in orders]
    assert next(order for order in orders if order.feet == gait.order).name.lower() == name


@pytest.mark.parametrize("robot", LARGE)
def test_a_wave_begins_at_the_back_and_ends_in_front_and_a_ripple_crosses(robot: str) -> None:
    model = load_robot(robot)
    half = model.leg_count // 2
    wave, ripple = named_orders(model, Orientation.FBS)
    assert (wave.feet[0], wave.feet[-1]) == (half + 1, 1)
    assert ripple.feet[:4] == (1, half + 1, 2, half + 2)


def test_a_new_gait_is_the_drawing_of_its_own_words() -> None:
    model = load_robot("hexapod")
    gait = drawn_gait(
        model, "Six", Orientation.FBS, (1, 2, 3, 4, 5, 6), 0.012, phase_knots=4, closing_knots=3, iterations=2
    )
    assert gait.timeline == drawn_timeline(gait)
    assert gait.timeline.sample_count == 2 * 6 * 2 * 4 + 3
    assert (gait.robot, gait.step) == ("hexapod", (0.012, 0.0, 0.0))


@pytest.mark.parametrize(
    ("change", "where"),
    [
        ({"order": (1, 2, 3)}, "order"),
        ({"step": -0.01}, "step"),
        ({"step": 10.0}, "step"),
        ({"phase_knots": 1}, "phase_knots"),
        ({"phase_knots": 50, "iterations": 20}, "phase_knots"),
        ({"name": " "}, "name"),
    ],
)
def test_what_cannot_be_drawn_is_refused_by_name(change: dict[str, Any], where: str) -> None:
    words: dict[str, Any] = {"name": "New", "orientation": Orientation.FB, "order": (3, 2, 4, 1)}
    with pytest.raises(InputError) as refused:
        drawn_gait(load_robot("deltawalker"), **({"step": 0.01} | words | change))
    assert refused.value.where == where


def test_a_robot_with_as_many_legs_takes_a_gait_over_as_it_stands() -> None:
    gait = manual_entry("walk", 0).gait
    taken = with_robot(gait, load_robot("deltawalker9"))
    assert taken.robot == "deltawalker9"
    assert (taken.segment_table, taken.timeline) == (gait.segment_table, gait.timeline)


def test_a_robot_with_other_legs_gets_the_gait_drawn_anew() -> None:
    gait = optimised_entry("walk").gait
    taken = with_robot(gait, load_robot("hexapod"))
    assert taken.order == named_orders(load_robot("hexapod"), gait.orientation)[0].feet
    assert taken.timeline == drawn_timeline(taken)
    assert taken.step == gait.step
    chosen = with_robot(gait, load_robot("hexapod"), (6, 5, 4, 3, 2, 1))
    assert chosen.order == (6, 5, 4, 3, 2, 1)
    with pytest.raises(InputError, match="made by hand for 4 legs"):
        with_robot(manual_entry("walk", 0).gait, load_robot("hexapod"))


def test_a_sequence_is_carried_over_part_by_part() -> None:
    tour = library()["walk-turn-s-gait"].gait
    taken = with_robot(tour, load_robot("deltawalker9"))
    assert {taken.robot, *(part.gait.robot for part in taken.sequence)} == {"deltawalker9"}
    assert (taken.timeline, taken.step) == (tour.timeline, tour.step)
    six = with_robot(tour, load_robot("hexapod"))
    assert six.timeline.leg_count == 6
    assert [part.times for part in six.sequence] == [part.times for part in tour.sequence]
