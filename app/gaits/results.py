"""Results of solvers: where they are kept, and which gait takes one.

Only the command queue's thread calls this, but for `Results.of`.
"""

from collections.abc import Callable
from dataclasses import replace

from app.common.json import Json
from app.documents.gait_json import asked_hash, motion_hash
from app.gaits.open_gait import OpenGait, gait_text
from app.gaits.open_gaits import OpenGaits
from app.gaits.plan_cache import PlanCache
from app.plans.provenance import stored_result, with_found_poses, with_result
from app.plans.sequence_plan import run_motions, runs_without_result
from app.store.database import Database
from app.store.tables.result_store import ResultStore
from app.undo.history import Author
from core.gait.gait import Gait
from core.gait.provenance import Provenance
from core.pose_gaits.gait_poses import found_gait
from core.robot.model import load_robot

_SCRIPT = Author()
OPTIMISE = "Optimise"
"""What an edit is called that takes a result, or sets a recorded motion aside for one."""


class Results:
    """The stored results, and those that came too late for their gait.

    Args:
        database: where they are stored.
    """

    def __init__(self, database: Database) -> None:
        self._store = ResultStore(database)
        self._late: dict[tuple[str, str], Provenance] = {}

    def of(self, gait: Gait) -> Json | None:
        """The stored result that a document has. Thread-safe."""
        return stored_result(gait, self._store.get)

    def keep(self, content: Json) -> Provenance:
        """Stores a checked result of the exact tier."""
        provenance = Provenance(**content["provenance"])
        self._store.put(provenance.trajectory, content)
        return provenance

    def taken(self, gait_id: str, gait: Gait, provenance: Provenance) -> tuple[Gait, bool]:
        """A gait with the result that was computed for it, and whether it asks for that.

        Where it asks for something else by now, it stays as it is, and takes the result once an undo makes
        it ask for that again (see `with_late`).

        Args:
            gait_id: which gait.
            gait: its present document.
            provenance: of the result.
        """
        if provenance.motion not in _asked(gait):
            self.keep_late(gait_id, provenance)
            return gait, False
        return with_result(gait, provenance), True

    def keep_late(self, gait_id: str, provenance: Provenance) -> None:
        """Keeps a result for the time when its gait asks for it again."""
        self._late[gait_id, provenance.motion] = provenance

    def with_late(self, gait_id: str, gait: Gait) -> Gait:
        """A document that an undo or redo leads to, with the results that came too late for it."""
        for motion in _asked(gait):
            late = self._late.get((gait_id, motion))
            gait = gait if late is None else with_result(gait, late)
        return gait

    def keep_poses(self, motion: str, content: Json) -> None:
        """Stores what a search for poses ended with.

        Args:
            motion: hash of what was asked.
            content: the result as it is kept.
        """
        self._store.put(motion, content)

    def with_known_poses(self, gait: Gait) -> Gait:
        """The document with poses that were found for exactly what it asks, where its own are others."""
        motion = motion_hash(gait)
        content = self._store.get(motion) if lacks_poses(gait, motion) else None
        return gait if content is None else with_found_poses(gait, motion, content)


class ResultDelivery:
    """Stores results of solvers, and gives them to the open gaits.

    Args:
        results: where they are stored.
        open_gaits: the open gaits.
        plans: the newest plan of each gait.
        edit: applies a document as an edit that can be undone.
    """

    def __init__(
        self,
        results: Results,
        open_gaits: OpenGaits,
        plans: PlanCache,
        edit: Callable[[OpenGait, Gait, str, Author], OpenGait],
    ) -> None:
        self._results = results
        self._open_gaits = open_gaits
        self._plans = plans
        self._edit = edit

    def runs_without_result(self, open_gait: OpenGait) -> tuple[Gait, ...]:
        """The runs of a sequence, each once, that the exact tier can solve and of which it has no result."""
        return runs_without_result(open_gait.gait, self._results.of)

    def on_result(
        self, content: Json, gait_id: str | None = None, author: Author = _SCRIPT
    ) -> OpenGait | None:
        """Stores a checked result of the exact tier; the gait that it was asked for takes it, as an edit.

        Other gaits that ask the same keep their plans and approvals. A gait that changed meanwhile takes the
        result when an undo makes it ask for that again.

        Args:
            content: the result as it is kept, with its provenance.
            gait_id: the gait that it was asked for; None where it is only kept.
            author: who asked.

        Returns:
            The gait with the result; None where it did not take it.
        """
        provenance = self._results.keep(content)
        open_gait = None if gait_id is None else self._open_gaits.known(gait_id)
        if open_gait is None:
            if gait_id is not None:  # it is deleted, and may be brought back
                self._results.keep_late(gait_id, provenance)
            return None
        gait, is_asked = self._results.taken(open_gait.id, open_gait.gait, provenance)
        if gait != open_gait.gait:
            present = open_gait.history.present
            if present.label == OPTIMISE and present.author.page == author.page:
                return self._resulted(replace(open_gait, revision=open_gait.revision + 1), gait)
            return self._edit(open_gait, gait, OPTIMISE, author)
        plan = self._plans.known(open_gait)
        if not is_asked or (plan is not None and plan.result == provenance.trajectory):
            return None
        self._plans.drop(open_gait.id)  # it names this result already, which was not here
        # Where it was not planned yet, its approval is looked at with its plan.
        if plan is None:
            return open_gait
        return self._open_gaits.put(open_gait.unapproved("The motion was optimised"))

    def on_poses(self, motion: str, content: Json) -> tuple[OpenGait, ...]:
        """Stores what a search for poses ended with, for every gait that asks for it and has no poses yet.

        Args:
            motion: hash of what was asked.
            content: the result as it is kept.

        Returns:
            The open gaits among them.
        """
        self._results.keep_poses(motion, content)
        return tuple(
            self._with_poses(open_gait, with_found_poses(open_gait.gait, motion, content))
            for open_gait in self._open_gaits.all()
            if lacks_poses(open_gait.gait, motion)
        )

    def _with_poses(self, open_gait: OpenGait, gait: Gait) -> OpenGait:
        """The gait with poses in its present document, which are no edit of anybody."""
        if gait != open_gait.gait:
            return self._resulted(open_gait, gait)
        self._plans.drop(open_gait.id)
        return self._open_gaits.put(open_gait.unapproved("Its poses were sought"))

    def _resulted(self, open_gait: OpenGait, gait: Gait) -> OpenGait:
        """The gait with a result in its present document, as a part of the edit before."""
        self._plans.drop(open_gait.id)
        history = open_gait.history.restated(gait_text(gait))
        unapproved = open_gait.unapproved("The motion was optimised")
        return self._open_gaits.put(replace(unapproved, gait=gait, history=history))


def lacks_poses(gait: Gait, motion: str) -> bool:
    """Whether a gait asks for the poses of a hash, and has none that answer it."""
    if gait.poses is None or motion_hash(gait) != motion:
        return False
    return found_gait(gait, load_robot(gait.robot)) is None


def _asked(gait: Gait) -> frozenset[str]:
    """What a document's plan is solved for; nothing where it has a recorded motion."""
    if gait.recorded is not None:
        return frozenset()
    return run_motions(gait) if gait.sequence else frozenset({asked_hash(gait)})
