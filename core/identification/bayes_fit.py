"""A Bayesian fit: parameters that explain measured displacements, and how certain each of them is."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from itertools import product
from statistics import NormalDist

import numpy as np
from numpy.typing import NDArray

from core.arrays import Bools, Floats
from core.identification.parameters import FitParameter, box
from core.identification.surrogate import Surrogate, space_filling_points

DRAWS = 16_000
"""Points drawn of what is thought before the trials."""
NOISES = (1.0, 1.7, 3.0, 5.0)
"""How many times the trials' own spread the misfit may be: trials spread, and no model is right. The factors
of distance and of angle are those under which what was measured is likeliest."""
LEAST_EFFECT = 1.0
"""A parameter that changes no figure by more than so many spreads of a trial cannot be told."""
MOST_LEFT = 0.7
"""Neither can one whose spread after the trials is more than this share of that before."""


@dataclass(frozen=True, eq=False)
class Measured:
    """Figures of the real robot: every gait's distance, then every gait's angle.

    Args:
        values: (2 · gaits,) m and rad.
        spread: (2 · gaits,) standard deviation of one trial's, m and rad.
    """

    values: Floats
    spread: Floats

    @property
    def gait_count(self) -> int:
        """Number of gaits."""
        return len(self.values) // 2


@dataclass(frozen=True, eq=False)
class Fit:
    """What trials say of parameters, each in its own units (z of `FitParameter`).

    Args:
        z: (parameters,) best values; 0, the default, of those that cannot be told.
        spread: (parameters,) standard deviations after the trials, all parameters being free: those that are
            put back to their defaults may be elsewhere, and would take others along.
        before: (parameters,) standard deviations before.
        effect: (parameters,) largest change of any figure as each goes through its range by itself, in
            spreads of a trial.
        is_identifiable: (parameters,) whether the trials tell them.
        noise: factors on the trials' spread, of distance and of angle.
    """

    z: Floats
    spread: Floats
    before: Floats
    effect: Floats
    is_identifiable: Bools
    noise: tuple[float, float]


def fit(
    surrogate: Surrogate,
    measured: Measured,
    parameters: Sequence[FitParameter],
    left_out: frozenset[int] = frozenset(),
    among: Bools | None = None,
) -> Fit:
    """The parameters after the trials: means over what was thought before, weighed by likelihood.

    Each figure is normal about its surface, with the spread of a trial times a factor and that of simulations
    about the surface. The parameter that is told least is put back to its default and the rest fitted again,
    until all that are left are told.

    Args:
        surrogate: of all figures.
        measured: the same figures of the real robot.
        parameters: what is fitted.
        left_out: gaits that do not count.
        among: (parameters,) which may be told at all; None for every one.
    """
    gaits = np.setdiff1d(np.arange(measured.gait_count), list(left_out)).astype(np.int64)
    draws = prior_draws(tuple(parameters))
    effect = _effects(surrogate, measured, parameters, gaits)
    before = draws.std(axis=0)
    _, spread = _moments(draws, _weights(draws, surrogate, measured, gaits)[0])
    told = np.asarray(effect > LEAST_EFFECT)
    told = told if among is None else told & among
    while True:
        weights, noise = _weights(np.where(told, draws, 0.0), surrogate, measured, gaits)
        mean, after = _moments(draws, weights)
        left = np.where(told, after / before, 0.0)
        if left.max() < MOST_LEFT:
            return Fit(np.where(told, mean, 0.0), spread, before, effect, told, noise)
        told[int(left.argmax())] = False


@cache
def prior_draws(parameters: tuple[FitParameter, ...]) -> Floats:
    """(DRAWS, parameters) points of the normal distribution within the parameters' box, evenly spread."""
    normal = NormalDist()
    low, high = box(parameters)
    shares = space_filling_points(DRAWS, len(parameters))
    ends = [(normal.cdf(float(a)), normal.cdf(float(b))) for a, b in zip(low, high, strict=True)]
    columns = [
        [normal.inv_cdf(a + (b - a) * share) for share in column.tolist()]
        for (a, b), column in zip(ends, shares.T, strict=True)
    ]
    return np.asarray(np.clip(np.array(columns).T, low, high))


def _effects(
    surrogate: Surrogate, measured: Measured, parameters: Sequence[FitParameter], gaits: NDArray[np.int64]
) -> Floats:
    """(parameters,) range of the figure that changes most, in spreads, the others at their defaults."""
    figures = np.concatenate([gaits, gaits + measured.gait_count])
    effects = []
    for column, parameter in enumerate(parameters):
        line = np.zeros((21, len(parameters)))
        line[:, column] = np.linspace(parameter.low, parameter.high, len(line))
        ranges = np.ptp(surrogate.at(line), axis=0) / measured.spread
        effects.append(float(ranges[figures].max()))
    return np.array(effects)


def _weights(
    draws: Floats, surrogate: Surrogate, measured: Measured, gaits: NDArray[np.int64]
) -> tuple[Floats, tuple[float, float]]:
    """(draws,) weights that sum to 1, and the factors on the trials' spread that are likeliest."""
    off = (surrogate.at(draws) - measured.values) ** 2

    def likelihoods(figures: NDArray[np.int64]) -> list[Floats]:
        """(draws,) logarithms, one for each factor."""
        logs = []
        for factor in NOISES:
            variance = (factor * measured.spread[figures]) ** 2 + surrogate.misfit[figures] ** 2
            logs.append(-0.5 * (off[:, figures] @ (1.0 / variance) + np.log(variance).sum()))
        return logs

    distances, angles = likelihoods(gaits), likelihoods(gaits + measured.gait_count)
    every = [one + other for one, other in product(distances, angles)]
    evidence = [float(logs.max() + np.log(np.exp(logs - logs.max()).mean())) for logs in every]
    best = int(np.argmax(evidence))
    weights = np.exp(every[best] - every[best].max())
    return weights / weights.sum(), list(product(NOISES, NOISES))[best]


def _moments(draws: Floats, weights: Floats) -> tuple[Floats, Floats]:
    mean = weights @ draws
    return np.asarray(mean), np.sqrt(weights @ (draws - mean) ** 2)
