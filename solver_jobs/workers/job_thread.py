"""The thread that gives jobs of the queue to one worker process and takes its answers back."""

import logging
import threading
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Protocol

from core.running_time import RunningClock
from solver_jobs.nlp.timing import TimingResult
from solver_jobs.results.motion import Iterate, MotionResult
from solver_jobs.workers.job import STATE_OF_STATUS, Job, JobState, result_sentence
from solver_jobs.workers.nlp_worker import Broke, Finished, Progressed, Stop, Work
from solver_jobs.workers.worker_process import POLL_SECONDS, WorkerEndedError, WorkerProcess, hung_sentence

GRACE_SECONDS = 1.0
"""How long a worker may take to stop when asked; then it is ended."""

SILENCE_SECONDS = 20.0
"""A solver hung if it has told nothing for so long at the time limit; an iteration takes far less."""

PUBLISH_SECONDS = 0.05
"""Progress is published no more often; the course itself is kept whole."""

_log = logging.getLogger(__name__)


class JobSource(Protocol):
    """The job queue as a thread sees it: takes the next job and publishes its changes."""

    @property
    def closing(self) -> bool:
        """Whether everything is to end."""

    def next_job(self) -> Job | None:
        """Waits for work; None at the end."""

    def job(self, job_id: str) -> Job:
        """The latest snapshot."""

    def update(self, job_id: str, change: Callable[[Job], Job]) -> Job:
        """Publishes a change."""

    def end(self, job: Job, state: JobState, sentence: str) -> Job:
        """Publishes a last state."""


@dataclass(eq=False)
class _RunningJob:
    """State of the job that the thread runs."""

    job: str
    clock: RunningClock
    iterates: list[Iterate] = field(default_factory=list)
    heard: float | None = None
    published: float = 0.0
    stop_sent: float | None = None
    timed_out: bool = False


class JobThread:
    """One worker process and the thread that feeds it.

    Args:
        source: where work comes from.
        worker: the process.
        time_limit: longest a job may run, s.
        starts_ahead: whether the process starts before there is work.
    """

    def __init__(
        self, source: JobSource, worker: WorkerProcess, time_limit: float, starts_ahead: bool = True
    ) -> None:
        self._starts_ahead = starts_ahead
        self.worker = worker
        self._source = source
        self._time_limit = time_limit
        self._thread = threading.Thread(target=self._run, name="footfall-jobs", daemon=True)

    def start(self) -> None:
        """Starts the thread."""
        self._thread.start()

    def join(self) -> None:
        """Waits for the thread, which kills the process when the queue closes."""
        self._thread.join()

    def _run(self) -> None:
        try:
            if self._starts_ahead:
                self._start_worker()
            while (job := self._source.next_job()) is not None:
                self._attend(job)
        finally:
            self.worker.kill()

    def _start_worker(self) -> None:
        """Starts the process ahead of work; where that fails, the next job tries again and says why."""
        try:
            self.worker.ensure_started()
        except OSError:
            _log.exception("The solver's process does not start")

    def _attend(self, job: Job) -> None:
        running = _RunningJob(job.id, RunningClock(self.worker.clock))
        try:
            try:
                self._serve(job, running)
            except WorkerEndedError:
                if running.heard is not None or self._source.closing:
                    raise
                # The process had ended while it stood by; the job deserves a living one.
                self._serve(job, running)
        except WorkerEndedError as ended:
            self._end(
                running,
                JobState.FAILED,
                f"The solver's process ended unexpectedly ({ended}). A new one starts; try again.",
            )
            self._start_worker()
        except Exception as error:
            _log.exception("Job %s failed in its service", job.id)
            self.worker.kill()  # it may still be at this job
            self._end(running, JobState.FAILED, f"The job could not be run: {error}.")

    def _serve(self, job: Job, running: _RunningJob) -> None:
        self.worker.ensure_started()
        self.worker.send(Work(job.id, job.problem, job.kind))
        while not self._source.closing and not self._advance(running):
            pass

    def _advance(self, running: _RunningJob) -> bool:
        """Handles the next message or limit; true when the job has ended."""
        message = self.worker.receive(POLL_SECONDS)
        running.clock.look()
        now = running.clock()
        if isinstance(message, Progressed | Finished | Broke) and message.job == running.job:
            running.heard = now
        if isinstance(message, Progressed) and message.job == running.job:
            running.iterates.append(message.iterate)
        elif isinstance(message, Finished) and message.job == running.job:
            self._finish(running, message.result)
            return True
        elif isinstance(message, Broke) and message.job == running.job:
            _log.error("Job %s: %s", running.job, message.details)
            self._end(running, JobState.FAILED, f"The solver broke off ({message.error}); this is a bug.")
            return True
        if now - running.published >= PUBLISH_SECONDS:
            self._publish(running, now)
        return self._stop_where_due(running, now)

    def _publish(self, running: _RunningJob, now: float) -> None:
        if len(self._source.job(running.job).progress) != len(running.iterates):
            running.published = now
            self._source.update(running.job, lambda job: replace(job, progress=tuple(running.iterates)))

    def _stop_where_due(self, running: _RunningJob, now: float) -> bool:
        if running.stop_sent is None:
            running.timed_out = now > self._time_limit
            if running.timed_out or self._source.job(running.job).state is JobState.CANCELLING:
                running.stop_sent = now
                self.worker.send(Stop(running.job))
            return False
        if now - running.stop_sent < GRACE_SECONDS:
            return False
        self.worker.kill()
        silent = now - (running.heard or 0.0)
        if running.timed_out and silent >= SILENCE_SECONDS:
            again = "A new one starts; optimise again."
            self._end(running, JobState.FAILED, hung_sentence("solver", silent, again))
        else:
            self._end(running, *self._stopped(running))
        self._start_worker()
        return True

    def _stopped(self, running: _RunningJob) -> tuple[JobState, str]:
        count = len(running.iterates)
        if running.timed_out:
            return JobState.FAILED, (
                f"Stopped after {count} iterations at the time limit of {self._time_limit:g} s. "
                "Shorten the gait or start from a smaller step."
            )
        return JobState.CANCELLED, f"Cancelled after {count} iterations."

    def _finish(self, running: _RunningJob, result: MotionResult | TimingResult) -> None:
        state, sentence = STATE_OF_STATUS[result.status], result_sentence(result)
        if state is JobState.CANCELLED:
            state, sentence = self._stopped(running)
        self._source.update(running.job, lambda job: replace(job, result=result))
        self._end(running, state, sentence)

    def _end(self, running: _RunningJob, state: JobState, sentence: str) -> None:
        job = replace(self._source.job(running.job), progress=tuple(running.iterates))
        self._source.end(job, state, sentence)
