"""The open gaits: opening, editing, saving, planning, checking and approving.

Only the command queue's thread calls this.
"""

import time
from collections.abc import Callable
from dataclasses import replace

from app.common.json import Json
from app.documents.stored_gait import stored_gait
from app.gaits.approvals import ApprovalRequest, Approvals, approval_record, approved
from app.gaits.known_times import KnownTimes
from app.gaits.normalise import normalise, normalise_imported
from app.gaits.open_gait import OpenGait, gait_text
from app.gaits.plan_cache import PlanCache, PlanRequest
from app.gaits.recovery import GaitRecovery, WayOut
from app.gaits.repository import GaitRepository
from app.gaits.results import Results, lacks_poses
from app.gaits.trash import DeletedGait
from app.gaits.undo import merged_gait, without_unreadable
from app.gaits.versions import VersionKind, Versions
from app.gaits.views import require_line
from app.plans.plan import Plan, Solve, verdict_of
from app.plans.provenance import with_found_poses
from app.plans.sequence_plan import runs_without_result
from app.store.database import Database
from app.store.edit_history_store import EditHistoryStore, VersionRow
from app.store.gait_files import GaitFiles
from app.store.storage_errors import left_undone
from app.store.times_store import TimesStore
from app.undo.history import Author
from core.checks.simulation import Simulated
from core.errors import InputError, NotFoundError, StateError
from core.findings import Verdict
from core.gait.gait import Gait, drawn_timeline
from core.library.library import library
from core.library.sequence import derived

_SCRIPT = Author()
OPTIMISE = "Optimise"
"""What an edit is called that takes a result, or sets a recorded motion aside for one."""


class GaitService:
    """The open gaits.

    Args:
        files: the saved gaits.
        database: histories, results and approvals.
        solve_for: gives what asks the live tier for a gait.
        connected: gives the pages that are connected.
        clock: gives the time, s since the epoch.
        simulated_for: gives the simulation of exactly a plan's waypoints, where there is one.
    """

    def __init__(
        self,
        files: GaitFiles,
        database: Database,
        solve_for: Callable[[Gait], Solve],
        connected: Callable[[], frozenset[str]] = frozenset,
        clock: Callable[[], float] = time.time,
        simulated_for: Callable[[Plan], Simulated | None] = lambda plan: None,
    ) -> None:
        self._database = database
        self._simulated_for = simulated_for
        self._results = Results(database)
        self._plans = PlanCache(self._results.of, solve_for, self._verdict_of)
        self._connected = connected
        log = EditHistoryStore(database)
        self.versions = Versions(log, clock)
        self.approvals = Approvals(log)
        self.times = KnownTimes(TimesStore(database))
        self._repository = GaitRepository(files, log)
        self._recovery = GaitRecovery(self._repository, log, self.versions)
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
        return there.revision, there.gait.poses, self.times.last(gait_id)

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

    def recover(self, gait_id: str, author: Author = _SCRIPT) -> OpenGait:
        """Takes the way out of a gait that cannot be shown (see `GaitRecovery.recover`).

        Raises:
            StateError: it can be shown, or no state of it can.
        """
        if self._can_be_shown(gait_id):
            raise StateError(f"“{gait_id}” can be shown; Undo and Versions go back.", gait_id)
        recovered = self._recovery.recover(gait_id, author, self._others(author))
        self._close(gait_id)
        self._open[gait_id] = recovered
        return recovered

    def _is_recoverable(self, gait_id: str) -> bool:
        """Whether a gait cannot be shown and has a way out."""
        return not self._can_be_shown(gait_id) and self.way_out(gait_id) is not None

    def _can_be_shown(self, gait_id: str) -> bool:
        try:
            self.open_gait(gait_id)
        except NotFoundError:
            raise
        except InputError:
            return False
        return True

    def touched_by(self, page: str) -> tuple[OpenGait, ...]:
        """The gaits in memory that a page edited."""
        return tuple(gait for gait in self._open.values() if page in gait.history.pages)

    def document(self, gait_id: str) -> Gait:
        """The gait's document as it is now (see `open_gait`)."""
        return self.open_gait(gait_id).gait

    def sequences_with(self, gait_id: str) -> tuple[OpenGait, ...]:
        """The sequences in memory of which a gait is a part."""
        opened = self._open.values()
        return tuple(s for s in opened if any(part.source == gait_id for part in s.gait.sequence))

    def plan(self, gait_id: str) -> Plan:
        """The gait's current plan. Computes it in this thread if the revision has none yet."""
        return self._plan_of(self.open_gait(gait_id))

    def _plan_of(self, open_gait: OpenGait) -> Plan:
        plan = self._plans.of(open_gait)
        self._seen(open_gait, open_gait.with_plan(plan, self._verdict_of))
        return plan

    def _seen(self, before: OpenGait, now: OpenGait) -> None:
        """Takes a gait with its plan over, and keeps what that made of its approval.

        People can look at a gait even if the disk takes nothing: the same is found anew at each start.
        """
        self._open[now.id] = now
        plan = self._plans.known(now)
        if plan is not None:
            self.times.keep(now.id, now.gait, plan)
        if before.approval_text != now.approval_text:
            with left_undone(f"The approval of {now.id} is in the database as it was before"):
                self._put(now)

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

    def edit(
        self,
        gait_id: str,
        gait: Gait,
        label: str,
        revision: int | None,
        author: Author = _SCRIPT,
        edit: str = "",
    ) -> OpenGait:
        """Makes a changed document the present one, in memory and in the database.

        The document of a gait that cannot be shown is replaced like any other; it is kept as a version.

        Args:
            gait_id: which gait.
            gait: the changed document.
            label: what the edit is called.
            revision: that the edit was made on; None for any.
            author: whose edit it is.
            edit: the number that its page gave it. One that was made already is not made again.

        Raises:
            StateError: somebody else changed it since the given revision.
        """
        require_line(gait)
        if self._is_recoverable(gait_id):
            self.recover(gait_id, author)
            revision = None  # nobody can have seen the revision that was there
        open_gait = self.open_gait(gait_id)
        if open_gait.history.has(edit):
            return open_gait
        if revision is not None and revision != open_gait.revision:
            raise StateError(
                f"“{open_gait.gait.name}” was changed elsewhere; look at its new state and edit again.",
                "revision",
            )
        changed, notice = normalise(open_gait.gait, gait)
        if changed == open_gait.gait:
            return open_gait
        return self._edited(open_gait, changed, label or "Edit", author, notice, edit)

    def _edited(
        self,
        open_gait: OpenGait,
        gait: Gait,
        label: str,
        author: Author,
        notice: str | None = None,
        edit: str = "",
    ) -> OpenGait:
        gait = self._results.with_known_poses(gait)
        require_line(gait)
        version = self.versions.due(open_gait)
        history = open_gait.history.edited(gait_text(gait), label, author, self._others(author), edit)
        return self._put(open_gait.changed(history.pruned(), gait, notice), version)

    def _others(self, author: Author) -> frozenset[str]:
        return self._connected() - {author.page}

    def redraw(
        self,
        gait_id: str,
        order: tuple[int, ...],
        phase_knots: int,
        closing_knots: int,
        author: Author = _SCRIPT,
    ) -> OpenGait:
        """Draws the timeline anew from a foot order and phase lengths."""
        open_gait = self.open_gait(gait_id)
        options = replace(open_gait.gait.options, phase_knots=phase_knots, closing_knots=closing_knots)
        changed = replace(open_gait.gait, order=order, options=options)
        if changed.poses is None:
            changed = replace(changed, timeline=drawn_timeline(changed))
        return self.edit(gait_id, changed, f"Draw order {'-'.join(map(str, order))}", None, author)

    def undo(self, gait_id: str, author: Author = _SCRIPT) -> OpenGait:
        """Takes the author's newest edit back; the edits of others stay.

        A gait that cannot be shown goes back to the last state that can.

        Raises:
            StateError: there is none, or somebody changed the same since.
        """
        if self._is_recoverable(gait_id):
            return self.recover(gait_id, author)
        return self._stepped(gait_id, author, again=False)

    def redo(self, gait_id: str, author: Author = _SCRIPT) -> OpenGait:
        """Does the author's newest undone edit again (see `undo`)."""
        return self._stepped(gait_id, author, again=True)

    def _stepped(self, gait_id: str, author: Author, *, again: bool) -> OpenGait:
        """Undoes or redoes; documents on the way that cannot be shown are skipped, and become versions."""
        open_gait, others = self.open_gait(gait_id), self._others(author)
        history, skipped = without_unreadable(open_gait.history, others, again=again)
        try:
            step = history.redo(author, others) if again else history.undo(author, others)
        except StateError as error:
            raise StateError(
                " ".join((*(state.sentence for state in skipped), error.sentence)), error.where
            ) from error
        gait = self._results.with_late(gait_id, merged_gait(open_gait.gait, step))
        for state in skipped:
            self.versions.keep_unreadable(gait_id, state.position, state.document, author)
        notice = " ".join(state.sentence for state in skipped) or None
        history = history.stepped(step, gait_text(gait), author)
        return self._put(open_gait.changed(history.pruned(), gait, notice))

    def save(self, gait_id: str, author: Author = _SCRIPT) -> OpenGait:
        """Writes the present document to the data folder."""
        open_gait = self.open_gait(gait_id)
        self._open[gait_id] = self._repository.write(
            open_gait, lambda saved: self.versions.keep(saved, VersionKind.SAVED, author)
        )
        return self._open[gait_id]

    def take_file(self, gait_id: str, author: Author = _SCRIPT) -> OpenGait:
        """Makes the document in a gait's file the present one, as an edit that can be undone.

        Raises:
            InputError: the file cannot be read.
            StateError: there is none.
        """
        open_gait, theirs = self.open_gait(gait_id), self._repository.theirs(gait_id)
        require_line(theirs)
        self.versions.keep(open_gait, VersionKind.BEFORE_RESTORE, author)
        taken = open_gait
        if theirs != open_gait.gait:
            taken = self._edited(open_gait, theirs, "Take the file over", author)
        self.versions.keep(taken, VersionKind.SAVED, author)
        self._open[gait_id] = self._repository.taken_over(taken)
        return self._open[gait_id]

    def keep_mine(self, gait_id: str) -> OpenGait:
        """Writes what the studio saved last over a file that was changed outside; that file is set aside.

        Raises:
            StateError: the file was not changed.
            StorageError: the disk does not take it.
        """
        open_gait = self.open_gait(gait_id)
        if self.outside(gait_id) is None:
            raise StateError(f"{gait_id}.json has not been changed outside the studio.", "keep")
        self._open[gait_id] = self._repository.keep_mine(open_gait)
        return self._open[gait_id]

    def restore_version(self, gait_id: str, number: int, author: Author = _SCRIPT) -> OpenGait:
        """Makes a version's document the present one again, as an edit that can be undone.

        Raises:
            NotFoundError: there is none of that number.
        """
        open_gait = self.open_gait(gait_id)
        gait = stored_gait(self.versions.get(gait_id, number).document, f"version {number}").gait
        if gait == open_gait.gait:
            return open_gait
        self.versions.keep(open_gait, VersionKind.BEFORE_RESTORE, author)
        return self._edited(open_gait, gait, f"Restore version {number}", author)

    def create(self, gait: Gait) -> OpenGait:
        """Adds a gait under a new id made from its name, and saves it."""
        gait, notice = normalise_imported(derived(gait) if gait.sequence else gait)
        require_line(gait)
        added = self._repository.add(
            gait, frozenset(self._open), lambda saved: self.versions.keep(saved, VersionKind.SAVED)
        )
        created = replace(added, notice=notice)
        self._open[created.id] = created
        return created

    def delete(self, gait_id: str) -> OpenGait | None:
        """Takes a saved gait away; `restore` brings it back.

        Returns:
            The gait that comes with the program under that id; None where none does.

        Raises:
            StateError: the gait comes with the program and was not saved over.
        """
        if not self._can_be_shown(gait_id):
            return self._delete_unreadable(gait_id)
        open_gait = self.open_gait(gait_id)
        if open_gait.saved_at is None:
            raise StateError(
                f"“{open_gait.gait.name}” comes with the program and cannot be deleted; "
                "undo takes edits back.",
                gait_id,
            )
        self.versions.keep(open_gait, VersionKind.BEFORE_DELETE)
        self._repository.remove(gait_id)
        self._close(gait_id)
        return self._return(gait_id, "Delete what was saved") if open_gait.builtin else None

    def _delete_unreadable(self, gait_id: str) -> OpenGait | None:
        if self._repository.has_file(gait_id):
            self._repository.remove(gait_id)
        self._close(gait_id)
        if gait_id not in library():
            return None
        return self.open_gait(gait_id) if self._can_be_shown(gait_id) else self.recover(gait_id)

    def deleted(self) -> tuple[DeletedGait, ...]:
        """What `restore` can bring back, the last deleted first."""
        return self._repository.deleted()

    def restore(self, gait_id: str) -> OpenGait:
        """Brings a deleted gait back with its unsaved edits and its history; it needs a new approval.

        One that cannot be shown comes back in the last state that can.

        Raises:
            InputError: it is back, and no state of it can be shown.
        """
        had_approval = self._repository.restore(gait_id)
        self._close(gait_id)
        if self._is_recoverable(gait_id):
            self.recover(gait_id)
        if had_approval:
            revoked = "The gait was deleted and brought back, so it is no longer approved."
            self._open[gait_id] = replace(self.open_gait(gait_id), revoked=revoked)
        return (
            self._return(gait_id, "Bring back what was saved")
            if gait_id in library()
            else self.open_gait(gait_id)
        )

    def _return(self, gait_id: str, label: str) -> OpenGait:
        """Goes back to what is saved or built in now, as an edit that can be undone."""
        open_gait = self.open_gait(gait_id)
        if open_gait.saved is None or open_gait.gait == open_gait.saved:
            return open_gait
        self.versions.keep(open_gait, VersionKind.BEFORE_RESTORE)
        return self._edited(open_gait, open_gait.saved, label, _SCRIPT)

    def _close(self, gait_id: str) -> None:
        self._open.pop(gait_id, None)
        self._plans.drop(gait_id)

    def check(self, gait_id: str) -> OpenGait:
        """Checks the present plan by every rule; an approval of another verdict is gone."""
        self.ask_again(gait_id)
        open_gait = self.confirmed(gait_id)
        self._open[gait_id] = replace(open_gait, verdict=self._verdict_of(self.plan(gait_id), open_gait.gait))
        return self._open[gait_id]

    def confirmed(self, gait_id: str) -> OpenGait:
        """The gait, without its approval where the verdict of this moment is not the approved one."""
        plan, open_gait = self.plan(gait_id), self.open_gait(gait_id)
        confirmed = open_gait.confirmed(plan, self._verdict_of)
        return open_gait if confirmed is open_gait else self._put(confirmed)

    def _verdict_of(self, plan: Plan, gait: Gait) -> Verdict:
        return verdict_of(plan, gait, self._simulated_for(plan))

    def approve(self, gait_id: str, request: ApprovalRequest) -> OpenGait:
        """Records a person's approval of the present verdict; see `app.gaits.approvals.approved`."""
        plan, open_gait = self.plan(gait_id), self.open_gait(gait_id)
        approval, verdict = approved(open_gait, plan, self._verdict_of, request)
        version = self.versions.made(open_gait, VersionKind.APPROVED, Author(name=request.by))
        number = self.versions.newest_number(gait_id) if version is None else version.number
        record = approval_record(approval, number, plan, verdict)
        return self._put(replace(open_gait, approval=approval, revoked=None), version, record)

    def on_simulated(self, waypoints_hash: str) -> tuple[OpenGait, ...]:
        """Revokes verdict and approval of each open gait that was simulated since; returns these gaits."""
        checked = tuple(self._open.values())
        touched = [g for g in checked if g.verdict and g.verdict.waypoints_hash == waypoints_hash]
        return tuple(self._put(gait.unapproved("It was simulated since")) for gait in touched)

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
        open_gait = None if gait_id is None else self._open.get(gait_id)
        if open_gait is None:
            if gait_id is not None:  # it is deleted, and may be brought back
                self._results.keep_late(gait_id, provenance)
            return None
        gait, is_asked = self._results.taken(open_gait.id, open_gait.gait, provenance)
        if gait != open_gait.gait:
            present = open_gait.history.present
            if present.label == OPTIMISE and present.author.page == author.page:
                return self._resulted(replace(open_gait, revision=open_gait.revision + 1), gait)
            return self._edited(open_gait, gait, OPTIMISE, author)
        plan = self._plans.known(open_gait)
        if not is_asked or (plan is not None and plan.result == provenance.trajectory):
            return None
        self._plans.drop(open_gait.id)  # it names this result already, which was not here
        # Where it was not planned yet, its approval is looked at with its plan.
        return open_gait if plan is None else self._put(open_gait.unapproved("The motion was optimised"))

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
            for open_gait in tuple(self._open.values())
            if lacks_poses(open_gait.gait, motion)
        )

    def _with_poses(self, open_gait: OpenGait, gait: Gait) -> OpenGait:
        """The gait with poses in its present document, which are no edit of anybody."""
        if gait != open_gait.gait:
            return self._resulted(open_gait, gait)
        self._plans.drop(open_gait.id)
        return self._put(open_gait.unapproved("Its poses were sought"))

    def _resulted(self, open_gait: OpenGait, gait: Gait) -> OpenGait:
        """The gait with a result in its present document, as a part of the edit before."""
        self._plans.drop(open_gait.id)
        history = open_gait.history.restated(gait_text(gait))
        unapproved = open_gait.unapproved("The motion was optimised")
        return self._put(replace(unapproved, gait=gait, history=history))

    def _put(
        self, open_gait: OpenGait, version: VersionRow | None = None, record: Json | None = None
    ) -> OpenGait:
        """Keeps a changed gait, in memory and in the repository, with its version and approval record."""
        self._repository.put(open_gait, version, record)
        self._open[open_gait.id] = open_gait
        return open_gait
