"""A solver's result after the independent checker: only what it confirms counts as solved."""

from dataclasses import dataclass

from app.common.json import Json, finite
from core.motion.trajectory import Trajectory
from core.problem.motion_check import MotionCheck, check_motion
from core.problem.motion_problem import MotionProblem
from solver_jobs import MotionResult, SolveStatus


@dataclass(frozen=True, eq=False)
class VerifiedResult:
    """A solver's result together with the findings of the independent checker.

    Args:
        status: the solver's, but failed where the checker does not confirm what is said to be solved.
        explanation: sentences where it is not solved.
        check: what the checker measured.
        result: the solver's own report.
        problem: what was asked.
    """

    status: SolveStatus
    explanation: tuple[str, ...]
    check: MotionCheck
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
    """Checks a solver's result with the independent checker; an unconfirmed solution counts as failed.

    Args:
        problem: what was asked.
        result: what the solver says of it.
    """
    check = check_motion(problem, result.trajectory)
    status, explanation = result.status, result.explanation
    if status is SolveStatus.SOLVED and not check.confirmed:
        status = SolveStatus.FAILED
        explanation = (
            f"The solver says it is solved, but the checker found {check.worst_family} violated by "
            f"{check.max_violation:.1e}; the result is not used.",
        )
    return VerifiedResult(status, explanation, check, result, problem)
