"""A job as others see it: what was asked, how far it is, what came out."""

from dataclasses import dataclass
from enum import StrEnum

from core.problem.motion_problem import MotionProblem
from solver_jobs.nlp.timing import TimingResult
from solver_jobs.results.motion import Iterate, MotionResult, SolveStatus


class JobKind(StrEnum):
    """What kind of computation it is."""

    MOTION = "motion"
    """The motion of a gait."""
    TIMING = "timing"
    """The shortest phases for a gait's order and goal."""


class JobState(StrEnum):
    """Where a job stands."""

    QUEUED = "queued"
    RUNNING = "running"
    CANCELLING = "cancelling"
    DONE = "done"
    INFEASIBLE = "infeasible"
    FAILED = "failed"
    CANCELLED = "cancelled"
    INTERRUPTED = "interrupted"
    """The program ended before the job did."""


OPEN_STATES = frozenset({JobState.QUEUED, JobState.RUNNING, JobState.CANCELLING})
"""States that will still change."""

STATE_OF_STATUS = {
    SolveStatus.SOLVED: JobState.DONE,
    SolveStatus.INFEASIBLE: JobState.INFEASIBLE,
    SolveStatus.FAILED: JobState.FAILED,
    SolveStatus.CANCELLED: JobState.CANCELLED,
}
"""How a job ends whose solver ended so."""


@dataclass(frozen=True, eq=False)
class Job:
    """A snapshot of one job.

    Args:
        id: name that no other job has.
        kind: what is computed.
        label: what a person calls it.
        problem: what was asked.
        state: where it stands.
        progress: every iteration so far.
        result: what the solver reported, or None.
        sentence: the state in words.
    """

    id: str
    kind: JobKind
    label: str
    problem: MotionProblem
    state: JobState
    progress: tuple[Iterate, ...] = ()
    result: MotionResult | TimingResult | None = None
    sentence: str = ""

    @property
    def open(self) -> bool:
        """Whether its state will still change."""
        return self.state in OPEN_STATES


def result_sentence(result: MotionResult | TimingResult) -> str:
    """A result in one sentence."""
    if isinstance(result, TimingResult):
        return _timing_sentence(result)
    if result.status is SolveStatus.SOLVED:
        return f"Solved in {result.iteration_count} iterations, {result.solve_seconds * 1000:.0f} ms."
    return result.explanation[0]


def _timing_sentence(result: TimingResult) -> str:
    if result.status is SolveStatus.SOLVED:
        usable = (
            ""
            if result.usable_timeline is None
            else f" In whole samples {result.usable_timeline.times[-1]:.1f} s."
        )
        return (
            f"The fastest timing takes {result.total_seconds:.1f} s, as drawn {result.drawn_seconds:.1f} s "
            f"({result.iterations} iterations, {result.solve_seconds:.1f} s).{usable}"
        )
    return result.explanation[0]
