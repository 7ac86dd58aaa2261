"""The simulator's own process; MuJoCo is imported here and not in the parent."""

from dataclasses import dataclass
from multiprocessing.connection import Connection

from core.physics.motion import SimulatedMotion
from core.physics.problem import SimulationProblem
from core.physics.variations import VariedRun
from solver_jobs.workers.task_worker import Report, run_tasks


@dataclass(frozen=True, eq=False)
class Simulate:
    """What is run.

    Args:
        problem: the waypoints and their parameters.
        variations: how many variations of the parameters are run as well.
        seed: of the variations.
    """

    problem: SimulationProblem
    variations: int
    seed: int


@dataclass(frozen=True, eq=False)
class Simulated:
    """What came of a problem.

    Args:
        motion: under the parameters as they are.
        runs: under their variations; empty where none were asked for.
    """

    motion: SimulatedMotion
    runs: tuple[VariedRun, ...] = ()


def run_simulation_worker(pipe: Connection, warm_up: SimulationProblem | None) -> None:
    """Body of the process.

    Args:
        pipe: the worker's end.
        warm_up: run before anything is asked; None for nothing.
    """
    from solver_jobs.physics.simulate import simulate

    if warm_up is not None:
        simulate(warm_up)
    run_tasks(pipe, _simulated)


def _simulated(asked: Simulate, report: Report) -> Simulated:
    """The run itself and its variations, which count alike in what is told."""
    from solver_jobs.physics.simulate import simulate, simulate_variations

    total = 1 + asked.variations
    motion = simulate(asked.problem, lambda share: report(share / total))
    if not asked.variations:
        return Simulated(motion)

    def varied(share: float) -> bool:
        return report((1 + share * asked.variations) / total)

    return Simulated(motion, simulate_variations(asked.problem, asked.variations, asked.seed, varied))
