"""Publishes changes to the pages: gaits with their plans, the list of gaits, jobs, trials, the robot."""

import secrets
from collections.abc import Callable, Iterable
from concurrent.futures import Future

from app.atlas.service import KIND as ATLAS
from app.common.json import Json
from app.common.version import VERSION
from app.documents.gait_json import asked_hash
from app.fastest.service import KIND as FASTEST
from app.gaits.open_gait import OpenGait
from app.gaits.planner import Planner
from app.gaits.sequence_documents import source_states
from app.gaits.service import GaitService
from app.gaits.summaries import GaitSummaries
from app.gaits.views import gait_view, steps_view
from app.jobs.repository import JobRepository
from app.plans.plan import Plan
from app.plans.sequence_plan import run_motions
from app.session.command_queue import log_failure
from app.session.event_hub import EventHub
from app.simulation.repository import SimulationRepository
from app.simulation.service import KIND as SIMULATE
from app.videos.tracking_service import KIND as TRACK
from core.errors import FootfallError, NotFoundError
from core.gait.gait import Gait


class Publisher:
    """Makes the views of what changed and sends them to the pages; for the command queue's thread.

    `tell_page`, `publish_trial` and `publish_robot` may be called from any thread.

    Args:
        hub: the pages.
        gaits: the gaits.
        plans: makes the plan that a view needs.
        simulations: the simulations that are kept.
        job_repository: the list of jobs.
        planned: told of each gait that is shown, with its plan; gives the state of its search.
    """

    def __init__(
        self,
        hub: EventHub,
        gaits: GaitService,
        plans: Planner,
        simulations: SimulationRepository,
        job_repository: JobRepository,
        planned: Callable[[str, Gait, Plan], Json | None] = lambda gait_id, gait, plan: None,
    ) -> None:
        self._hub = hub
        self._gaits = gaits
        self._plans = plans
        self._simulations = simulations
        self._job_repository = job_repository
        self._planned = planned
        self._list = GaitSummaries(gaits)
        self._start = secrets.token_hex(6)  # a page knows by it that the studio was started again
        self._troubles: dict[str, str] = {}
        self._simulated_as: dict[str, frozenset[str]] = {}
        self._told_sources: dict[str, tuple[int, list[str]]] = {}

    def hello(self, robot: Json) -> Json:
        """The first event for a page: the whole state that it renders.

        Args:
            robot: the robot's view.
        """
        return {
            "type": "hello",
            "start": self._start,
            "version": VERSION,
            "gaits": self.summaries(),
            "jobs": self.job_views(),
            "robot": robot,
        }

    def summaries(self) -> list[Json]:
        """The list of gaits."""
        return self._list.lines()

    def view(self, gait_id: str) -> Json:
        """A gait with its plan."""
        is_first = gait_id not in self._simulated_as
        view = self._gait_view(self._gaits.open_gait(gait_id))
        if is_first:
            self._publish_jobs(gait_id)
        return view

    def _gait_view(self, open_gait: OpenGait) -> Json:
        plan = self._gaits.plan(open_gait.id)
        search = self._planned(open_gait.id, open_gait.gait, plan)
        self._simulated_as[open_gait.id] = self._simulations.keys_of(plan)
        view = gait_view(open_gait, plan, self._hub.pages())
        return view | {
            "outside": self._gaits.open_gaits.outside(open_gait.id),
            "simulation": self._simulations.standing(open_gait.id, plan),
            "sources": self._sources(open_gait),
            "search": search,
            "version": self._gaits.versions.newest_number(open_gait.id),
        }

    def _sources(self, open_gait: OpenGait) -> list[str]:
        return [state.value for state in source_states(open_gait.gait, self._glanced)]

    def _glanced(self, gait_id: str) -> Gait:
        """A gait's document without opening the gait, which would read its whole history."""
        return self._gaits.open_gaits.glance(gait_id)[0]

    def job_views(self) -> list[Json]:
        """The newest jobs, newest first."""
        return [self.job_view(content) for content in self._job_repository.contents()]

    def job_view(self, content: Json) -> Json:
        """A job, and whether it is of the gait as it is now; None where its plan is not made yet."""
        if content["kind"] in (TRACK, FASTEST, ATLAS):
            return {**content, "fresh": None}
        if content["kind"] == SIMULATE:
            keys = self._simulated_as.get(content["gait"])
            return {**content, "fresh": None if keys is None else content["motion"] in keys}
        try:
            gait = self._glanced(content["gait"])
            fresh = content["motion"] in (run_motions(gait) if gait.sequence else {asked_hash(gait)})
        except FootfallError:  # it is gone, or cannot be shown
            fresh = False
        return {**content, "fresh": fresh}

    def publish_soon(self, gait_id: str, shown: Future[Json] | None = None) -> None:
        """Shows a gait to every page once its plan is known.

        Args:
            gait_id: which gait.
            shown: where its view goes; None where nobody waits for it.
        """
        if shown is None:
            shown = Future()
            shown.add_done_callback(_log_unless_deleted)
        self._plans.after(gait_id, lambda: self.publish_gait(self._gaits.open_gait(gait_id)), shown)

    def publish_all_soon(self, gaits: Iterable[OpenGait]) -> None:
        """Shows gaits to every page, each once its plan is known."""
        for open_gait in gaits:
            self.publish_soon(open_gait.id)

    def publish_gait(self, open_gait: OpenGait) -> Json:
        """Shows a changed gait to every page, with the jobs that it touches; pages keep their lists."""
        view = self._gait_view(open_gait)
        self._hub.publish({"type": "gait", "view": view})
        if not self._list.has(open_gait.id):
            self.publish_list()
        self._publish_jobs(open_gait.id)
        for sequence in self._gaits.open_gaits.sequences_with(open_gait.id):
            self._publish_sources(sequence)
        return view

    def look_at_files(self) -> None:
        """Shows every page what is wrong with gait files, if that is new."""
        before, self._troubles = self._troubles, self._list.troubles()
        touched = {gait for gait, _ in before.items() ^ self._troubles.items()}
        if touched:
            self.publish_list()
        for gait_id in touched & self._simulated_as.keys():
            self.publish_soon(gait_id)

    def publish_list(self) -> None:
        """Shows the list of gaits to every page."""
        self._hub.publish({"type": "gaits", "gaits": self.summaries()})

    def _publish_sources(self, sequence: OpenGait) -> None:
        """Shows which parts of a sequence differ from their gaits, if that is new."""
        sources = self._sources(sequence)
        if self._told_sources.get(sequence.id) != (sequence.revision, sources):
            self._told_sources[sequence.id] = (sequence.revision, sources)
            told = {"id": sequence.id, "revision": sequence.revision, "sources": sources}
            self._hub.publish({"type": "sources", **told})

    def publish_steps(self, page: str) -> None:
        """Shows what can be undone in the gaits that a page edited; it depends on the connected pages."""
        for open_gait in self._gaits.open_gaits.touched_by(page):
            steps = {"id": open_gait.id, "revision": open_gait.revision}
            self._hub.publish({"type": "steps", **steps, **steps_view(open_gait, self._hub.pages())})

    def publish_job(self, content: Json) -> Json:
        """Shows a job to every page, and returns its view."""
        view = self.job_view(content)
        self._hub.publish({"type": "job", "job": view})
        return view

    def _publish_jobs(self, gait_id: str) -> None:
        for content in self._job_repository.contents():
            if content["gait"] == gait_id:
                self.publish_job(content)

    def publish_simulation(self, content: Json) -> None:
        """Shows a simulation's job; once it is done, also the gait with its new simulation."""
        if content["state"] == "done":
            self.publish_soon(content["gait"])
        self.publish_job(content)

    def publish_trial(self, change: Json) -> None:
        """Shows every page that a trial changed."""
        self._hub.publish({"type": "trial", "trial": change})

    def publish_robot(self, view: Json) -> None:
        """Shows the robot to every page."""
        self._hub.publish({"type": "robot", "robot": view})

    def publish_motor_test(self, view: Json) -> None:
        """Shows the motor test to every page."""
        self._hub.publish({"type": "motor_test", "motor_test": view})

    def tell_page(self, page: str, event: Json) -> None:
        """Sends an event to one page."""
        self._hub.publish(event, page)


def _log_unless_deleted(shown: Future[Json]) -> None:
    """A gait that was deleted before its plan was known is shown nowhere."""
    if not isinstance(shown.exception(), NotFoundError):
        log_failure(shown)
