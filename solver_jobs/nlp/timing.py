"""Time-optimal timing: the shortest phases for a given order of feet and a given goal.

Every maximal run of knots with one contact pattern is a phase. Its knots stay, its duration is sought: with
stretches s_j as further unknowns, min Σ s_j·D_j over the whole problem, where D_j is the phase's duration as
drawn and every interval of the phase is s_j times as long. Without limits on motors, stances collapse to
nothing; hence the smallest phase.

Balance holds at knots, so few long intervals flatter: a foot may be lifted until the next knot while the body
already leaves its support. Read a total together with the number of knots, or ask the exact tier
about a `rounded_timeline`.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from core.arrays import Bools
from core.checks.made_plan import unmade_words
from core.errors import InputError
from core.motion.contact_timeline import ContactTimeline
from core.motion.trajectory import Trajectory, turn_trajectory
from core.problem.initial_guess import closed_contact
from core.problem.motion_check import check_motion
from core.problem.motion_problem import MotionProblem
from solver_jobs.results.motion import Iterate, MotionResult, SolveStatus

SMALLEST_PHASE = 0.2
"""Default of the shortest duration of a phase, s."""


@dataclass(frozen=True)
class PhaseTime:
    """Knots `first` to `last`, both included, 0-based, and the time until the knot after them, s."""

    first: int
    last: int
    seconds: float


@dataclass(frozen=True, eq=False)
class TimingResult:
    """The outcome of a search for the shortest timing.

    Args:
        status: how it ended. Solved only where the checker confirms the motion with its durations.
        phases: every phase with its duration, as drawn where it is not solved.
        total_seconds: of the motion found.
        drawn_seconds: of the motion as drawn.
        solve_seconds: time in the solver, that of the first motion included.
        iterations: of the solver, those of the first motion included.
        problem: the problem with `durations` set to those found.
        trajectory: the motion found; not a valid one unless it is solved.
        explanation: sentences where it is not solved.
        usable: the exact tier's motion for the phases in whole samples, where it has one.
        usable_timeline: these phases, as a gait has them.
    """

    status: SolveStatus
    phases: tuple[PhaseTime, ...]
    total_seconds: float
    drawn_seconds: float
    solve_seconds: float
    iterations: int
    problem: MotionProblem
    trajectory: Trajectory
    explanation: tuple[str, ...]
    usable: MotionResult | None = None
    usable_timeline: ContactTimeline | None = None


def phase_spans(problem: MotionProblem) -> tuple[tuple[int, int], ...]:
    """First and last knot of every phase that takes time, 0-based; the last knot alone takes none."""
    contact = closed_contact(problem)
    changes = np.nonzero((contact[1:] != contact[:-1]).any(axis=1))[0] + 1
    firsts = [0, *(int(knot) for knot in changes)]
    lasts = [*(first - 1 for first in firsts[1:]), problem.knot_count - 1]
    spans = zip(firsts, lasts, strict=True)
    return tuple((first, last) for first, last in spans if first < problem.knot_count - 1)


def fastest_timing(
    problem: MotionProblem,
    smallest_phase: float = SMALLEST_PHASE,
    progress: Callable[[Iterate], bool] = lambda iterate: True,
) -> TimingResult:
    """Chooses the durations of the phases so that the motion is as short as its limits allow.

    Args:
        problem: order of feet, goal and limits; its own durations are the start.
        smallest_phase: shortest duration of a phase, s.
        progress: told of each iteration, whose objective is the motion's duration in s; false cancels.

    Raises:
        InputError: the smallest phase is not above 0 s.
    """
    if not (np.isfinite(smallest_phase) and smallest_phase > 0):
        raise InputError(
            f"The smallest phase is {smallest_phase:g} s; it must be above 0 s.", "smallest_phase"
        )
    from solver_jobs.nlp.timing_nlp import StretchSearch

    turns = problem.quarter_turns
    at_first = problem.turned(-turns)
    found = StretchSearch(at_first, phase_spans(at_first), smallest_phase, progress).run()
    timed = replace(problem, durations=found.durations)
    trajectory = turn_trajectory(found.trajectory, turns)
    status, explanation = found.status, found.explanation
    if status is SolveStatus.SOLVED and not (check := check_motion(timed, trajectory)).confirmed:
        words = f"The motion found misses {check.worst_family} by {check.max_violation:.1e} (SI)."
        status, explanation = SolveStatus.FAILED, (words,)
    if status is SolveStatus.SOLVED and (unmade := unmade_words(timed.model, trajectory)):
        status, explanation = SolveStatus.FAILED, (unmade,)
    return TimingResult(
        status=status,
        phases=_phases(timed),
        total_seconds=float(timed.intervals.sum()),
        drawn_seconds=float(problem.intervals.sum()),
        solve_seconds=found.seconds,
        iterations=found.iterations,
        problem=timed,
        trajectory=trajectory,
        explanation=explanation,
    )


def _phases(problem: MotionProblem) -> tuple[PhaseTime, ...]:
    intervals = problem.intervals
    spans = phase_spans(problem)
    return tuple(PhaseTime(a, b, float(intervals[a : b + 1].sum())) for a, b in spans)


def rounded_timeline(timing: TimingResult, sample_time: float) -> ContactTimeline:
    """The phases as an ordinary timeline: each takes whole samples, and at least as long as found.

    The total grows by less than one sample a phase; the timeline's duration is
    (sample_count − 1)·sample_time.

    Args:
        timing: phases with their durations.
        sample_time: of the timeline, s.
    """
    stance = timing.problem.timeline.stance
    columns: list[Bools] = []
    for phase in timing.phases:
        count = int(np.ceil(phase.seconds / sample_time - 1e-6))
        columns += [stance[:, phase.first]] * max(count, 1)
    columns.append(~timing.problem.held_end)
    rounded = np.array(columns, dtype=np.bool_).T
    return ContactTimeline(rounded, np.zeros_like(rounded), sample_time)
