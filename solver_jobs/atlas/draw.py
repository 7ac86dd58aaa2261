"""Drawing the gaits of a space evenly: a scrambled Sobol sequence, in which every gait has its place."""

import numpy as np

from core.arrays import Floats
from core.atlas.point import AtlasPoint
from core.atlas.space import AtlasSpace


def drawn_points(space: AtlasSpace, first: int, count: int) -> list[AtlasPoint]:
    """Some gaits of a space, by their numbers; each is the same however many are drawn together.

    Args:
        space: what varies.
        first: number of the first one, from 0.
        count: how many.
    """
    return [space.point(first + place, row) for place, row in enumerate(_places(space, first, count))]


def _places(space: AtlasSpace, first: int, count: int) -> Floats:
    """(count, keys that vary) from 0 up to, not including, 1."""
    from scipy.stats.qmc import Sobol

    dimensions = len(space.varying)
    if not dimensions or not count:
        return np.zeros((count, dimensions))
    sequence = Sobol(dimensions, scramble=True, rng=np.random.default_rng(space.seed))
    if first == 0:
        return (
            np.vstack([sequence.random(1), sequence.random(count - 1)])
            if count
            else np.zeros((0, dimensions))
        )
    sequence.fast_forward(first)
    return np.asarray(sequence.random(count))
