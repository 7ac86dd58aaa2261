"""Learning runs: started for trials, run in background processes, and kept. Thread-safe."""

import logging
import threading
import uuid
from collections.abc import Sequence
from dataclasses import dataclass

from app.common.clock import Span
from app.common.json import Json
from app.learning.parameter_sets import ParameterSet, ParameterSets
from app.learning.runner import BatchTier, WalkRunner
from app.learning.views import learned_content, learned_sentence
from app.simulation.problem import physics_from_content
from app.store.database import Database
from app.store.storage_errors import left_undone
from app.store.tables.learning_store import LearningStore
from core.errors import FootfallError, NotFoundError, StateError
from core.identification.learning import POINTS, Walk, learn, require_gaits, simulation_count
from core.physics.parameters import PhysicsSet

_log = logging.getLogger(__name__)

INTERRUPTED = {"state": "interrupted", "sentence": "The studio ended while this was on. Learn again."}
MOST_SHOWN = 20
"""Courses in the page's list."""
MOST_SET_NAME = 80
"""Characters of a set's name."""


@dataclass(frozen=True, eq=False)
class _Work:
    """The course that is on."""

    content: Json
    walks: Sequence[Walk]
    physics: PhysicsSet
    runner: WalkRunner
    span: Span


class LearningService:
    """What is learned from trials, one course after the other.

    Args:
        database: where it is kept.
        tiers: what simulates gaits, each in a process of its own.
        points: sets of parameters at which every gait is simulated.
    """

    def __init__(self, database: Database, tiers: Sequence[BatchTier], points: int = POINTS) -> None:
        self.sets = ParameterSets(database)
        self._store = LearningStore(database)
        self._clock = database.clock
        self._tiers = tiers
        self._points = points
        self._lock = threading.Lock()
        self._on: _Work | None = None
        self._thread: threading.Thread | None = None
        with left_undone("Learning that was broken off is not marked so"):
            for content in (row.content for row in self._store.newest(MOST_SHOWN).rows):
                if content["state"] == "running":
                    ended = max(content["made"], self._clock.wall())
                    self._store.put({**content, **INTERRUPTED, "ended": ended})

    def start(self, walks: Sequence[Walk], physics: PhysicsSet, by: str, source: str) -> Json:
        """Begins a course.

        Args:
            walks: what the robot did and was sent.
            physics: the defaults.
            by: who asks.
            source: in a few words, where the walks are from.

        Raises:
            InputError: there are too few gaits.
            StateError: one is on.
        """
        require_gaits(walks)
        kinds = len({walk.measured.kind for walk in walks})
        span = self._clock.start()
        content: Json = {
            "id": uuid.uuid4().hex[:12],
            "made": span.started,
            "ended": None,
            "by": by,
            "source": source,
            "robot": walks[0].problem.model.name,
            "gaits": len(walks),
            "state": "running",
            "sentence": "Gaits are being simulated.",
            "done": 0,
            "left_seconds": None,
            "total": simulation_count(len(walks), kinds, self._points),
            "result": None,
        }
        with self._lock:
            if self._on is not None:
                raise StateError("Learning is on. Wait for it, or cancel it.", "learning")
            runner = WalkRunner(self._tiers, walks, lambda done: content.update(done=done))
            work = _Work(content, walks, physics, runner, span)
            self._store.put(content)
            self._on = work
            self._thread = threading.Thread(target=self._learn, args=(work,), name="learning", daemon=True)
            self._thread.start()
        return dict(content)

    def close(self) -> None:
        """Ends what is on; the tiers are closed after."""
        with self._lock:
            work, thread = self._on, self._thread
            if work is not None:
                work.content.update(INTERRUPTED)
                work.runner.cancel()
        if thread is not None:
            thread.join()

    def found(self) -> list[Json]:
        """The newest courses, the newest first; without their results."""
        now = self._now()
        kept = [
            now if now is not None and row.id == now["id"] else row.content
            for row in self._store.newest(MOST_SHOWN).rows
        ]
        return [{key: value for key, value in one.items() if key != "result"} for one in kept]

    def unreadable(self) -> list[Json]:
        """Courses that cannot be read."""
        return self._store.newest(MOST_SHOWN).unreadable

    def content(self, learning: str) -> Json:
        """One course with its result.

        Raises:
            NotFoundError: there is none.
        """
        now = self._now()
        if now is not None and now["id"] == learning:
            return now
        content = self._store.get(learning)
        if content is None:
            raise NotFoundError(f"There is no learning job {learning}.", "learning")
        return content

    def cancel(self, learning: str) -> Json:
        """Asks a course to end; one that has ended stays as it is."""
        with self._lock:
            work = self._on
            if work is not None and work.content["id"] == learning:
                work.content.update(state="cancelling", sentence="Learning is being cancelled.")
                work.runner.cancel()
        return self.content(learning)

    def save(self, learning: str, name: str, by: str) -> ParameterSet:
        """Keeps what a course has learned as the next version of a name.

        Raises:
            StateError: it has no result, or the trials tell nothing.
            InputError: the name is empty.
        """
        content = self.content(learning)
        result = content["result"]
        if result is None:
            raise StateError("This learning job has no result, so there is nothing to keep.", "learning")
        if not any(one["is_identifiable"] for one in result["parameters"]):
            raise StateError(
                "These trials do not identify any parameter, so there is nothing to keep. Add trials.",
                "learning",
            )
        physics = physics_from_content(result["physics"])
        note = f"learned from {content['gaits']} gaits"
        return self.sets.save(name, by, content["robot"], physics, learning, note)

    def _now(self) -> Json | None:
        with self._lock:
            if self._on is None:
                return None
            content, seconds = dict(self._on.content), self._on.span.seconds
        return {**content, "left_seconds": _left(content, seconds)}

    def _learn(self, work: _Work) -> None:
        end: Json
        try:
            learned = learn(work.walks, work.physics, work.runner, self._points)
            result = learned_content(learned, [walk.cut for walk in work.walks])
            end = {"state": "done", "sentence": learned_sentence(result), "result": result}
        except FootfallError as error:
            end = {"state": "failed", "sentence": error.sentence}
        except Exception as error:
            _log.exception("Learning broke off")
            end = {"state": "failed", "sentence": f"Learning broke off ({error!r}); this is a bug."}
        with self._lock:
            was = work.content["state"]
            if was != "running" and end["state"] != "done":
                end = (
                    INTERRUPTED if was == "interrupted" else {"state": "cancelled", "sentence": "Cancelled."}
                )
            work.content.update(end, ended=work.span.now)
            self._on = None
            self._store.put(work.content)


def _left(content: Json, seconds: float) -> float | None:
    """Seconds that a course still takes, as fast as until now; None before its first simulation."""
    done, total = content["done"], content["total"]
    return None if not done else seconds / done * max(total - done, 0)
