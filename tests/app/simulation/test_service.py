"""Simulations as jobs: begun by gait, told of as they go, cancelled, kept when done, or refused."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import pytest

from app.gaits.open_gait import OpenGait, fresh_gait
from app.jobs.repository import JobRepository
from app.simulation.repository import SimulationRepository
from app.simulation.service import SimulationService
from app.store.database import Database
from app.store.tables.simulation_store import SimulationStore
from core.errors import NotFoundError, StateError
from core.library.library import library
from core.physics.motion import SimulatedMotion
from core.physics.parameters import physics_set
from core.physics.problem import SimulationProblem
from core.physics.variations import VariedRun
from tests.support.simulated_walk import BEHIND, GAIT, followed, walk_plan
from tests.support.studio_process import wait_for


@dataclass(frozen=True, eq=False)
class Answer:
    motion: SimulatedMotion
    runs: Sequence[VariedRun] = ()


class Handle:
    """A simulation that ends when a test says so, or when it is cancelled."""

    def __init__(self, problem: SimulationProblem, progress: Callable[[float], object]) -> None:
        self.problem = problem
        self.progress = progress
        self.ended = threading.Event()
        self.error: Exception | None = None

    def result(self) -> Answer:
        assert self.ended.wait(60)
        if self.error is not None:
            raise self.error
        return Answer(followed(self.problem))

    def cancel(self) -> None:
        self.end(StateError("It was cancelled."))

    def end(self, error: Exception | None = None) -> None:
        self.error = error
        self.ended.set()


class Tier:
    def __init__(self) -> None:
        self.handles: list[Handle] = []

    def submit(
        self,
        problem: SimulationProblem,
        variations: int = 0,
        *,
        progress: Callable[[float], object] = lambda share: None,
    ) -> Handle:
        self.handles.append(Handle(problem, progress))
        return self.handles[-1]


class ServiceRig:
    """A service whose session is the test's own thread and those of the simulations."""

    def __init__(self, database: Database) -> None:
        self.tier = Tier()
        self.job_repository = JobRepository(database)
        self.kept = SimulationRepository(SimulationStore(database))
        self.shown: list[tuple[str, float]] = []
        self.service = SimulationService(
            self.tier,
            self.job_repository,
            self.kept,
            lambda act: act(),
            lambda job: self.shown.append((job["state"], job["share"])),
        )

    def submit(self) -> str:
        job_id: str = self.service.submit(open_gait(), walk_plan(), physics_set())["id"]
        return job_id

    def wait(self, job_id: str, state: str) -> None:
        wait_for(lambda: self.job_repository.content(job_id)["state"] == state, f"the job is {state}")


def open_gait() -> OpenGait:
    return fresh_gait(GAIT, library()[GAIT].gait, True, None)


@pytest.fixture
def service(database: Database) -> Iterator[ServiceRig]:
    made = ServiceRig(database)
    yield made
    for handle in made.tier.handles:
        handle.ended.set()
    made.service.close()


def test_a_simulation_that_is_done_is_kept_with_its_figures(service: ServiceRig) -> None:
    job_id = service.submit()
    assert service.job_repository.content(job_id)["state"] == "queued"
    service.tier.handles[0].end()
    service.wait(job_id, "done")
    job, standing = service.job_repository.content(job_id), service.kept.standing(GAIT, walk_plan())
    assert standing is not None
    assert standing["key"] == job["motion"]
    kept = service.kept.content(job["motion"])
    assert kept["report"]["body_error"] == pytest.approx(BEHIND)
    assert job["result"]["mean_error"]["feet"] == pytest.approx([BEHIND] * 4)
    assert "stays on its feet" in job["sentence"]
    assert len(kept["motion"]["times"]) == len(kept["motion"]["strokes_mm"])


def test_progress_is_told_while_it_goes(service: ServiceRig) -> None:
    job_id = service.submit()
    service.tier.handles[0].progress(0.25)
    assert service.shown == [("running", 0.25)]
    service.tier.handles[0].progress(0.26)  # too soon after the last
    assert service.shown == [("running", 0.25)]
    service.tier.handles[0].end()
    service.wait(job_id, "done")


def test_a_cancelled_simulation_leaves_nothing(service: ServiceRig) -> None:
    job_id = service.submit()
    assert service.service.cancel(job_id)["state"] == "cancelling"
    service.wait(job_id, "cancelled")
    assert service.kept.standing(GAIT, walk_plan()) is None
    assert service.service.cancel(job_id)["state"] == "cancelled"


def test_a_simulation_that_fails_says_why_and_the_next_one_may_begin(service: ServiceRig) -> None:
    job_id = service.submit()
    service.tier.handles[0].end(StateError("The physics' process ended twice."))
    service.wait(job_id, "failed")
    assert service.job_repository.content(job_id)["sentence"] == "The physics' process ended twice."
    assert service.submit() != job_id


def test_a_gait_is_simulated_once_at_a_time(service: ServiceRig) -> None:
    service.submit()
    with pytest.raises(StateError, match="is being simulated"):
        service.submit()


def test_after_a_restart_a_simulation_that_was_on_asks_to_simulate_again(
    service: ServiceRig, database: Database
) -> None:
    job_id = service.submit()
    again = JobRepository(database).content(job_id)
    assert again["state"] == "interrupted"
    assert again["sentence"].endswith("Simulate again.")


def test_an_unknown_job_cannot_be_cancelled(service: ServiceRig) -> None:
    with pytest.raises(NotFoundError):
        service.service.cancel("none")
