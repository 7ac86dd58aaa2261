"""Foot orders and directions of a search: each kind of gait once; and the front of what it finds."""

from __future__ import annotations

from dataclasses import replace
from math import factorial
from typing import Any

import numpy as np
import pytest

from core.gait.foot_orders import named_orders
from core.gait.gait import Orientation
from core.pose_gaits.choices import MOST_ORDERS, choices
from core.pose_gaits.front import FrontPoint, front
from core.pose_gaits.pose_problem import PoseProblem
from core.robot.model import load_robot


def problem(robot: str = "deltawalker", **asked: Any) -> PoseProblem:
    model = load_robot(robot)
    return PoseProblem(model, tuple(range(1, model.leg_count + 1)), 0.0, **asked)


def test_every_order_of_four_legs_is_tried_along_an_axis_and_between_two() -> None:
    chosen = choices(problem())
    assert chosen.is_complete
    assert chosen.order_count == 6
    assert {round(choice.heading, 6) for choice in chosen.tried} == {0.0, round(np.pi / 4, 6)}
    assert len(chosen.tried) == len(set(chosen.tried)) == 7
    # The mirror image of an order along the axis is not tried again.
    along = {choice.order for choice in chosen.tried if choice.heading == 0.0}
    assert {(1, 2, 3, 4), (1, 4, 3, 2)} & along == {(1, 2, 3, 4)}


def test_a_curve_has_no_mirror_image() -> None:
    assert len(choices(problem(turn=0.2)).tried) == 12


def test_on_the_spot_no_direction_is_chosen() -> None:
    tried = choices(problem(step=0.0, turn=1.0)).tried
    assert {choice.heading for choice in tried} == {0.0}
    assert {choice.order for choice in tried} >= {(1, 2, 3, 4), (1, 4, 3, 2)}


def test_a_given_order_is_tried_in_every_direction_that_differs() -> None:
    walk = choices(problem(), (3, 2, 4, 1)).tried
    assert {choice.order for choice in walk} == {(1, 3, 2, 4)}
    assert np.degrees([choice.heading for choice in walk]).round().tolist() == [0, 45, 135, 180, 225]
    # A quarter turn makes the C-gait of itself.
    assert len(choices(problem(), (1, 2, 3, 4)).tried) == 2


def test_the_order_that_was_asked_is_tried_first() -> None:
    ripple = replace(problem("hexapod"), order=(1, 4, 2, 5, 3, 6))
    assert choices(ripple).tried[0].order == (1, 4, 2, 5, 3, 6)


@pytest.mark.parametrize("robot", ["hexapod", "dodecapod"])
def test_orders_that_have_a_name_are_tried_first(robot: str) -> None:
    asked = problem(robot)
    named = {
        order.feet[order.feet.index(1) :] + order.feet[: order.feet.index(1)]
        for way in Orientation
        for order in named_orders(asked.model, way)
    }
    tried = list(dict.fromkeys(choice.order for choice in choices(asked).tried))
    assert tried[0] == asked.order
    assert set(tried[1 : 1 + len(named)]) == named
    assert len(tried) <= MOST_ORDERS + 1


def test_six_legs_may_lower_a_foot_while_the_next_is_lifted() -> None:
    asked = problem("hexapod")
    chosen = choices(asked)
    assert (chosen.order_count, chosen.is_complete) == (factorial(5), False)
    overlapping = [choice for choice in chosen.tried if choice.overlap]
    assert overlapping
    for choice in overlapping:
        apart = replace(choice, overlap=False).of(asked)
        both = choice.of(asked)
        assert both.move_count < apart.move_count
        assert (~both.moving).sum(axis=1).min() >= 4


@pytest.mark.parametrize("turn", [0.0, 0.3])
def test_a_choice_travels_along_its_heading(turn: float) -> None:
    asked = problem(turn=turn)
    for choice in choices(asked).tried:
        along = choice.of(asked).travel_direction()
        assert np.arctan2(along[1], along[0]) == pytest.approx(choice.heading)


def test_the_front_leaves_out_what_is_worse_in_everything() -> None:
    points = [
        FrontPoint(0.006, 1.5, 0.0030),
        FrontPoint(0.006, 1.5, 0.0028),
        FrontPoint(0.006, 1.0, 0.0018),
        FrontPoint(0.003, 1.0, 0.0018),
        FrontPoint(0.010, 2.0, 0.0026),
        FrontPoint(0.006, 1.5, 0.0030),
    ]
    assert front(points) == [0, 4, 2]
