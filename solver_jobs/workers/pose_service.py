"""Looks for pose gaits, in a process of their own."""

from collections.abc import Callable

from core.pose_gaits.pose_gait import PoseGait
from core.pose_gaits.pose_problem import PoseProblem
from solver_jobs.results.motion import SolveStatus
from solver_jobs.results.pose import PoseProgress, PoseResult
from solver_jobs.workers.pose_worker import PoseQuestion, run_pose_worker
from solver_jobs.workers.spawning import NICENESS
from solver_jobs.workers.task_service import Task, TaskService


class PoseSearch(Task[PoseQuestion, PoseProgress, PoseResult]):
    """A search that was submitted; a cancelled one has no gait."""

    def unanswered(self, seconds: float) -> PoseResult:
        """The result of a search that was cancelled."""
        return _without_gait(SolveStatus.CANCELLED, "The search was cancelled.", seconds)

    def hung(self, sentence: str, seconds: float) -> PoseResult:
        """A failed result, so that a search over several problems goes on with the others."""
        return _without_gait(SolveStatus.FAILED, sentence, seconds)


def _without_gait(status: SolveStatus, sentence: str, seconds: float) -> PoseResult:
    return PoseResult(status, None, None, False, (sentence,), 0.0, seconds)


class PoseGaitSolver(TaskService[PoseSearch]):
    """Searches in a process of their own, one after the other; it is started anew where it ends.

    Args:
        niceness: of the process; 0 where somebody waits for nothing else.
    """

    def __init__(self, niceness: int = NICENESS) -> None:
        super().__init__("pose gait solver", run_pose_worker, None, niceness)

    def submit(
        self,
        problem: PoseProblem,
        progress: Callable[[PoseProgress], object] = lambda known: None,
        near: PoseGait | None = None,
        explain: bool = True,
    ) -> PoseSearch:
        """Begins a search, after those that were submitted before.

        Args:
            problem: what is asked.
            progress: called with what is known, from a thread of the service's.
            near: poses to begin with; None for several starts.
            explain: whether to look for the reason where there is no gait.
        """
        return self.ask(PoseSearch(PoseQuestion(problem, near, explain), progress))
