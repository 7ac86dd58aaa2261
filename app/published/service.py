"""The published tables with our figures: computed in the background, row after row, and kept. Thread-safe."""

import logging
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass, field

from app.common.json import Json
from app.export.svg import svg
from app.plans.make_plan import Solve
from app.published.entries import Entry, entries_of
from app.published.figures import Tools
from app.published.opening import Source, opened_gait
from app.published.plots import row_plot
from app.published.problems import walker
from app.published.reference_folder import ReferenceFolder
from app.published.rows import Entries, Kept, has_row_failed, is_row_done, table_entries, table_view
from app.simulation.service import SimulationHandle, SimulationTier
from app.store.tables.published_store import PublishedStore
from core.errors import FootfallError, NotFoundError, SimulationCancelledError, StorageError
from core.gait.gait import Gait
from core.physics.motion import SimulatedMotion
from core.physics.problem import SimulationProblem
from core.published.gaits import row_title
from core.published.tables import PublishedTable, published_table, published_tables

_log = logging.getLogger(__name__)


@dataclass(eq=False)
class _Work:
    """The computation of a table that is on, waits, or has ended.

    Args:
        entries: of its rows, as they were when it was asked for.
        row: which is computed now; empty for none.
        state: `running`, `cancelled`, `failed` or `done`; `none` before it was asked for.
        sentence: why it failed.
        failures: sentences of computations that failed, by their key.
    """

    entries: Entries
    row: str = ""
    state: str = "running"
    sentence: str = ""
    failures: dict[str, str] = field(default_factory=dict)


_NONE = _Work({}, state="none")
"""Of a table whose figures nobody asked for."""


class PublishedService:
    """The published tables.

    Args:
        store: where figures are kept.
        tier: the physics.
        solve: the live tier.
        folder: of the published data.
        publish: sends an event to every page.
    """

    def __init__(
        self,
        store: PublishedStore,
        tier: SimulationTier,
        solve: Solve,
        folder: ReferenceFolder,
        publish: Callable[[Json], None],
    ) -> None:
        self._store = store
        self._tier = tier
        self._folder = folder
        self._tools = Tools(solve, self._simulated)
        self._publish = publish
        self._lock = threading.Lock()
        self._works: dict[str, _Work] = {}
        self._contents: Kept = {}
        self._is_read = False
        self._handle: SimulationHandle | None = None
        self._is_closed = False
        self._thread: threading.Thread | None = None

    def name_folder(self, folder: str) -> None:
        """Names the folder of the published data; an empty name forgets it.

        What is on ends, since it is computed from the folder before; what it has done stays.

        Raises:
            InputError: it is not there, or lacks the data.
            StorageError: it cannot be remembered.
        """
        with self._lock:
            self._folder.name(folder)
            for work in self._works.values():
                self._end(work)
            self._works = {}
        for table in published_tables():
            self._tell(table)

    def close(self) -> None:
        """Cancels what is on, and waits for its thread; the physics is closed after."""
        with self._lock:
            self._is_closed = True
            thread = self._thread
            for work in self._works.values():
                self._end(work)
        if thread is not None:
            thread.join()

    def overview(self) -> Json:
        """Every table without its rows, and the folder of the published data."""
        kept, published = self._kept(), self._folder.read()
        tables = published_tables().values()
        lines = [self._line(table, table_entries(table, published.reference), kept) for table in tables]
        return {"reference": published.content(), "tables": lines}

    def line(self, table_id: str) -> Json:
        """A table without its rows.

        Raises:
            NotFoundError: there is none of this id.
        """
        table = published_table(table_id)
        return self._line(table, table_entries(table, self._folder.read().reference), self._kept())

    def view(self, table_id: str) -> Json:
        """A table with sentences about it, columns and rows.

        Raises:
            NotFoundError: there is none of this id.
        """
        table, published, kept = published_table(table_id), self._folder.read(), self._kept()
        entries = table_entries(table, published.reference)
        line = self._line(table, entries, kept)
        with self._lock:
            work = self._works.get(table_id, _NONE)
            failures = dict(work.failures)
            row = work.row if work.state == "running" else None
        view = table_view(table, published, entries, kept, failures)
        rows = view["rows"] if row is None else [_begun(one, row) for one in view["rows"]]
        return line | view | {"rows": rows}

    def plot(self, table_id: str, row_id: str) -> str:
        """The x–y plot of a row, SVG.

        Raises:
            NotFoundError: there is no such row, or nothing is computed of which there is a plot.
        """
        table = published_table(table_id)
        row = table.row(row_id)
        kept = self._kept()
        entries = entries_of(table, row, self._folder.read().reference)
        contents = {entry.who: kept[entry.key] for entry in entries if entry.key in kept}
        drawing = row_plot(table, row, contents, walker().colours)
        if drawing is None:
            raise NotFoundError(f"There is no plot of {row_title(row)}; compute {table.name}.", "row")
        return svg(drawing, f"{table_id}-{row_id}")

    def gait(self, table_id: str, row_id: str, source: Source) -> Gait:
        """The document of a row's gait.

        Raises:
            NotFoundError: there is no such row, or its published motion is not at hand.
            InputError: the file of the published motion cannot be read.
        """
        table = published_table(table_id)
        return opened_gait(table, table.row(row_id), source, self._folder.read(), self._tools.solve)

    def compute(self, table_id: str) -> Json:
        """Begins to compute what is missing of a table; where nothing is, or it is on, nothing begins.

        Returns:
            The table's line.

        Raises:
            NotFoundError: there is none of this id.
        """
        table = published_table(table_id)
        kept = self._kept()
        with self._lock:
            entries = table_entries(table, self._folder.read().reference)
            work = self._works.get(table_id)
            is_on = work is not None and work.state == "running"
            is_done = all(is_row_done(one, kept) for one in entries.values())
            if not (is_on or is_done or self._is_closed):
                self._works[table_id] = _Work(entries)
                if self._thread is None:
                    self._thread = threading.Thread(target=self._work, name="published", daemon=True)
                    self._thread.start()
        return self.line(table_id)

    def cancel(self, table_id: str) -> Json:
        """Ends the computation of a table; what is done stays.

        Raises:
            NotFoundError: there is none of this id.
        """
        published_table(table_id)
        with self._lock:
            if table_id in self._works:
                self._end(self._works[table_id])
        self._tell(table_id)
        return self.line(table_id)

    def _end(self, work: _Work) -> None:
        """Ends a computation if it is on; the lock is held."""
        if work.state == "running":
            work.state = "cancelled"
            if work.row and self._handle is not None:
                self._handle.cancel()

    def _line(self, table: PublishedTable, entries: Entries, kept: Kept) -> Json:
        with self._lock:
            work = self._works.get(table.id, _NONE)
            state, sentence, failures = work.state, work.sentence, dict(work.failures)
        done = sum(is_row_done(one, kept) for one in entries.values())
        failed = sum(has_row_failed(one, kept, failures) for one in entries.values())
        if done == len(entries):
            state, sentence = "done", ""
        elif state == "done":
            state = "failed" if failed else "none"
            sentence = f"{failed} rows lack figures; they say why." if failed else ""
        heads = {name: getattr(table, name) for name in ("id", "name", "title", "source")}
        return heads | {"state": state, "done": done + failed, "total": len(entries), "sentence": sentence}

    def _tell(self, table_id: str) -> None:
        self._publish({"type": "published", "table": table_id})

    def _work(self) -> None:
        """Computes the tables that were asked for, one after the other, in a thread of its own."""
        while (found := self._next()) is not None:
            table_id, work = found
            try:
                self._compute(table_id, work)
                end, sentence = "done", ""
            except StorageError as error:
                end, sentence = "failed", error.sentence
            except Exception as error:
                _log.exception("A published table broke off")
                end, sentence = "failed", f"The computation broke off ({error!r}); this is a bug."
            with self._lock:
                work.row = ""
                if work.state == "running":
                    work.state, work.sentence = end, sentence
            self._tell(table_id)

    def _next(self) -> tuple[str, _Work] | None:
        """The next table; the thread ends where there is none."""
        with self._lock:
            found = next(((key, work) for key, work in self._works.items() if work.state == "running"), None)
            if found is None:
                self._thread = None
            return found

    def _compute(self, table_id: str, work: _Work) -> None:
        for row, entries in work.entries.items():
            with self._lock:
                if work.state != "running":
                    return
                work.row = row
            self._tell(table_id)
            for entry in entries:
                if work.state != "running":
                    return
                try:
                    self._keep(entry, work)
                except SimulationCancelledError:
                    with self._lock:
                        work.state = "cancelled"
                    return
                except StorageError:
                    raise
                except FootfallError as error:
                    with self._lock:
                        work.failures[entry.key] = error.sentence

    def _kept(self) -> Kept:
        """What is computed by now; read from the store once."""
        with self._lock:
            if not self._is_read:
                self._contents, self._is_read = self._store.all(), True
            return self._contents

    def _keep(self, entry: Entry, work: _Work) -> None:
        if entry.key not in self._kept() and entry.key not in work.failures:
            content = entry.compute(self._tools)
            self._store.put(entry.key, time.time(), content)
            with self._lock:
                self._contents = {**self._contents, entry.key: content}

    def _simulated(self, problem: SimulationProblem) -> SimulatedMotion:
        """Simulates in the physics' own process; ended by a cancel.

        Raises:
            SimulationCancelledError: it was cancelled.
        """
        handle = self._tier.submit(problem)
        with self._lock:
            self._handle = handle
            is_wanted = any(work.row and work.state == "running" for work in self._works.values())
        try:
            if not is_wanted:
                handle.cancel()
            return handle.result().motion
        finally:
            with self._lock:
                self._handle = None


def _begun(row: Json, present: str) -> Json:
    """A row of a table that is computed.

    Args:
        row: as it is known.
        present: id of the row that is computed now; empty for none.
    """
    if row["id"] == present and row["state"] != "done":
        return row | {"state": "running"}
    return row | {"state": "waiting"} if row["state"] == "none" else row
