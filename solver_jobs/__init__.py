"""Solvers and their worker processes, behind one public face.

This is the public face. Importing it loads no solver; `solve_motion` loads it when it is called.
"""

from collections.abc import Callable

from core.atlas.point import AtlasPoint
from core.atlas.row import AtlasRow
from core.atlas.space import AtlasSpace
from core.gait.gait import Gait
from core.motion.trajectory import Trajectory
from core.patterns.problem import PatternProblem, PatternProgress, PatternResult
from core.physics.motion import SimulatedMotion
from core.physics.problem import SimulationProblem
from core.physics.variations import VariedRun
from core.pose_gaits.pose_gait import PoseGait
from core.pose_gaits.pose_problem import PoseProblem
from core.problem.motion_problem import MotionProblem
from core.robot.model import RobotModel
from solver_jobs.nlp.timing import TimingResult, fastest_timing
from solver_jobs.remedies.completion import completed_drawing, completion_question, completion_remedy
from solver_jobs.remedies.limit import Limit
from solver_jobs.remedies.remedy import (
    MOST_REMEDIES,
    Remedy,
    RemedyKind,
    RemedySearch,
    Trouble,
    nothing_words,
    rank,
)
from solver_jobs.results.motion import Evidence, Iterate, Lack, MotionResult, SolveStatus
from solver_jobs.results.pose import PoseProgress, PoseResult
from solver_jobs.tiers.frontier import Frontier, FrontierSearch
from solver_jobs.workers.atlas_physics_service import PhysicsRun, PhysicsWorker
from solver_jobs.workers.atlas_service import (
    RUN_AGAIN,
    Chunk,
    ChunkRun,
    ChunkWorker,
    EvaluatedGaits,
    evaluated_chunk,
)
from solver_jobs.workers.batch_simulation_service import BatchSimulation, BatchSimulator
from solver_jobs.workers.fastest_search import FastestSearch, SearchStep, TriedGait, fastest_of
from solver_jobs.workers.job import OPEN_STATES, Job, JobKind, JobState, result_sentence
from solver_jobs.workers.job_queue import JobQueue
from solver_jobs.workers.live_service import LiveSolver
from solver_jobs.workers.pattern_service import PatternSearch, PatternSolver
from solver_jobs.workers.pose_service import PoseGaitSolver, PoseSearch
from solver_jobs.workers.signals import interrupts_held
from solver_jobs.workers.simulation_service import Simulation, Simulator
from solver_jobs.workers.simulation_worker import Simulated
from solver_jobs.workers.spawning import NICENESS
from solver_jobs.workers.task_service import Task, TaskService
from solver_jobs.workers.task_worker import Report, run_tasks
from solver_jobs.workers.worker_process import WorkerEndedError, WorkerProcess, hung_sentence

__all__ = [
    "MOST_REMEDIES",
    "NICENESS",
    "OPEN_STATES",
    "RUN_AGAIN",
    "BatchSimulation",
    "BatchSimulator",
    "Chunk",
    "ChunkRun",
    "ChunkWorker",
    "EvaluatedGaits",
    "Evidence",
    "FastestSearch",
    "Frontier",
    "FrontierSearch",
    "Iterate",
    "Job",
    "JobKind",
    "JobQueue",
    "JobState",
    "Lack",
    "Limit",
    "LiveSolver",
    "MotionResult",
    "PatternSearch",
    "PatternSolver",
    "PhysicsRun",
    "PhysicsWorker",
    "PoseGaitSolver",
    "PoseProgress",
    "PoseResult",
    "PoseSearch",
    "Remedy",
    "RemedyKind",
    "RemedySearch",
    "Report",
    "SearchStep",
    "Simulated",
    "Simulation",
    "Simulator",
    "SolveStatus",
    "Task",
    "TaskService",
    "TimingResult",
    "TriedGait",
    "Trouble",
    "WorkerEndedError",
    "WorkerProcess",
    "completed_drawing",
    "completion_question",
    "completion_remedy",
    "drawn_points",
    "evaluated_chunk",
    "evaluated_point",
    "fastest_of",
    "fastest_timing",
    "find_remedies",
    "hung_sentence",
    "nothing_words",
    "rank",
    "result_sentence",
    "run_tasks",
    "shortest_problem",
    "simulate",
    "simulate_variations",
    "solve_exact",
    "solve_live",
    "solve_motion",
    "solve_pattern",
    "solve_poses",
]


def solve_motion(
    problem: MotionProblem,
    progress: Callable[[Iterate], bool] = lambda iterate: True,
    start: Trajectory | None = None,
    *,
    resume: bool = False,
) -> MotionResult:
    """Solves a motion problem in this process; not for several threads at once.

    Args:
        problem: what is asked.
        progress: told of each iteration; false cancels.
        start: a motion of the same knots with velocities and forces, such as the live tier's.
        resume: whether to go on from the last solution of the same shape that was solved with `resume`.
    """
    from solver_jobs.nlp.motion_nlp import solve_motion as solve

    return solve(problem, progress, start, resume=resume)


def solve_live(problem: MotionProblem) -> MotionResult:
    """Solves a motion problem by the live tier in this process; not for several threads at once.

    Args:
        problem: what is asked.
    """
    from solver_jobs.live.solve import solve_live as solve

    return solve(problem)


def solve_exact(problem: MotionProblem) -> MotionResult:
    """Solves a motion problem by the exact tier with its convex start, in this process (see `solve_live`).

    Args:
        problem: what is asked.
    """
    from solver_jobs.tiers.exact_from_live import solve_exact as solve

    return solve(problem)


def find_remedies(gait: Gait, model: RobotModel, go_on: Callable[[], bool] = lambda: True) -> RemedySearch:
    """Looks for changes that make a gait walk, in this process (see `solver_jobs.remedies.search`).

    Args:
        gait: one that has no motion.
        model: its robot.
        go_on: asked before each try; false ends the search.
    """
    from solver_jobs.remedies.search import find_remedies as find

    return find(gait, model, go_on)


def solve_pattern(
    problem: PatternProblem,
    *,
    count: int = 1,
    seconds: float = 30.0,
    progress: Callable[[PatternProgress], bool] = lambda known: True,
) -> PatternResult:
    """Finds the best footfall patterns in this process.

    Args:
        problem: what is sought.
        count: how many different patterns, the best first.
        seconds: longest search.
        progress: told every 50 ms; false ends the search with what is known.
    """
    from solver_jobs.patterns.solve import solve_pattern as solve

    return solve(problem, count=count, seconds=seconds, progress=progress)


def drawn_points(space: AtlasSpace, first: int, count: int) -> list[AtlasPoint]:
    """Some gaits of a space, by their numbers (see `solver_jobs.atlas.draw`).

    Args:
        space: what varies.
        first: number of the first one, from 0.
        count: how many.
    """
    from solver_jobs.atlas.draw import drawn_points as draw

    return draw(space, first, count)


def evaluated_point(space: AtlasSpace, number: int) -> tuple[PoseGait | None, AtlasRow]:
    """One gait of a space, evaluated by itself in this process.

    Args:
        space: what varies.
        number: of the gait, from 0.

    Returns:
        Its motion in mid-walk, where it is a gait for the robot's clock and solved, and its row.
    """
    with interrupts_held():
        from solver_jobs.atlas.evaluate import evaluated_alone

    return evaluated_alone(space, number)


def shortest_problem(problem: PatternProblem) -> PatternProblem:
    """A pattern's problem in the shortest length that has a pattern, in this process.

    Args:
        problem: what is sought, in the longest length that is tried; only ends and whole limbs are fixed.
    """
    from solver_jobs.patterns.shortest import shortest_problem as shorten

    return shorten(problem)


def solve_poses(
    problem: PoseProblem,
    report: Callable[[PoseProgress], bool] = lambda progress: True,
    near: PoseGait | None = None,
    *,
    explain: bool = True,
) -> PoseResult:
    """Looks for the fastest pose gait of a problem in this process (see `solver_jobs.pose_gaits.solve`).

    Args:
        problem: what is asked.
        report: told what is known; false ends the search.
        near: poses to begin with; None for several starts.
        explain: whether to look for the reason where there is no gait, which takes as long again.
    """
    with interrupts_held():
        from solver_jobs.pose_gaits.solve import solve_poses as solve

    return solve(problem, report, near, explain)


def simulate(
    problem: SimulationProblem, progress: Callable[[float], bool] = lambda share: True
) -> SimulatedMotion:
    """Runs waypoints through the physics in this process, on one thread.

    Args:
        problem: what is asked.
        progress: told the share that is done; false cancels.

    Raises:
        SimulationCancelledError: `progress` said so.
        CheckError: a leg's chain opened, or the engine diverged.
    """
    with interrupts_held():
        from solver_jobs.physics.simulate import simulate as run

    return run(problem, progress)


def simulate_variations(
    problem: SimulationProblem,
    count: int = 64,
    seed: int = 0,
    progress: Callable[[float], bool] = lambda share: True,
) -> tuple[VariedRun, ...]:
    """Runs waypoints under seeded variations of the parameters, in this process, on two threads.

    Args:
        problem: what is asked.
        count: how many variations.
        seed: the same seed gives the same variations.
        progress: told the share that is done; false cancels.

    Raises:
        SimulationCancelledError: `progress` said so.
        CheckError: a leg's chain opened, or the engine diverged.
    """
    with interrupts_held():
        from solver_jobs.physics.simulate import simulate_variations as run

    return run(problem, count, seed, progress)
