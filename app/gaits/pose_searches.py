"""Searches for the poses of gaits for the robot's clock, after every edit.

Only the command queue's thread calls this; `on_answer` is called from a thread of the solver's.
"""

import logging
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

from app.common.json import Json
from app.documents.gait_json import found_content, motion_hash
from app.plans.plan import Plan, PlanSource
from core.errors import FootfallError, StateError
from core.gait.gait import Gait
from core.pose_gaits.gait_poses import found_of, pose_problem
from core.pose_gaits.pose_gait import PoseGait
from core.pose_gaits.pose_problem import PoseProblem
from solver_jobs import PoseGaitSolver, PoseProgress, PoseResult, PoseSearch, SolveStatus

logger = logging.getLogger(__name__)


@dataclass(frozen=True, eq=False)
class PoseAnswer:
    """How a search ended.

    Args:
        motion: hash of what was asked.
        search: that ended.
        content: the result that is kept; None where there is none.
        failure: why it broke off; None where it did not.
    """

    motion: str
    search: PoseSearch
    content: Json | None
    failure: str | None = None


OnAnswer = Callable[[str, PoseAnswer], None]
"""Told of the end of a gait's search, from a thread of the solver's."""


OnProgress = Callable[[str, Json], None]
"""Told of the state of a gait's search as it goes on, from a thread of the solver's."""

_CANCELLED = "The search was cancelled."


class Progress:
    """What is known of a search meanwhile; `take` is called from a thread of the solver's.

    Args:
        motion: hash of what is asked.
        tell: told of each change.
    """

    def __init__(self, motion: str, tell: Callable[[Json], None]) -> None:
        self._tell = tell
        self.state = _state("running", motion)

    def take(self, known: PoseProgress) -> None:
        """Keeps what is known now, and tells of it."""
        self.state = self.state | {
            "stage": known.stage,
            "speed": known.speed,
            "turn_rate": known.turn_rate,
        }
        self._tell(self.state)


@dataclass(frozen=True, eq=False)
class _Running:
    motion: str
    search: PoseSearch
    told: Progress


class PoseSearches:
    """One search a gait; an edit ends the search for what was asked before.

    Args:
        solver: the process that searches.
        on_answer: told of each end.
        on_progress: told of what is known meanwhile.
    """

    def __init__(
        self,
        solver: PoseGaitSolver,
        on_answer: OnAnswer,
        on_progress: OnProgress = lambda gait_id, state: None,
    ) -> None:
        self._solver = solver
        self._on_answer = on_answer
        self._on_progress = on_progress
        self._running: dict[str, _Running] = {}
        self._ended: dict[str, Json] = {}

    def look_at(self, gait_id: str, gait: Gait, plan: Plan) -> Json | None:
        """Begins a search where a gait's poses are only adapted, and ends one that nobody needs any more.

        What a person has cancelled, or what broke off, is not begun again before the gait is edited, or
        `again` asks for it.

        Args:
            gait_id: which gait.
            gait: its present document.
            plan: of that document.

        Returns:
            The state of its search: running, cancelled or failed, what is being done or why it ended, the
            speed and turn of the fastest yet in m/s and rad/s, the hash of what is asked; None where no
            search is needed.
        """
        running = self._running.get(gait_id)
        if gait.poses is None and running is None:
            return None
        motion = motion_hash(gait)
        wanted = plan.source is PlanSource.ADAPTED and not plan.infeasible
        if running is not None and (running.motion != motion or not wanted):
            running.search.cancel()
            del self._running[gait_id]
        if not wanted:
            return None
        ended = self._ended.get(gait_id)
        if ended is not None and ended["motion"] == motion:
            return ended
        if gait_id not in self._running:
            self._begin(gait_id, motion, pose_problem(gait, plan.model), plan.poses)
        return self._running[gait_id].told.state

    def _begin(self, gait_id: str, motion: str, problem: PoseProblem, near: PoseGait | None) -> None:
        told = Progress(motion, partial(self._on_progress, gait_id))
        search = self._solver.submit(problem, told.take, near)
        self._running[gait_id] = _Running(motion, search, told)
        search.when_done(partial(self._answered, gait_id, motion, search))

    def cancel(self, gait_id: str) -> None:
        """Ends a gait's search at a person's wish.

        Raises:
            StateError: none is running.
        """
        running = self._running.pop(gait_id, None)
        if running is None:
            raise StateError("No search for this gait's poses is running.", "search")
        running.search.cancel()
        self._ended[gait_id] = _state("cancelled", running.motion, _CANCELLED)

    def forget(self, gait_id: str) -> None:
        """Ends the search of a gait that is gone."""
        running = self._running.pop(gait_id, None)
        if running is not None:
            running.search.cancel()
        self._ended.pop(gait_id, None)

    def again(self, gait_id: str) -> None:
        """Lets a search begin again that was cancelled or broke off.

        Raises:
            StateError: there is none.
        """
        if self._ended.pop(gait_id, None) is None:
            raise StateError("No search for this gait's poses was cancelled or broke off.", "search")

    def take(self, gait_id: str, answer: PoseAnswer) -> None:
        """Forgets a search that has ended; one that broke off is remembered, and not begun anew."""
        running = self._running.get(gait_id)
        if running is None or running.search is not answer.search:
            return
        del self._running[gait_id]
        if answer.failure is not None:
            self._ended[gait_id] = _state("failed", answer.motion, answer.failure)

    def _answered(self, gait_id: str, motion: str, search: PoseSearch) -> None:
        try:
            result = search.result()
        except FootfallError as error:
            answer = PoseAnswer(motion, search, None, error.sentence)
        else:
            failed = result.status is SolveStatus.FAILED
            answer = PoseAnswer(
                motion, search, result_content(result), " ".join(result.explanation) if failed else None
            )
        if answer.failure is not None:  # it says nothing about the gait, and is kept nowhere
            logger.warning("The search for the poses of %s broke off: %s", gait_id, answer.failure)
        self._on_answer(gait_id, answer)


def _state(state: str, motion: str, stage: str = "") -> Json:
    return {"state": state, "motion": motion, "stage": stage, "speed": None, "turn_rate": None}


def result_content(result: PoseResult) -> Json | None:
    """What is kept of a search; None where it says nothing about the gait."""
    if result.status not in (SolveStatus.SOLVED, SolveStatus.INFEASIBLE):
        return None
    return {
        "status": result.status.value,
        "found": None if result.gait is None else found_content(found_of(result.gait)),
        "explanation": list(result.explanation),
        "solve_seconds": result.solve_seconds,
    }
