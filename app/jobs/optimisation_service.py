"""Optimisation jobs: submitted for a gait, run in worker processes, verified by the checker.

Only the command queue's thread calls this.
"""

from collections import OrderedDict
from collections.abc import Callable
from dataclasses import asdict, dataclass, replace
from typing import Any

from app.common.json import Json
from app.documents.gait_json import asked_hash
from app.documents.trajectory_json import trajectory_content
from app.gaits.open_gait import OpenGait
from app.jobs.repository import ENDED, JobRepository
from app.jobs.timing_view import timed_gait, timing_content, timing_problem
from app.plans.plan import Plan, iterate_plan
from app.plans.provenance import result_provenance
from app.plans.verified_result import VerifiedResult, verify
from app.undo.history import Author
from core.errors import InputError, StateError, StorageError
from core.gait.gait import Gait, motion_problem
from core.gait.provenance import Provenance
from core.library.library import optimised_entry
from core.motion.trajectory import Trajectory
from core.problem.motion_problem import MotionProblem
from core.robot.model import RobotModel, load_robot
from solver_jobs import Job, JobKind, JobQueue, JobState, MotionResult, SolveStatus, TimingResult

_SCRIPT = Author()
MOST_COURSES = 4
"""Jobs whose every iteration can still be looked at."""


KIND_WORDS = {JobKind.MOTION: "optimise", JobKind.TIMING: "timing"}
"""Kinds of jobs as the page and scripts name them."""


OnResult = Callable[[Json, str | None, Author], object]
"""Told of a checked result: its content, the id of the gait that takes it, if one does, and who asked."""


@dataclass(frozen=True)
class JobOrigin:
    """What a job is for: the gait as it was, its motion's hash, the problem and who asked."""

    gait_id: str
    gait: Gait
    motion: str
    problem: MotionProblem
    author: Author


class OptimisationService:
    """The optimisations in the list of jobs.

    Args:
        job_repository: the list of jobs.
        job_queue: the worker processes.
        on_result: told of a checked result: what to keep, the gait that takes it, and who asked.
    """

    def __init__(
        self,
        job_repository: JobRepository,
        job_queue: JobQueue,
        on_result: OnResult,
    ) -> None:
        self._job_repository = job_repository
        self._job_queue = job_queue
        self._on_result = on_result
        self._origins: dict[str, JobOrigin] = {}
        self._iterates: OrderedDict[str, tuple[RobotModel, tuple[Trajectory, ...]]] = OrderedDict()

    def submit(self, open_gait: OpenGait, kind: JobKind = JobKind.MOTION, author: Author = _SCRIPT) -> Json:
        """Starts the optimisation of a gait as it is now, or the search for its fastest timing.

        Args:
            open_gait: the gait; of a sequence, with the run of a part in place of its document.
            kind: which of the two.
            author: who asks, and takes the result back by an undo.

        Raises:
            StateError: the gait is made by hand.
            InputError: its timeline or options cannot be optimised.
            StorageError: the job cannot be kept; it is not begun.
        """
        # A recorded motion is what the gait has, not what is asked.
        gait = replace(open_gait.gait, recorded=None)
        if gait.segment_table is not None:
            raise StateError(
                "This gait is made by hand from its segment table. Draw on the timeline to make it one that "
                "the optimiser works on.",
                "gait",
            )
        problem = motion_problem(gait, load_robot(gait.robot))
        if kind is JobKind.TIMING:
            problem = timing_problem(gait, problem)
        origin = JobOrigin(open_gait.id, gait, asked_hash(gait), problem, author)
        job_id = self._job_queue.submit(problem, gait.name, kind)
        try:
            content = self._job_repository.begin(
                job_id, KIND_WORDS[kind], origin.gait_id, gait.name, origin.motion
            )
        except StorageError:
            self._job_queue.cancel(job_id)
            raise
        self._origins[job_id] = origin
        return content

    def cancel(self, job_id: str) -> Json:
        """Asks a job to end; one that ended already stays as it is."""
        content = self._job_repository.content(job_id)
        if content["state"] not in ENDED:
            self._job_queue.cancel(job_id)
        return content

    def changed(self, job: Job) -> Json | None:
        """Takes a change from the job queue and returns the job as it is now."""
        origin = self._origins.get(job.id)
        if origin is None:
            return None
        content = self._job_repository.content(job.id)
        now = self._job_repository.now(job.id)
        content |= {
            "state": job.state.value,
            "sentence": job.sentence,
            "started": content["started"] or (now if job.state is JobState.RUNNING else None),
            "ended": now if job.state.value in ENDED else None,
            "progress": [_iterate_content(iterate) for iterate in job.progress],
        }
        try:
            self._take_result(content, origin, job)
        except StorageError as error:
            content |= {"state": JobState.FAILED.value, "sentence": f"It was not kept. {error.sentence}"}
        self._job_repository.keep(content)
        if content["state"] in ENDED:
            del self._origins[job.id]
        return content

    def _take_result(self, content: Json, origin: JobOrigin, job: Job) -> None:
        if isinstance(job.result, TimingResult):
            content["result"] = timing_content(origin.gait, job.result)
            provenance = self._keep_timed_motion(origin.gait, job.result)
            if provenance is not None:
                content["result"]["usable"]["document"]["provenance"] = asdict(provenance)
        elif job.result is not None:
            self._keep_iterates(content, origin.problem.model, job.result.iterate_motions)
            self._verify(content, origin, job.result)

    def _keep_iterates(self, content: Json, model: RobotModel, motions: tuple[Trajectory, ...]) -> None:
        """Keeps the motions of a job's iterations in memory, in place of those of the oldest job."""
        self._iterates[content["id"]] = model, motions
        content["course"] = len(motions)
        while len(self._iterates) > MOST_COURSES:
            oldest, _ = self._iterates.popitem(last=False)
            self._job_repository.content(oldest)["course"] = 0

    def iterate(self, job_id: str, number: int) -> Plan:
        """The motion at an iteration, to be looked at.

        Raises:
            NotFoundError: there is no such job.
            StateError: its iterations are no longer kept.
            InputError: it has no iteration of that number.
        """
        content = self._job_repository.content(job_id)
        if not content["course"]:
            raise StateError(
                f"The iterations of this job are not kept any more; those of the last {MOST_COURSES} jobs "
                "are, until the studio ends. Optimise again to look at them.",
                "course",
            )
        model, motions = self._iterates[job_id]
        if not 0 <= number < len(motions):
            raise InputError(
                f"This job has iterations 0 to {len(motions) - 1}, and none of number {number}.",
                "course",
            )
        return iterate_plan(model, motions[number], number, len(motions) - 1)

    def _keep_timed_motion(self, gait: Gait, result: TimingResult) -> Provenance | None:
        """Keeps the exact motion of the gait in its new timings, so that it is there when they are used."""
        timed = timed_gait(gait, result)
        if timed is None or result.usable is None:
            return None
        verified = verify(motion_problem(timed, load_robot(timed.robot)), result.usable)
        if verified.status is not SolveStatus.SOLVED:
            return None
        content, provenance = _kept(asked_hash(timed), verified)
        self._on_result(content, None, _SCRIPT)
        return provenance

    def _verify(self, content: Json, origin: JobOrigin, result: MotionResult) -> None:
        """Believes a solved result only if the independent checker confirms it."""
        verified = verify(origin.problem, result)
        content["result"] = verified.content
        if verified.status is SolveStatus.SOLVED:
            kept, _ = _kept(origin.motion, verified)
            self._on_result(kept, origin.gait_id, origin.author)
        elif content["state"] == JobState.DONE.value:
            content |= {"state": JobState.FAILED.value, "sentence": verified.explanation[0]}


def _kept(motion: str, verified: VerifiedResult) -> tuple[Json, Provenance]:
    """A checked result as it is kept, and its provenance."""
    result = {**verified.content, "trajectory": trajectory_content(verified.trajectory)}
    provenance = result_provenance(motion, result)
    return {**result, "provenance": asdict(provenance)}, provenance


def _iterate_content(iterate: Any) -> Json:
    values = asdict(iterate)
    return {
        "iteration": values["number"],
        "objective": values["objective"],
        "primal": values["primal_infeasibility"],
        "dual": values["dual_infeasibility"],
    }


def likely_problem() -> MotionProblem:
    """The problem that is likely to be asked first, for workers to warm up with."""
    gait = optimised_entry("walk").gait
    return motion_problem(gait, load_robot(gait.robot))
