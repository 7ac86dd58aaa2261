"""Changes of the open gaits: editing, undoing, saving, deleting, checking and approving.

Only the command queue's thread calls this.
"""

import time
from collections.abc import Callable
from dataclasses import replace

from app.documents.stored_gait import stored_gait
from app.gaits.approvals import ApprovalRequest, Approvals, approval_record, approved
from app.gaits.known_times import KnownTimes
from app.gaits.normalise import normalise, normalise_imported
from app.gaits.open_gait import OpenGait, gait_text
from app.gaits.open_gaits import OpenGaits
from app.gaits.plan_cache import PlanCache
from app.gaits.recovery import GaitRecovery
from app.gaits.repository import GaitRepository
from app.gaits.results import ResultDelivery, Results
from app.gaits.trash import DeletedGait, RestoredUnshownError
from app.gaits.undo import merged_gait, without_unreadable
from app.gaits.versions import VersionKind, Versions
from app.gaits.views import require_line
from app.plans.make_plan import Solve
from app.plans.plan import Plan, verdict_of
from app.store.database import Database
from app.store.gait_files import GaitFiles
from app.store.tables.edit_history_store import EditHistoryStore
from app.store.tables.times_store import TimesStore
from app.undo.history import Author
from core.checks.simulation import Simulated
from core.errors import InputError, StateError
from core.findings import Verdict
from core.gait.gait import Gait, drawn_timeline
from core.library.library import library
from core.library.sequence import derived

_SCRIPT = Author()


class GaitService:
    """Changes the open gaits.

    Args:
        files: the saved gaits.
        database: histories, results and approvals.
        solve_for: gives what asks the live tier for a gait.
        connected: gives the pages that are connected.
        clock: gives the time, s since the epoch.
        simulated_for: gives the simulation of exactly a plan's waypoints, where there is one.

    Attributes:
        open_gaits: the gaits in memory with their plans.
        delivery: gives results of solvers to them.
        versions: of their documents.
        approvals: the record of their approvals.
        times: how long the robot takes for them.
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
        self._simulated_for = simulated_for
        self._results = Results(database)
        plans = PlanCache(self._results.of, solve_for, self._verdict_of)
        self._connected = connected
        log = EditHistoryStore(database)
        self.versions = Versions(log, clock)
        self.approvals = Approvals(log)
        self.times = KnownTimes(TimesStore(database))
        self._repository = GaitRepository(files, log)
        self._recovery = GaitRecovery(self._repository, log, self.versions)
        self.open_gaits = OpenGaits(self._repository, self._recovery, plans, self.times)
        self.delivery = ResultDelivery(self._results, self.open_gaits, plans, self._edited)

    def open_gait(self, gait_id: str) -> OpenGait:
        """The gait's present state (see `OpenGaits.open_gait`)."""
        return self.open_gaits.open_gait(gait_id)

    def document(self, gait_id: str) -> Gait:
        """The gait's document as it is now (see `open_gait`)."""
        return self.open_gait(gait_id).gait

    def plan(self, gait_id: str) -> Plan:
        """The gait's current plan (see `OpenGaits.plan`)."""
        return self.open_gaits.plan(gait_id)

    def recover(self, gait_id: str, author: Author = _SCRIPT) -> OpenGait:
        """Takes the way out of a gait that cannot be shown (see `GaitRecovery.recover`).

        Raises:
            StateError: it can be shown, or no state of it can.
        """
        if self.open_gaits.can_be_shown(gait_id):
            raise StateError(f"“{gait_id}” can be shown; Undo and Versions go back.", gait_id)
        recovered = self._recovery.recover(gait_id, author, self._others(author))
        self.open_gaits.close(gait_id)
        return self.open_gaits.keep(recovered)

    def _is_recoverable(self, gait_id: str) -> bool:
        """Whether a gait cannot be shown and has a way out."""
        return not self.open_gaits.can_be_shown(gait_id) and self.open_gaits.way_out(gait_id) is not None

    def edit(
        self,
        gait_id: str,
        gait: Gait,
        label: str,
        revision: int | None,
        author: Author = _SCRIPT,
        edit_number: str = "",
    ) -> OpenGait:
        """Makes a changed document the present one, in memory and in the database.

        The document of a gait that cannot be shown is replaced like any other; it is kept as a version.

        Args:
            gait_id: which gait.
            gait: the changed document.
            label: what the edit is called.
            revision: that the edit was made on; None for any.
            author: whose edit it is.
            edit_number: given by its page. An edit that was made already is not made again.

        Raises:
            StateError: somebody else changed it since the given revision.
        """
        require_line(gait)
        if self._is_recoverable(gait_id):
            self.recover(gait_id, author)
            revision = None  # nobody can have seen the revision that was there
        open_gait = self.open_gait(gait_id)
        if open_gait.history.has_edit(edit_number):
            return open_gait
        if revision is not None and revision != open_gait.revision:
            raise StateError(
                f"“{open_gait.gait.name}” was changed elsewhere; look at its new state and edit again.",
                "revision",
            )
        changed, notice = normalise(open_gait.gait, gait)
        if changed == open_gait.gait:
            return open_gait
        return self._edited(open_gait, changed, label or "Edit", author, notice, edit_number)

    def _edited(
        self,
        open_gait: OpenGait,
        gait: Gait,
        label: str,
        author: Author,
        notice: str | None = None,
        edit_number: str = "",
    ) -> OpenGait:
        gait = self._results.with_known_poses(gait)
        require_line(gait)
        version = self.versions.due(open_gait)
        history = open_gait.history.edited(gait_text(gait), label, author, self._others(author), edit_number)
        return self.open_gaits.put(open_gait.changed(history.pruned(), gait, notice), version)

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
        return self.open_gaits.put(open_gait.changed(history.pruned(), gait, notice))

    def save(self, gait_id: str, author: Author = _SCRIPT) -> OpenGait:
        """Writes the present document to the data folder."""
        open_gait = self.open_gait(gait_id)
        saved = self._repository.write(
            open_gait, lambda saved: self.versions.keep(saved, VersionKind.SAVED, author)
        )
        return self.open_gaits.keep(saved)

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
        return self.open_gaits.keep(self._repository.taken_over(taken))

    def keep_mine(self, gait_id: str) -> OpenGait:
        """Writes what the studio saved last over a file that was changed outside; that file is set aside.

        Raises:
            StateError: the file was not changed.
            StorageError: the disk does not take it.
        """
        open_gait = self.open_gait(gait_id)
        if self.open_gaits.outside(gait_id) is None:
            raise StateError(f"{gait_id}.json has not been changed outside the studio.", "keep")
        return self.open_gaits.keep(self._repository.keep_mine(open_gait))

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
        taken = frozenset(opened.id for opened in self.open_gaits.all())
        added = self._repository.add(gait, taken, lambda saved: self.versions.keep(saved, VersionKind.SAVED))
        return self.open_gaits.keep(replace(added, notice=notice))

    def delete(self, gait_id: str) -> OpenGait | None:
        """Takes a saved gait away; `restore` brings it back.

        Returns:
            The gait that comes with the program under that id; None where none does.

        Raises:
            StateError: the gait comes with the program and was not saved over.
        """
        if not self.open_gaits.can_be_shown(gait_id):
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
        self.open_gaits.close(gait_id)
        return self._return(gait_id, "Delete what was saved") if open_gait.builtin else None

    def _delete_unreadable(self, gait_id: str) -> OpenGait | None:
        if self._repository.has_file(gait_id):
            self._repository.remove(gait_id)
        self.open_gaits.close(gait_id)
        if gait_id not in library():
            return None
        return self.open_gait(gait_id) if self.open_gaits.can_be_shown(gait_id) else self.recover(gait_id)

    def deleted(self) -> tuple[DeletedGait, ...]:
        """What `restore` can bring back, the last deleted first."""
        return self._repository.deleted()

    def restore(self, gait_id: str) -> OpenGait:
        """Brings a deleted gait back with its unsaved edits and its history; it needs a new approval.

        One that cannot be shown comes back in the last state that can. One whose id is in use by now comes
        back under a free id.

        Raises:
            RestoredUnshownError: it is back, and no state of it can be shown.
            InputError: it is not in the trash.
        """
        gait_id, had_approval = self._repository.restore(gait_id)
        self.open_gaits.close(gait_id)
        if self._is_recoverable(gait_id):
            self.recover(gait_id)
        try:
            open_gait = self.open_gait(gait_id)
        except InputError as error:
            raise RestoredUnshownError(gait_id, error) from error
        if had_approval:
            revoked = "The gait was deleted and brought back, so it is no longer approved."
            self.open_gaits.keep(replace(open_gait, revoked=revoked))
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

    def check(self, gait_id: str) -> OpenGait:
        """Checks the present plan by every rule; an approval of another verdict is gone."""
        self.open_gaits.ask_again(gait_id)
        open_gait = self.confirmed(gait_id)
        verdict = self._verdict_of(self.plan(gait_id), open_gait.gait)
        return self.open_gaits.keep(replace(open_gait, verdict=verdict))

    def confirmed(self, gait_id: str) -> OpenGait:
        """The gait, without its approval where the verdict of this moment is not the approved one."""
        plan, open_gait = self.plan(gait_id), self.open_gait(gait_id)
        confirmed = open_gait.confirmed(plan, self._verdict_of)
        return open_gait if confirmed is open_gait else self.open_gaits.put(confirmed)

    def _verdict_of(self, plan: Plan, gait: Gait) -> Verdict:
        return verdict_of(plan, gait, self._simulated_for(plan))

    def approve(self, gait_id: str, request: ApprovalRequest) -> OpenGait:
        """Records a person's approval of the present verdict; see `app.gaits.approvals.approved`."""
        plan, open_gait = self.plan(gait_id), self.open_gait(gait_id)
        approval, verdict = approved(open_gait, plan, self._verdict_of, request)
        version = self.versions.made(open_gait, VersionKind.APPROVED, Author(name=request.by))
        number = self.versions.newest_number(gait_id) if version is None else version.number
        record = approval_record(approval, number, plan, verdict)
        return self.open_gaits.put(replace(open_gait, approval=approval, revoked=None), version, record)

    def on_simulated(self, waypoints_hash: str) -> tuple[OpenGait, ...]:
        """Takes verdicts anew of each open gait that was simulated since; returns the gaits that changed.

        An approval stays where its verdict is the same, or adds no error to those that it overrides.
        """
        checked = self.open_gaits.all()
        touched = [g for g in checked if g.verdict and g.verdict.waypoints_hash == waypoints_hash]
        since = [(gait, self._simulated_since(gait)) for gait in touched]
        return tuple(self.open_gaits.put(now) for before, now in since if now is not before)

    def _simulated_since(self, open_gait: OpenGait) -> OpenGait:
        plan = self.plan(open_gait.id)
        verdict = self._verdict_of(plan, open_gait.gait)
        if open_gait.verdict is not None and verdict.content_hash == open_gait.verdict.content_hash:
            return open_gait
        if open_gait.approval is None or open_gait.approval.override is None:
            return open_gait.unapproved("It was simulated since")
        confirmed = open_gait.confirmed(plan, self._verdict_of)
        return confirmed if confirmed.approval is None else replace(confirmed, verdict=verdict)
