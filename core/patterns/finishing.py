"""Phases that the cursors of a transition cut are finished in it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from core.arrays import Bools
from core.errors import InputError
from core.patterns.problem import Cells, PatternRules
from core.patterns.sides import PatternSide, locked_limbs, require_alike

Phases = tuple[NDArray[np.intp], NDArray[np.intp]]
"""(legs,) samples that the phase at a cursor has in its own gait, and those that it lacks."""


def finished_phases(fixed: Cells, first: PatternSide, second: PatternSide, rules: PatternRules) -> Cells:
    """(legs, samples) cells of a transition with those fixed that finish a phase which a cursor cuts.

    A swing that has lasted 2 samples at the first cursor goes on until it has lasted `shortest_swing`, and so
    backwards from the second one; a stance likewise, where it does not begin or end with its gait.

    Args:
        fixed: of `transition_cells`.
        first: the gait that is left.
        second: the gait that follows.
        rules: with the lengths of whole phases; a rule that is off asks for nothing.

    Raises:
        InputError: there is no room for them (see `finishing_length`).
    """
    cells = fixed.copy()
    samples, needed = cells.shape[1], finishing_length(first, second, rules)
    if samples < needed:
        raise InputError(
            f"The transition has {samples} samples; the swings and stances that its cursors cut need "
            f"{needed} to be finished. Give it as many, or move a cursor.",
            "samples",
        )
    inner = samples - 2
    before, after = _cut_phases(first, second, rules)
    for limb, (begun, ending) in enumerate(zip(before[1], after[1], strict=True)):
        cells[limb, 1 : 1 + min(int(begun), inner)] = cells[limb, 0]
        cells[limb, samples - 1 - min(int(ending), inner) : samples - 1] = cells[limb, -1]
    return cells


def finishing_length(first: PatternSide, second: PatternSide, rules: PatternRules) -> int:
    """Samples that a transition needs, both ends included, to finish every phase that its cursors cut.

    A limb that differs between the cursors finishes one phase and has begun another; one that is alike may
    join both into one phase.

    Args:
        first: the gait that is left.
        second: the gait that follows.
        rules: with the lengths of whole phases.

    Raises:
        InputError: the gaits do not fit together.
    """
    require_alike(first.gait, second.gait)
    (done, begun), (ahead, ending) = _cut_phases(first, second, rules)
    joined = np.maximum(np.maximum(begun - ahead, ending - done), 0)
    inner = np.where(first.state == second.state, joined, begun + ending)
    inner[locked_limbs(first.gait, second.gait)] = 0
    return 2 + int(inner.max())


def _cut_phases(first: PatternSide, second: PatternSide, rules: PatternRules) -> tuple[Phases, Phases]:
    before = first.gait.timeline.stance[:, first.at :: -1]
    after = second.gait.timeline.stance[:, second.at :]
    return _lengths(before, rules), _lengths(after, rules)


def _lengths(stance: Bools, rules: PatternRules) -> Phases:
    """Of (legs, n) stance from a cursor outwards."""
    own, lacking = [], []
    for row in stance:
        same = int(np.argmin(np.append(row == row[0], False)))
        least = (rules.shortest_stance if row[0] else rules.shortest_swing) or 0
        is_whole = bool(row[0]) and same == len(row)
        own.append(same)
        lacking.append(0 if is_whole else max(least - same, 0))
    return np.array(own), np.array(lacking)
