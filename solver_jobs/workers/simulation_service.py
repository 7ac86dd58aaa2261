"""Simulations, in a process of their own."""

from collections.abc import Callable
from typing import ClassVar

from core.errors import SimulationCancelledError
from core.physics.problem import SimulationProblem
from solver_jobs.workers.simulation_worker import Simulate, Simulated, run_simulation_worker
from solver_jobs.workers.spawning import BACKGROUND_NICENESS
from solver_jobs.workers.task_service import Task, TaskService


class Simulation(Task[Simulate, float, Simulated]):
    """A simulation that was asked for; one that is ended has no answer."""

    grace: ClassVar[float] = 2.0
    remedy: ClassVar[str] = "Simulate again."

    def unanswered(self, seconds: float) -> Simulated:
        """Nothing comes of it.

        Raises:
            SimulationCancelledError: always.
        """
        raise SimulationCancelledError("The simulation was cancelled.")


class Simulator(TaskService[Simulation]):
    """Simulations in a process of their own, one after the other; it is started anew where it ends.

    Args:
        warm_up: a problem that is run ahead; None for nothing.
    """

    def __init__(self, warm_up: SimulationProblem | None = None) -> None:
        super().__init__("simulator", run_simulation_worker, warm_up, BACKGROUND_NICENESS)

    def submit(
        self,
        problem: SimulationProblem,
        variations: int = 0,
        *,
        seed: int = 0,
        progress: Callable[[float], object] = lambda share: None,
    ) -> Simulation:
        """Begins a simulation, after those that were asked for before; the first one starts the process.

        Args:
            problem: what is asked.
            variations: how many variations of its parameters are run as well.
            seed: of the variations.
            progress: told the share that is done, from a thread of the simulator's.
        """
        return self.ask(Simulation(Simulate(problem, variations, seed), progress))
