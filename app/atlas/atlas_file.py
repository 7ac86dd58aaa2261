"""An atlas on disk: one SQLite file with its space and a row a gait; a chunk is one transaction."""

import json
import math
import sqlite3
import threading
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from urllib.parse import quote

from app.atlas.physics_table import physics_rows, store_physics_row
from app.common.json import Json
from app.common.version import VERSION
from app.store.storage_errors import storage_error
from core.atlas.axes import KEYS
from core.atlas.physics_row import PhysicsRow
from core.atlas.point import AtlasPoint
from core.atlas.row import FIGURES, AtlasRow, RowStatus, results_hash
from core.atlas.space import AtlasSpace, space_from_table
from core.errors import InputError, NotFoundError, StorageError
from solver_jobs import Chunk, EvaluatedGaits

FORMAT, FORMAT_VERSION = "footfall-atlas", 1
CHUNK = 400
"""Gaits of a chunk, which are evaluated together and stored in one transaction."""
PAGE = 10_000
"""Rows that are read at one time."""
WAIT_SECONDS = 30.0
"""How long another program may write to the file before it counts as busy."""
_TABLES = f"""
CREATE TABLE about (key TEXT PRIMARY KEY, value TEXT NOT NULL);
CREATE TABLE gaits (
    id INTEGER PRIMARY KEY,
    status TEXT NOT NULL,
    reason TEXT NOT NULL,
    {", ".join(f"{name} REAL" for name in FIGURES)},
    parameters TEXT NOT NULL
);
"""
_COLUMNS = ("id", "status", "reason", *FIGURES, "parameters")


class AtlasFile:
    """An open atlas; any thread may use it.

    Args:
        path: the file.
        space: of a file that is made, or that has to hold this space; None to take that of the file.

    Attributes:
        space: what its gaits are drawn from.
        version: of the program that made it.

    Raises:
        InputError: it is no atlas, of a newer program, or of another space or robot.
        NotFoundError: there is none, and no space to make one of.
        StorageError: the disk does not take it.
    """

    def __init__(self, path: Path, space: AtlasSpace | None = None) -> None:
        self.path = path
        self._lock = threading.Lock()
        if space is None and not path.is_file():
            raise NotFoundError(f"There is no atlas {path}. Make one with footfall atlas run.", str(path))
        is_new = not path.exists() or path.stat().st_size == 0
        with self._sentences():
            # A file that is only read is not made where somebody has just taken it away.
            address = f"file:{quote(str(path.absolute()))}?mode={'rw' if space is None else 'rwc'}"
            self._connection = sqlite3.connect(
                address, uri=True, check_same_thread=False, timeout=WAIT_SECONDS
            )
            try:
                if is_new and space is not None:
                    self._make(space)
                self.space, self.version = self._opened(space)
            except BaseException:
                self._connection.close()
                raise

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
        with self._reading() as connection:
            found = dict(connection.execute("SELECT status, count(*) FROM gaits GROUP BY status").fetchall())
        return {status: found.get(status.value, 0) for status in RowStatus}

    def rows(self, status: RowStatus | None = None) -> Iterator[AtlasRow]:
        """Rows in the order of their numbers.

        Args:
            status: which; None for all.
        """
        for row, _ in self.entries(status):
            yield row

    def entries(self, status: RowStatus | None = None) -> Iterator[tuple[AtlasRow, Json]]:
        """Rows in the order of their numbers, each with its parameters as JSON content."""
        wanted = ("AND status = ?", (status.value,)) if status is not None else ("", ())
        query = f"SELECT {', '.join(_COLUMNS)} FROM gaits WHERE id > ? {wanted[0]} ORDER BY id LIMIT {PAGE}"
        last = -1
        while True:
            with self._reading() as connection:
                found = connection.execute(query, (last, *wanted[1])).fetchall()
            for values in found:
                yield _row(values), json.loads(values[-1])
            if len(found) < PAGE:
                return
            last = found[-1][0]

    def entry(self, number: int) -> tuple[AtlasRow, Json]:
        """One gait's row and parameters.

        Raises:
            NotFoundError: the atlas has none of that number.
        """
        with self._reading() as connection:
            query = f"SELECT {', '.join(_COLUMNS)} FROM gaits WHERE id = ?"
            values = connection.execute(query, (number,)).fetchone()
            count = connection.execute("SELECT count(*) FROM gaits").fetchone()[0]
        if values is None:
            raise NotFoundError(f"{self.path} has no gait {number}; it has {count} gaits.", "ID")
        return _row(values), json.loads(values[-1])

    def fastest(self) -> float | None:
        """Speed of its fastest solved gait, m/s; None where none is solved."""
        with self._reading() as connection:
            query = "SELECT max(speed) FROM gaits WHERE status = ?"
            found = connection.execute(query, (RowStatus.SOLVED.value,)).fetchone()[0]
        return None if found is None else float(found)

    def physics(self) -> dict[int, PhysicsRow]:
        """What physics made of the gaits that were simulated, by their numbers."""
        with self._reading() as connection:
            return physics_rows(connection)

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
        return self._about()["robot_hash"]

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
        about = {
            "format": FORMAT,
            "version": str(FORMAT_VERSION),
            "program": VERSION,
            "space": json.dumps(space.content(), sort_keys=True),
            "space_hash": space.hash,
            "robot_hash": space.robot_hash,
        }
        with self._connection:
            self._connection.executescript("BEGIN;" + _TABLES)
            self._connection.executemany("INSERT INTO about VALUES (?, ?)", about.items())

    def _opened(self, space: AtlasSpace | None) -> tuple[AtlasSpace, str]:
        """The space and the program's version of a file that this program can go on with.

        Raises:
            InputError: it cannot.
        """
        try:
            about = self._about()
            missing = {"format", "version", "program", "space", "space_hash", "robot_hash"} - set(about)
        except sqlite3.DatabaseError as error:
            raise InputError(f"{self.path} is no atlas. Choose another file.", str(self.path)) from error
        if missing:
            raise InputError(f"{self.path} is no atlas. Choose another file.", str(self.path))
        if about.get("format") != FORMAT:
            raise InputError(f"{self.path} is no atlas. Choose another file.", str(self.path))
        if about["version"] != str(FORMAT_VERSION):
            raise InputError(
                f"{self.path} is an atlas of format {about['version']}, and this program reads "
                f"{FORMAT_VERSION}. Update the program, or choose another file.",
                str(self.path),
            )
        own = space_from_table(json.loads(about["space"]), str(self.path))
        if space is None:
            return own, about["program"]
        if space.hash != about["space_hash"]:
            raise InputError(
                f"{self.path} is an atlas of another space. Choose another file, or give the space that it "
                "was made of.",
                str(self.path),
            )
        if space.robot_hash != about["robot_hash"]:
            raise InputError(
                f"{self.path} was made with other parameters of {space.robot}. Choose another file.",
                str(self.path),
            )
        if about["program"] != VERSION:
            raise InputError(
                f"{self.path} was made by version {about['program']} of this program, which may solve gaits "
                f"otherwise than {VERSION}. Choose another file.",
                str(self.path),
            )
        return own, about["program"]

    def _about(self) -> Mapping[str, str]:
        return dict(self._connection.execute("SELECT key, value FROM about").fetchall())

    @contextmanager
    def _reading(self) -> Iterator[sqlite3.Connection]:
        with self._sentences(), self._lock:
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


def _row(values: Sequence[object]) -> AtlasRow:
    figures = {
        name: math.nan if value is None else float(str(value))
        for name, value in zip(FIGURES, values[3:-1], strict=True)
    }
    return AtlasRow(int(str(values[0])), RowStatus(str(values[1])), str(values[2]), **figures)


def _written(point: AtlasPoint) -> str:
    return json.dumps(parameters(point))


def parameters(point: AtlasPoint) -> Json:
    """The parameters of a gait as JSON content, by their keys in a space."""
    content: Json = {name: getattr(point, name) for name in KEYS}
    for name in ("order", "lost"):
        content[name] = ",".join(map(str, content[name]))
    return content | dict(point.numbers)
