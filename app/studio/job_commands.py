"""The commands on jobs: start an optimisation, a simulation or a tracking, and cancel one."""

from dataclasses import replace
from typing import Any

from app.gaits.service import GaitService
from app.jobs.optimisation_service import OptimisationService
from app.jobs.repository import JobRepository
from app.learning.parameter_sets import ParameterSets
from app.plans.sequence_plan import runs_without_result
from app.simulation.service import KIND as SIMULATE
from app.simulation.service import SimulationService
from app.store.database import Database
from app.studio.publisher import Publisher
from app.undo.history import Author
from app.videos.tracking_service import KIND as TRACK
from app.videos.tracking_service import TrackingService, TrackOrder
from core.errors import StateError
from solver_jobs import JobKind

Content = dict[str, Any]


class JobCommands:
    """Starts and cancels jobs of every kind, and shows them to the pages; for the session's thread.

    Args:
        database: where results are kept.
        gaits: the gaits.
        job_repository: the list of jobs.
        jobs: the optimisations.
        simulating: the simulations.
        sets: the sets of physics parameters.
        tracks: the videos that are tracked.
        publisher: shows a job to the pages.
    """

    def __init__(
        self,
        database: Database,
        gaits: GaitService,
        job_repository: JobRepository,
        jobs: OptimisationService,
        simulating: SimulationService,
        sets: ParameterSets,
        tracks: TrackingService,
        publisher: Publisher,
    ) -> None:
        self._database = database
        self._gaits = gaits
        self._job_repository = job_repository
        self._jobs = jobs
        self._simulating = simulating
        self._sets = sets
        self._tracks = tracks
        self._publisher = publisher

    def submit_job(self, gait_id: str, kind: JobKind, author: Author) -> Content:
        """Starts an optimisation, or the search for the fastest timing.

        What is optimised is computed from then on: a recorded motion is set aside, by an edit of the author.
        """
        open_gait = self._gaits.open_gait(gait_id)
        content = self._jobs.submit(open_gait, kind)
        if kind is JobKind.MOTION and open_gait.gait.recorded is not None:
            computed = replace(open_gait.gait, recorded=None)
            self._gaits.edit(gait_id, computed, "Optimise", None, author)
            self._publisher.publish_soon(gait_id)
        return self._publisher.publish_job(content)

    def submit_parts(self, gait_id: str) -> list[Content]:
        """Starts an optimisation of each part of a sequence that can have an exact motion and has none yet.

        Raises:
            StateError: there is none, or the gait is no sequence.
        """
        open_gait = self._gaits.open_gait(gait_id)
        runs = runs_without_result(open_gait.gait, self._database.result) if open_gait.gait.sequence else ()
        if not runs:
            raise StateError(
                "There is no part to optimise: each has its exact motion, or is made by hand or recorded.",
                "sequence",
            )
        contents = [self._jobs.submit(replace(open_gait, gait=run)) for run in runs]
        return [self._publisher.publish_job(content) for content in contents]

    def submit_simulation(self, gait_id: str, physics: str | None, variations: int) -> Content:
        """Starts a simulation of what would be sent of a gait; its plan is made.

        Args:
            gait_id: which gait.
            physics: name of the set of parameters; None for the robot's usual one.
            variations: how many variations of them are tried as well.
        """
        open_gait, plan = self._gaits.open_gait(gait_id), self._gaits.plan(gait_id)
        parameters = self._sets.chosen(plan.model, physics)
        return self._publisher.publish_job(self._simulating.submit(open_gait, plan, parameters, variations))

    def submit_tracking(self, order: TrackOrder) -> Content:
        """Starts following the feet in a video."""
        return self._publisher.publish_job(self._tracks.submit(order))

    def cancel_job(self, job_id: str) -> Content:
        """Asks a job to end; one that ended already stays as it is."""
        cancels = {SIMULATE: self._simulating.cancel, TRACK: self._tracks.cancel}
        cancel = cancels.get(self._job_repository.content(job_id)["kind"], self._jobs.cancel)
        return self._publisher.publish_job(cancel(job_id))
