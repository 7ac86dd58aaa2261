"""The best pattern of a small problem by trying them all: what the solver is held against.

Rows that one limb may have are joined limb by limb; what two joins have in common is kept once. Nothing is
shared with the solver or with the check, so that a rule that is misread shows.
"""

from itertools import groupby, product

import numpy as np
from numpy.typing import NDArray

from core.errors import InputError
from core.patterns.problem import FREE, PatternKind, PatternProblem, PatternRules

MOST_LIMBS, MOST_TRIED_SAMPLES = 5, 10
"""Of a problem that can still be tried out."""

Counts = NDArray[np.int64]


def least_weighted_sum(problem: PatternProblem) -> int | None:
    """The weighted sum of the best pattern, or None where none keeps the rules; the balance is left out.

    Args:
        problem: a small one.

    Raises:
        InputError: it is too large to be tried out.
    """
    if problem.leg_count > MOST_LIMBS or problem.sample_count > MOST_TRIED_SAMPLES:
        raise InputError(
            f"{problem.leg_count} limbs and {problem.sample_count} samples are too many to try them all; "
            f"take at most {MOST_LIMBS} and {MOST_TRIED_SAMPLES}.",
            "samples",
        )
    states = _Joined(problem)
    last = problem.leg_count - 1
    for limb in range(last):
        states.join(limb, _rows(problem, limb))
    return states.best_with(last, _rows(problem, last))


def _rows(problem: PatternProblem, limb: int) -> list[tuple[int, ...]]:
    """Every row of a limb that keeps the rules of single limbs."""
    fixed = problem.fixed[limb]
    choices = [(0, 1) if value == FREE else (int(value),) for value in fixed]
    return [row for row in product(*choices) if _is_allowed(problem, row, bool(problem.walking[limb]))]


def _is_allowed(problem: PatternProblem, row: tuple[int, ...], walks: bool) -> bool:
    rules, ring = problem.rules, problem.kind is PatternKind.PERIODIC
    changes = _changes(row, ring=ring)
    if rules.limb_changes is not None and len(changes) > rules.limb_changes:
        return False
    if walks and rules.least_swing is not None and row.count(0) < rules.least_swing:
        return False
    if walks and ring and not changes:
        return False
    return all(length >= _shortest(rules, value) for value, length in _whole_runs(row, ring=ring))


def _shortest(rules: PatternRules, value: int) -> int:
    return (rules.shortest_stance if value else rules.shortest_swing) or 0


def _whole_runs(row: tuple[int, ...], *, ring: bool) -> list[tuple[int, int]]:
    """Value and length of each run that nothing cuts off."""
    if ring:
        begins = _changes(row, ring=True)
        if not begins:
            return []
        row = row[begins[0] + 1 :] + row[: begins[0] + 1]
    runs = [(value, len(list(run))) for value, run in groupby(row)]
    return runs if ring else runs[1:-1]


def _changes(row: tuple[int, ...], *, ring: bool) -> list[int]:
    """Samples after which the row changes."""
    last = len(row) if ring else len(row) - 1
    return [j for j in range(last) if row[j] != row[(j + 1) % len(row)]]


class _Joined:
    """What counts of the limbs joined so far, a line for each way to join them.

    Columns: feet down by sample, all, left and right, four bits each; gaps with a change, a bit each; least
    and most stance of the walkers; what switches and redrawn cells cost.
    """

    def __init__(self, problem: PatternProblem) -> None:
        self._problem = problem
        self._lines: Counts = np.array([[0, 0, 0, 0, problem.sample_count, 0, 0]], dtype=np.int64)

    def join(self, limb: int, rows: list[tuple[int, ...]]) -> None:
        """Takes one more limb in."""
        lines = self._extended(self._lines, limb, rows)
        left = self._problem.leg_count - 1 - limb
        kept = lines[self._holds(lines, limb + 1, left)]
        order = np.lexsort(kept.T[::-1])
        kept = kept[order]
        new = np.ones(len(kept), dtype=np.bool_)
        new[1:] = (kept[1:, :-1] != kept[:-1, :-1]).any(axis=1)
        self._lines = kept[new]

    def best_with(self, limb: int, rows: list[tuple[int, ...]]) -> int | None:
        """The smallest weighted sum with the last limb."""
        best: int | None = None
        for first in range(0, len(self._lines), 4096):
            lines = self._extended(self._lines[first : first + 4096], limb, rows)
            sums = lines[:, 6] + self._problem.weights.sample_changes * np.bitwise_count(lines[:, 3]).astype(
                np.int64
            )
            if best is not None:
                lines, sums = lines[sums < best], sums[sums < best]
            sums = sums[self._holds(lines, limb + 1, 0)]
            best = int(sums.min()) if len(sums) else best
        return best

    def _extended(self, lines: Counts, limb: int, rows: list[tuple[int, ...]]) -> Counts:
        extended = [self._with_row(lines, limb, row) for row in rows]
        return np.concatenate([lines[:0], *extended])

    def _with_row(self, lines: Counts, limb: int, row: tuple[int, ...]) -> Counts:
        problem = self._problem
        packed = sum(value << (4 * sample) for sample, value in enumerate(row))
        changes = _changes(row, ring=problem.kind is PatternKind.PERIODIC)
        after = lines.copy()
        after[:, 0] += packed
        after[:, 1] += packed * int(problem.sides[0, limb])
        after[:, 2] += packed * int(problem.sides[1, limb])
        after[:, 3] |= sum(1 << gap for gap in changes)
        if problem.walking[limb]:
            after[:, 4] = np.minimum(after[:, 4], sum(row))
            after[:, 5] = np.maximum(after[:, 5], sum(row))
        after[:, 6] += problem.weights.limb_changes * len(changes) + self._redrawn(limb, row)
        return after

    def _redrawn(self, limb: int, row: tuple[int, ...]) -> int:
        problem = self._problem
        if problem.drawing is None:
            return 0
        wrong = (problem.drawing[limb] != np.array(row)) & (problem.fixed[limb] == FREE)
        return problem.weights.drawing * int(wrong.sum())

    def _holds(self, lines: Counts, joined: int, left: int) -> NDArray[np.bool_]:
        """Whether the rules can still hold when the limbs that are left all stand."""
        rules, holds = self._problem.rules, np.ones(len(lines), dtype=np.bool_)
        if rules.workload is not None:
            holds &= lines[:, 5] - lines[:, 4] <= rules.workload
        coming = self._problem.sides[:, joined:].sum(axis=1)
        each_side = rules.feet_down_each_side or 0
        for column, least in (
            (0, (rules.feet_down or 0) - left),
            (1, each_side - coming[0]),
            (2, each_side - coming[1]),
        ):
            for sample in range(self._problem.sample_count):
                holds &= (lines[:, column] >> (4 * sample) & 15) >= least
        return holds
