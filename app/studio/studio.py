"""The composition root: creates, connects and closes every service; other threads enter through `Studio`."""

from collections.abc import Callable, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import ExitStack
from functools import partial
from pathlib import Path
from typing import Protocol, TypeVar

from app.atlas.library import AtlasLibrary
from app.atlas.service import AtlasService
from app.cameras.address import CameraAddress
from app.common.json import Json
from app.fastest.service import FastestService
from app.gaits.faster import FasterGaits
from app.gaits.live_plans import LivePlans
from app.gaits.open_gait import OpenGait
from app.gaits.planner import Planner
from app.gaits.pose_searches import PoseAnswer, PoseSearches
from app.gaits.service import GaitService
from app.jobs.optimisation_service import OptimisationService, likely_problem
from app.jobs.repository import JobRepository
from app.learning.service import LearningService
from app.pattern_search.service import PatternSearchService
from app.published.reference_folder import REFERENCE, ReferenceFolder
from app.published.service import PublishedService
from app.remedies.run import RemedyParts
from app.remedies.service import RemedyService
from app.robot.jog_service import JogService
from app.robot.motor_test_service import MotorTestService
from app.robot.ports import RobotPorts
from app.robot.service import RobotService
from app.robot.views import RUNNING
from app.runs.service import RunService
from app.session.command_queue import CommandQueue, Result
from app.session.event_hub import EventHub
from app.simulation.repository import SimulationRepository
from app.simulation.service import SimulationService
from app.store.database import DATABASE, Database
from app.store.gait_files import ATLASES, GaitFiles, require_places
from app.store.tables.published_store import PublishedStore
from app.store.tables.simulation_store import SimulationStore
from app.store.tables.trial_reference_store import TrialReferenceStore
from app.studio.database_keeper import DatabaseKeeper
from app.studio.file_watch import FileWatch
from app.studio.job_commands import JobCommands
from app.studio.publisher import Publisher
from app.trials.comparison import TrialComparison
from app.trials.example import ExampleTrials
from app.trials.photos import TrialPhotos
from app.trials.report.service import TrialReportService
from app.trials.service import TrialService
from app.trials.simulated_feet import TrialSimulations
from app.undo.history import Author
from app.videos.lab import Lab
from solver_jobs import BatchSimulator, Job, JobQueue, LiveSolver, PatternSolver, PoseGaitSolver, Simulator

PATTERN_PROCESSES = 2
"""Pattern searches that go on at one time; each process starts when it is first needed."""
LEARNING_PROCESSES = 2
"""Gaits that are simulated at one time while the studio learns from trials; started when first needed."""

PUBLISHED_SECONDS = 120.0
"""How long the plan of a published gait may wait for the live solver, whose process may still start, s."""

STARTS_SOLVERS_AHEAD = True
"""Whether the live and the exact solver are started and warmed up before they are asked anything."""


class _Closable(Protocol):
    def close(self) -> None: ...


Part = TypeVar("Part", bound=_Closable)


class Studio:
    """Owns every service. Other threads run actions through `call`; pages get events from `hub`.

    Each part that holds a thread, a process, a file or the robot is closed in the reverse order of opening.
    The robot is opened last, so that it stops first.

    Args:
        data: the data folder.
        device: `emulator`, a serial device, or `socket://HOST:PORT`.
        cameras: video files that are played as cameras.

    Attributes:
        publisher: shows the pages what changed.
        storage: checks the database and keeps backups of it.
        job_commands: starts and cancels jobs.
    """

    def __init__(self, data: Path, device: str, cameras: Sequence[CameraAddress] = ()) -> None:
        with ExitStack() as self._parts:
            require_places(data)
            files = GaitFiles(data)
            self._database = self._register(Database(data / DATABASE))
            self.stop_executor = self._parts.enter_context(ThreadPoolExecutor(2, "stop"))
            self.hub = self._register(EventHub())
            self.storage = self._register(
                DatabaseKeeper(self._database, self._storage_changed, lambda: not self._is_running())
            )
            self.commands = self._register(CommandQueue())
            self._open_gaits(files)
            self._open_jobs(data)
            self._open_trials(data, cameras)
            self._open_robot(device, RobotPorts(data / "robot.json"))
            self.storage.start()
            self._parts = self._parts.pop_all()

    def _register(self, part: Part) -> Part:
        """Returns the part, and closes it with the studio from now on."""
        self._parts.callback(part.close)
        return part

    def _open_gaits(self, files: GaitFiles) -> None:
        """Gaits, their plans, patterns and learned parameters, and what the pages are shown."""
        database, hub = self._database, self.hub
        self._solver = solver = self._register(LiveSolver(likely_problem() if STARTS_SOLVERS_AHEAD else None))
        if STARTS_SOLVERS_AHEAD:
            solver.start()
        self.live = LivePlans(solver)
        simulators = tuple(self._register(BatchSimulator()) for _ in range(LEARNING_PROCESSES))
        self.learning = self._register(LearningService(database, simulators))
        sets = self.learning.sets
        self.simulations = SimulationRepository(SimulationStore(database), self._simulated, sets.physics)
        self.gaits = GaitService(
            files, database, self.live.solve_for, hub.pages, simulated_for=self.simulations.simulated
        )
        self._plans = self._register(Planner(self.commands, self.gaits.open_gaits))
        self._register(solver)  # closed before the plans too, which wait for it
        self.job_repository = JobRepository(database)
        pose_solver = self._register(PoseGaitSolver())
        self.pose_searches = PoseSearches(pose_solver, self._poses_answered, self._poses_sought)
        self.faster = FasterGaits(pose_solver, self._keep_poses)
        self.publisher = Publisher(
            hub, self.gaits, self._plans, self.simulations, self.job_repository, self.pose_searches.look_at
        )
        self.commands.tell(self.publisher.summaries)
        self._register(FileWatch(partial(self.commands.tell, self.publisher.look_at_files)))
        self._pattern_solvers = tuple(self._register(PatternSolver()) for _ in range(PATTERN_PROCESSES))
        self.patterns = PatternSearchService(self._pattern_solvers, self.publisher.tell_page)

    def _open_jobs(self, data: Path) -> None:
        """Optimisations, simulations, searches and atlases."""
        warm_up = likely_problem() if STARTS_SOLVERS_AHEAD else None
        queue = JobQueue(self._job_changed, warm_up=warm_up, starts_ahead=STARTS_SOLVERS_AHEAD)
        runner = self._register(queue)
        self.jobs = OptimisationService(self.job_repository, runner, self._on_result)
        self._simulator = simulator = Simulator()
        shown = self.publisher.publish_simulation
        simulations = SimulationService(
            simulator, self.job_repository, self.simulations, self.commands.tell, shown
        )
        self._simulating = self._register(simulations)
        shown_job = self.publisher.publish_job
        self.fastest = self._register(FastestService(self.job_repository, self.commands.tell, shown_job))
        library = AtlasLibrary(data / ATLASES)
        self.atlases = self._register(
            AtlasService(library, self.job_repository, self.commands.tell, shown_job)
        )
        parts = RemedyParts(self.live, self._solver, self._pattern_solvers[0], simulator, self.simulations)
        self.remedies = self._register(RemedyService(parts))
        self._trial_simulations = self._register(
            TrialSimulations(TrialReferenceStore(self._database), simulator)
        )
        folder = ReferenceFolder(data / REFERENCE)
        solve = partial(self._solver.solve, timeout=PUBLISHED_SECONDS)
        store = PublishedStore(self._database)
        self.published = self._register(PublishedService(store, simulator, solve, folder, self.hub.publish))
        self._register(
            simulator
        )  # closed before them, which wait for it; it starts with the first simulation

    def _open_trials(self, data: Path, cameras: Sequence[CameraAddress]) -> None:
        """Runs, trials, videos and cameras."""
        database, job_repository, publisher = self._database, self.job_repository, self.publisher
        self.runs = runs = RunService(database)
        self.trials = trials = TrialService(database, publisher.publish_trial)
        self.examples = ExampleTrials(trials, self._simulator)
        self.comparison = TrialComparison(trials, self._trial_simulations)
        later, shown, publish = self.commands.tell, publisher.publish_job, self.hub.publish
        lab = Lab(data, database, job_repository, trials, runs, cameras, later, shown, publish)
        self.lab = self._register(lab)
        self.photos = TrialPhotos(trials, database, data, lab.vision)
        self.reports = TrialReportService(trials, self.comparison, self.photos, runs)
        sets, tracks = self.learning.sets, lab.tracks
        self.job_commands = JobCommands(
            self.gaits,
            job_repository,
            self.jobs,
            self._simulating,
            sets,
            tracks,
            self.fastest,
            self.atlases,
            publisher,
        )

    def _open_robot(self, device: str, ports: RobotPorts) -> None:
        show, tell_page = self.publisher.publish_robot, self.publisher.tell_page
        self.robot = self._register(RobotService(self._database, device, show, ports, tell_page))
        self.jog = JogService(self.robot.bridge)
        self.motor_test = MotorTestService(self.robot.bridge, self.publisher.publish_motor_test)
        self.robot.bridge.subscribe(self.lab.recordings.follow)

    def close(self) -> None:
        """Stops a run, ends workers and threads; doing it twice does no harm."""
        self._parts.close()

    def stop_run(self, by: str) -> None:
        """Stops the robot where a run is on; returns at once."""
        if self._is_running():
            self.stop_executor.submit(self.robot.bridge.stop, by)

    def _is_running(self) -> bool:
        return self.robot.bridge.snapshot.robot in RUNNING

    def call(self, action: Callable[[], Result]) -> Future[Result]:
        """Runs an action on the command queue's thread."""
        return self.commands.submit(action)

    def call_planned(self, gait_id: str, action: Callable[[], Result]) -> Future[Result]:
        """Runs an action on the command queue's thread once the gait's plan is made; see `Planner`."""
        return self._plans.after(gait_id, action)

    def change(self, action: Callable[[], OpenGait]) -> Future[Json]:
        """Changes a gait on the command queue's thread, and shows it to every page once its plan is known.

        Returns:
            A future with the gait's view.
        """
        shown: Future[Json] = Future()
        self.commands.tell(partial(self._change, action, shown))
        return shown

    def _change(self, action: Callable[[], OpenGait], shown: Future[Json]) -> None:
        try:
            self.publisher.publish_soon(action().id, shown)
        except BaseException as error:  # it belongs to whoever waits for the view
            shown.set_exception(error)

    def hello(self) -> Json:
        """The first event for a page: the whole state that it renders."""
        rest = {"storage": self.storage.view(), "motor_test": self.motor_test.view()}
        return self.publisher.hello(self.robot.view()) | rest

    def page_came_or_went(self, page: str) -> None:
        """Updates what the other pages can undo: anybody may undo the edits of a page that is gone."""
        if page not in self.hub.pages():
            self.patterns.forget(page)
            self.robot.lease.page_left(page)
        self.publisher.publish_steps(page)

    def _storage_changed(self, view: Json) -> None:
        self.hub.publish({"type": "storage", "storage": view})

    def _job_changed(self, job: Job) -> None:
        self.commands.tell(lambda: self._show_job(job))

    def _show_job(self, job: Job) -> None:
        content = self.jobs.changed(job)
        if content is not None:
            self.publisher.publish_job(content)

    def _on_result(self, content: Json, gait_id: str | None, author: Author) -> None:
        resulted = self.gaits.delivery.on_result(content, gait_id, author)
        if resulted is not None:
            self.publisher.publish_soon(resulted.id)

    def _on_poses(self, motion: str, content: Json) -> None:
        self.publisher.publish_all_soon(self.gaits.delivery.on_poses(motion, content))

    def _keep_poses(self, motion: str, content: Json) -> None:
        """Stores checked poses that no gait may ask for yet. Thread-safe."""
        self.commands.tell(lambda: self._on_poses(motion, content))

    def _poses_sought(self, gait_id: str, state: Json) -> None:
        self.hub.publish({"type": "search", "gait": gait_id, "search": state})

    def _poses_answered(self, gait_id: str, answer: PoseAnswer) -> None:
        self.commands.tell(lambda: self._take_poses(gait_id, answer))

    def _take_poses(self, gait_id: str, answer: PoseAnswer) -> None:
        self.pose_searches.take(gait_id, answer)
        if answer.content is not None:
            self._on_poses(answer.motion, answer.content)
        elif answer.failure is not None:
            self.publisher.publish_soon(gait_id)

    def _simulated(self, waypoints: str) -> None:
        """Drops verdicts and approvals that are older than the simulation of their waypoints. Thread-safe."""
        self.commands.tell(lambda: self.publisher.publish_all_soon(self.gaits.on_simulated(waypoints)))
