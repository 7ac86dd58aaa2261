"""The search for a footfall pattern as a value: what is fixed, which rules hold, what counts as better.

Source: the footfall-pattern thesis ("F"), 3.1 and 3.2, with the corrections of docs/sources.md.
"""

from __future__ import annotations

from dataclasses import dataclass, field, fields
from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

from core.arrays import Bools, Floats, frozen_bools, frozen_floats
from core.errors import InputError

Cells = NDArray[np.int8]
"""(legs, samples) 1 stance, 0 swing, −1 free."""

FREE = -1
MOST_LEGS, LEAST_SAMPLES, MOST_SAMPLES = 16, 2, 240


class PatternKind(StrEnum):
    """What the pattern is for."""

    TRANSITION = "transition"
    """From one gait's state, the first sample, to another one's, the last."""
    PERIODIC = "periodic"
    """A gait: the first sample follows the last one."""


class Rule(StrEnum):
    """What may forbid a pattern, by the name of its field in `PatternRules` where it is switchable."""

    FIXED = "fixed"
    """g1 and locked cells: these keep their value."""
    SHORTEST_SWING = "shortest_swing"
    """g2: how many samples a swing lasts at least."""
    FEET_DOWN = "feet_down"
    """g3: how many feet stand at least."""
    FEET_DOWN_EACH_SIDE = "feet_down_each_side"
    """g4, g5: how many feet stand on each side at least."""
    WORKLOAD = "workload"
    """g6, g7: how many samples the stance of two walking limbs may differ by."""
    LIMB_CHANGES = "limb_changes"
    """g8: how often a limb may change between stance and swing."""
    SHORTEST_STANCE = "shortest_stance"
    """g9, g10: how many samples a stance lasts at least."""
    LEAST_SWING = "least_swing"
    """g11: how many samples a walking limb swings at least."""
    BALANCE = "balance"
    """Beyond F: how far inside the support polygon the body can be kept, m."""


@dataclass(frozen=True)
class PatternRules:
    """The rules' numbers, F's by default; None switches a rule off.

    A transition's phases that its first or last sample cuts are exempt from shortest_swing and
    shortest_stance; limbs that do not walk are exempt from workload and least_swing, and count for feet_down
    all the same. In a periodic pattern every rule holds round the end.
    """

    shortest_swing: int | None = 2
    feet_down: int | None = 3
    feet_down_each_side: int | None = 1
    workload: int | None = 2
    limb_changes: int | None = 2
    shortest_stance: int | None = 3
    least_swing: int | None = 2
    balance: float | None = None

    def __post_init__(self) -> None:
        for rule in fields(self):
            value = getattr(self, rule.name)
            if value is None or rule.name == "balance":
                continue
            if isinstance(value, bool) or int(value) != value or not 0 <= value <= MOST_SAMPLES:
                raise InputError(
                    f"{rule.name} is {value}; it must be a whole number from 0 to {MOST_SAMPLES}, or off.",
                    rule.name,
                )
        if self.balance is not None and not (np.isfinite(self.balance) and -0.05 <= self.balance <= 0.05):
            raise InputError(
                f"The balance margin is {self.balance * 1000:g} mm; it must lie between −50 and 50 mm.",
                "balance",
            )


@dataclass(frozen=True)
class PatternWeights:
    """What a change costs; a pattern of the smallest sum is sought.

    Args:
        sample_changes: each time between two samples at which any limb switches, F's objective.
        limb_changes: each switch of a single limb; by default it only breaks ties.
        drawing: each free cell that differs from the drawing, where one is given.
    """

    sample_changes: int = 1000
    limb_changes: int = 1
    drawing: int = 10

    def __post_init__(self) -> None:
        for weight in fields(self):
            value = getattr(self, weight.name)
            if isinstance(value, bool) or int(value) != value or not 0 <= value <= 100_000:
                raise InputError(
                    f"The weight {weight.name} is {value}; it must be a whole number from 0 to 100000.",
                    weight.name,
                )


@dataclass(frozen=True, eq=False)
class BalanceModel:
    """Where feet stand and how the body can move, for the rule `balance`; seen from the mean of the feet.

    Args:
        feet_xy: (legs, 2) places of the standing feet, m.
        reach: how far the body's centre of mass can be moved from its middle place, m.
        speed: how fast it can be moved, m/s.
    """

    feet_xy: Floats
    reach: float
    speed: float

    def __post_init__(self) -> None:
        object.__setattr__(self, "feet_xy", frozen_floats(self.feet_xy, (None, 2), "feet"))


@dataclass(frozen=True, eq=False)
class PatternProblem:
    """What is sought.

    Args:
        kind: transition or periodic.
        fixed: (legs, samples) of `Cells`: a transition's first and last sample are fixed, and all of a limb
            that does not walk.
        walking: (legs,) limbs that walk; the others keep one value at every sample.
        sides: (2, legs) which feet count for the left and for the right side.
        rules: what holds.
        weights: what counts as better.
        drawing: (legs, samples) stance of a drawing to keep where that can be; None for none.
        balance_model: for the rule `balance`; needed where that is on.
        sample_time: between samples, s.
        noun: what sentences call a limb: "limb", or "foot" in a document.
        once_an_order: whether patterns whose limbs change in the same order, only at other samples, count as
            one; the best of them is given.
        finishing: (2, legs) how many cells after the first sample keep its value, and how many before the
            last one keep that, so that phases which a transition's ends cut are finished; `fixed` has them,
            and in another length they are laid anew. None for none.
    """

    kind: PatternKind
    fixed: Cells
    walking: Bools
    sides: Bools
    rules: PatternRules = field(default_factory=PatternRules)
    weights: PatternWeights = field(default_factory=PatternWeights)
    drawing: Bools | None = None
    balance_model: BalanceModel | None = None
    sample_time: float = 0.4
    noun: str = "limb"
    once_an_order: bool = False
    finishing: NDArray[np.intp] | None = None

    def __post_init__(self) -> None:
        fixed = np.array(self.fixed, dtype=np.int8)
        _require_size(fixed.shape)
        fixed.setflags(write=False)
        legs = fixed.shape[0]
        object.__setattr__(self, "fixed", fixed)
        object.__setattr__(self, "walking", frozen_bools(self.walking, (legs,), "walking limbs"))
        object.__setattr__(self, "sides", frozen_bools(self.sides, (2, legs), "sides"))
        if self.drawing is not None:
            object.__setattr__(self, "drawing", frozen_bools(self.drawing, fixed.shape, "drawing"))
        self._require_whole()

    def _require_whole(self) -> None:
        if self.kind is PatternKind.TRANSITION and (self.fixed[:, [0, -1]] == FREE).any():
            raise InputError("A transition's first and last sample must be given for every limb.", "from")
        for limb in np.nonzero(~self.walking)[0]:
            if (self.fixed[limb] != self.fixed[limb, 0]).any() or self.fixed[limb, 0] == FREE:
                raise InputError(
                    f"Limb {limb + 1} is locked, so it must have one value at every sample.", "locked"
                )
        if self.rules.balance is not None and self.balance_model is None:
            raise InputError(
                "The balance rule needs to know the robot; choose one, or switch it off.", "balance"
            )

    @property
    def leg_count(self) -> int:
        """Number of limbs."""
        return int(self.fixed.shape[0])

    @property
    def sample_count(self) -> int:
        """Number of samples, a transition's two boundary samples included."""
        return int(self.fixed.shape[1])


class PatternStatus(StrEnum):
    """How a search ended."""

    OPTIMAL = "optimal"
    """Nothing better exists: proven."""
    FEASIBLE = "feasible"
    """A pattern that keeps every rule; better ones may exist."""
    INFEASIBLE = "infeasible"
    """No pattern keeps every rule: proven."""
    CANCELLED = "cancelled"
    """Broken off before any pattern was found."""


@dataclass(frozen=True, eq=False)
class Pattern:
    """An answer.

    Args:
        stance: (legs, samples).
        sample_changes: F's objective: times between two samples at which any limb switches.
        limb_changes: switches of single limbs.
        redrawn: free cells that differ from the drawing.
        body_xy: (samples, 2) places of the body that keep the balance, m; None where that was not asked.
    """

    stance: Bools
    sample_changes: int
    limb_changes: int
    redrawn: int = 0
    body_xy: Floats | None = None


@dataclass(frozen=True)
class Relaxation:
    """A change of the problem that makes it solvable, found by solving it.

    Args:
        rule: which is relaxed; FIXED where cells are freed or samples are added.
        value: the rule's new number; None switches it off.
        cells: (limb, sample) that are freed, where the rule is FIXED; a locked limb walks then.
        words: for the button, such as "2 feet down instead of 3".
        samples: the pattern's new length, where samples are added.
        also: changes that go with it, where no single one suffices.
    """

    rule: Rule
    value: float | None
    cells: tuple[tuple[int, int], ...]
    words: str
    samples: int | None = None
    also: tuple[Relaxation, ...] = ()


@dataclass(frozen=True)
class PatternProgress:
    """What is known in the middle of a search.

    Args:
        seconds: since the start.
        objective: the weighted sum of the best pattern yet; None before the first.
        bound: no pattern is better than this.
        pattern: the best yet.
    """

    seconds: float
    objective: float | None
    bound: float
    pattern: Pattern | None


@dataclass(frozen=True)
class PatternResult:
    """How a search came out.

    Args:
        status: what is proven.
        patterns: the best first; distinct.
        bound: no pattern's weighted sum is below this; None where infeasible.
        solve_seconds: in the solver.
        explanation: sentences where there is no pattern: a smallest set of rules that conflict.
        relaxations: what would make it solvable.
    """

    status: PatternStatus
    patterns: tuple[Pattern, ...]
    bound: float | None
    solve_seconds: float
    explanation: tuple[str, ...] = ()
    relaxations: tuple[Relaxation, ...] = ()


def with_finished_phases(cells: Cells, finishing: NDArray[np.intp]) -> Cells:
    """(legs, samples) cells of a transition with those fixed that finish the phases which its ends cut.

    Args:
        cells: with the first and the last sample fixed.
        finishing: (2, legs) of `PatternProblem`.
    """
    laid, samples = cells.copy(), cells.shape[1]
    inner = samples - 2
    for limb, (begun, ending) in enumerate(finishing.T):
        laid[limb, 1 : 1 + min(int(begun), inner)] = cells[limb, 0]
        laid[limb, samples - 1 - min(int(ending), inner) : samples - 1] = cells[limb, -1]
    return laid


def index_halves(legs: int) -> Bools:
    """(2, legs) F's sides: the first half of the limbs and the others; a middle limb counts for both."""
    limbs = np.arange(legs)
    return np.array([limbs < (legs + 1) // 2, limbs >= legs // 2])


def _require_size(shape: tuple[int, ...]) -> None:
    if len(shape) != 2 or not (2 <= shape[0] <= MOST_LEGS and LEAST_SAMPLES <= shape[1] <= MOST_SAMPLES):
        raise InputError(
            f"A pattern has 2 to {MOST_LEGS} limbs and {LEAST_SAMPLES} to {MOST_SAMPLES} samples.",
            "samples",
        )


def free_cells(legs: int, samples: int) -> Cells:
    """(legs, samples) cells none of which is fixed.

    Raises:
        InputError: too few or too many limbs or samples; nothing is reserved for them.
    """
    _require_size((legs, samples))
    return np.full((legs, samples), FREE, dtype=np.int8)


def transition_cells(start: Bools, end: Bools, samples: int, locked: Bools) -> Cells:
    """(legs, samples) cells of a transition from one state to another.

    Args:
        start: (legs,) stance at the first sample.
        end: (legs,) stance at the last sample.
        samples: how many, both included.
        locked: (legs,) limbs that keep their value throughout.

    Raises:
        InputError: a locked limb's two values differ, or a number of samples that no pattern has.
    """
    cells = free_cells(len(start), samples)
    cells[:, 0], cells[:, -1] = start, end
    for limb in np.nonzero(locked)[0]:
        if start[limb] != end[limb]:
            raise InputError(
                f"Limb {limb + 1} is locked, but stands at one end and swings at the other. Unlock it, or "
                "choose the same state at both ends.",
                "locked",
            )
        cells[limb] = int(start[limb])
    return cells
