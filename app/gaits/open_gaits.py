"""The open gaits in memory, each with its plan and its state beside what is saved.

Only the command queue's thread calls this, but for `OpenGaits.planned`.
"""

from app.common.json import Json
from app.gaits.known_times import KnownTimes
from app.gaits.open_gait import OpenGait
from app.gaits.plan_cache import PlanCache, PlanRequest
from app.gaits.recovery import GaitRecovery, WayOut
from app.gaits.repository import GaitRepository
from app.plans.plan import Plan
from app.store.storage_errors import left_undone
from app.store.tables.edit_history_store import VersionRow
from core.errors import InputError, NotFoundError
from core.gait.gait import Gait


class OpenGaits:
    """Opens gaits, keeps them in memory, and plans them; `GaitService` changes them.

    Args:
        repository: the gaits as they are kept.
        recovery: the ways out of gaits that cannot be shown.
        plans: the newest plan of each gait.
        times: the robot times of gaits; records those of each plan.
    """

    def __init__(
        self, repository: GaitRepository, recovery: GaitRecovery, plans: PlanCache, times: KnownTimes
    ) -> None:
        self._repository = repository
        self._recovery = recovery
        self._plans = plans
        self._times = times
        self._open: dict[str, OpenGait] = {}

    def marks(self) -> dict[str, tuple[object, ...]]:
        """Built-in gaits first, then saved ones; each with what changes whenever its line in a list may."""
        stamps = self._repository.stamps()
        ids = dict.fromkeys((*stamps, *self._open))
        return {gait_id: (stamps.get(gait_id), self._mark_of(gait_id)) for gait_id in ids}

    def _mark_of(self, gait_id: str) -> tuple[object, ...] | None:
        there = self._open.get(gait_id)
        if there is None:
            return None
        # Poses that a search found are no edit, so that they make no revision.
        return there.revision, there.gait.poses, self._times.last(gait_id)

    def glance(self, gait_id: str) -> tuple[Gait, bool, bool]:
        """A gait's present document, whether it is built in, and whether it is edited; not its history."""
        open_gait = self._open.get(gait_id)
        if open_gait is not None:
            return open_gait.gait, open_gait.builtin, open_gait.edited
        return self._repository.glance(gait_id)

    def outside(self, gait_id: str) -> str | None:
        """How a gait's file differs from what the studio saved, in a sentence; None where it does not."""
        open_gait = self._open.get(gait_id)
        if open_gait is None:
            return self._repository.outside_of(gait_id)
        try:
            return self._repository.outside(open_gait)
        except InputError as error:
            return f"{error.sentence} It was changed outside the studio. Keep yours to write it again."

    def misnamed(self) -> tuple[str, ...]:
        """JSON files beside the gaits whose names are no ids."""
        return self._repository.misnamed()

    def open_gait(self, gait_id: str) -> OpenGait:
        """The gait's present state.

        Raises:
            NotFoundError: there is none of that id.
            InputError: it cannot be shown; the sentence names the way out.
        """
        if gait_id not in self._open:
            try:
                self._open[gait_id] = self._repository.gait(gait_id)
            except NotFoundError:
                raise
            except InputError as error:
                sentence = f"“{gait_id}” cannot be shown: {error.sentence}"
                if self._recovery.way_out(gait_id) is not None:
                    way = f"Choose it in the list of gaits, or call POST /api/gaits/{gait_id}/recover."
                    sentence = f"{sentence} {way}"
                raise InputError(sentence, error.where) from error
        return self._open[gait_id]

    def way_out(self, gait_id: str) -> WayOut | None:
        """What can be done about a gait that cannot be shown; None where it can only be deleted."""
        return self._recovery.way_out(gait_id)

    def can_be_shown(self, gait_id: str) -> bool:
        """Whether `open_gait` gives a gait of this id.

        Raises:
            NotFoundError: there is none.
        """
        try:
            self.open_gait(gait_id)
        except NotFoundError:
            raise
        except InputError:
            return False
        return True

    def known(self, gait_id: str) -> OpenGait | None:
        """A gait if it is in memory already."""
        return self._open.get(gait_id)

    def all(self) -> tuple[OpenGait, ...]:
        """The gaits in memory."""
        return tuple(self._open.values())

    def touched_by(self, page: str) -> tuple[OpenGait, ...]:
        """The gaits in memory that a page edited."""
        return tuple(gait for gait in self._open.values() if page in gait.history.pages)

    def sequences_with(self, gait_id: str) -> tuple[OpenGait, ...]:
        """The sequences in memory of which a gait is a part."""
        opened = self._open.values()
        return tuple(s for s in opened if any(part.source == gait_id for part in s.gait.sequence))

    def plan(self, gait_id: str) -> Plan:
        """The gait's current plan. Computes it in this thread if the revision has none yet."""
        return self._plan_of(self.open_gait(gait_id))

    def _plan_of(self, open_gait: OpenGait) -> Plan:
        plan = self._plans.of(open_gait)
        self._seen(open_gait, open_gait.with_plan(plan, self._plans.verdict_of))
        return plan

    def _seen(self, before: OpenGait, now: OpenGait) -> None:
        """Takes a gait with its plan over, and keeps what that made of its approval.

        People can look at a gait even if the disk takes nothing: the same is found anew at each start.
        """
        self._open[now.id] = now
        plan = self._plans.known(now)
        if plan is not None:
            self._times.keep(now.id, now.gait, plan)
        if before.approval_text != now.approval_text:
            with left_undone(f"The approval of {now.id} is in the database as it was before"):
                self.put(now)

    def planned(self, gait: Gait) -> Plan:
        """Computes the plan of any document, also one that no gait has now. Thread-safe."""
        return self._plans.made(gait)

    def unplanned(self, gait_id: str, *, retry: bool = False) -> PlanRequest | None:
        """What is to be planned before the gait's plan is known; None where it is.

        Args:
            gait_id: which gait.
            retry: whether a solver that broke off is to be asked again.
        """
        open_gait = self.open_gait(gait_id)
        asked = self._plans.unplanned(open_gait, retry=retry)
        if asked is None:
            self._plan_of(open_gait)
        return asked

    def on_plan(self, asked: PlanRequest, plan: Plan) -> None:
        """Takes over a plan that was made elsewhere, unless the gait or its results changed meanwhile."""
        now = self._open.get(asked.open_gait.id)
        if now is not None:
            self._seen(now, self._plans.taken(asked, plan, now))

    def ask_again(self, gait_id: str) -> None:
        """Plans again if the live tier broke off; the verdict on the old plan is dropped."""
        self.plan(gait_id)
        asked = self.unplanned(gait_id, retry=True)
        if asked is not None:
            self.on_plan(asked, self.planned(asked.open_gait.gait))

    def close(self, gait_id: str) -> None:
        """Forgets a gait and its plan; it is read again when it is opened next."""
        self._open.pop(gait_id, None)
        self._plans.drop(gait_id)

    def keep(self, open_gait: OpenGait) -> OpenGait:
        """Keeps a gait in memory alone."""
        self._open[open_gait.id] = open_gait
        return open_gait

    def put(
        self, open_gait: OpenGait, version: VersionRow | None = None, record: Json | None = None
    ) -> OpenGait:
        """Keeps a changed gait, in memory and in the repository, with its version and approval record."""
        self._repository.put(open_gait, version, record)
        return self.keep(open_gait)
