"""How many events a pattern has at least and at most, and what it costs at least."""

import numpy as np

from core.arrays import Floats
from core.patterns.problem import FREE, PatternKind, PatternProblem


def event_counts(problem: PatternProblem) -> range:
    """Numbers of events that a pattern of this problem can have; others need no proof."""
    gaps = problem.sample_count - (problem.kind is PatternKind.TRANSITION)
    fewest = max(_fewest_switches(problem), default=0)
    most = sum(_most_switches(problem, gaps))
    return range(fewest, min(gaps, most) + 1)


def floor_of(problem: PatternProblem, events: int, row_floors: list[int]) -> int:
    """No pattern of so many events costs less: every event has a switch, and limbs need theirs.

    Args:
        problem: what is sought.
        events: K.
        row_floors: of each limb, from `row_floors`.
    """
    weights = problem.weights
    switches = max(events, sum(_fewest_switches(problem)))
    return weights.sample_changes * events + max(weights.limb_changes * switches, sum(row_floors))


def row_floors(problem: PatternProblem) -> list[int]:
    """What each limb costs at least in switches and redrawn cells, whatever the others do."""
    gaps = problem.sample_count - (problem.kind is PatternKind.TRANSITION)
    allowed = gaps if problem.rules.limb_changes is None else min(problem.rules.limb_changes, gaps)
    return [_row_floor(problem, limb, allowed) for limb in range(problem.leg_count)]


def _row_floor(problem: PatternProblem, limb: int, allowed: int) -> int:
    """The cheapest way through (value, switches so far), sample by sample; 0 where there is none."""
    costs, switch = _cell_costs(problem, limb), problem.weights.limb_changes
    ring, fewest = (
        problem.kind is PatternKind.PERIODIC,
        _fewest(problem, limb) if problem.walking[limb] else 0,
    )
    ends = []
    for first in (0, 1):
        ways = np.full((2, allowed + 1), np.inf)
        ways[first, 0] = costs[0, first]
        for cost in costs[1:]:
            switched = np.full_like(ways, np.inf)
            switched[:, 1:] = ways[::-1, :-1] + switch
            ways = np.minimum(ways, switched) + cost[:, None]
        if ring:
            ways[1 - first, :-1] += switch
            ways[1 - first, -1] = np.inf
        closing = ring & (np.arange(2) != first)
        reached = np.arange(allowed + 1) + closing[:, None]
        ends.append(ways[reached >= fewest].min(initial=np.inf))
    return int(min(ends)) if np.isfinite(min(ends)) else 0


def _cell_costs(problem: PatternProblem, limb: int) -> Floats:
    """(samples, 2) what swing and stance cost at each sample: inf against a fixed cell, else the drawing."""
    fixed = problem.fixed[limb]
    values = np.arange(2)
    costs = np.where((fixed[:, None] != FREE) & (fixed[:, None] != values), np.inf, 0.0)
    if problem.drawing is not None:
        redrawn = (fixed[:, None] == FREE) & (problem.drawing[limb][:, None] != values)
        costs += problem.weights.drawing * redrawn
    return np.asarray(costs)


def _fewest_switches(problem: PatternProblem) -> list[int]:
    return [_fewest(problem, int(limb)) for limb in np.nonzero(problem.walking)[0]]


def _fewest(problem: PatternProblem, limb: int) -> int:
    """A limb whose state differs at the ends switches; one that stands at both has to swing between."""
    if problem.kind is PatternKind.PERIODIC:
        return 2
    first, last = problem.fixed[limb, 0], problem.fixed[limb, -1]
    if first != last:
        return 1
    return 2 if first == 1 and problem.rules.least_swing else 0


def _most_switches(problem: PatternProblem, gaps: int) -> list[int]:
    """Switches of a limb are odd in number where its ends differ, else even."""
    allowed = gaps if problem.rules.limb_changes is None else min(problem.rules.limb_changes, gaps)
    most = []
    for limb in np.nonzero(problem.walking)[0]:
        odd = problem.kind is PatternKind.TRANSITION and (problem.fixed[limb, 0] != problem.fixed[limb, -1])
        most.append(allowed - (allowed - odd) % 2 if allowed >= odd else 0)
    return most
