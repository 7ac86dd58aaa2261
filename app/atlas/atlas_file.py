"""An atlas on disk: one SQLite file with its space and a row a gait; a chunk is one transaction."""

import json
import math
import sqlite3
import threading
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from types import MappingProxyType

from app.atlas.about import about_content, fitting_space, read_about
from app.atlas.guarded_connection import (
    StepLimit,
    allow_rows_alone,
    guarded_connection,
    real_path,
    written_ahead,
)
from app.atlas.physics_table import PHYSICS_TABLE, physics_rows, store_physics_row
from app.atlas.stored_values import MOST_GAITS, StoredValues, parameter_bounds, require_tables
from app.common.json import Json
from app.store.storage_errors import storage_error
from core.atlas.axes import KEYS
from core.atlas.physics_row import PhysicsRow
from core.atlas.point import AtlasPoint
from core.atlas.row import FIGURES, AtlasRow, RowStatus, results_hash
from core.atlas.space import AtlasSpace
from core.errors import InputError, NotFoundError, StorageError
from core.text.documents import as_written
from solver_jobs import Chunk, EvaluatedGaits

CHUNK = 400
"""Gaits of a chunk, which are evaluated together and stored in one transaction."""
LEAST_NUMBER = -(2**63)
"""Least whole number of SQLite; each row has a larger one."""
PAGE = 10_000
"""Rows that are read at one time."""
WAIT_SECONDS, READ_WAIT_SECONDS = 30.0, 2.0
"""How long another program may write to the file before it counts as busy, for a run and for a reader."""
_TABLES = (
    "CREATE TABLE about (key TEXT PRIMARY KEY, value TEXT NOT NULL)",
    f"""CREATE TABLE gaits (
    id INTEGER PRIMARY KEY,
    status TEXT NOT NULL,
    reason TEXT NOT NULL,
    {", ".join(f"{name} REAL" for name in FIGURES)},
    parameters TEXT NOT NULL
)""",
)
_STATUSES: Mapping[object, RowStatus] = MappingProxyType({status.value: status for status in RowStatus})
_IN_THE_FILE = frozenset(
    {
        sqlite3.SQLITE_ERROR,
        sqlite3.SQLITE_CORRUPT,
        sqlite3.SQLITE_NOTADB,
        sqlite3.SQLITE_FORMAT,
        sqlite3.SQLITE_TOOBIG,
        sqlite3.SQLITE_AUTH,
        sqlite3.SQLITE_SCHEMA,
        sqlite3.SQLITE_INTERRUPT,
    }
)
"""Faults that lie in the file itself."""
_COLUMNS = ("id", "status", "reason", *FIGURES, "parameters")


class AtlasFile:
    """An open atlas; any thread may use it.

    Args:
        path: the file.
        space: of a file that is made, or that has to hold this space; None to take that of the file.
        adds: whether rows are added without a `space`; a file that is only read is opened so.
        follows_link: whether the path may be a symbolic link.

    Attributes:
        space: what its gaits are drawn from.
        version: of the program that made it.

    Raises:
        InputError: it is no atlas, of a newer program, or of another space or robot.
        NotFoundError: there is none, and no space to make one of.
        StorageError: the disk does not take it.
    """

    def __init__(
        self, path: Path, space: AtlasSpace | None = None, *, adds: bool = False, follows_link: bool = True
    ) -> None:
        self.path = path
        self._lock = threading.Lock()
        makes, adds = space is not None, adds or space is not None
        with self._sentences():
            self._real = real_path(path, follows_link=follows_link)
            is_there = self._real.exists()
            if not (makes or is_there):
                raise NotFoundError(f"There is no atlas {path}. Make one with footfall atlas run.", str(path))
            is_new = not is_there or self.size == 0
            # A file that is only read is not made where somebody has just taken it away.
            self._connection = guarded_connection(
                path, self._real, WAIT_SECONDS if adds else READ_WAIT_SECONDS, adds=adds, makes=makes
            )
            try:
                if is_new and space is not None:
                    self._make(space)
                self._limit = StepLimit(self._connection)
                self._limit.begin_schema()
                if self._connection.execute("PRAGMA journal_mode").fetchone()[0] == "wal":
                    raise written_ahead(path)
                allow_rows_alone(self._connection, adds=adds)
                require_tables(self._connection, path, _TABLES, PHYSICS_TABLE)
                self._about = read_about(self._connection, path)
                self.space, self.version = fitting_space(self._about, space, path), self._about["program"]
                self._bounds = parameter_bounds(self.space.axes)
            except BaseException:
                self._connection.close()
                raise

    @property
    def size(self) -> int:
        """Bytes of the file.

        Raises:
            OSError: it is gone.
        """
        return self._real.stat().st_size

    def close(self) -> None:
        """Closes the file."""
        with self._lock:
            self._connection.close()

    def missing(self, count: int) -> list[Chunk]:
        """Chunks that lack for the gaits from 0 to, not including, `count`."""
        query = f"SELECT id / {CHUNK}, count(*) FROM gaits GROUP BY 1"
        with self._reading() as connection:
            known = dict(connection.execute(query).fetchall())
        # Of each chunk the first gaits are stored first.
        starts = ((first + known.get(first // CHUNK, 0), first + CHUNK) for first in range(0, count, CHUNK))
        return [Chunk(start, min(end, count) - start) for start, end in starts if start < min(end, count)]

    def add(self, gaits: EvaluatedGaits) -> None:
        """Stores a chunk; it is on disk when this ends without an error, and nothing of it is otherwise.

        Args:
            gaits: of the chunk, each with what came of it.

        Raises:
            StorageError: the disk does not take it.
        """
        values = [
            (row.number, row.status.value, row.reason, *map(_or_none, row.figures), _written(point))
            for point, row in gaits
        ]
        places = ", ".join("?" * len(_COLUMNS))
        with self._reading() as connection, connection:
            connection.executemany(f"INSERT OR REPLACE INTO gaits VALUES ({places})", values)

    def counts(self) -> dict[RowStatus, int]:
        """How many gaits have each status."""
        return self.summary()[0]

    def summary(self) -> tuple[dict[RowStatus, int], float | None]:
        """How many gaits have each status, and the speed of the fastest solved one in m/s, if there is one.

        Raises:
            InputError: a status, a number or a speed cannot be one of an atlas.
        """
        first, last = ("(SELECT min(id) FROM gaits)", "(SELECT max(id) FROM gaits)")
        each = ", ".join(f"count(*) FILTER (WHERE status = '{status.value}')" for status in RowStatus)
        query = f"SELECT count(*), {first}, {last}, max(speed) FILTER (WHERE status = ?), {each} FROM gaits"
        with self._reading() as connection:
            total, least, most, speed, *counts = connection.execute(
                query, (RowStatus.SOLVED.value,)
            ).fetchone()
        values = StoredValues(self.path)
        if total != sum(counts):
            raise values.fault(f"{total - sum(counts):,} of its {total:,} gaits have an unknown status")
        for number in (least, most) if total else ():
            values.whole(number, "the number of a gait", 0, MOST_GAITS - 1)
        fastest = None if speed is None else values.figure(speed, "the speed of a gait")
        return dict(zip(RowStatus, counts, strict=True)), fastest

    def rows(self, status: RowStatus | None = None) -> Iterator[AtlasRow]:
        """Rows in the order of their numbers.

        Args:
            status: which; None for all.
        """
        for row, _ in self.entries(status):
            yield row

    def entries(self, status: RowStatus | None = None) -> Iterator[tuple[AtlasRow, Json]]:
        """Rows in the order of their numbers, each with its parameters as JSON content.

        All rows are looked at, whichever are asked for: a file fits or does not, whoever reads it.

        Raises:
            InputError: a value of any row cannot be one of an atlas.
        """
        query = f"SELECT {', '.join(_COLUMNS)} FROM gaits WHERE id > ? ORDER BY id LIMIT {PAGE}"
        last, values = LEAST_NUMBER, StoredValues(self.path)
        while True:
            with self._reading(values) as connection:
                found = [self._entry(stored, values) for stored in connection.execute(query, (last,))]
            yield from (entry for entry in found if status in (None, entry[0].status))
            if len(found) < PAGE:
                return
            last = found[-1][0].number

    def entry(self, number: int) -> tuple[AtlasRow, Json]:
        """One gait's row and parameters.

        Raises:
            NotFoundError: the atlas has none of that number.
        """
        values = StoredValues(self.path)
        if not isinstance(number, int) or isinstance(number, bool) or not 0 <= number < MOST_GAITS:
            raise NotFoundError(
                f"{self.path} has no gait {as_written(number)}; gaits have numbers from 0.", "ID"
            )
        with self._reading(values) as connection:
            query = f"SELECT {', '.join(_COLUMNS)} FROM gaits WHERE id = ?"
            stored = connection.execute(query, (number,)).fetchone()
        if stored is None:
            count = sum(self.counts().values())
            raise NotFoundError(f"{self.path} has no gait {number}; it has {count} gaits.", "ID")
        return self._entry(stored, values)

    def _entry(self, stored: Sequence[object], values: StoredValues) -> tuple[AtlasRow, Json]:
        number = values.number(stored[0])
        status = _STATUSES.get(stored[1])
        if status is None:
            raise values.fault(
                f"the status of gait {number} must be one of {', '.join(RowStatus)}", stored[1]
            )
        reason = values.text(stored[2], "a reason")
        figures = [values.figure(value, "a figure") for value in stored[3:-1]]
        parameters = values.parameters(stored[-1], number, self._bounds)
        return AtlasRow(number, status, reason, *figures), parameters

    def physics(self) -> dict[int, PhysicsRow]:
        """What physics made of the gaits that were simulated, by their numbers."""
        values = StoredValues(self.path)
        with self._reading(values) as connection:
            return physics_rows(connection, values)

    def add_physics(self, row: PhysicsRow) -> None:
        """Stores what physics made of a gait; it is on disk when this ends without an error.

        Args:
            row: takes the place of an earlier one of the same gait.

        Raises:
            StorageError: the disk does not take it.
        """
        with self._reading() as connection:
            store_physics_row(connection, row)

    @property
    def hash(self) -> str:
        """SHA-256 over its results, in the order of their numbers."""
        return results_hash(self.rows())

    @property
    def robot_hash(self) -> str:
        """SHA-256 of the robot's parameters with which it was made."""
        return self._about["robot_hash"]

    def require_same_robot(self) -> None:
        """The robot's parameters are still those with which the atlas was made.

        Raises:
            InputError: they are not.
        """
        if self.space.robot_hash != self.robot_hash:
            raise InputError(
                f"The parameters of {self.space.robot} have changed since {self.path} was made, so its gaits "
                "are those of another robot. Run the atlas again into another file.",
                str(self.path),
            )

    def _make(self, space: AtlasSpace) -> None:
        with self._connection:
            self._connection.executescript(";".join(("BEGIN", *_TABLES)))
            self._connection.executemany("INSERT INTO about VALUES (?, ?)", about_content(space).items())

    @contextmanager
    def _reading(self, values: StoredValues | None = None) -> Iterator[sqlite3.Connection]:
        """The connection for one statement, whose values are looked at before it ends."""
        with self._sentences(), self._lock:
            state = self._real.stat()
            self._limit.begin(state)
            if values is not None:
                values.size = state.st_size
            yield self._connection

    @contextmanager
    def _sentences(self) -> Iterator[None]:
        """Turns what SQLite and the disk say into a sentence.

        Raises:
            StorageError: with it.
        """
        try:
            yield
        except sqlite3.Error as error:
            code = getattr(error, "sqlite_errorcode", None)
            is_no_text = code is None and "decode" in str(error)
            if is_no_text or (code is not None and code & 0xFF in _IN_THE_FILE):
                words = (
                    "it takes more work than an atlas of its size"
                    if code == sqlite3.SQLITE_INTERRUPT
                    else error
                )
                raise StoredValues(self.path).fault(f"{words}") from error
            known = storage_error(error, self.path)
            if known is None:
                raise
            raise known from error
        except OSError as error:
            raise StorageError(
                f"{self.path} cannot be opened: {error.strerror}. Choose another place.", str(self.path)
            ) from error


def _or_none(value: float) -> float | None:
    return None if math.isnan(value) else value


def _written(point: AtlasPoint) -> str:
    return json.dumps(parameters(point))


def parameters(point: AtlasPoint) -> Json:
    """The parameters of a gait as JSON content, by their keys in a space."""
    content: Json = {name: getattr(point, name) for name in KEYS}
    for name in ("order", "lost"):
        content[name] = ",".join(map(str, content[name]))
    return content | dict(point.numbers)
