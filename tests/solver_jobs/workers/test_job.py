"""The job queue: real worker processes, cancelled, killed, timed out and closed."""

from __future__ import annotations

import os
import queue
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from dataclasses import replace

import pytest

from core.errors import InputError, StateError
from core.gait.options import GaitOptions
from core.motion.contact_timeline import timeline_from_order
from core.problem.motion_problem import Cost, MotionProblem, Workspace, standing_pose
from core.robot.model import load_robot
from solver_jobs import Job, JobQueue, JobState, SolveStatus
from solver_jobs.workers import job_queue as runner_module
from tests.support.solvers.cases import gait_problem

DEADLINE = 60.0
WALK = gait_problem("walk", 0.010, Workspace.STROKE)


def long_problem() -> MotionProblem:
    """Minutes to build, long before the first iteration."""
    model = load_robot("dodecapod")
    timeline = timeline_from_order(12, range(1, 13), iterations=4)
    start, goal = (standing_pose(model, 0.0535, (x, 0.0)) for x in (0.0, 0.020))
    return MotionProblem(model, timeline, start, goal, GaitOptions().motion_limits(), Cost.GOAL)


class Listener:
    """Collects snapshots and waits for one that fits."""

    def __init__(self) -> None:
        self.seen: list[Job] = []
        self._news: queue.SimpleQueue[Job] = queue.SimpleQueue()

    def __call__(self, job: Job) -> None:
        self.seen.append(job)
        self._news.put(job)

    def until(self, fits: Callable[[Job], bool]) -> Job:
        deadline = time.monotonic() + DEADLINE
        while True:
            job = self._news.get(timeout=max(0.0, deadline - time.monotonic()))
            if fits(job):
                return job


@pytest.fixture
def listener() -> Listener:
    return Listener()


@pytest.fixture
def runner(listener: Listener) -> Iterator[JobQueue]:
    with JobQueue(listener) as made:
        yield made


def test_a_job_runs_and_keeps_its_whole_course(runner: JobQueue, listener: Listener) -> None:
    job_id = runner.submit(WALK, "Walk, 10 mm")
    job = runner.wait(job_id, DEADLINE)
    assert job.state is JobState.DONE
    assert job.label == "Walk, 10 mm"
    assert job.result is not None
    assert job.result.status is SolveStatus.SOLVED
    assert job.progress == job.result.iterations
    assert job.sentence.startswith("Solved in")
    last = listener.until(lambda one: not one.open)
    assert last is job
    states = list(dict.fromkeys(one.state for one in listener.seen))
    assert states == [JobState.QUEUED, JobState.RUNNING, JobState.DONE]
    counts = [len(one.progress) for one in listener.seen]
    assert counts == sorted(counts)


def test_jobs_that_cannot_be_done_end_infeasible_with_a_sentence(runner: JobQueue) -> None:
    job = runner.wait(runner.submit(gait_problem("walk", 0.2, Workspace.STROKE), "far"), DEADLINE)
    assert job.state is JobState.INFEASIBLE
    assert "Foot 1 has to travel 200.0 mm" in job.sentence


def test_a_waiting_job_is_cancelled_at_once(runner: JobQueue, listener: Listener) -> None:
    first = runner.submit(long_problem(), "long")
    listener.until(lambda job: job.state is JobState.RUNNING)
    second = runner.submit(WALK, "walk")
    assert runner.cancel(second).state is JobState.CANCELLED
    assert runner.job(first).state is JobState.RUNNING
    assert runner.cancel(second).state is JobState.CANCELLED


def test_a_running_job_is_cancelled_within_an_iteration(
    runner: JobQueue, listener: Listener, monkeypatch: pytest.MonkeyPatch
) -> None:
    # A worker that gets no turn for a second would be ended, and would have no result.
    monkeypatch.setattr("solver_jobs.workers.job_thread.GRACE_SECONDS", DEADLINE)
    timeline = timeline_from_order(4, (3, 2, 4, 1), iterations=5)
    job_id = runner.submit(replace(WALK, timeline=timeline), "five iterations")
    listener.until(lambda job: len(job.progress) > 0)
    runner.cancel(job_id)
    job = runner.wait(job_id, DEADLINE)
    assert job.state is JobState.CANCELLED
    assert job.result is not None
    assert job.result.status is SolveStatus.CANCELLED


def test_a_worker_that_does_not_answer_is_ended_and_replaced(runner: JobQueue, listener: Listener) -> None:
    job_id = runner.submit(long_problem(), "long")
    listener.until(lambda job: job.state is JobState.RUNNING)
    before = runner.process_ids()
    runner.cancel(job_id)
    listener.until(lambda job: job.state is JobState.CANCELLING)
    assert runner.wait(job_id, DEADLINE).state is JobState.CANCELLED
    assert runner.wait(runner.submit(WALK, "walk"), DEADLINE).state is JobState.DONE
    assert set(before).isdisjoint(runner.process_ids())


def test_a_job_beyond_its_time_fails_with_a_sentence() -> None:
    with JobQueue(time_limit=0.2) as runner:
        job = runner.wait(runner.submit(long_problem(), "long"), DEADLINE)
    assert job.state is JobState.FAILED
    assert "time limit of 0.2 s" in job.sentence


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="needs POSIX signals")
def test_a_killed_worker_fails_its_job_and_the_next_one_runs(listener: Listener) -> None:
    timeline = timeline_from_order(4, (3, 2, 4, 1), iterations=5)
    with JobQueue(listener) as runner:
        job_id = runner.submit(replace(WALK, timeline=timeline), "five iterations")
        listener.until(lambda job: len(job.progress) > 0)
        os.kill(runner.process_ids()[0], signal.SIGKILL)
        job = runner.wait(job_id, DEADLINE)
        assert job.state is JobState.FAILED
        assert "ended unexpectedly (signal 9)" in job.sentence
        assert runner.wait(runner.submit(WALK, "walk"), DEADLINE).state is JobState.DONE


def test_closing_interrupts_open_jobs_and_leaves_no_process(listener: Listener) -> None:
    runner = JobQueue(listener)
    running = runner.submit(long_problem(), "long")
    listener.until(lambda job: job.state is JobState.RUNNING)
    waiting = runner.submit(WALK, "walk")
    runner.close()
    runner.close()
    assert {runner.job(running).state, runner.job(waiting).state} == {JobState.INTERRUPTED}
    assert runner.process_ids() == ()
    assert not any(thread.name.startswith("footfall-jobs") for thread in threading.enumerate())
    with pytest.raises(StateError, match="closed"):
        runner.submit(WALK, "walk")


def test_a_full_queue_refuses_with_the_limit(
    runner: JobQueue, listener: Listener, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(runner_module, "QUEUE_LIMIT", 1)
    runner.submit(long_problem(), "long")
    listener.until(lambda job: job.state is JobState.RUNNING)
    runner.submit(WALK, "walk")
    with pytest.raises(StateError, match="1 jobs are waiting"):
        runner.submit(WALK, "walk")


def test_an_unknown_job_is_refused(runner: JobQueue) -> None:
    with pytest.raises(InputError, match="no job"):
        runner.cancel("none")


def test_a_listener_that_fails_does_not_stop_the_queue(caplog: pytest.LogCaptureFixture) -> None:
    def fail(job: Job) -> None:
        raise RuntimeError("listener")

    with JobQueue(fail) as runner:
        assert runner.wait(runner.submit(WALK, "walk"), DEADLINE).state is JobState.DONE
    assert "listener failed" in caplog.text


PARENT = """
import sys
from solver_jobs import JobQueue
from tests.support.solvers.cases import gait_problem
from core.problem.motion_problem import Workspace

if __name__ == "__main__":
    runner = JobQueue()
    problem = gait_problem("walk", 0.010, Workspace.STROKE)
    runner.wait(runner.submit(problem, "walk"), 60)
    print("casadi" in sys.modules, runner.process_ids()[0], flush=True)
    sys.stdin.read()
"""


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="needs POSIX signals")
def test_the_parent_never_loads_the_solver_and_its_death_ends_the_worker() -> None:
    with subprocess.Popen(
        [sys.executable, "-c", PARENT], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    ) as parent:
        assert parent.stdout is not None
        loaded, worker = parent.stdout.readline().split()
        assert loaded == "False"
        os.kill(int(worker), 0)
        parent.kill()
        # The worker holds the same standard output; its end is the end of the file.
        rest, _ = parent.communicate(timeout=DEADLINE)
        assert rest == ""
