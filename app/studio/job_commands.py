"""The commands on jobs: start an optimisation, a simulation or a tracking, and cancel one."""

from dataclasses import dataclass, replace

from app.atlas.atlas_file import AtlasFile
from app.atlas.service import KIND as ATLAS
from app.atlas.service import AtlasService
from app.common.json import Json
from app.fastest.request import FastestRequest
from app.fastest.service import KIND as FASTEST
from app.fastest.service import FastestService
from app.gaits.results import OPTIMISE
from app.gaits.service import GaitService
from app.jobs.optimisation_service import OptimisationService
from app.jobs.repository import JobRepository
from app.learning.parameter_sets import ParameterSets
from app.simulation.service import KIND as SIMULATE
from app.simulation.service import SimulationService
from app.studio.publisher import Publisher
from app.undo.history import Author
from app.videos.tracking_service import KIND as TRACK
from app.videos.tracking_service import TrackingJob, TrackingService
from core.errors import StateError
from solver_jobs import JobKind


@dataclass(frozen=True, eq=False)
class JobCommands:
    """Starts and cancels jobs of every kind, and shows them to the pages; for the command queue's thread.

    Args:
        gaits: the gaits.
        job_repository: the list of jobs.
        jobs: the optimisations.
        simulating: the simulations.
        sets: the sets of physics parameters.
        tracks: the videos that are tracked.
        fastest: the searches for the fastest gait.
        atlases: the runs of atlases.
        publisher: shows a job to the pages.
    """

    gaits: GaitService
    job_repository: JobRepository
    jobs: OptimisationService
    simulating: SimulationService
    sets: ParameterSets
    tracks: TrackingService
    fastest: FastestService
    atlases: AtlasService
    publisher: Publisher

    def submit_job(self, gait_id: str, kind: JobKind, author: Author) -> Json:
        """Starts an optimisation, or the search for the fastest timing.

        What is optimised is computed from then on: a recorded motion is set aside, by an edit of the author.
        """
        open_gait = self.gaits.open_gait(gait_id)
        content = self.jobs.submit(open_gait, kind, author)
        if kind is JobKind.MOTION and open_gait.gait.recorded is not None:
            computed = replace(open_gait.gait, recorded=None)
            self.gaits.edit(gait_id, computed, OPTIMISE, None, author)
            self.publisher.publish_soon(gait_id)
        return self.publisher.publish_job(content)

    def submit_parts(self, gait_id: str, author: Author) -> list[Json]:
        """Starts an optimisation of each part of a sequence that can have an exact motion and has none yet.

        Raises:
            StateError: there is none, or the gait is no sequence.
        """
        open_gait = self.gaits.open_gait(gait_id)
        runs = self.gaits.delivery.runs_without_result(open_gait) if open_gait.gait.sequence else ()
        if not runs:
            raise StateError(
                "There is no part to optimise: each has its exact motion, or is made by hand or recorded.",
                "sequence",
            )
        contents = [self.jobs.submit(replace(open_gait, gait=run), author=author) for run in runs]
        return [self.publisher.publish_job(content) for content in contents]

    def submit_simulation(self, gait_id: str, physics: str | None, variations: int) -> Json:
        """Starts a simulation of what would be sent of a gait; its plan is made.

        Args:
            gait_id: which gait.
            physics: name of the set of parameters; None for the robot's usual one.
            variations: how many variations of them are tried as well.
        """
        open_gait, plan = self.gaits.open_gait(gait_id), self.gaits.plan(gait_id)
        parameters = self.sets.chosen(plan.model, physics)
        return self.publisher.publish_job(self.simulating.submit(open_gait, plan, parameters, variations))

    def submit_tracking(self, order: TrackingJob) -> Json:
        """Starts following the feet in a video."""
        return self.publisher.publish_job(self.tracks.submit(order))

    def submit_fastest(self, request: FastestRequest, has_front: bool) -> Json:
        """Starts a search for the fastest gait."""
        return self.publisher.publish_job(self.fastest.submit(request, has_front))

    def submit_atlas(self, name: str, atlas: AtlasFile, count: int) -> Json:
        """Starts a run of an atlas, whose file it closes at the end."""
        return self.publisher.publish_job(self.atlases.submit(name, atlas, count))

    def cancel_job(self, job_id: str) -> Json:
        """Asks a job to end; one that ended already stays as it is."""
        cancels = {
            SIMULATE: self.simulating.cancel,
            TRACK: self.tracks.cancel,
            FASTEST: self.fastest.cancel,
            ATLAS: self.atlases.cancel,
        }
        cancel = cancels.get(self.job_repository.content(job_id)["kind"], self.jobs.cancel)
        return self.publisher.publish_job(cancel(job_id))
