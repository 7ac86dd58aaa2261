"""A surrogate: how a simulated figure depends on parameters, fitted to simulations over their box."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from core.arrays import Bools, Floats
from core.errors import CheckError

LINEAR_RIDGE, SQUARE_RIDGE = 0.002, 0.02
"""Weights of the coefficients' squares beside the mean squared misfit. Robots that rock go by jumps, which
the surface is to smooth and not to follow; what bends it counts more than what slopes it."""
LEAST_SHARE = 0.6
"""Of the points that must have an answer."""


@dataclass(frozen=True, eq=False)
class Surrogate:
    """Quadratic response surfaces over a box, one a figure; x goes from −1 to 1 along each side of it.

    y_j(x) = c_j0 + Σ c_ja x_a + Σ c_jab x_a x_b for a < b + Σ c_jaa (x_a² − 1/3).

    Args:
        low: (parameters,) one corner of the box.
        high: (parameters,) the other.
        coefficients: (terms, figures).
        misfit: (figures,) root of the mean squared distance of simulations from their surface.
    """

    low: Floats
    high: Floats
    coefficients: Floats
    misfit: Floats

    def at(self, z: Floats) -> Floats:
        """(n, figures) values at points (n, parameters)."""
        return np.asarray(_terms(self.low, self.high, z) @ self.coefficients)


def space_filling_points(count: int, axes: int) -> Floats:
    """Points of the additive recurrence x(k) = frac(1/2 + k / φ^j), which fill the unit box evenly.

    φ is the positive root of x^(axes + 1) = x + 1, the golden ratio where there is one axis. A larger count
    begins with the points of a smaller one. M. Roberts, "The unreasonable effectiveness of quasirandom
    sequences", 2018.

    Args:
        count: how many.
        axes: of the box.

    Returns:
        (count, axes) between 0 and 1.
    """
    ratio = 2.0
    for _ in range(40):
        ratio = (1.0 + ratio) ** (1.0 / (axes + 1))
    steps = ratio ** -np.arange(1.0, axes + 1.0)
    return np.asarray((0.5 + np.arange(1, count + 1)[:, None] * steps) % 1.0)


def fit_surrogate(low: Floats, high: Floats, z: Floats, values: Floats, gaits: Sequence[str]) -> Surrogate:
    """The surfaces of least squares, with a little ridge on all but the constant term.

    Args:
        low: (parameters,) one corner of the box.
        high: (parameters,) the other.
        z: (n, parameters) where it was simulated.
        values: (n, figures) what came of it; nan where there is no answer.
        gaits: (figures,) names of the gaits that the figures are of, for messages.

    Raises:
        CheckError: too few simulations of a gait have an answer.
    """
    terms = _terms(low, high, z)
    known = np.isfinite(values)
    shares = known.mean(axis=0)
    least = float(shares.min())
    if least < LEAST_SHARE:
        raise CheckError(
            f"Only {least * 100:.0f} % of the simulations of “{gaits[int(shares.argmin())]}” came to their "
            f"end, where {LEAST_SHARE * 100:.0f} % are needed: it falls. Leave it out.",
            "trials",
        )
    columns = [_coefficients(terms, values[:, j], known[:, j], len(low)) for j in range(values.shape[1])]
    coefficients = np.stack(columns, axis=1)
    off = np.where(known, values - terms @ coefficients, np.nan)
    return Surrogate(low, high, coefficients, np.sqrt(np.nanmean(off**2, axis=0)))


def _terms(low: Floats, high: Floats, z: Floats) -> Floats:
    """(n, terms) 1, each x, each product of two, and each square less its mean over the box."""
    x = (2.0 * z - low - high) / (high - low)
    first, second = np.triu_indices(len(low), 1)
    return np.concatenate([np.ones((len(x), 1)), x, x[:, first] * x[:, second], x**2 - 1.0 / 3.0], axis=1)


def _coefficients(terms: Floats, values: Floats, known: Bools, parameters: int) -> Floats:
    rows = terms[known]
    ridge = np.full(terms.shape[1], SQUARE_RIDGE)
    ridge[0], ridge[1 : 1 + parameters] = 0.0, LINEAR_RIDGE
    return np.asarray(np.linalg.solve(rows.T @ rows + len(rows) * np.diag(ridge), rows.T @ values[known]))
