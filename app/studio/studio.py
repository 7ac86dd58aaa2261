"""The studio: every service behind one command queue, and what they publish."""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

from app.cameras.address import CameraAddress
from app.common.version import VERSION
from app.documents.gait_json import asked_hash
from app.gaits.live_preview import LivePreview
from app.gaits.open_gait import OpenGait
from app.gaits.planner import Planner
from app.gaits.sequence_documents import source_states
from app.gaits.service import GaitService
from app.gaits.summaries import GaitSummaries
from app.gaits.views import gait_view, steps_view
from app.jobs.optimisation_service import OptimisationService
from app.jobs.repository import JobRepository
from app.learning.service import LearningService
from app.pattern_search.service import PatternSearchService
from app.plans.sequence_plan import run_motions, runs_without_result
from app.robot.jog_service import JogService
from app.robot.ports import RobotPorts
from app.robot.service import RobotService
from app.robot.views import RUNNING
from app.runs.service import RunService
from app.session.command_queue import CommandQueue, Result, log_failure
from app.session.event_hub import EventHub
from app.simulation.repository import SimulationRepository
from app.simulation.service import KIND as SIMULATE
from app.simulation.service import SimulationService
from app.store.database import Database
from app.store.gait_files import GaitFiles
from app.store.simulation_store import SimulationStore
from app.store.trial_reference_store import TrialReferenceStore
from app.trials.comparison import TrialComparison
from app.trials.photos import TrialPhotos
from app.trials.report.service import TrialReportService
from app.trials.service import TrialService
from app.trials.simulated_feet import TrialSimulations
from app.undo.history import Author
from app.videos.lab import Lab
from app.videos.tracking_service import KIND as TRACK
from app.videos.tracking_service import TrackOrder
from core.errors import FootfallError, StateError
from core.gait.gait import Gait, motion_problem
from core.library.library import library
from core.problem.motion_problem import MotionProblem
from core.robot.model import load_robot
from solver_jobs import BatchSimulator, Job, JobKind, JobQueue, LiveSolver, PatternSolver, Simulator

_SCRIPT = Author()

PATTERN_PROCESSES = 2
"""Pattern searches that go on at one time; each process starts when it is first needed."""
LEARNING_PROCESSES = 2
"""Gaits that are simulated at one time while the studio learns from trials; started when first needed."""


class Studio:
    """Everything with state, to be asked through `call` and watched through `hub`.

    Args:
        data: the data folder.
        device: `emulator`, a serial device, or `socket://HOST:PORT`.
        cameras: video files that are played as cameras.
    """

    def __init__(self, data: Path, device: str, cameras: Sequence[CameraAddress] = ()) -> None:
        self.hub = EventHub()
        self._files = GaitFiles(data)
        self._database = Database(data / "studio.sqlite3")
        self.commands = CommandQueue()
        self._solver = LiveSolver(_likely_problem())
        self._solver.start()
        self.live = LivePreview(self._solver)
        self._pattern_solvers = tuple(PatternSolver() for _ in range(PATTERN_PROCESSES))
        self.patterns = PatternSearchService(self._pattern_solvers, self._tell_page)
        self._batch_simulators = tuple(BatchSimulator() for _ in range(LEARNING_PROCESSES))
        self.learning = LearningService(self._database, self._batch_simulators)
        self.simulations = SimulationRepository(
            SimulationStore(self._database), self._simulated, self.learning.sets.physics
        )
        self.gaits = GaitService(
            self._files,
            self._database,
            self.live.solve_for,
            self.hub.pages,
            simulated_for=self.simulations.simulated,
        )
        self._plans = Planner(self.commands, self.gaits)
        self._list = GaitSummaries(self.gaits)
        self.commands.tell(self.summaries)
        self._job_queue = JobQueue(self._job_changed, warm_up=_likely_problem())
        self.job_repository = JobRepository(self._database)
        self.jobs = OptimisationService(self.job_repository, self._job_queue, self._take_result)
        self._simulator = Simulator()
        self._simulating = SimulationService(
            self._simulator, self.job_repository, self.simulations, self.commands.tell, self._show_simulation
        )
        self._simulated_as: dict[str, frozenset[str]] = {}
        self.robot = RobotService(
            self._database, device, self._robot_changed, RobotPorts(data / "robot.json"), self._tell_page
        )
        self.jog = JogService(self.robot.bridge)
        self.runs = RunService(self._database)
        self.trials = TrialService(
            self._database, lambda change: self.hub.publish({"type": "trial", "trial": change})
        )
        self._trial_simulations = TrialSimulations(TrialReferenceStore(self._database), self._simulator)
        self.comparison = TrialComparison(self.trials, self._trial_simulations)
        self.lab = Lab(
            data,
            self._database,
            self.job_repository,
            self.trials,
            self.runs,
            cameras,
            self.commands.tell,
            self._show_tracking,
            self.hub.publish,
        )
        self.photos = TrialPhotos(self.trials, self._database, data, self.lab.vision)
        self.reports = TrialReportService(self.trials, self.comparison, self.photos, self.runs)
        self.robot.bridge.subscribe(self.lab.recordings.follow)
        self._told_sources: dict[str, tuple[int, list[str]]] = {}
        self.stop_lane = ThreadPoolExecutor(max_workers=2, thread_name_prefix="stop")
        self._closed = threading.Event()

    def close(self) -> None:
        """Stops a run, ends workers and threads; doing it twice does no harm."""
        if self._closed.is_set():
            return
        self._closed.set()
        self.robot.close()
        self._job_queue.close()
        self._solver.close()
        for solver in self._pattern_solvers:
            solver.close()
        self._simulator.close()
        self._simulating.close()
        self.learning.close()
        for simulator in self._batch_simulators:
            simulator.close()
        self.lab.close()
        self._trial_simulations.close()
        self._plans.close()
        self.commands.close()
        self.hub.close()
        self.stop_lane.shutdown()
        self._database.close()

    def stop_run(self, by: str) -> None:
        """Stops the robot where a run is on; returns at once."""
        if self.robot.bridge.snapshot.robot in RUNNING:
            self.stop_lane.submit(self.robot.bridge.stop, by)

    def call(self, action: Callable[[], Result]) -> Future[Result]:
        """Does something on the session's thread."""
        return self.commands.submit(action)

    def call_planned(self, gait_id: str, action: Callable[[], Result]) -> Future[Result]:
        """Does something on the session's thread that finds the plan of a gait made; see `Planner`."""
        return self._plans.after(gait_id, action)

    def change(self, action: Callable[[], OpenGait]) -> Future[dict[str, Any]]:
        """Changes a gait on the session's thread, and shows it to every page once its plan is known.

        Returns:
            A future with the gait's view.
        """
        shown: Future[dict[str, Any]] = Future()
        self.commands.tell(partial(self._change, action, shown))
        return shown

    def _change(self, action: Callable[[], OpenGait], shown: Future[dict[str, Any]]) -> None:
        try:
            self.publish_soon(action().id, shown)
        except BaseException as error:  # it belongs to whoever waits for the view
            shown.set_exception(error)

    def publish_soon(self, gait_id: str, shown: Future[dict[str, Any]] | None = None) -> None:
        """Shows a gait to every page once its plan is known."""
        if shown is None:
            shown = Future()
            shown.add_done_callback(log_failure)
        self._plans.after(gait_id, lambda: self.publish_gait(self.gaits.open_gait(gait_id)), shown)

    def hello(self) -> dict[str, Any]:
        """The first event of every page: everything that it renders from."""
        return {
            "type": "hello",
            "version": VERSION,
            "gaits": self.summaries(),
            "jobs": [self.job_view(content) for content in self.job_repository.contents()],
            "robot": self.robot.view(),
        }

    def summaries(self) -> list[dict[str, Any]]:
        """The list of gaits."""
        return self._list.lines()

    def view(self, gait_id: str) -> dict[str, Any]:
        """A gait with its plan, on the session's thread."""
        is_first = gait_id not in self._simulated_as
        view = self._gait_view(self.gaits.open_gait(gait_id))
        if is_first:
            self._publish_jobs(gait_id)
        return view

    def _gait_view(self, open_gait: OpenGait) -> dict[str, Any]:
        plan = self.gaits.plan(open_gait.id)
        self._simulated_as[open_gait.id] = self.simulations.keys_of(plan)
        view = gait_view(open_gait, plan, self.hub.pages())
        return view | {
            "simulation": self.simulations.standing(open_gait.id, plan),
            "sources": self._sources(open_gait),
            "version": self.gaits.versions.newest_number(open_gait.id),
        }

    def _sources(self, open_gait: OpenGait) -> list[str]:
        return [state.value for state in source_states(open_gait.gait, self._glanced)]

    def _glanced(self, gait_id: str) -> Gait:
        """A gait that is not opened for it, which reads its whole history."""
        return self.gaits.glance(gait_id)[0]

    def job_view(self, content: dict[str, Any]) -> dict[str, Any]:
        """A job, and whether it is of the gait as it is now; None where its plan is not made yet."""
        if content["kind"] == TRACK:
            return {**content, "fresh": None}
        if content["kind"] == SIMULATE:
            keys = self._simulated_as.get(content["gait"])
            return {**content, "fresh": None if keys is None else content["motion"] in keys}
        try:
            gait = self._glanced(content["gait"])
            fresh = content["motion"] in (run_motions(gait) if gait.sequence else {asked_hash(gait)})
        except FootfallError:  # it is gone, or its file is damaged
            fresh = False
        return {**content, "fresh": fresh}

    def publish_gait(self, open_gait: OpenGait) -> dict[str, Any]:
        """Shows a changed gait to every page, with the jobs that it touches; pages keep their lists."""
        view = self._gait_view(open_gait)
        self.hub.publish({"type": "gait", "view": view})
        if not self._list.has(open_gait.id):
            self.publish_list()
        self._publish_jobs(open_gait.id)
        for sequence in self.gaits.sequences_with(open_gait.id):
            self._publish_sources(sequence)
        return view

    def _publish_jobs(self, gait_id: str) -> None:
        for content in self.job_repository.contents():
            if content["gait"] == gait_id:
                self.hub.publish({"type": "job", "job": self.job_view(content)})

    def _publish_sources(self, sequence: OpenGait) -> None:
        """Tells how a sequence's parts stand to their gaits, where that is another way than told last."""
        sources = self._sources(sequence)
        if self._told_sources.get(sequence.id) != (sequence.revision, sources):
            self._told_sources[sequence.id] = (sequence.revision, sources)
            told = {"id": sequence.id, "revision": sequence.revision, "sources": sources}
            self.hub.publish({"type": "sources", **told})

    def page_came_or_went(self, page: str) -> None:
        """Tells the others what they can undo now: the edits of a page that is gone are everybody's."""
        if page not in self.hub.pages():
            self.patterns.forget(page)
        for open_gait in self.gaits.touched_by(page):
            steps = {"id": open_gait.id, "revision": open_gait.revision}
            self.hub.publish({"type": "steps", **steps, **steps_view(open_gait, self.hub.pages())})

    def _tell_page(self, page: str, event: dict[str, Any]) -> None:
        self.hub.publish(event, page)

    def publish_list(self) -> None:
        """Shows the list of gaits to every page."""
        self.hub.publish({"type": "gaits", "gaits": self.summaries()})

    def submit_job(
        self, gait_id: str, kind: JobKind = JobKind.MOTION, author: Author = _SCRIPT
    ) -> dict[str, Any]:
        """Starts an optimisation, or the search for the fastest timing.

        What is optimised is computed from then on: a recorded motion is set aside, by an edit of the author.
        """
        open_gait = self.gaits.open_gait(gait_id)
        content = self.jobs.submit(open_gait, kind)
        if kind is JobKind.MOTION and open_gait.gait.recorded is not None:
            computed = replace(open_gait.gait, recorded=None)
            self.gaits.edit(gait_id, computed, "Optimise", None, author)
            self.publish_soon(gait_id)
        view = self.job_view(content)
        self.hub.publish({"type": "job", "job": view})
        return view

    def submit_simulation(
        self, gait_id: str, physics: str | None = None, variations: int = 0
    ) -> dict[str, Any]:
        """Starts a simulation of what would be sent of a gait; its plan is made.

        Args:
            gait_id: which gait.
            physics: name of the set of parameters; None for the robot's usual one.
            variations: how many variations of them are tried as well.
        """
        open_gait, plan = self.gaits.open_gait(gait_id), self.gaits.plan(gait_id)
        content = self._simulating.submit(
            open_gait, plan, self.learning.sets.chosen(plan.model, physics), variations
        )
        view = self.job_view(content)
        self.hub.publish({"type": "job", "job": view})
        return view

    def cancel_job(self, job_id: str) -> dict[str, Any]:
        """Asks a job to end; one that ended already stays as it is."""
        cancels = {SIMULATE: self._simulating.cancel, TRACK: self.lab.tracks.cancel}
        view = self.job_view(
            cancels.get(self.job_repository.content(job_id)["kind"], self.jobs.cancel)(job_id)
        )
        self.hub.publish({"type": "job", "job": view})
        return view

    def submit_tracking(self, order: TrackOrder) -> dict[str, Any]:
        """Starts following the feet in a video."""
        view = self.job_view(self.lab.tracks.submit(order))
        self._show_tracking(view)
        return view

    def _show_tracking(self, content: dict[str, Any]) -> None:
        self.hub.publish({"type": "job", "job": self.job_view(content)})

    def _show_simulation(self, content: dict[str, Any]) -> None:
        """Shows a simulation's job, and once it is done its gait, which has another simulation now."""
        if content["state"] == "done":
            self.publish_soon(content["gait"])
        self.hub.publish({"type": "job", "job": self.job_view(content)})

    def submit_parts(self, gait_id: str) -> list[dict[str, Any]]:
        """Starts an optimisation of each part of a sequence that can have an exact motion and has none yet.

        Raises:
            StateError: there is none, or the gait is no sequence.
        """
        open_gait = self.gaits.open_gait(gait_id)
        runs = runs_without_result(open_gait.gait, self._database.result) if open_gait.gait.sequence else ()
        if not runs:
            raise StateError(
                "There is no part to optimise: each has its exact motion, or is made by hand or recorded.",
                "sequence",
            )
        views = [self.job_view(self.jobs.submit(replace(open_gait, gait=run))) for run in runs]
        for view in views:
            self.hub.publish({"type": "job", "job": view})
        return views

    def _job_changed(self, job: Job) -> None:
        self.commands.tell(lambda: self._show_job(job))

    def _show_job(self, job: Job) -> None:
        content = self.jobs.changed(job)
        if content is not None:
            self.hub.publish({"type": "job", "job": self.job_view(content)})

    def _take_result(self, motion: str, content: dict[str, Any]) -> None:
        for open_gait in self.gaits.on_result(motion, content):
            self.publish_soon(open_gait.id)

    def _simulated(self, waypoints_hash: str) -> None:
        """Takes back what was found of waypoints before they were simulated; any thread may call."""

        def take() -> None:
            for open_gait in self.gaits.on_simulated(waypoints_hash):
                self.publish_soon(open_gait.id)

        self.commands.tell(take)

    def _robot_changed(self, view: dict[str, Any]) -> None:
        self.hub.publish({"type": "robot", "robot": view})


def _likely_problem() -> MotionProblem:
    """The problem that is likely to be asked first, for workers to warm up with."""
    gait = next(iter(library().values())).gait
    return motion_problem(gait, load_robot(gait.robot))
