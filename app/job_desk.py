"""Optimisation jobs: asked for by gait, run in worker processes, believed only through the checker.

Only the session's thread calls this.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import asdict, dataclass
from typing import Any

from app.documents import motion_hash
from app.judgement import judge
from app.open_gait import OpenGait
from app.store.database import Database
from app.trajectory_content import trajectory_content
from core.errors import InputError, StateError
from core.gait import motion_problem
from core.motion_problem import MotionProblem
from core.robot import load_robot
from solver_jobs import Job, JobRunner, JobState, MotionResult, SolveStatus

ENDED = frozenset({"done", "infeasible", "failed", "cancelled", "interrupted"})
MOST_SHOWN = 20
"""Jobs in the page's list."""


class UnknownJobError(InputError):
    """There is no job of that id."""


@dataclass(frozen=True)
class JobOrigin:
    """What a job is for: the gait, its motion's hash and the problem."""

    gait: str
    gait_name: str
    motion: str
    problem: MotionProblem


class JobDesk:
    """The list of jobs.

    Args:
        database: where jobs and results are kept.
        runner: the worker processes.
        take_result: told of a checked result: motion hash and content to keep.
    """

    def __init__(
        self,
        database: Database,
        runner: JobRunner,
        take_result: Callable[[str, dict[str, Any]], None],
    ) -> None:
        self._database = database
        self._runner = runner
        self._take_result = take_result
        self._origins: dict[str, JobOrigin] = {}
        self._contents = {content["id"]: content for content in reversed(database.jobs(MOST_SHOWN))}
        for content in self._contents.values():
            if content["state"] not in ENDED:
                content |= {"state": "interrupted", "ended": time.time()}
                content["sentence"] = "The studio ended while this job was on. Optimise again."
                database.put_job(content)

    def submit(self, open_gait: OpenGait) -> dict[str, Any]:
        """Starts the optimisation of a gait as it is now.

        Raises:
            StateError: the gait is made by hand.
            InputError: its timeline or options cannot be optimised.
        """
        gait = open_gait.gait
        if gait.segment_table is not None:
            raise StateError(
                "This gait is made by hand from its segment table. Draw on the timeline to make it one that "
                "the optimiser works on.",
                "gait",
            )
        problem = motion_problem(gait, load_robot(gait.robot))
        origin = JobOrigin(open_gait.id, gait.name, motion_hash(gait), problem)
        job_id = self._runner.submit(problem, gait.name)
        self._origins[job_id] = origin
        content = {
            "id": job_id,
            "kind": "optimise",
            "gait": origin.gait,
            "gait_name": origin.gait_name,
            "motion": origin.motion,
            "state": "queued",
            "sentence": "Waits for a worker.",
            "created": time.time(),
            "started": None,
            "ended": None,
            "progress": [],
            "result": None,
        }
        self._contents[job_id] = content
        self._database.put_job(content)
        return content

    def cancel(self, job_id: str) -> dict[str, Any]:
        """Asks a job to end; one that ended already stays as it is."""
        content: dict[str, Any] = self.content(job_id)
        if content["state"] not in ENDED:
            self._runner.cancel(job_id)
        return content

    def content(self, job_id: str) -> dict[str, Any]:
        """A job as JSON content.

        Raises:
            UnknownJobError: there is none of that id.
        """
        if job_id not in self._contents:
            raise UnknownJobError(f"There is no job “{job_id}”.", job_id)
        found: dict[str, Any] = self._contents[job_id]
        return found

    def contents(self) -> list[dict[str, Any]]:
        """The newest jobs, newest first."""
        return list(reversed(self._contents.values()))[:MOST_SHOWN]

    def changed(self, job: Job) -> dict[str, Any] | None:
        """Takes news from the runner and gives back the job as it is now."""
        content: dict[str, Any] | None = self._contents.get(job.id)
        origin = self._origins.get(job.id)
        if content is None or origin is None:
            return None
        content |= {
            "state": job.state.value,
            "sentence": job.sentence,
            "started": job.started,
            "ended": job.ended,
            "progress": [_iterate_content(iterate) for iterate in job.progress],
        }
        if job.result is not None:
            self._judge(content, origin, job.result)
        if content["state"] in ENDED:
            self._database.put_job(content)
        return content

    def _judge(self, content: dict[str, Any], origin: JobOrigin, result: MotionResult) -> None:
        """Believes a solved result only if the independent checker confirms it."""
        judged = judge(origin.problem, result)
        content["result"] = judged.content
        if judged.status is SolveStatus.SOLVED:
            self._take_result(
                origin.motion, {**judged.content, "trajectory": trajectory_content(judged.trajectory)}
            )
        elif content["state"] == JobState.DONE.value:
            content |= {"state": JobState.FAILED.value, "sentence": judged.explanation[0]}


def _iterate_content(iterate: Any) -> dict[str, Any]:
    values = asdict(iterate)
    return {
        "iteration": values["number"],
        "objective": values["objective"],
        "primal": values["primal_infeasibility"],
        "dual": values["dual_infeasibility"],
    }
