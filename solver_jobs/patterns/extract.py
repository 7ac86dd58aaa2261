"""From a solution of a model to a pattern."""

from collections.abc import Callable

import numpy as np

from core.arrays import Floats
from core.patterns.check import scored
from core.patterns.problem import Pattern
from solver_jobs.patterns.balance import UNIT
from solver_jobs.patterns.events import EventModel
from solver_jobs.patterns.model import PatternModel


def read_pattern(built: EventModel, value: Callable[..., int]) -> Pattern:
    """The pattern of a solution, its columns drawn out to samples.

    Args:
        built: the model.
        value: of its variables.
    """
    count = built.problem.sample_count
    begins = np.array([value(start) for start in built.starts])
    columns = np.array([[value(cell) for cell in row] for row in built.stance], dtype=np.bool_)
    which = np.searchsorted(begins, np.arange(count), side="right") - 1
    body = _body(built, begins, value) if built.places else None
    return scored(built.problem, columns[:, which], body)


def _body(built: EventModel, begins: np.ndarray, value: Callable[..., int]) -> Floats:
    """(samples, 2) m; straight through each column, at one speed."""
    count = built.problem.sample_count
    body = np.empty((count, 2))
    ends = [*begins[1:], begins[0] + count if built.is_ring else count]
    for (entry, leave), begin, end in zip(built.places, begins, ends, strict=True):
        first = np.array([value(entry.x), value(entry.y)]) * UNIT
        last = np.array([value(leave.x), value(leave.y)]) * UNIT
        share = np.linspace(0.0, 1.0, end - begin)[:, None]
        body[np.arange(begin, end) % count] = first + share * (last - first)
    return body


def read_samples(built: PatternModel, value: Callable[..., int]) -> Pattern:
    """The pattern of a solution of the model with a truth value a limb and sample."""
    stance = np.array([[value(cell) for cell in row] for row in built.stance], dtype=np.bool_)
    body = np.array([(value(place.x), value(place.y)) for place in built.places]) * UNIT
    return scored(built.problem, stance, body if built.places else None)
