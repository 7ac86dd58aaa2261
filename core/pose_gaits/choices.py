"""Foot orders and directions among which the fastest gait is looked for: one of each that differ."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from math import factorial

import numpy as np

from core.gait.foot_orders import named_orders
from core.gait.gait import Orientation
from core.gait.mirroring import mirrored_feet
from core.pose_gaits.pose_problem import PoseProblem
from core.robot.model import RobotModel

MOST_ORDERS = 8
"""Foot orders that are tried beside the one that was asked where a robot has more."""


@dataclass(frozen=True)
class Choice:
    """One combination of foot order, direction and overlap.

    Args:
        order: every foot once, counted from 1; it begins with foot 1.
        heading: direction of travel, rad from x: towards a foot, or between two feet.
        overlap: whether a foot is lifted in the move that lowers the one before it.
    """

    order: tuple[int, ...]
    heading: float
    overlap: bool = False

    def of(self, problem: PoseProblem) -> PoseProblem:
        """A problem with this choice; in a curve it travels along the heading half way through a cycle."""
        half_turn = 0.0 if problem.on_the_spot else problem.turn / 2.0
        return replace(problem, order=self.order, heading=self.heading - half_turn, overlap=self.overlap)


@dataclass(frozen=True)
class Choices:
    """The choices of a search.

    Args:
        tried: that differ.
        order_count: foot orders that a robot with so many legs has, wherever they begin.
    """

    tried: tuple[Choice, ...]
    order_count: int

    @property
    def is_complete(self) -> bool:
        """Whether every foot order is among them, itself or one that is the same by symmetry."""
        return self.order_count <= MOST_ORDERS


def choices(problem: PoseProblem, order: tuple[int, ...] | None = None) -> Choices:
    """Orders, directions and overlaps that lead to different gaits of a problem.

    The mirror image of a straight gait is the same gait, so only one of the two is tried. Where a robot has
    more than `MOST_ORDERS` foot orders, those that have a name come first, and the rest is an even choice.

    Args:
        problem: what is asked; its order is tried first, its heading does not count.
        order: the only foot order to try; None for every one.
    """
    legs = problem.model.leg_count
    count = factorial(legs - 1)
    orders = [_from_one(problem.order), *_other_orders(problem.model)]
    places = range(2)
    if order is not None:
        # In other directions an order goes as other orders do in the first two.
        count, orders, places = 1, [_from_one(order)], range(2 * legs)
    found: list[Choice] = []
    seen: set[tuple[tuple[int, ...], int]] = set()
    for place in range(1) if problem.on_the_spot else places:
        for one in orders:
            if (one, place) in seen:
                continue
            seen |= set(_same(problem, one, place))
            apart = Choice(one, np.pi / legs * place)
            overlapping = replace(apart, overlap=True)
            # With four legs, or where the others would not balance the body, an overlap changes nothing.
            is_other = overlapping.of(problem).move_count < apart.of(problem).move_count
            found += [apart, overlapping] if is_other else [apart]
    return Choices(tuple(found), count)


def _other_orders(model: RobotModel) -> list[tuple[int, ...]]:
    """Orders that are tried whichever was asked, at most `MOST_ORDERS`; see `choices`."""
    legs = model.leg_count
    count = factorial(legs - 1)
    if count <= MOST_ORDERS:
        return [_nth_order(legs, number) for number in range(count)]
    named = [_from_one(order.feet) for way in Orientation for order in named_orders(model, way)]
    chosen = list(dict.fromkeys(named))[:MOST_ORDERS]
    stride = -(-count // max(MOST_ORDERS - len(chosen), 1))
    others = [_nth_order(legs, number) for number in range(0, count, stride)]
    return list(dict.fromkeys([*chosen, *others]))[:MOST_ORDERS]


def _nth_order(legs: int, number: int) -> tuple[int, ...]:
    """The order with this number, counted from 0, in the sorted list of those that begin with foot 1."""
    order, rest = [1], list(range(2, legs + 1))
    while rest:
        place, number = divmod(number, factorial(len(rest) - 1))
        order.append(rest.pop(place))
    return tuple(order)


def _same(problem: PoseProblem, order: tuple[int, ...], place: int) -> Iterator[tuple[tuple[int, ...], int]]:
    """Foot orders and directions that are the same gait, the one itself among them.

    Args:
        problem: what is asked.
        order: begins with foot 1.
        place: of the direction, in steps of half the angle between two legs.
    """
    legs, azimuths = problem.model.leg_count, problem.model.azimuths
    is_even = np.allclose(np.diff(azimuths), 2.0 * np.pi / legs)
    mirrored = None if problem.turn else mirrored_feet(azimuths, np.pi / legs * place)
    images = [order]
    if mirrored is not None:
        images.append(tuple(mirrored[foot - 1] + 1 for foot in order))
    for image in images:
        for shift in range(legs if is_even else 1):
            turned = _from_one(tuple((foot - 1 + shift) % legs + 1 for foot in image))
            yield turned, 0 if problem.on_the_spot else (place + 2 * shift) % (2 * legs)


def _from_one(order: tuple[int, ...]) -> tuple[int, ...]:
    """The same circular order, begun with foot 1."""
    first = order.index(1)
    return order[first:] + order[:first]
