"""One search for remedies: first the live tier's, then the finished drawing, with physics behind them."""

import logging
import queue
import threading
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Protocol

import numpy as np

from app.common.json import Json
from app.gaits.live_plans import LivePlans
from app.plans.plan import Plan, PlanSource, verdict_of
from app.remedies.views import Change, Tried, remedy_view
from app.simulation.problem import simulation_problem
from app.simulation.repository import SimulationRepository, SimulationResult, simulation_row
from core.checks.simulation import Simulated
from core.errors import FootfallError, SimulationCancelledError
from core.findings import Severity
from core.gait.gait import Gait
from core.gait.recording import Recording
from core.patterns.problem import PatternProblem, PatternResult
from core.physics.findings import SIMULATED_ROCKING, physics_outcomes
from core.physics.masses import default_physics
from core.physics.metrics import report
from core.physics.problem import SimulationProblem
from core.physics.report import SimulationReport
from core.recorded.fit_choices import FitChoice, fit_choices
from core.robot.model import load_robot
from solver_jobs import (
    MOST_REMEDIES,
    Limit,
    Remedy,
    RemedySearch,
    SolveStatus,
    Trouble,
    completed_drawing,
    completion_question,
    completion_remedy,
    nothing_words,
    rank,
)

_log = logging.getLogger(__name__)

COMPLETION_SECONDS = 2.0
"""How long a drawing may take to be finished."""


class RemedyTier(Protocol):
    """Interface to what finds remedies; the studio passes `solver_jobs.LiveSolver`."""

    def remedies(
        self, gait: Gait, tell: Callable[[Remedy], object], *, tips: bool, go_on: Callable[[], bool]
    ) -> RemedySearch:
        """Searches while `go_on` is true; calls back with each remedy as it is found."""

    def limit(self, gait: Gait, which: Limit) -> float | None:
        """How far one number can go, m or rad."""


class CompletionHandle(Protocol):
    """A search for a pattern; `solver_jobs.PatternSearch` in the studio."""

    def result(self) -> PatternResult:
        """Waits for its answer."""

    def use_now(self) -> None:
        """Ends it with the best pattern yet."""

    def when_done(self, tell: Callable[[], object]) -> None:
        """Calls back once the answer is there."""


class CompletionTier(Protocol):
    """Interface to the pattern solver; the studio passes `solver_jobs.PatternSolver`."""

    def submit(self, problem: PatternProblem, *, seconds: float) -> CompletionHandle:
        """Begins a search."""


class PhysicsHandle(Protocol):
    """A simulation under way; `solver_jobs.Simulation` in the studio."""

    def result(self) -> SimulationResult:
        """Waits for its answer."""

    def cancel(self) -> None:
        """Ends it."""

    def when_done(self, tell: Callable[[], object]) -> None:
        """Calls back once the answer is there."""


class PhysicsTier(Protocol):
    """Interface to the simulator; the studio passes `solver_jobs.Simulator`."""

    def submit(self, problem: SimulationProblem) -> PhysicsHandle:
        """Begins a simulation."""


@dataclass(frozen=True, eq=False)
class RemedyParts:
    """The services that a search uses, and the store of simulations."""

    live: LivePlans
    tier: RemedyTier
    patterns: CompletionTier
    simulator: PhysicsTier
    simulations: SimulationRepository


Rank = tuple[bool, bool, float]
"""Sort key of a change; smaller is better (see `rank`)."""


@dataclass(eq=False)
class _Offer:
    """A change with its plan, and what physics says of it."""

    change: Change
    plan: Plan
    rank: Rank
    tried: Tried | None = None

    @property
    def is_untried(self) -> bool:
        """Whether physics can still say something of it."""
        return self.tried is None and self.plan.way is not None


class RemedyRun:
    """A search in threads of its own.

    Args:
        gait: one without a motion or one that tips, or a recorded one that does not fit the robot.
        tips: whether it has a motion and tips.
        parts: what is used.
        show: told of each state as JSON content, and None at the end; from a thread of the run's.
    """

    def __init__(
        self, gait: Gait, parts: RemedyParts, show: Callable[[Json | None], object], *, tips: bool
    ) -> None:
        self._gait, self._parts, self._show, self._tips = gait, parts, show, tips
        self._model = load_robot(gait.robot)
        self._events: queue.SimpleQueue[Callable[[], None] | None] = queue.SimpleQueue()
        self._cancelled = threading.Event()
        self._offers: list[_Offer] = []
        self._is_searching, self._is_complete = True, False
        self._completion: CompletionHandle | None = None
        self._simulation: PhysicsHandle | None = None

    def start(self) -> None:
        """Begins."""
        threading.Thread(target=self._work, name="remedies", daemon=True).start()
        threading.Thread(target=self._search, name="remedy-search", daemon=True).start()

    def cancel(self) -> None:
        """Ends it; nothing more is shown but the end."""
        self._cancelled.set()
        self._events.put(None)

    def _work(self) -> None:
        """Does one event after the other until nothing is left to do."""
        try:
            while self._is_searching or self._completion is not None or self._simulation is not None:
                act = self._events.get()
                if act is None or self._cancelled.is_set():
                    break
                act()
                self._try_next()
                self._show(self._content())
        except Exception:
            # A bug here must not leave a page waiting.
            _log.exception("The search for remedies broke off.")
        finally:
            self._cancelled.set()
            if self._completion is not None:
                self._completion.use_now()
            if self._simulation is not None:
                self._simulation.cancel()
            self._show(None)

    def _search(self) -> None:
        """The live tier's search, or the ways to keep a recorded motion."""
        if self._gait.recorded is not None:
            self._later(partial(self._searched, RemedySearch((), complete=self._keep(self._gait.recorded))))
            return
        result = self._parts.tier.remedies(
            self._gait,
            lambda remedy: self._later(partial(self._found, remedy)),
            tips=self._tips,
            go_on=lambda: not self._cancelled.is_set(),
        )
        self._later(partial(self._searched, result))

    def _keep(self, recording: Recording) -> bool:
        """Looks for ways to keep a recorded motion; whether it came to its end."""
        try:
            for way in fit_choices(self._gait, recording):
                if self._cancelled.is_set():
                    return False
                self._later(partial(self._kept, way))
        except FootfallError as error:
            _log.info("The search for ways to keep a recording was cut short: %s", error)
            return False
        return True

    def _later(self, act: Callable[[], None]) -> None:
        self._events.put(act)

    def _found(self, remedy: Remedy) -> None:
        """Plans a remedy in full; one that makes no plan to send is not offered."""
        plan = self._parts.live.plan_with(remedy.gait, remedy.motion)
        if plan.live is not None and plan.live.status is SolveStatus.SOLVED and plan.way is not None:
            self._offer(remedy, plan, rank(self._gait, self._model, remedy))

    def _kept(self, way: FitChoice) -> None:
        """Plans a way to keep a recorded motion; the least change comes first."""
        plan = self._parts.live.plan(way.gait)
        if plan.source is PlanSource.RECORDED:
            self._offer(way, plan, (False, False, len(self._offers)))

    def _offer(self, change: Change, plan: Plan, order: Rank) -> None:
        """Offers a change; one that comes again is not offered twice."""
        if not any(offer.change.gait == change.gait for offer in self._offers):
            self._offers.append(_Offer(change, plan, order))

    def _searched(self, result: RemedySearch) -> None:
        self._is_searching, self._is_complete = False, result.complete
        question = completion_question(self._gait, self._model) if result.trouble is Trouble.SHAPE else None
        if question is None:
            return
        handle = self._parts.patterns.submit(question, seconds=COMPLETION_SECONDS)
        self._completion = handle
        # Without an answer in time it would go on to explain why there is none.
        timer = threading.Timer(COMPLETION_SECONDS, handle.use_now)
        timer.daemon = True
        timer.start()
        handle.when_done(lambda: self._later(partial(self._finished, handle)))

    def _finished(self, handle: CompletionHandle) -> None:
        """Offers the finished drawing where it has a motion."""
        self._completion = None
        try:
            patterns = handle.result().patterns
        except FootfallError as error:
            # Such as another search for patterns, which took its place.
            _log.info("The search for footfalls near the drawing was cut short: %s", error)
            self._is_complete = False
            return
        if not patterns:
            return
        try:
            gait = completed_drawing(self._gait, self._model, patterns[0].stance)
        except FootfallError as error:
            _log.info("The drawing was not finished: %s", error)
            return
        live = self._parts.live.plan(gait).live
        if live is not None and live.status is SolveStatus.SOLVED:
            self._found(completion_remedy(self._gait, gait, self._model, live.result))

    def _shown(self) -> list[_Offer]:
        """The best offers: what physics refuses comes last."""

        def key(offer: _Offer) -> tuple[bool, Rank]:
            return offer.tried is not None and offer.tried.walks is False, offer.rank

        return sorted(self._offers, key=key)[:MOST_REMEDIES]

    def _try_next(self) -> None:
        """Begins to simulate the best offer that was not tried yet, once the search is over."""
        if self._is_searching or self._simulation is not None:
            return
        offer = next((one for one in self._shown() if one.is_untried), None)
        if offer is None:
            return
        known = self._parts.simulations.simulated(offer.plan)
        if known is not None and known.problem.physics == default_physics(self._model):
            offer.tried = _tried(offer, known.report, known.problem)
            self._try_next()
            return
        problem = simulation_problem(offer.plan, default_physics(self._model))
        handle = self._parts.simulator.submit(problem)
        self._simulation = handle
        handle.when_done(lambda: self._later(partial(self._simulated, offer, problem, handle)))

    def _simulated(self, offer: _Offer, problem: SimulationProblem, handle: PhysicsHandle) -> None:
        self._simulation = None
        try:
            answer = handle.result()
            figures = report(problem, answer.motion)
            if self._gait.recorded is not None:
                # Of drawings every edit leads to other remedies: they would crowd out what people asked for.
                self._parts.simulations.keep(simulation_row(offer.plan, problem), problem, answer)
        except SimulationCancelledError:
            offer.tried = Tried(walks=None, sentence="The simulation was cancelled.")
        except FootfallError as error:
            offer.tried = Tried(walks=None, sentence=error.sentence)
        else:
            offer.tried = _tried(offer, figures, problem)

    def _content(self) -> Json:
        offers = self._shown()
        is_over = self._is_complete and self._completion is None
        return {
            "remedies": [remedy_view(one.change, one.plan, one.tried) for one in offers],
            "searching": self._is_searching,
            "trying": any(one.is_untried for one in offers) or self._completion is not None,
            "complete": self._is_complete,
            "sentence": self._nothing_words() if is_over and not offers else "",
        }

    def _nothing_words(self) -> str:
        if self._gait.recorded is None:
            return nothing_words(self._gait)
        return (
            "Neither clipping nor raising, lowering or scaling brings this motion within the motors' range. "
            "Record it anew, or press Optimise, which computes another motion."
        )


def _tried(offer: _Offer, figures: SimulationReport, problem: SimulationProblem) -> Tried:
    """The result in physics: the first error, or how far the robot leans; for a recording also the check."""
    findings = [one for outcome in physics_outcomes(figures, problem) for one in outcome.findings]
    errors = [one.sentence for one in findings if one.severity is Severity.ERROR]
    rocks = any(one.rule in SIMULATED_ROCKING for one in findings)
    leans = f"It leans by up to {np.degrees(figures.max_tilt):.1f}° and does not fall."
    said = [leans] if rocks else []
    if offer.plan.source is PlanSource.RECORDED:
        verdict = verdict_of(offer.plan, offer.change.gait, Simulated(figures, problem))
        broken = ", ".join(sorted({error.rule for error in verdict.errors}))
        said += [f"The check finds errors then ({broken}); a person may override them."] if broken else []
    return Tried(not errors, errors[0] if errors else " ".join(said))
