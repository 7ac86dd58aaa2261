"""Caches the plans of open gaits; each revision is planned once."""

from collections.abc import Callable
from dataclasses import dataclass

from app.gaits.open_gait import OpenGait, VerdictOf
from app.plans.make_plan import Solve
from app.plans.plan import Plan
from app.plans.sequence_plan import ResultFor, plan_of
from core.gait.gait import Gait


@dataclass(frozen=True, eq=False)
class PlanRequest:
    """A request to make a gait's plan, with a count that detects plans dropped meanwhile."""

    open_gait: OpenGait
    dropped: int


class PlanCache:
    """The newest plan of each open gait.

    Args:
        result_for: gives the stored result that a document has.
        solve_for: gives what asks the live tier for a gait.
        verdict_of: checks a plan as everything stands now.
    """

    def __init__(
        self, result_for: ResultFor, solve_for: Callable[[Gait], Solve], verdict_of: VerdictOf
    ) -> None:
        self._result_for = result_for
        self.verdict_of = verdict_of
        self._solve_for = solve_for
        self._plans: dict[str, tuple[int, Plan]] = {}
        self._dropped: dict[str, int] = {}

    def made(self, gait: Gait) -> Plan:
        """Computes a document's plan now. Thread-safe."""
        return plan_of(gait, self._result_for, self._solve_for)

    def known(self, open_gait: OpenGait) -> Plan | None:
        """The plan of the gait's present revision, where it was made already."""
        revision, plan = self._plans.get(open_gait.id, (None, None))
        return plan if revision == open_gait.revision else None

    def of(self, open_gait: OpenGait) -> Plan:
        """The plan of the gait's present revision, made where it is not known."""
        plan = self.known(open_gait)
        if plan is None:
            plan = self.made(open_gait.gait)
            self.keep(open_gait, plan)
        return plan

    def keep(self, open_gait: OpenGait, plan: Plan) -> None:
        """Takes a plan over that was made of the gait's present revision."""
        self._plans[open_gait.id] = (open_gait.revision, plan)

    def drop(self, gait_id: str) -> None:
        """Forgets a gait's plan; one that is being made just now is not taken over either."""
        self._plans.pop(gait_id, None)
        self._dropped[gait_id] = self._dropped.get(gait_id, 0) + 1

    def unplanned(self, open_gait: OpenGait, *, retry: bool = False) -> PlanRequest | None:
        """The plan that has to be made first, or None if the gait's plan is known.

        Args:
            open_gait: the gait.
            retry: whether a solver that broke off is to be asked again.
        """
        known = self.known(open_gait)
        if known is not None and not (retry and known.broke_off):
            return None
        return PlanRequest(open_gait, self._dropped.get(open_gait.id, 0))

    def taken(self, asked: PlanRequest, plan: Plan, now: OpenGait) -> OpenGait:
        """The gait with a plan that was made elsewhere; as it is where gait or results changed meanwhile.

        Where it would send something else than before, what was found of the old one is gone.
        """
        dropped = self._dropped.get(now.id, 0)
        if now.revision != asked.open_gait.revision or dropped != asked.dropped:
            return now
        before = self.known(now)
        self.keep(now, plan)
        if before is not None and before.approvable != plan.approvable:
            now = now.unapproved("The plan is another one than before")
        return now.with_plan(plan, self.verdict_of)
