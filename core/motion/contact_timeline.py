"""Which foot stands and which swings at each sample."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from core.arrays import Bools, Floats, frozen_bools
from core.errors import InputError

DRAWN_SAMPLE_TIME = 0.4
"""Sample time of a timeline that is drawn from a foot order, unless another one is given, s."""
SAME_INTERVAL = 1e-6
"""Sample times that differ by less than this part are the same; files round theirs."""
MAX_SAMPLES = 2000
"""More samples than any gait here needs; a guard against a slip of the pen in a file."""


@dataclass(frozen=True)
class Swing:
    """One stretch in the air: samples `first` to `last`, both included, 0-based."""

    foot: int
    first: int
    last: int

    @property
    def samples(self) -> range:
        """Indices of the samples in the air."""
        return range(self.first, self.last + 1)


@dataclass(frozen=True, eq=False)
class ContactTimeline:
    """Legs × samples of stance and swing, with locked cells.

    Args:
        stance: (legs, samples) true where the foot stands.
        locked: (legs, samples) true where editing is locked.
        sample_time: time between samples, s.
    """

    stance: Bools
    locked: Bools
    sample_time: float

    def __post_init__(self) -> None:
        stance = frozen_bools(self.stance, (None, None), "timeline")
        locked = frozen_bools(self.locked, stance.shape, "locked cells")
        if not 2 <= stance.shape[1] <= MAX_SAMPLES:
            raise InputError(
                f"The timeline has {stance.shape[1]} samples; it needs 2 to {MAX_SAMPLES}.", "timeline"
            )
        if not (np.isfinite(self.sample_time) and 0.001 <= self.sample_time <= 60):
            raise InputError(
                f"The sample time is {self.sample_time} s; it must lie between 0.001 and 60 s.", "sample_time"
            )
        object.__setattr__(self, "stance", stance)
        object.__setattr__(self, "locked", locked)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, ContactTimeline):
            return NotImplemented
        return (
            self.sample_time == other.sample_time
            and np.array_equal(self.stance, other.stance)
            and np.array_equal(self.locked, other.locked)
        )

    @property
    def leg_count(self) -> int:
        """Number of feet."""
        return int(self.stance.shape[0])

    @property
    def sample_count(self) -> int:
        """Number of samples."""
        return int(self.stance.shape[1])

    @property
    def times(self) -> Floats:
        """(samples,) time of each sample from the start, s."""
        return np.asarray(np.arange(self.sample_count) * self.sample_time, dtype=np.float64)

    @property
    def contact(self) -> Bools:
        """(samples, legs) stance with time first, as trajectories hold it."""
        return np.asarray(self.stance.T)

    def swings(self) -> tuple[Swing, ...]:
        """Every swing, by foot and then by time."""
        found = []
        for foot, row in enumerate(self.stance):
            edges = np.diff(np.concatenate([[1], row.astype(np.int8), [1]]))
            for first, after in zip(np.nonzero(edges < 0)[0], np.nonzero(edges > 0)[0], strict=True):
                found.append(Swing(foot, int(first), int(after) - 1))
        return tuple(found)

    def turned(self, quarter_turns: int) -> ContactTimeline:
        """The same steps taken by the feet a number of quarter turns further on (four legs a turn of 90°)."""
        shift = quarter_turns * self.leg_count // 4
        return replace(
            self, stance=np.roll(self.stance, shift, axis=0), locked=np.roll(self.locked, shift, axis=0)
        )


def timeline_from_rows(rows: Sequence[str], sample_time: float) -> ContactTimeline:
    """Builds a timeline from strings of 1 (stance) and 0 (swing), foot 1 first; nothing locked.

    Raises:
        InputError: rows of different length, or another character.
    """
    stance = bits_from_rows(rows, "timeline")
    return ContactTimeline(stance, np.zeros_like(stance), sample_time)


def bits_from_rows(rows: Sequence[str], name: str) -> Bools:
    """(legs, samples) booleans from strings of 1 and 0.

    Raises:
        InputError: naming the row that does not fit.
    """
    for foot, row in enumerate(rows, 1):
        if len(row) != len(rows[0]) or set(row) - {"0", "1"}:
            raise InputError(
                f"{name}, foot {foot}: needs {len(rows[0])} characters, each 1 or 0, as foot 1 has.", name
            )
    samples = len(rows[0]) if rows else 0
    return np.array([[c == "1" for c in row] for row in rows], dtype=np.bool_).reshape(len(rows), samples)


def rows_from_bits(bits: ArrayLike) -> tuple[str, ...]:
    """Strings of 1 and 0, a row a foot."""
    return tuple("".join("1" if b else "0" for b in row) for row in np.asarray(bits))


def drawn_samples(legs: int, phase_knots: int, closing_knots: int, iterations: int) -> int:
    """Samples of a timeline that `timeline_from_order` draws."""
    return iterations * legs * 2 * phase_knots + closing_knots


def timeline_from_order(
    legs: int,
    order: Sequence[int],
    *,
    phase_knots: int = 5,
    closing_knots: int = 5,
    iterations: int = 1,
    sample_time: float = DRAWN_SAMPLE_TIME,
) -> ContactTimeline:
    """The published timing (docs/sources.md): for each foot, all feet down, then that foot in the air.

    The last sample is the goal, and stance for every foot, so that without a closing stance the last swing
    is one sample shorter.

    Args:
        legs: number of feet.
        order: feet in the order of their steps, counted from 1.
        phase_knots: samples of each stance phase and of each swing.
        closing_knots: samples with all feet down after the last swing.
        iterations: how often the whole order is run through.
        sample_time: time between samples, s.

    Raises:
        InputError: the order is not a permutation of the feet, or a number is out of range.
    """
    if sorted(order) != list(range(1, legs + 1)):
        raise InputError(
            f"The foot order {','.join(map(str, order))} must name each of the feet 1 to {legs} once.",
            "order",
        )
    if phase_knots < 2 or closing_knots < 0 or iterations < 1:
        raise InputError(
            "Phases need at least 2 samples, the final stance at least 0, and there is at least 1 iteration.",
            "phase_knots",
        )
    samples = drawn_samples(legs, phase_knots, closing_knots, iterations)
    if samples > MAX_SAMPLES:
        raise InputError(
            f"{iterations} iterations of {legs} feet with phases of {phase_knots} samples have {samples} "
            f"samples; at most {MAX_SAMPLES} are drawn. Take fewer iterations or shorter phases.",
            "phase_knots",
        )
    stance = np.ones((legs, samples), dtype=np.bool_)
    for step, foot in enumerate(list(order) * iterations):
        first = (2 * step + 1) * phase_knots
        stance[foot - 1, first : first + phase_knots] = False
    stance[:, -1] = True
    return ContactTimeline(stance, np.zeros_like(stance), sample_time)
