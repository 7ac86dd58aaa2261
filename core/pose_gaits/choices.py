"""Foot orders and directions among which the fastest gait is looked for: one of each that differ."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from math import factorial

import numpy as np

from core.gait.mirroring import mirrored_feet
from core.pose_gaits.pose_problem import PoseProblem

MOST_ORDERS = 8
"""Foot orders that are tried where a robot has more; an even choice of them."""


@dataclass(frozen=True)
class Choice:
    """What a search may choose freely.

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

    The mirror image of a straight gait is the same gait, so only one of the two is tried.

    Args:
        problem: what is asked; its order and heading are left aside.
        order: the only foot order to try; None for every one.
    """
    legs = problem.model.leg_count
    count = 1 if order is not None else factorial(legs - 1)
    numbers = range(0, count, -(-count // MOST_ORDERS))
    orders = [_nth_order(legs, number) for number in numbers] if order is None else [_from_one(order)]
    headings = (0.0,) if problem.on_the_spot else (0.0, np.pi / legs)
    found: list[Choice] = []
    for heading in headings:
        seen: set[tuple[int, ...]] = set()
        for one in orders:
            if one in seen:
                continue
            seen |= set(_same(problem, one, heading))
            apart = Choice(one, heading)
            overlapping = replace(apart, overlap=True)
            # With four legs, or where the others would not balance the body, an overlap changes nothing.
            is_other = overlapping.of(problem).move_count < apart.of(problem).move_count
            found += [apart, overlapping] if is_other else [apart]
    return Choices(tuple(found), count)


def _nth_order(legs: int, number: int) -> tuple[int, ...]:
    """One of the orders that begin with foot 1, counted from 0 as they are sorted."""
    order, rest = [1], list(range(2, legs + 1))
    while rest:
        place, number = divmod(number, factorial(len(rest) - 1))
        order.append(rest.pop(place))
    return tuple(order)


def _same(problem: PoseProblem, order: tuple[int, ...], heading: float) -> Iterator[tuple[int, ...]]:
    """Foot orders that are the same gait: the order itself, and where it is straight its mirror image."""
    yield order
    azimuths = problem.model.azimuths
    mirrored = None if problem.turn else mirrored_feet(azimuths, heading)
    if mirrored is not None:
        yield _from_one(tuple(mirrored[foot - 1] + 1 for foot in order))
    # On the spot every turn of the ring onto itself leads to the same gait.
    legs = problem.model.leg_count
    for shift in range(1, legs) if problem.on_the_spot else ():
        yield _from_one(tuple((foot - 1 + shift) % legs + 1 for foot in order))


def _from_one(order: tuple[int, ...]) -> tuple[int, ...]:
    """The same circular order, begun with foot 1."""
    first = order.index(1)
    return order[first:] + order[:first]
