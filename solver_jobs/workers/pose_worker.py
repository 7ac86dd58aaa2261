"""The process that looks for pose gaits; CasADi is loaded there."""

from dataclasses import dataclass
from multiprocessing.connection import Connection

from core.pose_gaits.pose_gait import PoseGait
from core.pose_gaits.pose_problem import PoseProblem
from solver_jobs.results.pose import PoseResult
from solver_jobs.workers.task_worker import Report, run_tasks


@dataclass(frozen=True, eq=False)
class PoseQuestion:
    """To the process: look for this.

    Args:
        problem: what is asked.
        near: poses to begin with, or None.
        explain: whether to look for the reason where there is no gait.
    """

    problem: PoseProblem
    near: PoseGait | None = None
    explain: bool = True


def run_pose_worker(pipe: Connection, nothing: None) -> None:
    """Body of the process.

    Args:
        pipe: the worker's end.
        nothing: what other workers are given to begin with.
    """
    del nothing
    from solver_jobs.pose_gaits.solve import solve_poses

    def solved(asked: PoseQuestion, report: Report) -> PoseResult:
        return solve_poses(asked.problem, report, asked.near, asked.explain)

    run_tasks(pipe, solved)
