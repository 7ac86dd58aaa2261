"""The studio: desks for gaits, jobs and robot behind one session, and what they publish."""

from __future__ import annotations

import threading
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from pathlib import Path
from typing import Any

from app.documents import motion_hash
from app.events import EventHub
from app.gait_desk import GaitDesk, UnknownGaitError
from app.job_desk import JobDesk
from app.open_gait import OpenGait
from app.robot_desk import RobotDesk
from app.robot_view import RUNNING
from app.session import Result, Session
from app.store.database import Database
from app.store.files import GaitFiles
from app.version import VERSION
from app.views import gait_view, summary_view
from core.gait import motion_problem
from core.library import library
from core.motion_problem import MotionProblem
from core.robot import load_robot
from solver_jobs import Job, JobRunner


class Studio:
    """Everything with state, to be asked through `call` and watched through `hub`.

    Args:
        data: the data folder.
        device: `emulator`, a serial device, or `socket://HOST:PORT`.
    """

    def __init__(self, data: Path, device: str) -> None:
        self.hub = EventHub()
        self._files = GaitFiles(data)
        self._database = Database(data / "studio.sqlite3")
        self.session = Session()
        self.gaits = GaitDesk(self._files, self._database)
        self._runner = JobRunner(self._job_changed, warm_up=_likely_problem())
        self.jobs = JobDesk(self._database, self._runner, self._take_result)
        self.robot = RobotDesk(self._database, device, self._robot_changed)
        self.stop_lane = ThreadPoolExecutor(max_workers=2, thread_name_prefix="stop")
        self._closed = threading.Event()

    def close(self) -> None:
        """Stops a run, ends workers and threads; doing it twice does no harm."""
        if self._closed.is_set():
            return
        self._closed.set()
        self.robot.close()
        self._runner.close()
        self.session.close()
        self.hub.close()
        self.stop_lane.shutdown()
        self._database.close()

    def stop_run(self, by: str) -> None:
        """Stops the robot where a run is on; returns at once."""
        if self.robot.bridge.snapshot.robot in RUNNING:
            self.stop_lane.submit(self.robot.bridge.stop, by)

    def call(self, action: Callable[[], Result]) -> Future[Result]:
        """Does something on the session's thread."""
        return self.session.submit(action)

    def hello(self) -> dict[str, Any]:
        """The first event of every page: everything that it renders from."""
        return {
            "type": "hello",
            "version": VERSION,
            "gaits": self.summaries(),
            "jobs": [self.job_view(content) for content in self.jobs.contents()],
            "robot": self.robot.view(),
        }

    def summaries(self) -> list[dict[str, Any]]:
        """The list of gaits."""
        return [summary_view(open_gait) for open_gait in self.gaits.open_gaits()]

    def view(self, gait_id: str) -> dict[str, Any]:
        """A gait with its plan."""
        return gait_view(self.gaits.open_gait(gait_id), self.gaits.plan(gait_id))

    def job_view(self, content: dict[str, Any]) -> dict[str, Any]:
        """A job, and whether it is of the gait as it is now."""
        try:
            fresh = motion_hash(self.gaits.open_gait(content["gait"]).gait) == content["motion"]
        except UnknownGaitError:
            fresh = False
        return {**content, "fresh": fresh}

    def publish_gait(self, open_gait: OpenGait) -> dict[str, Any]:
        """Shows a changed gait to every page, and the jobs and list that it touches."""
        view = gait_view(open_gait, self.gaits.plan(open_gait.id))
        self.hub.publish({"type": "gait", "view": view})
        self.publish_list()
        for content in self.jobs.contents():
            if content["gait"] == open_gait.id:
                self.hub.publish({"type": "job", "job": self.job_view(content)})
        return view

    def publish_list(self) -> None:
        """Shows the list of gaits to every page."""
        self.hub.publish({"type": "gaits", "gaits": self.summaries()})

    def submit_job(self, gait_id: str) -> dict[str, Any]:
        """Starts an optimisation."""
        content = self.job_view(self.jobs.submit(self.gaits.open_gait(gait_id)))
        self.hub.publish({"type": "job", "job": content})
        return content

    def _job_changed(self, job: Job) -> None:
        self.session.tell(lambda: self._show_job(job))

    def _show_job(self, job: Job) -> None:
        content = self.jobs.changed(job)
        if content is not None:
            self.hub.publish({"type": "job", "job": self.job_view(content)})

    def _take_result(self, motion: str, content: dict[str, Any]) -> None:
        for open_gait in self.gaits.take_result(motion, content):
            self.publish_gait(open_gait)

    def _robot_changed(self, view: dict[str, Any]) -> None:
        self.hub.publish({"type": "robot", "robot": view})


def _likely_problem() -> MotionProblem:
    """The problem that is likely to be asked first, for workers to warm up with."""
    gait = next(iter(library().values())).gait
    return motion_problem(gait, load_robot(gait.robot))
