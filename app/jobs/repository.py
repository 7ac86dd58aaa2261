"""The list of jobs that pages and scripts see, kept in the database so that it survives a restart.

Only the command queue's thread calls this.
"""

import itertools
from typing import Any

from app.common.clock import Span
from app.common.json import Json
from app.store.database import Database
from app.store.storage_errors import left_undone
from app.store.tables.job_store import JobStore
from core.errors import NotFoundError

ENDED = frozenset({"done", "infeasible", "failed", "cancelled", "interrupted"})
MOST_SHOWN = 20
"""Jobs in the page's list."""
MOST_KEPT = 100
"""Ended jobs that are kept in memory; older ones are read from the database."""

AGAIN = {
    "simulate": "Simulate again.",
    "track": "Track the video again.",
    "fastest": "Search again.",
    "atlas": "Make the same atlas again to go on.",
}
"""What to do about a job that was interrupted, by kind."""


class JobRepository:
    """The jobs.

    Args:
        database: where they are kept.
    """

    def __init__(self, database: Database) -> None:
        self._store, self._clock = JobStore(database), database.clock
        self._spans: dict[str, Span] = {}
        self._numbers = itertools.count(1)
        self._contents: dict[str, Json] = {}
        with left_undone("The list of jobs is empty"):
            newest = self._store.newest(MOST_SHOWN).rows
            self._contents = {row.id: row.content for row in reversed(newest)}
        for content in self._contents.values():
            content["number"] = next(self._numbers)
            self._take_back(content)

    def begin(self, job_id: str, kind: str, gait_id: str, gait_name: str, motion: str, **more: Any) -> Json:
        """Adds a job that waits for a worker.

        Args:
            job_id: its id.
            kind: what it does, as pages and scripts name it.
            gait_id: which gait it is of.
            gait_name: what that is called.
            motion: hash of what it works on, by which its answer is told to be of the gait as it is.
            **more: what else the job says of itself.

        Raises:
            StorageError: it cannot be kept; then there is no such job.
        """
        span = self._clock.start()
        content = {
            "id": job_id,
            "number": next(self._numbers),  # orders the jobs of one course of the studio
            "kind": kind,
            "gait": gait_id,
            "gait_name": gait_name,
            "motion": motion,
            "state": "queued",
            "sentence": "Waits for a worker.",
            "created": span.started,
            "started": None,
            "ended": None,
            "progress": [],
            "course": 0,
            "result": None,
            **more,
        }
        self._store.put(content)
        self._contents[job_id], self._spans[job_id] = content, span
        self._forget_old()
        return content

    def now(self, job_id: str) -> float:
        """The present time in the course of a job that is on, s since 1970; see `Span`."""
        return self._spans[job_id].now

    def keep(self, content: Json) -> None:
        """Stores a job that has ended; until then it is worth nothing after a restart."""
        if content["state"] in ENDED:
            self._spans.pop(content["id"], None)
            with left_undone("The end of a job is shown until the studio ends, and not kept"):
                self._store.put(content)

    def content(self, job_id: str) -> Json:
        """A job as JSON content.

        Raises:
            NotFoundError: there is none of that id.
        """
        known = self._contents.get(job_id)
        if known is not None:
            return known
        stored = self._store.get(job_id)
        if stored is None:
            raise NotFoundError(f"There is no job “{job_id}”.", job_id)
        return self._take_back(stored | {"number": 0})

    def contents(self) -> list[Json]:
        """The newest jobs, newest first."""
        return list(reversed(self._contents.values()))[:MOST_SHOWN]

    def unreadable(self) -> list[Json]:
        """Jobs among the newest that cannot be read."""
        return self._store.newest(MOST_SHOWN).unreadable

    def _take_back(self, content: Json) -> Json:
        """A job from the database: nothing of its course is there, and it is not on any more."""
        content["course"] = 0
        if content["state"] not in ENDED:
            begun = content.get("started") or content["created"]
            content |= {"state": "interrupted", "ended": max(begun, self._clock.wall())}
            again = AGAIN.get(content["kind"], "Optimise again.")
            content["sentence"] = f"The studio ended while this job was on. {again}"
            self.keep(content)
        return content

    def _forget_old(self) -> None:
        ended = [job_id for job_id, content in self._contents.items() if content["state"] in ENDED]
        for job_id in ended[: max(0, len(ended) - MOST_KEPT)]:
            del self._contents[job_id]
