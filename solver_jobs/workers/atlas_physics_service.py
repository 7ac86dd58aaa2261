"""Gaits of an atlas, each simulated with variations in a worker process."""

from collections.abc import Callable
from dataclasses import dataclass
from multiprocessing.connection import Connection
from typing import ClassVar

from core.atlas.physics_row import PhysicsRow
from core.atlas.row import AtlasRow
from core.atlas.space import AtlasSpace, space_from_table
from core.errors import StateError
from solver_jobs.workers.atlas_service import RUN_AGAIN
from solver_jobs.workers.spawning import BACKGROUND_NICENESS
from solver_jobs.workers.task_service import Task, TaskService
from solver_jobs.workers.task_worker import Report, run_tasks


@dataclass(frozen=True, eq=False)
class PhysicsTask:
    """What a process is given.

    Args:
        space: its content.
        stored: the row of a solved gait.
        variations: how many variations of the physics parameters are tried.
    """

    space: dict[str, object]
    stored: AtlasRow
    variations: int


class PhysicsRun(Task[PhysicsTask, float, PhysicsRow]):
    """One gait that is being simulated."""

    remedy: ClassVar[str] = RUN_AGAIN

    def unanswered(self, seconds: float) -> PhysicsRow:
        """Nothing comes of a simulation that did not end.

        Raises:
            StateError: always.
        """
        raise StateError("The run was ended.")


class PhysicsWorker(TaskService[PhysicsRun]):
    """Simulates gaits of an atlas in a process of its own, one after the other."""

    def __init__(self) -> None:
        super().__init__("simulator of the atlas", run_physics_worker, niceness=BACKGROUND_NICENESS)

    def submit(
        self,
        space: AtlasSpace,
        stored: AtlasRow,
        variations: int,
        progress: Callable[[float], object] = lambda share: None,
    ) -> PhysicsRun:
        """Begins a gait.

        Args:
            space: that it is of.
            stored: its row; it is solved.
            variations: how many variations of the physics parameters are tried.
            progress: told the share that is done, from a thread of the service's.
        """
        return self.ask(PhysicsRun(PhysicsTask(space.content(), stored, variations), progress))


def run_physics_worker(pipe: Connection, warm_up: None) -> None:
    """Body of the process.

    Args:
        pipe: the worker's end.
        warm_up: nothing.
    """
    run_tasks(pipe, _simulated)


def _simulated(task: PhysicsTask, report: Report) -> PhysicsRow:
    from solver_jobs.atlas.physics import simulated_row

    space = space_from_table(task.space, "the space")
    return simulated_row(space, task.stored, task.variations, report)
