"""What a motion solver reports, as frozen values that carry nothing of the solver itself."""

from dataclasses import dataclass
from enum import StrEnum

from core.motion.trajectory import Trajectory


class SolveStatus(StrEnum):
    """How a solve ended."""

    SOLVED = "solved"
    INFEASIBLE = "infeasible"
    FAILED = "failed"
    CANCELLED = "cancelled"


class Evidence(StrEnum):
    """How sure an explanation is."""

    PROVEN = "proven"
    """No motion exists in the stated model."""
    DIAGNOSED = "diagnosed"
    """One local search ended without a motion; another may exist."""


@dataclass(frozen=True)
class Iterate:
    """One iteration of the solver.

    Args:
        number: 0 is the start.
        objective: the cost in SI as in the thesis.
        primal_infeasibility: largest violation in the solver's scale (mm, N).
        dual_infeasibility: how far the gradient is from balance, in the solver's scale.
        step: fraction of the proposed step that was taken.
    """

    number: int
    objective: float
    primal_infeasibility: float
    dual_infeasibility: float
    step: float


@dataclass(frozen=True)
class Lack:
    """A demand that the nearest motion found still misses.

    Args:
        family: which, by the checker's name, or `margin`.
        amount: by how much, in `unit`.
        unit: mm, mm/s or N; of the foot's load where it is friction.
        first: first knot of the phase concerned, 0-based.
        last: last knot of that phase, included.
        feet: the foot concerned, or both feet of the support polygon's edge or of two shoes, 0-based; empty
            for the body.
        sentence: all of this in words.
    """

    family: str
    amount: float
    unit: str
    first: int
    last: int
    feet: tuple[int, ...]
    sentence: str


@dataclass(frozen=True, eq=False)
class MotionResult:
    """The outcome of one solve.

    Args:
        status: how it ended.
        solver_word: the solver's own return status, or "" where it was not asked.
        explanation: sentences where it is not solved.
        evidence: how sure the explanation is; None where there is none.
        iterations: the whole course, the start included.
        objective: the cost at the end, SI; None where the solver was not asked.
        solve_seconds: time in the solver.
        build_seconds: time to build the structure; 0 where it was at hand.
        trajectory: the last iterate, with velocities and forces. It is a motion that keeps the
            constraints only where the status is solved.
        initial: what the solver started from.
        lacks: what the nearest motion misses, the worst first, where it is infeasible.
        iterate_motions: the motion at each of the iterations, the start included; empty if not kept.
        optimal: whether a solved motion is a local optimum of the cost; a motion of the live tier is none,
            since footholds and heights are given there.
    """

    status: SolveStatus
    solver_word: str
    explanation: tuple[str, ...]
    evidence: Evidence | None
    iterations: tuple[Iterate, ...]
    objective: float | None
    solve_seconds: float
    build_seconds: float
    trajectory: Trajectory
    initial: Trajectory
    lacks: tuple[Lack, ...] = ()
    iterate_motions: tuple[Trajectory, ...] = ()
    optimal: bool = False

    @property
    def iteration_count(self) -> int:
        """Number of iterations after the start."""
        return self.iterations[-1].number if self.iterations else 0
