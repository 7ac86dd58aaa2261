"""Learning parameters of the physics from trials, and how well they predict gaits that were left out."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from core.arrays import Floats
from core.errors import InputError
from core.identification.baseline import baseline_left_out, linear_baseline
from core.identification.bayes_fit import Fit, Measured, fit
from core.identification.parameters import FIT_PARAMETERS, FitParameter, box, physics_at
from core.identification.surrogate import Surrogate, fit_surrogate, space_filling_points
from core.physics.parameters import PhysicsSet
from core.physics.problem import SimulationProblem
from core.trials.displacement import Displacement, MeasuredWalk, pooled_spread

POINTS = 40
"""Sets of parameters at which every gait is simulated; a quadratic surface of seven has 36 coefficients."""
LEAST_GAITS = 3
LEAST_POINTS = 8
PARTS = 4
"""So many times an equal part of the points is left out; a parameter must be told each time, since what is
told with all of them alone hangs on where they happen to lie."""
FALLEN = Displacement(0.0, math.nan)
"""The prediction where the robot falls in simulation: no angle and distance 0, all of it error."""
USUAL_SPREAD = (0.0021, float(np.radians(3.8)))
"""Of one trial, m and rad, where none was repeated: that of the published trials."""

Task = tuple[int, PhysicsSet]
"""Which gait is simulated, and with which parameters."""
Simulate = Callable[[Sequence[Task]], list[Displacement | None]]
"""Simulates gaits; None of one whose robot falls or whose simulation cannot be trusted."""


@dataclass(frozen=True, eq=False)
class Walk:
    """A gait that the real robot walked, and what physics is asked about it.

    Args:
        measured: what it did.
        problem: exactly what it was sent, once.
        laps: how often that was sent.
        heading: of the wanted direction in the plan's frame, rad.
        cut: most that was cut off a stroke of what it was sent, to keep it in the motors' range, m.
    """

    measured: MeasuredWalk
    problem: SimulationProblem
    laps: int
    heading: float
    cut: float = 0.0


class Named(Protocol):
    """What the walks' procedure needs of a walk."""

    @property
    def measured(self) -> MeasuredWalk:
        """What the real robot did."""


@dataclass(frozen=True, eq=False)
class Prediction:
    """Displacements of every gait as one method predicts them.

    Args:
        name: of the way.
        displacements: a gait each; an angle is nan where the way says nothing of it, or the robot falls.
        falls: how many simulations fell.
    """

    name: str
    displacements: tuple[Displacement, ...]
    falls: int = 0

    @property
    def angles(self) -> int:
        """Of how many gaits it tells an angle."""
        return sum(not math.isnan(displacement.angle) for displacement in self.displacements)


@dataclass(frozen=True, eq=False)
class Learned:
    """What came of it.

    Args:
        physics: the parameters with what was learned; what cannot be told is as it was.
        defaults: the parameters before.
        parameters: what was fitted.
        fit: of all gaits.
        measured: what the real robot did.
        spread: of one trial, m and rad.
        predicted: every way of foretelling beside it.
        misfit: (2 · gaits,) of the response surfaces, m and rad.
        simulations: how many were run.
    """

    physics: PhysicsSet
    defaults: PhysicsSet
    parameters: tuple[FitParameter, ...]
    fit: Fit
    measured: tuple[MeasuredWalk, ...]
    spread: tuple[float, float]
    predicted: tuple[Prediction, ...]
    misfit: Floats
    simulations: int

    def errors(self, way: Prediction) -> tuple[float, float]:
        """Mean absolute error of a way's distances, m, and of the angles that it tells, rad."""
        pairs = [(one, walk.displacement) for one, walk in zip(way.displacements, self.measured, strict=True)]
        distance = float(np.mean([abs(one.distance - real.distance) for one, real in pairs]))
        angles = [abs(one.angle - real.angle) for one, real in pairs if not math.isnan(one.angle)]
        return distance, float(np.mean(angles)) if angles else math.nan


def simulation_count(gaits: int, kinds: int, points: int = POINTS) -> int:
    """How many simulations `learn` asks for."""
    return gaits * (points + 3 + (1 if is_by_kind(gaits, kinds) else 0))


def is_by_kind(gaits: int, kinds: int) -> bool:
    """Whether whole kinds of gaits are left out as well: there are three, and they are not gaits."""
    return LEAST_GAITS <= kinds < gaits


def require_gaits(walks: Sequence[Named]) -> None:
    """Refuses what nothing can be learned from.

    Raises:
        InputError: there are too few gaits.
    """
    count = len({walk.measured.name for walk in walks})
    if count < LEAST_GAITS:
        raise InputError(
            f"Learning needs trials of {LEAST_GAITS} different gaits or steps, so that one can be left out; "
            f"these are of {count}. Add trials of others.",
            "trials",
        )


def learn(
    walks: Sequence[Named],
    physics: PhysicsSet,
    simulate: Simulate,
    points: int = POINTS,
    parameters: tuple[FitParameter, ...] = FIT_PARAMETERS,
) -> Learned:
    """Fits parameters to measured travels.

    Every gait is simulated at points that fill the parameters' box, chosen before any measurement is looked
    at; quadratic surfaces through these stand for the physics in the fit. Each gait is then left out in turn,
    the rest fitted anew, and the gait itself simulated (not read off the surface) with what came of it.

    Args:
        walks: of at least three gaits.
        physics: the defaults.
        simulate: the physics.
        points: how many.
        parameters: what is fitted.

    Raises:
        InputError: there are too few gaits or points.
        CheckError: a gait falls in most simulations.
    """
    require_gaits(walks)
    if points < LEAST_POINTS:
        raise InputError(f"{points} points are asked for; take at least {LEAST_POINTS}.", "points")
    identification = _Identification(walks, physics, simulate, points, parameters)
    gaits, kinds = [[gait] for gait in range(len(walks))], _kinds(walks)
    ways = [
        identification.as_planned(),
        identification.at("default", physics),
        identification.at("fitted", identification.learned),
    ]
    ways += [
        *identification.left_out("left out", gaits),
        identification.linear_baseline("ratio, left out", gaits),
    ]
    if is_by_kind(len(walks), len(kinds)):
        ways += [
            *identification.left_out("kind left out", kinds),
            identification.linear_baseline("ratio, kind left out", kinds),
        ]
    return Learned(
        physics=identification.learned,
        defaults=physics,
        parameters=parameters,
        fit=identification.fit,
        measured=tuple(walk.measured for walk in walks),
        spread=identification.spread,
        predicted=tuple(ways),
        misfit=identification.surrogate.misfit,
        simulations=simulation_count(len(walks), len(kinds), points),
    )


class _Identification:
    """The surfaces and the fit of all gaits, and predictions with and without some.

    Args:
        walks: the gaits.
        physics: the defaults.
        simulate: the physics.
        points: how many sets of parameters the surfaces go through.
        parameters: what is fitted.
    """

    def __init__(
        self,
        walks: Sequence[Named],
        physics: PhysicsSet,
        simulate: Simulate,
        points: int,
        parameters: tuple[FitParameter, ...],
    ) -> None:
        self._walks = walks
        self._physics = physics
        self._simulate = simulate
        self._parameters = parameters
        known = [walk.measured for walk in walks]
        self.spread = pooled_spread(known) or USUAL_SPREAD
        values = [walk.displacement.distance for walk in known] + [walk.displacement.angle for walk in known]
        self._measured = Measured(np.array(values), np.repeat(self.spread, len(known)))
        self.surrogate, *self._parts = self._surrogate(points)
        self.fit = self._fit()
        self.learned = self._set(self.fit)

    def _surrogate(self, points: int) -> list[Surrogate]:
        """Those through all points, then those without each part of them."""
        low, high = box(self._parameters)
        z = low + (high - low) * space_filling_points(points, len(self._parameters))
        sets = [physics_at(self._physics, row, self._parameters) for row in z]
        displacements = self._simulate([(gait, one) for one in sets for gait in range(len(self._walks))])
        figures = np.array([_row(displacement) for displacement in displacements]).reshape(
            points, len(self._walks), 2
        )
        values = np.concatenate([figures[..., 0], figures[..., 1]], axis=1)
        names = [walk.measured.name for walk in self._walks] * 2
        without = [np.arange(points) % PARTS != part for part in range(PARTS)]
        return [
            fit_surrogate(low, high, z[kept], values[kept], names)
            for kept in (np.ones(points, dtype=np.bool_), *without)
        ]

    def _fit(self, left_out: frozenset[int] = frozenset()) -> Fit:
        """The fit of what is told with all points and without each part of them."""
        whole, *parts = (
            fit(surrogate, self._measured, self._parameters, left_out)
            for surrogate in (self.surrogate, *self._parts)
        )
        told = np.all([one.is_identifiable for one in (whole, *parts)], axis=0)
        return fit(self.surrogate, self._measured, self._parameters, left_out, told)

    def _set(self, found: Fit) -> PhysicsSet:
        return physics_at(self._physics, found.z, self._parameters)

    def as_planned(self) -> Prediction:
        """Every gait goes as far as wanted, in the wanted direction."""
        return Prediction(
            "as planned", tuple(Displacement(walk.measured.wanted, 0.0) for walk in self._walks)
        )

    def at(self, name: str, physics: PhysicsSet) -> Prediction:
        """Every gait simulated with one set."""
        return self._prediction(name, [physics] * len(self._walks))

    def left_out(self, name: str, groups: Sequence[Sequence[int]]) -> tuple[Prediction, Prediction]:
        """Every gait simulated with what is fitted without the group that it is in, and with a line besides.

        The line goes through the others' measured distances over those of their surfaces.
        """
        count = len(self._walks)
        chosen, lines = [self._physics] * count, [(1.0, 0.0)] * count
        for group in groups:
            without = self._fit(frozenset(group))
            kept = np.setdiff1d(np.arange(count), group)
            said = self.surrogate.at(without.z[None])[0]
            for gait in group:
                chosen[gait] = self._set(without)
                lines[gait] = linear_baseline(said[kept], self._measured.values[kept])
        plain = self._prediction(name, chosen)
        moved = tuple(
            displacement
            if displacement is FALLEN
            else Displacement(slope * displacement.distance + offset, displacement.angle)
            for displacement, (slope, offset) in zip(plain.displacements, lines, strict=True)
        )
        return plain, Prediction(f"{name}, line", moved, plain.falls)

    def linear_baseline(self, name: str, groups: Sequence[Sequence[int]]) -> Prediction:
        """Every gait by a line through the others' distances; of angles it says nothing."""
        wanted = np.array([walk.measured.wanted for walk in self._walks])
        said = baseline_left_out(wanted, self._measured.values[: len(wanted)], groups)
        return Prediction(name, tuple(Displacement(float(distance), float("nan")) for distance in said))

    def _prediction(self, name: str, chosen: Sequence[PhysicsSet]) -> Prediction:
        displacements = self._simulate(list(enumerate(chosen)))
        falls = sum(displacement is None for displacement in displacements)
        return Prediction(name, tuple(displacement or FALLEN for displacement in displacements), falls)


def _kinds(walks: Sequence[Named]) -> list[list[int]]:
    kinds: dict[str, list[int]] = {}
    for gait, walk in enumerate(walks):
        kinds.setdefault(walk.measured.kind, []).append(gait)
    return list(kinds.values())


def _row(displacement: Displacement | None) -> tuple[float, float]:
    return (
        (float("nan"), float("nan")) if displacement is None else (displacement.distance, displacement.angle)
    )
