"""How long gaits last, without planning them: stored for the library, and when a plan was made."""

from app.documents.gait_json import sent_hash
from app.plans.plan import Plan
from app.plans.robot_times import robot_times
from app.store.storage_errors import left_undone
from app.store.tables.times_store import TimesStore
from core.gait.gait import Gait
from core.library.robot_times import RobotTimes, library_times


class KnownTimes:
    """Times of gaits by id, valid for the document whose plan was made last.

    Args:
        store: where they are kept.
    """

    def __init__(self, store: TimesStore) -> None:
        self._store = store
        self._known = store.all()

    def of(self, gait_id: str, gait: Gait, *, is_original: bool) -> RobotTimes | None:
        """A gait's times; None where they are not known.

        Args:
            gait_id: its id.
            gait: its present document.
            is_original: whether it is as it came with the program.
        """
        if is_original and gait_id in library_times():
            return library_times()[gait_id]
        sent, times = self._known.get(gait_id, (None, None))
        return times if times is not None and sent == sent_hash(gait) else None

    def last(self, gait_id: str) -> tuple[str, RobotTimes] | None:
        """What was taken over last for a gait; another value where its line in a list may change."""
        return self._known.get(gait_id)

    def keep(self, gait_id: str, gait: Gait, plan: Plan) -> None:
        """Takes over what a plan says; a plan that cannot be sent says nothing."""
        times = None if plan.is_draft else robot_times(plan)
        if times is None:
            return
        entry = sent_hash(gait), times
        if self._known.get(gait_id) == entry:
            return
        self._known[gait_id] = entry
        with left_undone(f"The times of {gait_id} are not kept"):
            self._store.put(gait_id, *entry)
