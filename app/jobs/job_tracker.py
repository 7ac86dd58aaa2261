"""Running jobs of one kind: their progress, cancelling and end, on the command queue's thread."""

import time
from collections.abc import Callable
from typing import Protocol

from app.common.json import Json
from app.jobs.repository import ENDED, JobRepository

TELL_SECONDS = 0.2
"""Between two reports of a job's progress."""


class JobHandle(Protocol):
    """What is being done."""

    def cancel(self) -> None:
        """Ends it."""


class Teller(Protocol):
    """Tells how far a job is."""

    def __call__(self, share: float, more: Json | None = None) -> None:
        """Takes the share that is done, and what else the job says of itself."""


class JobTracker:
    """Jobs that are on. Only the command queue's thread calls this, but for what says otherwise.

    Args:
        job_repository: the list of jobs.
        later: does something on the command queue's thread.
        shown: told of each job that changed, on the command queue's thread.
        sentence: what a job says of itself while it is at work.
    """

    def __init__(
        self,
        job_repository: JobRepository,
        later: Callable[[Callable[[], None]], object],
        shown: Callable[[Json], object],
        sentence: str,
    ) -> None:
        self._job_repository = job_repository
        self._later = later
        self._shown = shown
        self._sentence = sentence
        self._on: dict[str, JobHandle] = {}

    def begin(self, job_id: str, handle: JobHandle) -> None:
        """Takes a job of the list as one that is on."""
        self._on[job_id] = handle

    def contents(self) -> list[Json]:
        """The jobs that are on, as JSON content."""
        return [self._job_repository.content(job_id) for job_id in self._on]

    def teller(self, job_id: str) -> Teller:
        """Returns a thread-safe, throttled progress callback."""
        told_at = 0.0

        def tell(share: float, more: Json | None = None) -> None:
            nonlocal told_at
            now = time.monotonic()
            if now - told_at >= TELL_SECONDS:
                told_at = now
                self._later(lambda: self._progressed(job_id, share, more or {}))

        return tell

    def cancel(self, job_id: str) -> Json:
        """Asks a job to end; one that ended already stays as it is."""
        job, handle = self._job_repository.content(job_id), self._on.get(job_id)
        if handle is not None and job["state"] not in ENDED:
            job |= {"state": "cancelling", "sentence": "The job is being cancelled."}
            handle.cancel()
        return job

    def end(self, job_id: str, end: Json) -> None:
        """Ends a job; any thread may say so.

        Args:
            job_id: which job.
            end: its state, sentence and result.
        """
        self._later(lambda: self._ended(job_id, end))

    def _progressed(self, job_id: str, share: float, more: Json) -> None:
        if job_id not in self._on:
            return
        job = self._job_repository.content(job_id)
        if job["state"] in ("queued", "running"):
            started = job["started"] or self._job_repository.now(job_id)
            job |= {"state": "running", "started": started, "share": share, "sentence": self._sentence}
            job |= more
            self._shown(job)

    def _ended(self, job_id: str, end: Json) -> None:
        del self._on[job_id]
        job = self._job_repository.content(job_id)
        if job["state"] == "cancelling" and end["state"] not in ("done", "cancelled"):
            end = {"state": "cancelled", "sentence": "Cancelled."}
        job |= {**end, "ended": self._job_repository.now(job_id)}
        self._job_repository.keep(job)
        self._shown(job)
