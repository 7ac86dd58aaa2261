"""The rule `balance`: a place for the body at each sample, inside the support polygon, and ways between them.

The centre of mass stays left of the line from foot i to foot j, by the margin, wherever every foot on the
right of that line is in the air; these lines are the support polygon's edges and lines outside it. Places are
whole numbers of `UNIT`, lines are rounded inwards, and discs are 16-gons inside them (98 % of the radius), so
that what is found keeps the rule exactly, and what is called impossible may miss it by a fiftieth. With a
margin below nothing the body is that near to a place inside.
"""

from dataclasses import dataclass
from math import floor

import numpy as np
from ortools.sat.python.cp_model import CpModel, IntVar, LinearExprT

from core.arrays import Floats
from core.patterns.problem import PatternProblem

UNIT = 2e-5
"""Of a place, m."""

SCALE = 10_000
"""Of a direction: its parts are whole numbers of 1/SCALE."""

SIDES = 16
"""Of the polygon that stands for a disc."""

ROUNDING = 1e-3
"""Share of a unit that rounding may have taken, so that a whole number of units stays whole."""

_ON_THE_LINE = 1e-9


@dataclass(frozen=True)
class Edge:
    """A line that the body has to keep left of: x·place_x + y·place_y ≥ least, in units.

    Args:
        x: of the direction to the left.
        y: of the same.
        least: in units times SCALE.
        lifted: the limbs that must be in the air for it to count.
        is_reachable: whether any place within reach keeps it.
    """

    x: int
    y: int
    least: int
    lifted: tuple[int, ...]
    is_reachable: bool


@dataclass(frozen=True, eq=False)
class Place:
    """Where the body is, in units."""

    x: IntVar
    y: IntVar


class Balance:
    """Adds places and ways of one problem to one model.

    Args:
        problem: with a balance model, and the rule on.
        model: of the solver.
    """

    def __init__(self, problem: PatternProblem, model: CpModel) -> None:
        balance, margin = problem.balance_model, problem.rules.balance
        if balance is None or margin is None:
            raise ValueError("the problem asks for no balance")
        self._model = model
        self._reach = _at_most(balance.reach / UNIT)
        self._step = _at_most(balance.speed * problem.sample_time * SCALE * np.cos(np.pi / SIDES) / UNIT)
        self._slack = _at_most(max(-margin, 0.0) / UNIT)
        furthest = balance.reach + max(-margin, 0.0)
        self._edges = _edges(balance.feet_xy, max(margin, 0.0), furthest)
        angles = np.arange(SIDES) * 2 * np.pi / SIDES
        self._directions = [(round(SCALE * np.cos(a)), round(SCALE * np.sin(a))) for a in angles]

    def place(self) -> Place:
        """A place within reach."""
        place = self._free_place(self._reach)
        furthest = floor(self._reach * SCALE * np.cos(np.pi / SIDES))
        for across, along in self._directions:
            self._model.add(across * place.x + along * place.y <= furthest)
        return place

    def _free_place(self, most: int) -> Place:
        return Place(self._model.new_int_var(-most, most, "x"), self._model.new_int_var(-most, most, "y"))

    def _inner(self, place: Place) -> Place:
        """With a margin below nothing: a place on the support polygon, at most that far away."""
        if not self._slack:
            return place
        inner, furthest = self._free_place(self._reach + self._slack), self._slack * SCALE
        for across, along in self._directions:
            way = across * (inner.x - place.x) + along * (inner.y - place.y)
            self._model.add(way <= floor(furthest * np.cos(np.pi / SIDES)))
        return inner

    def keep_inside(self, places: list[Place], standing: list[IntVar]) -> None:
        """These places are balanced while these feet stand.

        Args:
            places: of the body.
            standing: a truth value a limb.
        """
        inner = [self._inner(place) for place in places]
        for edge in self._edges:
            feet = [standing[limb] for limb in edge.lifted]
            if not edge.is_reachable:
                self._model.add_bool_or(feet)
                continue
            counts = self._model.new_bool_var("")
            self._model.add_bool_or([*feet, counts])
            for place in inner:
                inside = edge.x * place.x + edge.y * place.y >= edge.least
                self._model.add(inside).only_enforce_if(counts)

    def keep_near(self, one: Place, other: Place, samples: LinearExprT) -> None:
        """The body can go from one place to the other in so many samples."""
        for across, along in self._directions:
            way = across * (other.x - one.x) + along * (other.y - one.y)
            self._model.add(way <= self._step * samples)


def _edges(feet: Floats, margin: float, reach: float) -> list[Edge]:
    """Every line between two feet that matters within a distance from the middle."""
    found = []
    for start, first in enumerate(feet):
        for end, second in enumerate(feet):
            length = float(np.linalg.norm(second - first))
            if start == end or length < _ON_THE_LINE:
                continue
            left = np.array([first[1] - second[1], second[0] - first[0]]) / length
            beyond = (feet - first) @ left < -_ON_THE_LINE
            lifted = tuple(int(limb) for limb in np.nonzero(beyond)[0])
            edge = _edge(left, float(left @ first) + margin, reach, lifted)
            if edge is not None:
                found.append(edge)
    return list(dict.fromkeys(found))


def _edge(left: Floats, least: float, reach: float, lifted: tuple[int, ...]) -> Edge | None:
    """The line in whole numbers; None where every place within reach keeps it."""
    if least <= -reach:
        return None
    x, y = round(SCALE * float(left[0])), round(SCALE * float(left[1]))
    lost = SCALE * float(np.abs(left - np.array([x, y]) / SCALE).sum()) * reach / UNIT
    return Edge(x, y, -_at_most(-(least * SCALE / UNIT + lost)), lifted, least <= reach)


def _at_most(units: float) -> int:
    """The whole units in a length; feet and margins are round numbers, so that it often is a whole number."""
    return floor(units + ROUNDING)
