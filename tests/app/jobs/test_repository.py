"""The list of jobs: what is kept in memory, and what the database gives back."""

from __future__ import annotations

import pytest

from app.jobs.repository import MOST_KEPT, JobRepository
from app.store.database import Database
from core.errors import NotFoundError

MORE = 7


def end(repository: JobRepository, job_id: str) -> None:
    content = repository.content(job_id)
    content |= {"state": "done", "course": 3, "ended": 2.0}
    repository.keep(content)


def test_old_jobs_leave_the_memory_and_are_found_all_the_same(database: Database) -> None:
    repository = JobRepository(database)
    names = [f"job{number}" for number in range(MOST_KEPT + MORE)]
    repository.begin("open", "optimise", "walk", "Walk", "motion")
    for name in names:
        repository.begin(name, "optimise", "walk", "Walk", "motion")
        end(repository, name)
    first, last = repository.content(names[0]), repository.content(names[-1])
    assert first is not repository.content(names[0])
    assert last is repository.content(names[-1])
    assert (first["state"], first["course"]) == ("done", 0)
    assert (last["state"], last["course"]) == ("done", 3)
    assert repository.content("open")["state"] == "queued"
    with pytest.raises(NotFoundError):
        repository.content("never")
