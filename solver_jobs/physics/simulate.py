"""Waypoints through the physics: one run, or many at a time."""

import os
import time
from collections.abc import Callable, Sequence

from core.errors import SimulationCancelledError
from core.physics.metrics import report
from core.physics.motion import SimulatedMotion
from core.physics.problem import SimulationProblem
from core.physics.variations import VariedRun, variations, varied_problem, varied_run
from solver_jobs.physics.states import new_pool, simulated_motion
from solver_jobs.physics.stepping import TIME_STEP, VARIED_STEP, SimulatedRun, advance

Progress = Callable[[float], bool]

MOST_THREADS = 2
"""More would leave nothing for the page and the robot on a small machine."""

TOGETHER = 8
"""Variations that are computed side by side."""


def simulate(
    problem: SimulationProblem,
    progress: Progress = lambda share: True,
    *,
    time_step: float = TIME_STEP,
) -> SimulatedMotion:
    """Runs one problem on one thread; the same problem gives the same bits.

    Args:
        problem: what is asked.
        progress: told the share that is done; false cancels.
        time_step: of the integration, s.

    Raises:
        SimulationCancelledError: `progress` said so.
        CheckError: a chain opened, or the engine diverged.
    """
    return simulate_together([problem], progress, threads=1, time_step=time_step)[0]


def simulate_together(
    problems: Sequence[SimulationProblem],
    progress: Progress = lambda share: True,
    *,
    threads: int | None = None,
    time_step: float = TIME_STEP,
) -> list[SimulatedMotion]:
    """Runs problems of one robot and rig side by side, each as it would run alone.

    Args:
        problems: what is asked.
        progress: told the share that is done; false cancels.
        threads: at most so many; by default as many as the machine has cores, up to `MOST_THREADS`.
        time_step: of the integration, s.

    Raises:
        SimulationCancelledError: `progress` said so.
        CheckError: a chain opened, or the engine diverged.
    """
    begin = time.perf_counter()
    runs = [SimulatedRun(problem, time_step) for problem in problems]
    pool = new_pool(runs[0].model, threads or min(os.cpu_count() or 1, MOST_THREADS))
    total = sum(run.rows for run in runs)
    while unfinished := [run for run in runs if run.rows_done < run.rows]:
        advance(unfinished, pool)
        if not progress(sum(run.rows_done for run in runs) / total):
            raise SimulationCancelledError("The simulation was cancelled.")
    seconds = time.perf_counter() - begin
    return [_motion(run, seconds * run.rows / total) for run in runs]


def simulate_variations(
    problem: SimulationProblem,
    count: int,
    seed: int,
    progress: Progress = lambda share: True,
    *,
    threads: int | None = None,
) -> tuple[VariedRun, ...]:
    """Runs a problem under variations of its parameters, some at a time so that memory stays small.

    Args:
        problem: what is asked.
        count: how many variations.
        seed: of their parameters.
        progress: told the share that is done; false cancels.
        threads: at most so many; by default as many as the machine has cores, up to `MOST_THREADS`.

    Raises:
        SimulationCancelledError: `progress` said so.
        CheckError: a chain opened, or the engine diverged.
    """
    drawn = variations(problem.physics, count, seed, problem.model.motor_count)
    done: list[VariedRun] = []
    for first in range(0, count, TOGETHER):
        some = drawn[first : first + TOGETHER]
        problems = [varied_problem(problem, variation) for variation in some]

        def tell(share: float, before: int = first, now: int = len(some)) -> bool:
            return progress((before + share * now) / count)

        motions = simulate_together(problems, tell, threads=threads, time_step=VARIED_STEP)
        done += [
            varied_run(variation, report(varied, motion))
            for variation, varied, motion in zip(some, problems, motions, strict=True)
        ]
    return tuple(done)


def _motion(run: SimulatedRun, seconds: float) -> SimulatedMotion:
    return simulated_motion(
        run.problem, run.trajectory_done, run.layout, run.recorded, run.loop_error, seconds, run.ended_early
    )
