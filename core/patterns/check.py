"""Whether a pattern keeps the rules of its problem, by counting; shares nothing with the solver.

Source: F 3.2, with docs/sources.md.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from core.arrays import Bools, Floats, frozen_bools
from core.motion.support_polygon import polygon_margin, support_polygon
from core.patterns.problem import FREE, Pattern, PatternKind, PatternProblem, Rule

ROUNDING = 1e-9
"""Places of the body are rounded; a margin or a way counts as kept within this, m."""


@dataclass(frozen=True)
class Violation:
    """One rule broken at one place.

    Args:
        rule: which.
        limb: 0-based, where it is one limb's.
        samples: 0-based, where it happens; in a gait a phase may go on from the last sample to the first.
        value: what was found; m for balance, else a count.
        limit: the rule's number.
    """

    rule: Rule
    limb: int | None
    samples: tuple[int, ...]
    value: float
    limit: float


def check_pattern(
    problem: PatternProblem, stance: Bools, body_xy: Floats | None = None
) -> tuple[Violation, ...]:
    """Every place where a pattern breaks a rule of its problem; empty where it keeps them all.

    Args:
        problem: what is asked.
        stance: (legs, samples).
        body_xy: (samples, 2) places of the body, m; needed for the rule `balance`.

    Raises:
        InputError: the pattern has another size than the problem.
    """
    cells = frozen_bools(stance, problem.fixed.shape, "pattern")
    found = [violation for rule in CHECKS for violation in rule(problem, cells)]
    return (*found, *_balance(problem, cells, body_xy))


def broken_rules(violations: tuple[Violation, ...]) -> frozenset[Rule]:
    """Which rules are broken at all."""
    return frozenset(violation.rule for violation in violations)


def scored(problem: PatternProblem, stance: Bools, body_xy: Floats | None = None) -> Pattern:
    """A pattern with its counts; a periodic one's last sample is followed by its first.

    Args:
        problem: for its kind and drawing.
        stance: (legs, samples).
        body_xy: (samples, 2) m, where known.
    """
    cells = frozen_bools(stance, problem.fixed.shape, "pattern")
    switched = _switched(problem, cells)
    redrawn = 0
    if problem.drawing is not None:
        redrawn = int(((cells != problem.drawing) & (problem.fixed == FREE)).sum())
    return Pattern(cells, int(switched.any(axis=0).sum()), int(switched.sum()), redrawn, body_xy)


def weighted_sum(problem: PatternProblem, pattern: Pattern) -> int:
    """What the pattern costs by `PatternWeights`; smaller is better."""
    weights = problem.weights
    return (
        weights.sample_changes * pattern.sample_changes
        + weights.limb_changes * pattern.limb_changes
        + weights.drawing * pattern.redrawn
    )


def _is_ring(problem: PatternProblem) -> bool:
    return problem.kind is PatternKind.PERIODIC


def _switched(problem: PatternProblem, stance: Bools) -> Bools:
    """(legs, gaps) where a limb differs between a sample and the next one."""
    gaps: Bools = stance != np.roll(stance, -1, axis=1)
    return gaps if _is_ring(problem) else gaps[:, :-1]


def _fixed(problem: PatternProblem, stance: Bools) -> list[Violation]:
    """g1."""
    wrong = np.argwhere((problem.fixed != FREE) & (problem.fixed != stance))
    return [
        Violation(Rule.FIXED, int(i), (int(j),), float(stance[i, j]), float(problem.fixed[i, j]))
        for i, j in wrong
    ]


def inner_phases(row: Bools, *, ring: bool) -> list[tuple[bool, tuple[int, ...]]]:
    """Stance or not, and the samples, of each phase of a limb that begins and ends within what is seen.

    Args:
        row: (samples,) stance of one limb.
        ring: whether the first sample follows the last one.
    """
    count = len(row)
    begins = [j for j in range(count) if row[j] != row[j - 1] and (ring or j > 0)]
    ends = [*begins[1:], begins[0] + count] if ring and begins else begins[1:]
    return [(bool(row[a]), tuple(j % count for j in range(a, b))) for a, b in zip(begins, ends, strict=False)]


def _shortest(problem: PatternProblem, stance: Bools) -> list[Violation]:
    """g2, g9, g10."""
    limits = {
        False: (Rule.SHORTEST_SWING, problem.rules.shortest_swing),
        True: (Rule.SHORTEST_STANCE, problem.rules.shortest_stance),
    }
    found = []
    for limb, row in enumerate(stance):
        for stands, samples in inner_phases(row, ring=_is_ring(problem)):
            rule, limit = limits[stands]
            if limit is not None and len(samples) < limit:
                found.append(Violation(rule, limb, samples, len(samples), limit))
    return found


def _feet_down(problem: PatternProblem, stance: Bools) -> list[Violation]:
    """g3."""
    return _too_few(Rule.FEET_DOWN, stance.sum(axis=0), problem.rules.feet_down)


def _each_side(problem: PatternProblem, stance: Bools) -> list[Violation]:
    """g4, g5; the emptier side counts."""
    down = np.array([stance[side].sum(axis=0) for side in problem.sides])
    return _too_few(Rule.FEET_DOWN_EACH_SIDE, down.min(axis=0), problem.rules.feet_down_each_side)


def _too_few(rule: Rule, down: np.ndarray, limit: int | None) -> list[Violation]:
    if limit is None:
        return []
    return [Violation(rule, None, (int(j),), int(down[j]), limit) for j in np.nonzero(down < limit)[0]]


def _workload(problem: PatternProblem, stance: Bools) -> list[Violation]:
    """g6, g7; told of the limb that stands longest."""
    limit, walkers = problem.rules.workload, np.nonzero(problem.walking)[0]
    if limit is None or len(walkers) < 2:
        return []
    stands = stance[walkers].sum(axis=1)
    difference = int(stands.max() - stands.min())
    if difference <= limit:
        return []
    return [Violation(Rule.WORKLOAD, int(walkers[stands.argmax()]), (), difference, limit)]


def _limb_changes(problem: PatternProblem, stance: Bools) -> list[Violation]:
    """g8."""
    limit, switched = problem.rules.limb_changes, _switched(problem, stance)
    if limit is None:
        return []
    return [
        Violation(Rule.LIMB_CHANGES, limb, tuple(int(j) for j in np.nonzero(row)[0]), int(row.sum()), limit)
        for limb, row in enumerate(switched)
        if row.sum() > limit
    ]


def _least_swing(problem: PatternProblem, stance: Bools) -> list[Violation]:
    """g11; in a periodic pattern a walking limb also has to step: to lift off, and to stand again."""
    limit, found = problem.rules.least_swing or 0, []
    for limb in np.nonzero(problem.walking)[0]:
        swings = int((~stance[limb]).sum())
        idle = _is_ring(problem) and swings in (0, problem.sample_count)
        if swings < limit or idle:
            found.append(Violation(Rule.LEAST_SWING, int(limb), (), swings, max(limit, 1)))
    return found


CHECKS: tuple[Callable[[PatternProblem, Bools], list[Violation]], ...] = (
    _fixed,
    _shortest,
    _feet_down,
    _each_side,
    _workload,
    _limb_changes,
    _least_swing,
)
"""Every rule but balance."""


def _balance(problem: PatternProblem, stance: Bools, body_xy: Floats | None) -> list[Violation]:
    """The body stays inside the support polygon, within its reach, and moves no faster than it can."""
    margin, model = problem.rules.balance, problem.balance_model
    if margin is None or model is None:
        return []
    if body_xy is None:
        return [Violation(Rule.BALANCE, None, tuple(range(problem.sample_count)), float("-inf"), margin)]
    places = np.asarray(body_xy, dtype=np.float64)
    found = []
    for sample, (place, stands) in enumerate(zip(places, stance.T, strict=True)):
        inside = polygon_margin(support_polygon(model.feet_xy[stands]), place)
        if inside < margin - ROUNDING:
            found.append(Violation(Rule.BALANCE, None, (sample,), inside, margin))
    return found + _too_far(problem, places)


def _too_far(problem: PatternProblem, places: Floats) -> list[Violation]:
    """Places beyond the body's reach, and ways between samples that it cannot go in time, m."""
    model, count = problem.balance_model, len(places)
    if model is None:
        return []
    out = np.linalg.norm(places, axis=1)
    way = np.linalg.norm(np.roll(places, -1, axis=0) - places, axis=1)
    gaps = range(count if _is_ring(problem) else count - 1)
    longest = model.speed * problem.sample_time
    beyond = [
        Violation(Rule.BALANCE, None, (j,), float(out[j]), model.reach)
        for j in range(count)
        if out[j] > model.reach + ROUNDING
    ]
    return beyond + [
        Violation(Rule.BALANCE, None, (j, (j + 1) % count), float(way[j]), longest)
        for j in gaps
        if way[j] > longest + ROUNDING
    ]
