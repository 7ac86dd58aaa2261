"""Simulates gaits of an atlas in worker processes; each is stored as soon as it is done."""

import time
from collections.abc import Callable, Generator
from contextlib import closing
from dataclasses import dataclass, replace

from app.atlas.atlas_file import AtlasFile
from app.atlas.physics_choice import PhysicsChoice
from core.atlas.physics_row import PhysicsRow
from core.atlas.row import AtlasRow
from solver_jobs import PhysicsRun, PhysicsWorker

VARIATIONS = 16
"""Variations of a gait: the first ones of those that `footfall simulate` has, which tries 64."""
POLL_SECONDS = 0.05
"""Between looks for gaits that are done, and for a wish to end."""


@dataclass(frozen=True)
class PhysicsProgress:
    """How far the simulations are.

    Args:
        done: chosen gaits that the file has simulated.
        count: chosen gaits.
        walking: those that walk in all variations.
        simulated: gaits that this run has simulated.
        begun: shares of the gaits in work, as a sum.
        seconds: since it began.
    """

    done: int
    count: int
    walking: int
    simulated: int
    begun: float
    seconds: float

    @property
    def seconds_left(self) -> float | None:
        """About how long it still takes; None before anything is known."""
        worked = self.simulated + self.begun
        if not worked:
            return None
        return max(self.count - self.done - self.begun, 0.0) * self.seconds / worked


def run_physics(
    atlas: AtlasFile,
    choice: PhysicsChoice,
    workers: int,
    tell: Callable[[PhysicsProgress], object] = lambda progress: None,
    go_on: Callable[[], bool] = lambda: True,
    variations: int = VARIATIONS,
) -> PhysicsProgress:
    """Simulates the chosen gaits that the file has not simulated with so many variations yet.

    Args:
        atlas: the file; every gait that is done is in it at once.
        choice: which gaits.
        workers: processes on this computer, which stand back behind everything else.
        tell: told how far it is.
        go_on: asked often; False ends it with what is stored.
        variations: of the physics parameters, for each gait.

    Raises:
        InputError: the robot's parameters are no longer those of the atlas.
        StorageError: the disk takes no more; what was stored before stays.
        StateError: a simulator ended more than once with the same gait.
    """
    atlas.require_same_robot()
    begin = time.monotonic()
    known = atlas.physics()
    kept = [known[row.number] for row in choice.rows if _is_kept(known.get(row.number), variations)]
    waiting = [row for row in choice.rows if not _is_kept(known.get(row.number), variations)]
    walking = sum(row.walks_in_all for row in kept)
    progress = PhysicsProgress(len(kept), len(choice.rows), walking, 0, 0.0, 0.0)
    tell(progress)
    with closing(_simulated(atlas, waiting, workers, go_on, variations)) as flow:
        for begun, row in flow:
            if row is not None:
                atlas.add_physics(row)
                progress = replace(
                    progress,
                    done=progress.done + 1,
                    walking=progress.walking + row.walks_in_all,
                    simulated=progress.simulated + 1,
                )
            progress = replace(progress, begun=begun, seconds=time.monotonic() - begin)
            tell(progress)
    return replace(progress, begun=0.0, seconds=time.monotonic() - begin)


def _is_kept(row: PhysicsRow | None, variations: int) -> bool:
    return row is not None and row.variations == variations


def _simulated(
    atlas: AtlasFile, rows: list[AtlasRow], workers: int, go_on: Callable[[], bool], variations: int
) -> Generator[tuple[float, PhysicsRow | None]]:
    """Shares of the gaits in work, and each gait as it is done; None from time to time where none is."""
    waiting = rows[::-1]
    services = [PhysicsWorker() for _ in range(min(workers, len(rows)))]
    running: dict[int, PhysicsRun] = {}
    shares: dict[int, float] = {}
    try:
        while (waiting or running) and go_on():
            for place, service in enumerate(services):
                if place not in running and waiting:
                    shares[place] = 0.0
                    running[place] = service.submit(
                        atlas.space, waiting.pop(), variations, _teller(shares, place)
                    )
            ended = [place for place, task in running.items() if task.is_done]
            for place in ended:
                shares[place] = 0.0
                yield sum(shares.values()), running.pop(place).result()
            if not ended:
                time.sleep(POLL_SECONDS)
                yield sum(shares.values()), None
    finally:
        for task in running.values():
            task.cancel()
        for service in services:
            service.close()


def _teller(shares: dict[int, float], place: int) -> Callable[[float], None]:
    def tell(share: float) -> None:
        shares[place] = share

    return tell
