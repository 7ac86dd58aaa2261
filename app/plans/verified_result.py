"""A solver's result after the independent checker: only what it confirms, and the robot makes, is solved."""

from dataclasses import dataclass

from app.common.json import Json, finite
from core.checks.made_plan import unmade_words
from core.motion.trajectory import Trajectory
from core.problem.motion_check import MotionCheck, check_motion
from core.problem.motion_problem import MotionProblem
from solver_jobs import MotionResult, SolveStatus


@dataclass(frozen=True, eq=False)
class VerifiedResult:
    """A solver's result together with the findings of the independent checker.

    Args:
        status: the solver's, but failed where the checker does not confirm what is said to be solved, or
            where the robot's motors make another motion of it.
        explanation: sentences where it is not solved.
        check: what the checker measured.
        has_motion: whether there is a motion that keeps every limit, be it the one that is made or not.
        result: the solver's own report.
        problem: what was asked.
    """

    status: SolveStatus
    explanation: tuple[str, ...]
    check: MotionCheck
    has_motion: bool
    result: MotionResult
    problem: MotionProblem

    @property
    def trajectory(self) -> Trajectory:
        """The motion, or the last iterate where there is none."""
        return self.result.trajectory

    @property
    def content(self) -> Json:
        """The figures as JSON content."""
        figures = {
            "status": self.status.value,
            "optimal": self.status is SolveStatus.SOLVED and self.result.optimal,
            "iterations": self.result.iteration_count,
            "objective": self.result.objective,
            "solve_seconds": self.result.solve_seconds,
            "build_seconds": self.result.build_seconds,
            "max_violation": self.check.max_violation,
            "violations": self.check.violations,
            "min_margin": self.check.min_margin,
            "min_cop_margin": self.check.min_cop_margin,
            "explanation": list(self.explanation),
        }
        content: Json = finite(figures)
        return content


def verify(problem: MotionProblem, result: MotionResult) -> VerifiedResult:
    """Checks a solver's result with the independent checker.

    An unconfirmed solution counts as failed, and so does one that the robot's motors cannot make.

    Args:
        problem: what was asked.
        result: what the solver says of it.
    """
    check = check_motion(problem, result.trajectory)
    if result.status is not SolveStatus.SOLVED:
        return VerifiedResult(result.status, result.explanation, check, False, result, problem)
    if not check.confirmed:
        unconfirmed = (
            f"The solver says it is solved, but the checker found {check.worst_family} violated by "
            f"{check.max_violation:.1e}; the result is not used."
        )
        return VerifiedResult(SolveStatus.FAILED, (unconfirmed,), check, False, result, problem)
    unmade = unmade_words(problem.model, result.trajectory)
    status = SolveStatus.FAILED if unmade else SolveStatus.SOLVED
    return VerifiedResult(status, (unmade,) if unmade else result.explanation, check, True, result, problem)
