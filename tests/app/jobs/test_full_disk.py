"""Jobs whose record or result finds no room."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import pytest

from app.common.json import Json
from app.gaits.open_gait import fresh_gait
from app.jobs.optimisation_service import OptimisationService
from app.jobs.repository import JobRepository
from app.store.database import Database
from app.store.tables.job_store import JobStore
from app.undo.history import Author
from core.errors import NotFoundError, StorageFullError
from core.gait.gait import motion_problem
from core.library.library import library
from core.robot.model import load_robot
from solver_jobs import Job, JobKind, JobState, solve_live

GAIT = library()["walk"].gait


@dataclass
class Queue:
    """Job queue that takes everything and does nothing."""

    cancelled: list[str] = field(default_factory=list)

    def submit(self, problem: Any, name: str, kind: JobKind) -> str:
        return "job"

    def cancel(self, job: str) -> None:
        self.cancelled.append(job)


def refuse(*_: Any) -> None:
    raise StorageFullError("The disk is full.", "studio.sqlite3")


def test_a_job_that_cannot_be_kept_is_not_begun(database: Database, monkeypatch: pytest.MonkeyPatch) -> None:
    queue, repository = Queue(), JobRepository(database)
    service = OptimisationService(repository, queue, refuse)  # type: ignore[arg-type]
    monkeypatch.setattr(JobStore, "put", refuse)
    with pytest.raises(StorageFullError):
        service.submit(fresh_gait("walk", GAIT, True, None))
    assert (queue.cancelled, repository.contents()) == (["job"], [])
    with pytest.raises(NotFoundError):
        repository.content("job")


def test_a_result_that_cannot_be_kept_ends_its_job_with_the_reason(database: Database) -> None:
    results: list[Json] = []

    def keep(content: Json, gait_id: str | None, author: Author) -> None:
        results.append(content)
        refuse()

    service = OptimisationService(JobRepository(database), Queue(), keep)  # type: ignore[arg-type]
    service.submit(fresh_gait("walk", GAIT, True, None))
    problem = motion_problem(GAIT, load_robot(GAIT.robot))
    job = Job("job", JobKind.MOTION, GAIT.name, problem, JobState.DONE, result=solve_live(problem))
    content = service.changed(job)
    assert results
    assert content is not None
    assert content["state"] == "failed"
    assert "The disk is full." in content["sentence"]
