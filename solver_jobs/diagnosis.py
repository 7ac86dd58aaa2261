"""What an unsolved problem's last iterate says: which demand is missed most, where and by how much."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from core.arrays import Floats
from solver_jobs.constraint import Family, Situation
from solver_jobs.structure import Structure
from solver_jobs.words import FAMILY_WORDS, REMEDIES

NOTABLE = 1e-3
"""Violations (mm, N, mm/s) that are worth a sentence."""

DIAGNOSED = "This is diagnosed from a local search, not proven."


@dataclass(frozen=True)
class Shortfall:
    """A demand that is missed.

    Args:
        family: which.
        amount: largest violation, in `unit`.
        unit: mm, mm/s or N.
        knots: 0-based knots where at least half the largest violation remains.
    """

    family: Family
    amount: float
    unit: str
    knots: tuple[int, ...]

    @property
    def phrase(self) -> str:
        """Such as “0.9 mm in balance at knots 15–19, 35–39”."""
        return f"{self.amount:.3g} {self.unit} in {FAMILY_WORDS[self.family]} at {knot_ranges(self.knots)}"


def shortfalls(structure: Structure, situation: Situation, rows: Floats) -> tuple[Shortfall, ...]:
    """Everything that is missed notably, the worst first.

    Args:
        structure: the problem's shape.
        situation: the problem.
        rows: value of every row.
    """
    lower, upper = structure.row_bounds(situation)
    found = []
    for block in structure.blocks:
        excess = block.constraint.excess(block.of(rows), block.of(lower), block.of(upper)).max(axis=1)
        amount = float(excess.max())
        if amount > NOTABLE:
            knots = tuple(int(k) for k in np.nonzero(excess >= amount / 2)[0])
            found.append(Shortfall(block.constraint.family, amount, block.constraint.unit, knots))
    return tuple(sorted(found, key=lambda shortfall: -shortfall.amount))


def explanation(found: tuple[Shortfall, ...]) -> tuple[str, ...]:
    """Sentences for a search that ended without a motion."""
    if not found:
        nearly = "IPOPT did not reach its tolerance, though its last iterate keeps every constraint nearly."
        return (nearly, DIAGNOSED)
    worst = found[0]
    sentences = [
        "IPOPT found no motion that keeps every constraint: the largest remaining violation is "
        f"{worst.phrase}. {REMEDIES[worst.family]}"
    ]
    if len(found) > 1:
        sentences.append(f"Also missed: {'; '.join(other.phrase for other in found[1:4])}.")
    return (*sentences, DIAGNOSED)


def nearest_motion(missed: tuple[Shortfall, ...]) -> tuple[str, ...]:
    """Sentences for what the nearest motion still misses, the worst first."""
    worst = missed[0]
    sentences = [
        "IPOPT found no motion that keeps every constraint. The nearest one found lacks "
        f"{worst.phrase}. {REMEDIES[worst.family]}"
    ]
    if len(missed) > 1:
        sentences.append(f"It also lacks {'; '.join(other.phrase for other in missed[1:4])}.")
    return (*sentences, DIAGNOSED)


def broken_pose(missed: Shortfall) -> str:
    """A sentence for a demand that the given start or goal itself breaks."""
    return (
        f"The given start or goal misses a limit by {missed.phrase}, whatever happens between. "
        f"{REMEDIES[missed.family]}"
    )


def knot_ranges(knots: tuple[int, ...]) -> str:
    """Knots counted from 1, such as “knots 16–20, 36”."""
    runs: list[list[int]] = []
    for knot in knots:
        if runs and knot == runs[-1][1] + 1:
            runs[-1][1] = knot
        else:
            runs.append([knot, knot])
    text = ", ".join(f"{a + 1}" if a == b else f"{a + 1}–{b + 1}" for a, b in runs)
    return f"knot {text}" if len(knots) == 1 else f"knots {text}"
