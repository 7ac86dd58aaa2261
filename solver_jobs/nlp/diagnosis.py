"""Diagnoses an unsolved problem by its last iterate: which constraints it violates, where, how much."""

from dataclasses import dataclass

import numpy as np

from core.arrays import Floats, first_place
from core.robot.shoes import neighbour_pairs
from solver_jobs.nlp.compiled_problem import CompiledProblem
from solver_jobs.nlp.constraint import Family, RowConstraint, Situation
from solver_jobs.nlp.messages import FAMILY_WORDS, REMEDIES
from solver_jobs.results.motion import Lack

NOTABLE = 1e-3
"""Violations (mm, N, mm/s) that are worth a sentence."""

DIAGNOSED = "This is diagnosed from a local search, not proven."


@dataclass(frozen=True)
class Shortfall:
    """A demand that is missed.

    Args:
        family: which.
        amount: largest violation, in `unit`.
        unit: mm, mm/s, mm/s² or N, or for friction the share of a foot's load.
        knots: 0-based knots where at least half the largest violation remains.
        worst: the knot of the largest violation.
        feet: the foot there, or both feet of the support polygon's edge or of two shoes, 0-based; empty for
            the body.
    """

    family: Family
    amount: float
    unit: str
    knots: tuple[int, ...]
    worst: int
    feet: tuple[int, ...]

    @property
    def phrase(self) -> str:
        """Such as “0.9 mm in reach of foot 3 at knots 15–19, 35–39”."""
        feet = _of_shoes(self.feet) if self.family is Family.SHOE_DISTANCE else _of_feet(self.feet)
        words = f"{FAMILY_WORDS[self.family]}{feet}"
        return f"{self.amount:.3g} {self.unit} in {words} at {knot_ranges(self.knots)}"

    @property
    def run(self) -> tuple[int, int]:
        """First and last of the unbroken knots about the worst one."""
        first = last = self.worst
        while first - 1 in self.knots:
            first -= 1
        while last + 1 in self.knots:
            last += 1
        return first, last


def _of_shoes(feet: tuple[int, ...]) -> str:
    return f" of feet {' and '.join(str(foot + 1) for foot in sorted(feet))}"


def _of_feet(feet: tuple[int, ...]) -> str:
    if len(feet) == 2:
        return f" on the edge from foot {feet[0] + 1} to foot {feet[1] + 1}"
    return f" of foot {feet[0] + 1}" if feet else ""


def shortfalls(
    compiled: CompiledProblem, situation: Situation, rows: Floats, shift: int = 0
) -> tuple[Shortfall, ...]:
    """Everything that is missed notably, the worst first.

    Args:
        compiled: the problem's shape.
        situation: the problem.
        rows: value of every row.
        shift: by how many feet the problem was handed back to stand in direction 1.
    """
    lower, upper = compiled.row_bounds(situation)
    found = []
    for block in compiled.blocks:
        excess = block.constraint.excess(block.of(rows), block.of(lower), block.of(upper))
        amount = float(excess.max())
        if amount > NOTABLE:
            knots = tuple(int(k) for k in np.nonzero(excess.max(axis=1) >= amount / 2 - NOTABLE)[0])
            worst, row = first_place(excess, NOTABLE)
            feet = _feet_of_row(block.constraint, situation, worst, row)
            feet = tuple((foot + shift) % situation.contact.shape[1] for foot in feet)
            constraint = block.constraint
            found.append(Shortfall(constraint.family, amount, constraint.unit, knots, worst, feet))
    return tuple(sorted(found, key=_rank))


def _rank(shortfall: Shortfall) -> tuple[float, int]:
    """The largest first, as sentences show it; of equal ones the earlier."""
    return -float(f"{shortfall.amount:.3g}"), shortfall.worst


def _feet_of_row(constraint: RowConstraint, situation: Situation, knot: int, row: int) -> tuple[int, ...]:
    if constraint.family is Family.SHOE_DISTANCE:
        first, second = neighbour_pairs(situation.problem.model.leg_count)[row]
        return (int(first), int(second))
    if constraint.rows_per_foot == 0:
        return ()
    foot = row // constraint.rows_per_foot
    if constraint.family is Family.MARGIN:
        return (foot, int(situation.successor[knot, foot]))
    return (foot,)


def lacks(found: tuple[Shortfall, ...]) -> tuple[Lack, ...]:
    """The same for a page, which shows phases and feet."""
    return tuple(
        Lack(
            family=one.family.value,
            amount=one.amount,
            unit=one.unit,
            first=one.run[0],
            last=one.run[1],
            feet=one.feet,
            sentence=f"The nearest motion lacks {one.phrase}. {REMEDIES[one.family]}",
        )
        for one in found
    )


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
    """Samples counted from 1, such as “samples 16–20, 36”."""
    runs: list[list[int]] = []
    for knot in knots:
        if runs and knot == runs[-1][1] + 1:
            runs[-1][1] = knot
        else:
            runs.append([knot, knot])
    text = ", ".join(f"{a + 1}" if a == b else f"{a + 1}–{b + 1}" for a, b in runs)
    return f"sample {text}" if len(knots) == 1 else f"samples {text}"
