"""Seeded random searches for patterns: transitions between gaits, gaits for some limbs, and small ones."""

import numpy as np

from core.arrays import Bools
from core.patterns.problem import (
    FREE,
    PatternKind,
    PatternProblem,
    PatternRules,
    PatternWeights,
    index_halves,
    transition_cells,
)

FEWEST_STANDING = 3
"""Feet that stand at every sample of a gait made here; F's rule asks for as many."""


def random_transition(random: np.random.Generator, legs: int, samples: int) -> PatternProblem:
    """F's transition from any sample of one random gait to any sample of another; both may hold limbs.

    Args:
        random: where chance comes from.
        legs: number of limbs.
        samples: of the transition, both ends included.
    """
    gaits = [random_gait(random, legs) for _ in range(2)]
    start, end = (gait[:, int(random.integers(gait.shape[1]))] for gait in gaits)
    still = np.all([gait.all(axis=1) | ~gait.any(axis=1) for gait in gaits], axis=0)
    locked = still & (gaits[0][:, 0] == gaits[1][:, 0])
    fixed = transition_cells(start, end, samples, locked)
    return PatternProblem(PatternKind.TRANSITION, fixed, ~locked, index_halves(legs))


def random_periodic(random: np.random.Generator, legs: int, samples: int) -> PatternProblem:
    """A gait for the limbs that are left when random ones are held up, or stand."""
    held = _held_limbs(random, legs)
    fixed = np.full((legs, samples), FREE, dtype=np.int8)
    fixed[held] = random.integers(0, 2, (int(held.sum()), 1))
    return PatternProblem(PatternKind.PERIODIC, fixed, ~held, index_halves(legs))


def random_gait(random: np.random.Generator, legs: int) -> Bools:
    """(legs, samples) one cycle in which groups of limbs swing in turn while some limbs are held up."""
    held = _held_limbs(random, legs)
    walkers = random.permutation(np.nonzero(~held)[0])
    group = int(random.integers(1, max(len(walkers) - FEWEST_STANDING, 1) + 1))
    swing, wait = int(random.integers(2, 6)), int(random.integers(0, 3))
    turns = -(-len(walkers) // group)
    stance = np.ones((legs, max(turns, 2) * (swing + wait)), dtype=np.bool_)
    stance[held] = False
    for place, limb in enumerate(walkers):
        first = place // group * (swing + wait)
        stance[limb, first : first + swing] = False
    return stance


def _held_limbs(random: np.random.Generator, legs: int) -> Bools:
    held = np.zeros(legs, dtype=np.bool_)
    most = min(legs // 3, legs - FEWEST_STANDING - 1)
    held[random.permutation(legs)[: int(random.integers(0, most + 1))]] = True
    return held


def random_small(random: np.random.Generator) -> PatternProblem:
    """At most 5 limbs and 9 samples, any rules, weights, locks and drawing: for trying out whole."""
    legs, samples = int(random.integers(2, 6)), int(random.integers(3, 10))
    kind = PatternKind.PERIODIC if random.random() < 0.4 else PatternKind.TRANSITION
    walking = np.asarray(random.random(legs) > 0.15)
    locks = 0.12 if random.random() < 0.4 else 0.0
    values = (random.random((legs, samples)) > 0.35).astype(np.int8)
    fixed = np.where(random.random((legs, samples)) < locks, values, FREE).astype(np.int8)
    if kind is PatternKind.TRANSITION:
        fixed[:, [0, -1]] = values[:, [0, -1]]
    fixed[~walking] = values[~walking, :1]
    drawing = random.random((legs, samples)) > 0.4 if random.random() < 0.3 else None
    weights = PatternWeights()
    if random.random() < 0.5:
        weights = PatternWeights(*(int(weight) for weight in random.integers(1, 20, 3)))
    rules = _random_rules(random, legs)
    return PatternProblem(kind, fixed, walking, index_halves(legs), rules, weights, drawing)


def _random_rules(random: np.random.Generator, legs: int) -> PatternRules:
    """F's number of each rule, another one, or none."""

    def number(usual: int, low: int, high: int) -> int | None:
        chance = float(random.random())
        if chance < 0.12:
            return None
        return usual if chance < 0.6 else int(random.integers(low, high))

    return PatternRules(
        shortest_swing=number(2, 1, 4),
        feet_down=number(min(3, legs - 1), 1, 4),
        feet_down_each_side=number(1, 0, 2),
        workload=number(2, 0, 4),
        limb_changes=number(2, 1, 5),
        shortest_stance=number(3, 1, 4),
        least_swing=number(2, 0, 4),
    )
