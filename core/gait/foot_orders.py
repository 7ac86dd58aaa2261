"""Foot orders that have names, for any robot."""

from dataclasses import dataclass

import numpy as np

from core.gait.gait import Orientation, heading_angle
from core.robot.model import RobotModel

_OF_FOUR = {
    Orientation.FB: (("Walk", (3, 2, 4, 1)), ("Amble", (3, 1, 4, 2))),
    Orientation.FBS: (("S-Gait", (1, 2, 4, 3)), ("C-Gait", (1, 2, 3, 4))),
}
"""Foot orders of the optimised gaits (thesis Figure 3.4)."""


@dataclass(frozen=True)
class FootOrder:
    """An order in which feet step, and what it is called; feet count from 1."""

    name: str
    feet: tuple[int, ...]


def named_orders(model: RobotModel, orientation: Orientation) -> tuple[FootOrder, ...]:
    """Orders that work for a robot, at direction 1; the first is the one to begin with.

    With four legs those of the thesis; else a wave from the back foot to the front one, side by side, and a
    ripple in which opposite feet follow each other.

    Args:
        model: the robot.
        orientation: FB looks along the diagonal between x and y, FBS along x.
    """
    if model.leg_count == 4:
        return tuple(FootOrder(name, feet) for name, feet in _OF_FOUR[orientation])
    heading = heading_angle(orientation)
    ahead = np.round(np.cos(model.azimuths - heading), 9)
    left = np.round(np.sin(model.azimuths - heading), 9)
    wave = np.lexsort((-left, ahead))
    half = model.leg_count // 2
    ripple = [foot for first in range(half) for foot in (first, first + half)]
    ripple += list(range(2 * half, model.leg_count))
    return tuple(
        FootOrder(name, tuple(int(foot) + 1 for foot in feet))
        for name, feet in (("Wave", wave), ("Ripple", ripple))
    )


def order_title(model: RobotModel, order: tuple[int, ...]) -> str | None:
    """The name of a foot order wherever it begins, None where it has none."""
    for orientation in Orientation:
        for named in named_orders(model, orientation):
            first = named.feet.index(order[0])
            if named.feet[first:] + named.feet[:first] == order:
                return named.name
    return None
