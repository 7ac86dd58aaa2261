"""How much of the way and of the turn that a plan asks for a robot makes."""

from dataclasses import dataclass

import numpy as np

from core.arrays import Floats

WARNED_SHARE = 0.9
"""A robot that makes less of its way or turn gets a warning."""
LEAST_SHARE = 0.5
"""A robot that makes less does not walk: an error."""
NO_WAY = 0.001
"""A plan that never gets further from where it begins asks for no way, m."""
NO_TURN = float(np.radians(1.0))
"""A plan that never turns further asks for no turn, rad."""
STEPS_ROUND = 0.02
"""Feet that step round a body which turns on the spot move their middle by less, and bring it back, m."""
COMES_BACK = 0.5
"""A plan that ends nearer to its start than this part of its furthest place is judged at that place."""


@dataclass(frozen=True)
class WayMade:
    """Way and turn from the start to the place at which a plan is judged.

    That is its end, or where it is furthest from its start if it comes back from there. The way is that of
    the middle of all feet, which does not sway as the body does.

    Args:
        asked: the plan's way, m; 0 where it goes nowhere.
        made: of the robot, along the plan's, m; negative backwards.
        gap: how far from the plan's end the robot ends, both taken from their starts, m.
        asked_turn: the plan's turn, rad; 0 where it turns nowhere.
        made_turn: the robot's at the same place, rad, positive as the plan turns.
        turn_gap: how far from the plan's last heading the robot's is, rad.
    """

    asked: float
    made: float
    gap: float
    asked_turn: float
    made_turn: float
    turn_gap: float

    @property
    def share(self) -> float | None:
        """Part of the asked way that is made; None where none is asked."""
        return self.made / self.asked if self.asked else None

    @property
    def turn_share(self) -> float | None:
        """Part of the asked turn that is made; None where none is asked."""
        return self.made_turn / self.asked_turn if self.asked_turn else None


def way_made(planned: tuple[Floats, Floats], real: tuple[Floats, Floats]) -> WayMade:
    """Compares a robot's way with its plan's.

    Args:
        planned: (n, 2) middles of the feet, m, and (n,) headings, rad, without jumps of a whole turn.
        real: the same of the robot at the same moments; where it ended early, its last ones stand for the
            rest, and there are fewer.
    """
    count = len(planned[0])
    reached = np.minimum(np.arange(count), len(real[0]) - 1)
    asked, turned = planned[0] - planned[0][0], planned[1] - planned[1][0]
    way, turn = (real[0] - real[0][0])[reached], (real[1] - real[1][0])[reached]
    most = _judged(np.abs(turned), NO_TURN)
    away = np.linalg.norm(asked, axis=1)
    far = _judged(away, NO_WAY, comes_back=most is None or float(away.max()) > STEPS_ROUND)
    length = 0.0 if far is None else float(np.linalg.norm(asked[far]))
    side = 1.0 if most is None else float(np.sign(turned[most]))
    return WayMade(
        asked=length,
        made=0.0 if far is None else float(way[far] @ asked[far]) / length,
        gap=float(np.linalg.norm(way[-1] - asked[-1])),
        asked_turn=0.0 if most is None else abs(float(turned[most])),
        made_turn=0.0 if most is None else side * float(turn[most]),
        turn_gap=abs(float(turn[-1] - turned[-1])),
    )


def _judged(away: Floats, least: float, comes_back: bool = True) -> int | None:
    """The sample at which (n,) distances from the start are judged; None where nothing is asked.

    Args:
        away: the plan's distances.
        least: smaller ones are none.
        comes_back: whether a plan that ends near its start is judged at its furthest place. Feet that step
            round one after the other move their middle, and bring it back, without going anywhere.
    """
    furthest, last = int(away.argmax()), len(away) - 1
    if comes_back and away[last] < COMES_BACK * away[furthest]:
        last = furthest
    return last if away[last] > least else None
