"""Simulations in batches: the displacements of gaits, from a process of its own."""

from collections.abc import Callable, Sequence

from core.errors import SimulationCancelledError
from core.identification.learning import Walk
from core.physics.parameters import PhysicsSet
from core.trials.displacement import Displacement
from solver_jobs.workers.batch_simulation_worker import BatchTask, run_batch_simulation_worker
from solver_jobs.workers.spawning import BACKGROUND_NICENESS
from solver_jobs.workers.task_service import Task, TaskService


class BatchSimulation(Task[BatchTask, float, tuple[Displacement | None, ...]]):
    """Some simulations of a gait; what is ended has no answer."""

    def unanswered(self, seconds: float) -> tuple[Displacement | None, ...]:
        """Nothing comes of it.

        Raises:
            SimulationCancelledError: always.
        """
        raise SimulationCancelledError("Learning was cancelled.")


class BatchSimulator(TaskService[BatchSimulation]):
    """Simulates gaits under several sets of parameters, one task after the other."""

    def __init__(self) -> None:
        super().__init__("simulator of gaits", run_batch_simulation_worker, niceness=BACKGROUND_NICENESS)

    def submit(
        self,
        walk: Walk,
        sets: Sequence[PhysicsSet],
        progress: Callable[[float], object] = lambda share: None,
    ) -> BatchSimulation:
        """Begins some simulations of a gait, after those that were asked for before.

        Args:
            walk: the gait.
            sets: parameters, one simulation each.
            progress: told the share of the present simulation, from a thread of the service's.
        """
        return self.ask(BatchSimulation(BatchTask(walk, tuple(sets)), progress))
