"""How far each kind of process stands back where cores are scarce."""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from multiprocessing.connection import Connection
from typing import Any

import pytest

from solver_jobs import BatchSimulator, ChunkWorker, JobQueue, LiveSolver, PatternSolver, Simulator
from solver_jobs.workers.spawning import BACKGROUND_NICENESS, IDLE_NICENESS, NICENESS, start_process

PATIENCE = 60.0
"""Longest wait for a process, s."""


def job_process(runner: JobQueue) -> int | None:
    return next(iter(runner.process_ids()), None)


def niceness_of(process: Callable[[], int | None], wanted: int) -> int:
    """Waits until the process has set it, or for `PATIENCE`."""
    latest = time.monotonic() + PATIENCE
    own = os.getpriority(os.PRIO_PROCESS, 0)
    while True:
        number = process()
        found = own if number is None else os.getpriority(os.PRIO_PROCESS, number)
        if found - own == wanted or time.monotonic() > latest:
            return found - own
        time.sleep(0.01)


@pytest.mark.parametrize(
    ("service", "wanted"),
    [
        (PatternSolver, NICENESS),
        (LiveSolver, NICENESS),
        (Simulator, BACKGROUND_NICENESS),
        (BatchSimulator, BACKGROUND_NICENESS),
    ],
)
def test_simulations_stand_back_behind_what_answers_a_hand_and_both_behind_the_bridge(
    service: type[PatternSolver | LiveSolver | Simulator | BatchSimulator], wanted: int
) -> None:
    solver = service()
    solver.start()
    try:
        assert niceness_of(lambda: solver.process_id, wanted) == wanted
    finally:
        solver.close()


def test_jobs_stand_back_behind_what_answers_a_hand() -> None:
    with JobQueue() as runner:
        assert niceness_of(lambda: job_process(runner), BACKGROUND_NICENESS) == BACKGROUND_NICENESS


@pytest.mark.parametrize(
    ("is_idle", "wanted", "policy"),
    [(True, IDLE_NICENESS, os.SCHED_IDLE), (False, BACKGROUND_NICENESS, os.SCHED_OTHER)],
)
def test_an_idle_worker_of_an_atlas_runs_only_while_a_core_is_free(
    is_idle: bool, wanted: int, policy: int
) -> None:
    worker = ChunkWorker(is_idle)
    worker.start()
    try:
        assert niceness_of(lambda: worker.process_id, wanted) == wanted
        assert worker.process_id is not None
        deadline = time.monotonic() + PATIENCE
        while os.sched_getscheduler(worker.process_id) != policy and time.monotonic() < deadline:
            time.sleep(0.01)
        assert os.sched_getscheduler(worker.process_id) == policy
    finally:
        worker.close()


def break_off(pipe: Connection, name: Any) -> None:
    del pipe
    raise ValueError(f"no gait {name}")


@pytest.mark.parametrize("name", ["\x1b[2Jwalk", "walk\x07", "\x9b31m", "a\u202egpj"])
def test_what_a_worker_says_at_its_end_controls_no_terminal(
    capfd: pytest.CaptureFixture[str], name: str
) -> None:
    process, pipe = start_process(break_off, name, "breaking off")
    process.join(PATIENCE)
    pipe.close()
    said = capfd.readouterr().err
    assert "ValueError: no gait " in said
    assert name not in said
    assert not {"\x1b", "\x07", "\x9b", "\u202e"} & set(said)
