"""A run: chunks of an atlas go to an engine, and what comes back is stored."""

import time
from collections.abc import Callable, Generator
from contextlib import closing
from dataclasses import dataclass, replace
from typing import Protocol

from app.atlas.atlas_file import AtlasFile
from core.atlas.row import RowStatus
from core.atlas.space import AtlasSpace
from solver_jobs import Chunk, ChunkRun, ChunkWorker, EvaluatedGaits

POLL_SECONDS = 0.05
"""Between looks for chunks that are done, and for a wish to end."""


@dataclass(frozen=True)
class Progress:
    """How far a run is.

    Args:
        done: gaits that the file has.
        count: gaits that it will have.
        solved: gaits of the file that are solved.
        evaluated: gaits that this run has evaluated.
        seconds: since it began.
    """

    done: int
    count: int
    solved: int
    evaluated: int
    seconds: float

    @property
    def seconds_left(self) -> float | None:
        """About how long it still takes; None before the first chunk is done."""
        if not self.evaluated:
            return None
        return (self.count - self.done) * self.seconds / self.evaluated


@dataclass(frozen=True, eq=False)
class DoneChunk:
    """A chunk that an engine has evaluated.

    Args:
        chunk: which gaits.
        gaits: what came of them.
    """

    chunk: Chunk
    gaits: EvaluatedGaits


class Engine(Protocol):
    """Evaluates chunks, on this machine or on others."""

    def run(
        self, space: AtlasSpace, chunks: list[Chunk], go_on: Callable[[], bool]
    ) -> Generator[DoneChunk | None]:
        """Chunks as they are done, in any order; None from time to time where none is."""
        ...


class LocalEngine:
    """Worker processes of this machine, which stand back behind everything else.

    Args:
        workers: how many.
        is_idle: whether they run only while a core is free.
    """

    def __init__(self, workers: int, is_idle: bool = False) -> None:
        self._workers, self._is_idle = workers, is_idle

    def run(
        self, space: AtlasSpace, chunks: list[Chunk], go_on: Callable[[], bool]
    ) -> Generator[DoneChunk | None]:
        """Chunks as they are done; ends early where `go_on` says so.

        Raises:
            StateError: a worker ended more than once with the same chunk.
        """
        waiting = chunks[::-1]
        services = [ChunkWorker(self._is_idle) for _ in range(min(self._workers, len(chunks)))]
        running: dict[int, tuple[Chunk, ChunkRun]] = {}
        try:
            while (waiting or running) and go_on():
                for number, service in enumerate(services):
                    if number not in running and waiting:
                        chunk = waiting.pop()
                        running[number] = chunk, service.submit(space, chunk)
                found = False
                for number, (chunk, task) in list(running.items()):
                    if task.is_done:
                        found = True
                        del running[number]
                        yield DoneChunk(chunk, task.result())
                if not found:
                    time.sleep(POLL_SECONDS)
                    yield None
        finally:
            for _, task in running.values():
                task.cancel()
            for service in services:
                service.close()


def run_atlas(
    atlas: AtlasFile,
    count: int,
    engine: Engine,
    tell: Callable[[Progress], object] = lambda progress: None,
    go_on: Callable[[], bool] = lambda: True,
) -> Progress:
    """Evaluates the gaits of an atlas that it does not have yet.

    Args:
        atlas: the file; every chunk that is done is in it at once.
        count: how many gaits of its space, from gait 0 on.
        engine: evaluates chunks.
        tell: told how far the run is.
        go_on: asked often; False ends the run with what is stored.

    Raises:
        StorageError: the disk takes no more; what was stored before stays.
        StateError: the engine cannot go on.
    """
    begin = time.monotonic()
    chunks = atlas.missing(count)
    counts, lacking = atlas.counts(), sum(chunk.count for chunk in chunks)
    done = sum(counts.values())
    progress = Progress(done, done + lacking, counts[RowStatus.SOLVED], 0, 0.0)
    tell(progress)
    with closing(_flow(engine, atlas, chunks, go_on)) as flow:
        for chunk in flow:
            if chunk is not None:
                atlas.add(chunk.gaits)
                solved = sum(row.status is RowStatus.SOLVED for _, row in chunk.gaits)
                progress = replace(
                    progress,
                    done=progress.done + chunk.chunk.count,
                    solved=progress.solved + solved,
                    evaluated=progress.evaluated + chunk.chunk.count,
                )
            progress = replace(progress, seconds=time.monotonic() - begin)
            tell(progress)
    return replace(progress, seconds=time.monotonic() - begin)


def _flow(
    engine: Engine, atlas: AtlasFile, chunks: list[Chunk], go_on: Callable[[], bool]
) -> Generator[DoneChunk | None]:
    if chunks:
        yield from engine.run(atlas.space, chunks, go_on)
