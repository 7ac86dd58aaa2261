"""The job queue: a thread for each worker process, and one that hands out snapshots."""

from __future__ import annotations

import logging
import queue
import secrets
import threading
from collections import OrderedDict, deque
from collections.abc import Callable
from dataclasses import replace
from types import TracebackType

from core.errors import InputError, StateError
from core.problem.motion_problem import MotionProblem
from solver_jobs.workers.job import Job, JobKind, JobState
from solver_jobs.workers.job_thread import JobThread
from solver_jobs.workers.spawning import BACKGROUND_NICENESS
from solver_jobs.workers.worker_process import WorkerProcess

OnChange = Callable[[Job], None]
"""Receives a snapshot of every change, in order, on one thread of the queue."""

QUEUE_LIMIT = 32
HISTORY_LIMIT = 100
"""Ended jobs that are remembered."""

_log = logging.getLogger(__name__)


class JobQueue:
    """Runs jobs in worker processes that stand by warm.

    Starting costs the caller nothing: processes are started, and the solver imported, in the background.

    Args:
        on_change: told of every change, or None.
        workers: number of processes.
        time_limit: longest a job may run, s.
        warm_up: a problem of the shape that is likely to come first, solved by each new worker.
        starts_ahead: whether the processes start now, rather than with their first job.
    """

    def __init__(
        self,
        on_change: OnChange | None = None,
        *,
        workers: int = 1,
        time_limit: float = 60.0,
        warm_up: MotionProblem | None = None,
        starts_ahead: bool = True,
    ) -> None:
        self._on_change = on_change
        self._changed = threading.Condition()
        self._jobs: OrderedDict[str, Job] = OrderedDict()
        self._waiting: deque[str] = deque()
        self._closing = False
        self._news: queue.SimpleQueue[Job | None] = queue.SimpleQueue()
        self._notifier = threading.Thread(target=self._notify, name="footfall-jobs-news", daemon=True)
        self._threads = [
            JobThread(self, WorkerProcess(warm_up, niceness=BACKGROUND_NICENESS), time_limit, starts_ahead)
            for _ in range(workers)
        ]
        self._notifier.start()
        for service in self._threads:
            service.start()

    def __enter__(self) -> JobQueue:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def submit(self, problem: MotionProblem, label: str, kind: JobKind = JobKind.MOTION) -> str:
        """Queues a job and returns its id.

        Raises:
            StateError: the queue is full, or the runner is closed.
        """
        with self._changed:
            if self._closing:
                raise StateError("The job queue is closed; start the studio again.", "jobs")
            if len(self._waiting) >= QUEUE_LIMIT:
                raise StateError(
                    f"{QUEUE_LIMIT} jobs are waiting already, which is the limit; cancel some or wait.",
                    "jobs",
                )
            job = Job(
                id=secrets.token_hex(6),
                kind=kind,
                label=label,
                problem=problem,
                state=JobState.QUEUED,
                sentence="Waiting for a worker.",
            )
            self._waiting.append(job.id)
            self.publish(job)
            self._forget_old()
            return job.id

    def cancel(self, job_id: str) -> Job:
        """Asks a job to end: at once where it waits, within an iteration or a second where it runs.

        Raises:
            InputError: there is no such job.
        """
        with self._changed:
            job = self.job(job_id)
            if job.state is JobState.QUEUED:
                self._waiting.remove(job_id)
                return self.end(job, JobState.CANCELLED, "Cancelled before it began.")
            if job.state is JobState.RUNNING:
                return self.publish(replace(job, state=JobState.CANCELLING, sentence="Cancelling."))
            return job

    def job(self, job_id: str) -> Job:
        """The latest snapshot of a job.

        Raises:
            InputError: there is no such job.
        """
        with self._changed:
            if job_id not in self._jobs:
                raise InputError(f"There is no job “{job_id}”.", "job")
            return self._jobs[job_id]

    def jobs(self) -> tuple[Job, ...]:
        """The latest snapshot of every job that is remembered, oldest first."""
        with self._changed:
            return tuple(self._jobs.values())

    def wait(self, job_id: str, timeout: float) -> Job:
        """Waits until a job has ended.

        Raises:
            InputError: there is no such job.
            TimeoutError: it is still open after `timeout` seconds.
        """
        with self._changed:
            if not self._changed.wait_for(lambda: not self.job(job_id).open, timeout):
                raise TimeoutError(f"Job {job_id} is still {self.job(job_id).state} after {timeout:g} s.")
            return self.job(job_id)

    def process_ids(self) -> tuple[int, ...]:
        """Numbers of the worker processes that live."""
        known = (service.worker.process_id for service in self._threads)
        return tuple(number for number in known if number is not None)

    def close(self) -> None:
        """Ends every process and thread; open jobs become interrupted. May be called again."""
        with self._changed:
            if self._closing:
                return
            self._closing = True
            self._waiting.clear()
            self._changed.notify_all()
        for service in self._threads:
            service.join()
        with self._changed:
            for job in self._jobs.values():
                if job.open:
                    self.end(job, JobState.INTERRUPTED, "The studio was closed before the job ended.")
        self._news.put(None)
        self._notifier.join()

    # What the services use.

    def next_job(self) -> Job | None:
        """Waits for work and marks it running; None when the runner closes."""
        with self._changed:
            self._changed.wait_for(lambda: self._closing or self._waiting)
            if self._closing:
                return None
            job = self._jobs[self._waiting.popleft()]
            return self.publish(replace(job, state=JobState.RUNNING, sentence="Optimising."))

    @property
    def closing(self) -> bool:
        """Whether the runner is being closed."""
        return self._closing

    def publish(self, job: Job) -> Job:
        """Makes a snapshot the latest one and announces it."""
        with self._changed:
            self._jobs[job.id] = job
            self._news.put(job)
            self._changed.notify_all()
            return job

    def update(self, job_id: str, change: Callable[[Job], Job]) -> Job:
        """Publishes a change of the latest snapshot."""
        with self._changed:
            return self.publish(change(self._jobs[job_id]))

    def end(self, job: Job, state: JobState, sentence: str) -> Job:
        """Publishes a job's last state."""
        return self.publish(replace(job, state=state, sentence=sentence))

    def _forget_old(self) -> None:
        ended = [job.id for job in self._jobs.values() if not job.open]
        for job_id in ended[: max(0, len(ended) - HISTORY_LIMIT)]:
            del self._jobs[job_id]

    def _notify(self) -> None:
        while (job := self._news.get()) is not None:
            if self._on_change is None:
                continue
            try:
                self._on_change(job)
            except Exception:
                _log.exception("A listener failed on job %s", job.id)
