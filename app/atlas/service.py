"""Runs of atlases as jobs of the studio: one at a time, in processes that run only while a core is free."""

import logging
import os
import threading
import uuid
from collections.abc import Callable
from contextlib import closing

from app.atlas.atlas_file import AtlasFile
from app.atlas.library import AtlasLibrary, require_name
from app.atlas.run import LocalEngine, Progress, run_atlas
from app.common.json import Json
from app.jobs.job_tracker import JobTracker
from app.jobs.repository import JobRepository
from core.atlas.space import AtlasSpace
from core.errors import FootfallError, StateError

_log = logging.getLogger(__name__)

KIND = "atlas"
"""The kind of these jobs, as pages and scripts name it."""
CORES_A_WORKER = 2
"""One worker for so many cores: the others are for the people at the pages."""


class AtlasJob:
    """A run that is on.

    Args:
        name: of its atlas.
    """

    def __init__(self, name: str) -> None:
        self.name = name
        self._ending = threading.Event()

    def cancel(self) -> None:
        """Ends it; what is computed is kept."""
        self._ending.set()

    @property
    def is_ending(self) -> bool:
        """Whether it was asked to end."""
        return self._ending.is_set()


class AtlasService:
    """Begins and ends runs.

    `submit`, `cancel` and `delete` belong to the command queue's thread.

    Args:
        library: the atlases.
        job_repository: the list of jobs.
        later: does something on the command queue's thread.
        shown: told of each job that changed, on the command queue's thread.
    """

    def __init__(
        self,
        library: AtlasLibrary,
        job_repository: JobRepository,
        later: Callable[[Callable[[], None]], object],
        shown: Callable[[Json], object],
    ) -> None:
        self.library = library
        self._job_repository = job_repository
        self._tracker = JobTracker(job_repository, later, shown, "The first gaits are evaluated.")
        self._on: tuple[AtlasJob, threading.Thread] | None = None
        self._closed = False
        self._lock = threading.Lock()

    def opened(self, name: str, space: AtlasSpace | None) -> AtlasFile:
        """The file of a run; any thread may ask, since opening may wait for the disk.

        Args:
            name: of the atlas; a new one is made.
            space: what its gaits are drawn from; None for its own, or else the default space.

        Raises:
            InputError: it cannot have that name, or is of another space, robot or version.
            StateError: a run is on.
            StorageError: the disk does not take it.
        """
        require_name(name)
        self._require_none()
        return self.library.started(name, space)

    def submit(self, name: str, atlas: AtlasFile, count: int) -> Json:
        """Evaluates the gaits that an atlas does not have yet.

        Args:
            name: of the atlas.
            atlas: its file; closed at the end of the run, or when it is refused.
            count: how many gaits it is to have.

        Raises:
            StateError: a run is on, or the studio is closing.
        """
        try:
            with self._lock:
                self._require_none()
                job_id, work = uuid.uuid4().hex[:12], AtlasJob(name)
                known = {"share": 0.0, "atlas": name, "count": count, "done": 0}
                job = self._job_repository.begin(job_id, KIND, "", name, "", **known)
                self._tracker.begin(job_id, work)
                thread = threading.Thread(
                    target=self._run, args=(job_id, atlas, count, work), name="atlas", daemon=True
                )
                self._on = work, thread
                thread.start()
        except BaseException:
            atlas.close()
            raise
        return job

    def _require_none(self) -> None:
        if self._closed:
            raise StateError("The studio is closing.", "studio")
        if self._running is not None:
            raise StateError(
                "An atlas is being made. Wait until its job ends, or cancel the job in Jobs.", "atlas"
            )

    @property
    def _running(self) -> AtlasJob | None:
        return self._on[0] if self._on is not None and self._on[1].is_alive() else None

    def cancel(self, job_id: str) -> Json:
        """Asks a run to end; one that ended already stays as it is."""
        return self._tracker.cancel(job_id)

    def delete(self, name: str) -> None:
        """Takes an atlas out of the list; it can be brought back until the studio starts again.

        Raises:
            NotFoundError: there is none of that name.
            StateError: a run is on that adds to it.
        """
        running = self._running
        if running is not None and running.name == name:
            raise StateError(f"“{name}” is being made. Cancel it in Jobs first.", "name")
        self.library.delete(name)

    def _run(self, job_id: str, atlas: AtlasFile, count: int, work: AtlasJob) -> None:
        tell, last = self._tracker.teller(job_id), ""

        def show(progress: Progress) -> None:
            nonlocal last
            sentence = _sentence(progress)
            if sentence != last:
                last, share = sentence, progress.done / max(progress.count, 1)
                tell(share, {"done": progress.done, "count": progress.count, "sentence": sentence})

        try:
            with closing(atlas):
                engine = LocalEngine(max(1, (os.cpu_count() or 1) // CORES_A_WORKER), is_idle=True)
                progress = run_atlas(atlas, count, engine, show, lambda: not work.is_ending)
                end = _end(progress)
        except FootfallError as error:
            end = {"state": "failed", "sentence": error.sentence}
        except Exception as error:
            _log.exception("A run of an atlas broke off")
            end = {"state": "failed", "sentence": f"The run broke off ({error!r}); this is a bug."}
        if not self._closed:  # else it counts as interrupted
            self._tracker.end(job_id, end)

    def close(self) -> None:
        """Ends the run that is on; what is computed is kept."""
        with self._lock:
            self._closed = True
        if self._on is not None:
            work, thread = self._on
            work.cancel()
            thread.join()


def _sentence(progress: Progress) -> str:
    left = progress.seconds_left
    words = f"{progress.done:,} of {progress.count:,} gaits, {progress.solved:,} solved"
    return f"{words}." if left is None else f"{words}, {_duration(left)} left."


def _duration(seconds: float) -> str:
    """About how long, in words."""
    minutes = round(seconds / 60)
    if minutes < 1:
        return "less than a minute"
    return f"about {minutes} min" if minutes < 120 else f"about {minutes / 60:.0f} h"


def _end(progress: Progress) -> Json:
    """The state in which a run ends."""
    words = f"{progress.done:,} gaits, {progress.solved:,} solved."
    known = {"done": progress.done, "count": progress.count}
    if progress.done < progress.count:
        sentence = f"Cancelled. {words} Make the same atlas again to go on."
        return {"state": "cancelled", "sentence": sentence, **known}
    return {"state": "done", "sentence": words, "share": 1.0, **known}
