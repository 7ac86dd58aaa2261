"""Makes plans during an edit: solves a document with the live tier, verifies the result and caches it.

It knows documents, not the open gaits, and may be called from any thread; nothing here changes an open gait.
"""

import hashlib
import threading
import time
from collections import OrderedDict
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any, Protocol, TypeVar

from app.common.json import Json
from app.documents.gait_json import gait_from_content, motion_hash
from app.gaits.normalise import normalise
from app.gaits.views import plan_view
from app.plans.make_plan import Solve
from app.plans.plan import Plan
from app.plans.sequence_plan import plan_of
from core.errors import StateError
from core.gait.gait import Gait, motion_problem
from core.gait.motion_source import MotionSource, motion_source
from core.problem.motion_problem import MotionProblem
from core.robot.model import load_robot
from solver_jobs import MotionResult, SolveStatus

FIRST_SECONDS = 40.0
"""How long a plan may wait for the first answer of the live tier's process, which still loads the solver."""
NEXT_SECONDS = 4.0
"""How long it may wait for the answers after that: the command queue waits along."""
FAILED_SECONDS = 5.0
"""How long a solver that broke off is not asked for the same motion again."""
MOST_RESULTS, MOST_PLANS = 64, 12
"""Answers that are remembered, enough for every part of a sequence, and plans."""

Value = TypeVar("Value")


class LiveTier(Protocol):
    """Interface to the live tier; the studio passes `solver_jobs.LiveSolver`."""

    @property
    def process_id(self) -> int | None:
        """Number of the process that answers; another one, or None, once it was ended."""

    def solve(self, problem: MotionProblem, timeout: float) -> MotionResult:
        """Solves a problem and waits for the answer."""


@dataclass(frozen=True, eq=False)
class _Failure:
    result: MotionResult
    until: float


class LivePlans:
    """Solves gaits with the live tier and caches the last results and plans. Thread-safe.

    Args:
        tier: what solves.
        clock: s, for how long a failure is remembered.
    """

    def __init__(self, tier: LiveTier, clock: Callable[[], float] = time.monotonic) -> None:
        self._tier = tier
        self._clock = clock
        self._answered_by: int | None = None
        self._failures: OrderedDict[str, _Failure] = OrderedDict()
        self._lock = threading.Lock()
        self._asking = threading.Lock()
        self._results: OrderedDict[str, MotionResult] = OrderedDict()
        self._plans: OrderedDict[str, Plan] = OrderedDict()

    def solve_for(self, gait: Gait) -> Solve:
        """Returns a function that solves the gait's problems with the live tier, or takes cached results."""
        return partial(self._solve, motion_hash(gait))

    def _solve(self, gait: str, problem: MotionProblem) -> MotionResult:
        # A sequence asks for several problems: the steps between its parts, which differ by their ends.
        motion = f"{gait} {_ends(problem)}"
        # A page asks while the gait service asks for the same edit: the second finds the first one's answer.
        with self._asking:
            known = self._known(motion)
            if known is not None:
                return known
            result = self._ask(problem)
            # A solver that broke off says nothing about the gait, so that it is asked again after a while.
            if result.status in (SolveStatus.SOLVED, SolveStatus.INFEASIBLE):
                _remember(self._results, motion, result, MOST_RESULTS)
            else:
                failure = _Failure(result, self._clock() + FAILED_SECONDS)
                _remember(self._failures, motion, failure, MOST_RESULTS)
            return result

    def _known(self, motion: str) -> MotionResult | None:
        failure = self._failures.get(motion)
        if failure is not None and self._clock() < failure.until:
            return failure.result
        return self._results.get(motion)

    def _ask(self, problem: MotionProblem) -> MotionResult:
        """Solves with a long timeout if the process is new and still loads the solver, else a short one."""
        asked = self._tier.process_id
        is_warm = asked is not None and asked == self._answered_by
        result = self._tier.solve(problem, NEXT_SECONDS if is_warm else FIRST_SECONDS)
        if result.status is not SolveStatus.FAILED:
            self._answered_by = self._tier.process_id
        return result

    def keep(self, plan: Plan) -> Plan:
        """Keeps a plan for a while, so that its poses can be asked for by its hash."""
        with self._lock:
            _remember(self._plans, plan.session_hash, plan, MOST_PLANS)
        return plan

    def kept(self, plan_hash: str) -> Plan:
        """A plan that was kept.

        Raises:
            StateError: newer ones have taken its place.
        """
        with self._lock:
            if plan_hash not in self._plans:
                raise StateError("The plan changed meanwhile; ask for the new one.", "plan")
            return self._plans[plan_hash]

    def plan(self, gait: Gait) -> Plan:
        """Makes a gait's plan with the live tier and keeps it for a while (see `keep`)."""
        return self.keep(plan_of(gait, lambda motion: None, self.solve_for))

    def plan_with(self, gait: Gait, motion: MotionResult) -> Plan:
        """The plan of a gait whose motion the live tier has found already (see `plan`)."""
        problem = motion_problem(gait, load_robot(gait.robot))
        with self._asking:
            _remember(self._results, f"{motion_hash(gait)} {_ends(problem)}", motion, MOST_RESULTS)
        return self.plan(gait)

    def answer(self, gait: Gait) -> Json:
        """The plan that a gait would have, as JSON content.

        Raises:
            InputError: it makes no motion.
        """
        plan = self.plan(gait)
        if plan.trajectory is None and plan.refusal is not None:
            raise plan.refusal
        view = plan_view(plan)
        return {**_summary(view), "plan": view}


def changed_gait(before: Gait, document: Any | None) -> Gait:
    """A gait as a changed document says.

    Args:
        before: the gait as it is now.
        document: the changed document; None for the gait as it is.

    Raises:
        InputError: the document cannot be read.
        StateError: a locked cell would change.
    """
    return before if document is None else normalise(before, gait_from_content(document, "document"))[0]


def is_drawing(gait: Gait) -> bool:
    """Whether a gait's motion follows from its drawing alone."""
    return motion_source(gait) in (MotionSource.OPTIMISED, MotionSource.DRAWN)


def lacks_motion(gait: Gait, plan: Plan) -> bool:
    """Whether a drawing has no motion: it is refused, or the live tier finds none."""
    refused = plan.refusal is not None and plan.trajectory is None and is_drawing(gait)
    return refused or (plan.live is not None and plan.live.status is SolveStatus.INFEASIBLE)


def _ends(problem: MotionProblem) -> str:
    poses = (problem.start, problem.goal)
    return hashlib.sha256(
        b"".join(p.body_world.tobytes() + p.feet_world.tobytes() for p in poses)
    ).hexdigest()


def _summary(view: Json) -> Json:
    """The result in short; a gait made by hand has no live result."""
    if view["live"] is not None:
        return {"method": "live", **view["live"]}
    nothing: Json = {
        "seconds": 0.0,
        "evidence": None,
        "explanation": [],
        "lacks": [],
        "check": None,
    }
    return {"method": "table", "status": view["source"], **nothing}


def _remember(store: OrderedDict[str, Value], key: str, value: Value, most: int) -> None:
    store[key] = value
    store.move_to_end(key)
    while len(store) > most:
        store.popitem(last=False)
