"""Chunks of an atlas, each evaluated in a worker process."""

from collections.abc import Callable
from dataclasses import dataclass
from multiprocessing.connection import Connection
from typing import ClassVar

from core.atlas.point import AtlasPoint
from core.atlas.row import AtlasRow
from core.atlas.space import AtlasSpace, space_from_table
from core.errors import StateError
from solver_jobs.workers.spawning import BACKGROUND_NICENESS, IDLE_NICENESS
from solver_jobs.workers.task_service import Task, TaskService
from solver_jobs.workers.task_worker import Report, run_tasks


@dataclass(frozen=True)
class Chunk:
    """Some gaits of a space, which are evaluated together.

    Args:
        first: number of the first one.
        count: how many.
    """

    first: int
    count: int


@dataclass(frozen=True, eq=False)
class ChunkTask:
    """What a process is given: a space as content, so that another version can read it too, and a chunk."""

    space: dict[str, object]
    chunk: Chunk


RUN_AGAIN = "What was computed is kept; run again to go on."
EvaluatedGaits = list[tuple[AtlasPoint, AtlasRow]]
"""Gaits in the order of their numbers, each with what came of it."""


class ChunkRun(Task[ChunkTask, float, EvaluatedGaits]):
    """One chunk that is being evaluated."""

    remedy: ClassVar[str] = RUN_AGAIN

    def unanswered(self, seconds: float) -> EvaluatedGaits:
        """Nothing comes of a chunk that did not end.

        Raises:
            StateError: always.
        """
        raise StateError("The run was ended.")


class ChunkWorker(TaskService[ChunkRun]):
    """Evaluates chunks in a process of its own, one after the other.

    Args:
        is_idle: whether it runs only while a core is free, as in a studio with people at its pages.
    """

    def __init__(self, is_idle: bool = False) -> None:
        niceness = IDLE_NICENESS if is_idle else BACKGROUND_NICENESS
        super().__init__("worker of the atlas", run_atlas_worker, niceness=niceness)

    def submit(
        self, space: AtlasSpace, chunk: Chunk, progress: Callable[[float], object] = lambda share: None
    ) -> ChunkRun:
        """Begins a chunk.

        Args:
            space: what varies.
            chunk: which gaits.
            progress: told the share that is done, from a thread of the service's.
        """
        return self.ask(ChunkRun(ChunkTask(space.content(), chunk), progress))


def run_atlas_worker(pipe: Connection, warm_up: None) -> None:
    """Body of the process.

    Args:
        pipe: the worker's end.
        warm_up: nothing.
    """
    run_tasks(pipe, _evaluated)


def _evaluated(task: ChunkTask, report: Report) -> EvaluatedGaits:
    return evaluated_chunk(task.space, task.chunk.first, task.chunk.count, report)


def evaluated_chunk(
    space: dict[str, object], first: int, count: int, report: Report = lambda share: True
) -> EvaluatedGaits:
    """The gaits of a chunk, as any engine computes them; the same on one core or on many.

    Args:
        space: its content.
        first: number of the first gait.
        count: how many.
        report: told the share that is done; False ends it.

    Raises:
        StateError: `report` ended it.
    """
    from solver_jobs.atlas.draw import drawn_points
    from solver_jobs.atlas.evaluate import evaluated_points

    drawn_from = space_from_table(space, "the space")
    points = drawn_points(drawn_from, first, count)
    rows = evaluated_points(drawn_from, points, report)
    if len(rows) < count:
        raise StateError("The run was ended.")
    return list(zip(points, rows, strict=True))
