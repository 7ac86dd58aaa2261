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
from app.published.reference import Reference
from app.published.reference_folder import ReferenceFolder
from app.published.rows import Entries, Kept, is_row_done, table_entries, table_view
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
        state: `running`, `cancelled`, `failed` or `done`.
        sentence: why it failed.
        failures: sentences of rows that failed, by row.
    """

    entries: Entries
    row: str = ""
    state: str = "running"
    sentence: str = ""
    failures: dict[str, str] = field(default_factory=dict)


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

    @property
    def reference(self) -> Reference | None:
        """The published data; None where no folder is named, or it cannot be read now."""
        return self._folder.reference()

    def name_folder(self, folder: str) -> None:
        """Names the folder of the published data; an empty name forgets it.

        Raises:
            InputError: it is not there, or lacks the data.
            StorageError: it cannot be remembered.
        """
        self._folder.name(folder)
        for table in published_tables():
            self._tell(table)

    def close(self) -> None:
        """Cancels what is on, and waits for its thread; the physics is closed after."""
        with self._lock:
            self._is_closed = True
            thread = self._thread
        for table in published_tables():
            self._end(table)
        if thread is not None:
            thread.join()

    def overview(self) -> Json:
        """Every table without its rows, and the folder of the published data."""
        kept, reference = self._kept(), self.reference
        tables = published_tables().values()
        lines = [self._line(table, table_entries(table, reference), kept) for table in tables]
        return {"reference": self._folder.content(), "tables": lines}

    def line(self, table_id: str) -> Json:
        """A table without its rows.

        Raises:
            NotFoundError: there is none of this id.
        """
        table = published_table(table_id)
        return self._line(table, table_entries(table, self.reference), self._kept())

    def view(self, table_id: str) -> Json:
        """A table with sentences about it, columns and rows.

        Raises:
            NotFoundError: there is none of this id.
        """
        table, reference, kept = published_table(table_id), self.reference, self._kept()
        entries = table_entries(table, reference)
        view = table_view(table, reference, entries, kept)
        rows = [row | self._row_state(table_id, row) for row in view["rows"]]
        return self._line(table, entries, kept) | view | {"rows": rows}

    def plot(self, table_id: str, row_id: str) -> str:
        """The x–y plot of a row, SVG.

        Raises:
            NotFoundError: there is no such row, or nothing is computed of which there is a plot.
        """
        table = published_table(table_id)
        row = table.row(row_id)
        kept = self._kept()
        entries = entries_of(table, row, self.reference)
        contents = [kept[entry.key] for entry in entries if entry.key in kept]
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
        return opened_gait(table, table.row(row_id), source, self.reference, self._tools.solve)

    def compute(self, table_id: str) -> Json:
        """Begins to compute what is missing of a table; where nothing is, or it is on, nothing begins.

        Returns:
            The table's line.

        Raises:
            NotFoundError: there is none of this id.
        """
        table = published_table(table_id)
        entries = table_entries(table, self.reference)
        kept = self._kept()
        with self._lock:
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
        self._end(table_id)
        self._tell(table_id)
        return self.line(table_id)

    def _end(self, table_id: str) -> None:
        with self._lock:
            work = self._works.get(table_id)
            if work is None or work.state != "running":
                return
            work.state = "cancelled"
            if work.row and self._handle is not None:
                self._handle.cancel()

    def _line(self, table: PublishedTable, entries: Entries, kept: Kept) -> Json:
        with self._lock:
            work = self._works.get(table.id)
            state, sentence, failures = (
                ("none", "", set()) if work is None else (work.state, work.sentence, set(work.failures))
            )
        done = {row for row, one in entries.items() if is_row_done(one, kept)}
        if len(done) == len(entries):
            state, sentence = "done", ""
        elif state == "done":
            state = "failed" if failures else "none"
            sentence = f"{len(failures)} rows were not computed; they say why." if failures else ""
        heads = {name: getattr(table, name) for name in ("id", "name", "title", "source")}
        count = len(done | failures)
        return heads | {"state": state, "done": count, "total": len(entries), "sentence": sentence}

    def _row_state(self, table_id: str, row: Json) -> Json:
        """State and sentence of a row whose figures are not all there."""
        with self._lock:
            work = self._works.get(table_id)
            if work is None or row["state"] != "none":
                return {}
            if row["id"] in work.failures:
                return {"state": "failed", "sentence": work.failures[row["id"]]}
            if work.state != "running":
                return {}
            return {"state": "running" if work.row == row["id"] else "waiting"}

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
            try:
                for entry in entries:
                    self._keep(entry)
            except SimulationCancelledError:
                with self._lock:
                    work.state = "cancelled"
                return
            except StorageError:
                raise
            except FootfallError as error:
                with self._lock:
                    work.failures[row] = error.sentence

    def _kept(self) -> Kept:
        """What is computed by now; read from the store once."""
        with self._lock:
            if not self._is_read:
                self._contents, self._is_read = self._store.all(), True
            return self._contents

    def _keep(self, entry: Entry) -> None:
        if entry.key not in self._kept():
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
