"""Simulations as jobs in the list: asked for by gait, run in the physics' own process, then kept.

Only the command queue's thread calls this; a thread a simulation waits for its answer.
"""

import logging
import threading
import uuid
from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

from app.common.json import Json
from app.gaits.open_gait import OpenGait
from app.jobs.job_tracker import JobTracker
from app.jobs.repository import JobRepository
from app.plans.plan import Plan
from app.simulation.problem import (
    report_figures,
    report_from_content,
    simulation_key,
    simulation_problem,
)
from app.simulation.repository import SimulationRepository, SimulationResult, simulation_row
from app.simulation.view import report_sentence
from app.store.tables.simulation_store import SimulationRow
from core.errors import FootfallError, StateError, StorageError
from core.physics.masses import part_masses
from core.physics.parameters import PhysicsSet
from core.physics.problem import SimulationProblem

_log = logging.getLogger(__name__)

KIND = "simulate"
"""What pages and scripts call these jobs."""


class SimulationHandle(Protocol):
    """A simulation under way; `solver_jobs.Simulation` in the studio."""

    def result(self) -> SimulationResult:
        """Waits for its answer."""

    def cancel(self) -> None:
        """Ends it."""


class SimulationTier(Protocol):
    """Interface to the simulator; the studio passes `solver_jobs.Simulator`."""

    def submit(
        self,
        problem: SimulationProblem,
        variations: int = 0,
        *,
        progress: Callable[[float], object] = lambda share: None,
    ) -> SimulationHandle:
        """Begins a simulation."""


@dataclass(frozen=True, eq=False)
class _Work:
    """A simulation that is on: its job, where it is kept, what it is of, and the hold on it."""

    job: Json
    row: SimulationRow
    problem: SimulationProblem
    handle: SimulationHandle


class SimulationService:
    """The simulations in the list of jobs.

    Args:
        tier: what simulates.
        job_repository: the list of jobs.
        kept: where simulations are kept.
        later: does something on the command queue's thread.
        shown: told of each job that changed, on the command queue's thread.
    """

    def __init__(
        self,
        tier: SimulationTier,
        job_repository: JobRepository,
        kept: SimulationRepository,
        later: Callable[[Callable[[], None]], object],
        shown: Callable[[Json], None],
    ) -> None:
        self._tier = tier
        self._job_repository = job_repository
        self._kept = kept
        self._running = JobTracker(job_repository, later, shown, "The physics is running.")
        self._waiting: list[threading.Thread] = []

    def submit(self, open_gait: OpenGait, plan: Plan, physics: PhysicsSet, variations: int = 0) -> Json:
        """Starts a simulation of exactly the waypoints that would be sent.

        Args:
            open_gait: which gait.
            plan: what it amounts to now.
            physics: the parameters.
            variations: how many variations of them are tried as well.

        Raises:
            CheckError: the plan has no waypoints.
            InputError: the robot has no such masses.
            StateError: this gait is being simulated.
        """
        if any(job["gait"] == open_gait.id for job in self._running.contents()):
            raise StateError("This gait is being simulated. Wait for it, or cancel that job.", "gait")
        part_masses(plan.model, physics)
        problem, key = simulation_problem(plan, physics), simulation_key(plan, physics)
        job_id = uuid.uuid4().hex[:12]
        handle = self._tier.submit(problem, variations, progress=self._running.teller(job_id))
        more = {"share": 0.0, "physics": physics.name, "variations": variations}
        try:
            job = self._job_repository.begin(job_id, KIND, open_gait.id, open_gait.gait.name, key, **more)
        except StorageError:
            handle.cancel()
            raise
        row = simulation_row(plan, problem, open_gait.id)
        work = _Work(job, row, problem, handle)
        self._running.begin(job_id, handle)
        thread = threading.Thread(target=self._await, args=(work,), name=f"simulation-{job_id}", daemon=True)
        self._waiting = [one for one in self._waiting if one.is_alive()] + [thread]
        thread.start()
        return job

    def close(self) -> None:
        """Waits for the threads of simulations, whose answers are there once what simulates is closed."""
        for thread in self._waiting:
            thread.join()

    def cancel(self, job_id: str) -> Json:
        """Asks a simulation to end; one that ended already stays as it is."""
        return self._running.cancel(job_id)

    def _await(self, work: _Work) -> None:
        """Waits for the answer, in a thread of its own, and hands it to the command queue."""
        end: Json
        try:
            content = self._kept.keep(work.row, work.problem, work.handle.result())
            end = {"state": "done", "sentence": report_sentence(content["report"]), "share": 1.0}
            end["result"] = report_figures(report_from_content(content["report"]))
        except FootfallError as error:
            end = {"state": "failed", "sentence": error.sentence}
        except Exception as error:
            _log.exception("A simulation broke off.")
            end = {"state": "failed", "sentence": f"The simulation broke off: {error!r}."}
        self._running.end(work.job["id"], end)
