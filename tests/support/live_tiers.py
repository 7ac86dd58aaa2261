"""Stand-ins of the live tier: one that has no answer, and one that finds everything infeasible."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from core.gait.gait import Gait, motion_problem
from core.problem.initial_guess import initial_guess
from core.problem.motion_problem import MotionProblem
from core.robot.model import load_robot
from solver_jobs import (
    Evidence,
    Lack,
    MotionResult,
    Remedy,
    RemedyKind,
    RemedySearch,
    SolveStatus,
    Trouble,
    solve_live,
)

LACK = Lack("workspace", 1.2, "mm", 5, 9, (2,), "Reach lacks 1.2 mm: foot 3 is outside its workspace.")


def result_of(problem: MotionProblem, status: SolveStatus) -> MotionResult:
    """A result with the drawn motion."""
    drawn = initial_guess(problem)
    infeasible = status is SolveStatus.INFEASIBLE
    return MotionResult(
        status=status,
        solver_word="",
        explanation=() if status is SolveStatus.SOLVED else ("There is none.",),
        evidence=Evidence.PROVEN if infeasible else None,
        iterations=(),
        objective=None,
        solve_seconds=0.01,
        build_seconds=0.0,
        trajectory=drawn,
        initial=drawn,
        lacks=(LACK,) if infeasible else (),
    )


class FixedTier:
    """Answers every problem with the drawn motion and one status.

    Args:
        status: what it says.
    """

    def __init__(self, status: SolveStatus) -> None:
        self.status = status
        self.asked = 0
        self.waits: list[float] = []
        self.process_id: int | None = 1
        self.complete = True
        self.offered = False

    def solve(self, problem: MotionProblem, timeout: float) -> MotionResult:
        """The drawn motion; of what was offered, a checked one."""
        assert timeout > 0
        self.asked += 1
        self.waits.append(timeout)
        return solve_live(problem) if self.offered else result_of(problem, self.status)

    def remedies(
        self, gait: Gait, tell: Callable[[Remedy], object], *, tips: bool, go_on: Callable[[], bool]
    ) -> RemedySearch:
        """Half the step."""
        assert go_on()
        self.offered = True
        dx, dy, yaw = gait.step
        half = replace(gait, step=(dx / 2, dy / 2, yaw))
        motion = solve_live(motion_problem(half, load_robot(gait.robot)))
        remedy = Remedy(RemedyKind.STEP, "Half the step", "A step half as long.", half, motion)
        tell(remedy)
        return RemedySearch((remedy,), self.complete, Trouble.TIPS if tips else Trouble.STEP)
