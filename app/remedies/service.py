"""The searches for remedies that are under way."""

import threading
from collections.abc import Callable

from app.common.json import Json
from app.gaits.live_plans import is_drawing, lacks_motion
from app.remedies.run import RemedyParts, RemedyRun
from core.gait.gait import Gait
from solver_jobs import Limit

NOTHING: Json = {"remedies": [], "searching": False, "trying": False, "complete": True, "sentence": ""}
"""Of a gait that has a motion and does not tip."""


class RemedyService:
    """Searches for remedies. Thread-safe.

    Args:
        parts: what a search uses.
    """

    def __init__(self, parts: RemedyParts) -> None:
        self._parts = parts
        self._lock = threading.Lock()
        self._runs: set[RemedyRun] = set()
        self._closed = False

    def search(self, gait: Gait, show: Callable[[Json | None], object], *, tips: bool) -> Callable[[], None]:
        """Begins a search.

        Args:
            gait: a drawing, or a gait with a recorded motion.
            show: told of each state as JSON content, and None at the end; from another thread.
            tips: whether physics said that the gait tips; then it gets remedies though it has a motion.

        Returns:
            What ends the search.
        """
        plan = self._parts.live.plan(gait)
        is_stuck = lacks_motion(gait, plan) or (plan.misfit is not None)
        if not is_stuck and not (tips and is_drawing(gait)):
            show(NOTHING)
            show(None)
            return lambda: None
        run = RemedyRun(gait, self._parts, lambda content: self._told(run, content, show), tips=not is_stuck)
        with self._lock:
            if self._closed:
                show(None)
                return lambda: None
            self._runs.add(run)
            run.start()
        return run.cancel

    def limit(self, gait: Gait, which: Limit) -> float | None:
        """How far one number of a drawing can go, m or rad; None where no value works, or of other gaits."""
        return self._parts.tier.limit(gait, which) if is_drawing(gait) else None

    def _told(self, run: RemedyRun, content: Json | None, show: Callable[[Json | None], object]) -> None:
        if content is None:
            with self._lock:
                self._runs.discard(run)
        show(content)

    def close(self) -> None:
        """Ends every search and refuses new ones."""
        with self._lock:
            self._closed = True
            runs = list(self._runs)
        for run in runs:
            run.cancel()
