"""The process that looks for pose gaits; CasADi is loaded there."""

from multiprocessing.connection import Connection

from core.pose_gaits.pose_problem import PoseProblem
from solver_jobs.results.pose import PoseResult
from solver_jobs.workers.task_worker import Report, run_tasks


def run_pose_worker(pipe: Connection, nothing: None) -> None:
    """Body of the process.

    Args:
        pipe: the worker's end.
        nothing: what other workers are given to begin with.
    """
    del nothing
    from solver_jobs.pose_gaits.solve import solve_poses

    def solved(problem: PoseProblem, report: Report) -> PoseResult:
        return solve_poses(problem, report)

    run_tasks(pipe, solved)
