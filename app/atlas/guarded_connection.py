"""A connection to an atlas file that somebody else may have made: it runs nothing of the file."""

import os
import sqlite3
import stat
import sys
from collections.abc import Callable
from pathlib import Path
from urllib.parse import quote

from app.store.plain_file import link_refusal
from core.errors import InputError

MOST_BYTES = 8_000_000_000
"""Of an atlas file; ten million gaits with physics have about half of it."""
MOST_JOURNAL = 4_000_000
"""Bytes of the journal of a run that broke off; a chunk changes a few pages."""
MOST_SPACE = 200_000
"""Bytes of the longest text, which is the space."""
LEAST_STEPS, STEPS_A_BYTE = 150_000, 0.25
"""Steps of SQLite's machine that a statement may take, and more for each byte of the file: a statement over
all rows takes about 0.05 a byte."""
SCHEMA_STEPS = 400
"""Steps until the tables are known; an atlas has at most four entries there."""
_LOOKS = 50
"""How often a statement of the most steps is looked at."""
_HOLES = 8
"""A disk that packs files makes them smaller by this factor at most; a file with less has holes."""
_LIMITS = {
    sqlite3.SQLITE_LIMIT_LENGTH: MOST_SPACE,
    sqlite3.SQLITE_LIMIT_SQL_LENGTH: 10_000,
    sqlite3.SQLITE_LIMIT_COLUMN: 32,
    sqlite3.SQLITE_LIMIT_EXPR_DEPTH: 32,
    sqlite3.SQLITE_LIMIT_ATTACHED: 0,
    sqlite3.SQLITE_LIMIT_TRIGGER_DEPTH: 0,
}
_END_OF_NAME = bytes.fromhex("d9d505f920a163d7")
"""Ends a journal that names a second file, which SQLite would delete."""
_KINDS = {stat.S_IFDIR: "a folder", stat.S_IFIFO: "a pipe", stat.S_IFSOCK: "a socket"}
_SCHEMA = frozenset({"sqlite_master", "sqlite_schema"})
_TABLES = frozenset({"about", "gaits", "physics"})


def guarded_connection(
    path: Path, real: Path, wait_seconds: float, *, adds: bool, makes: bool
) -> sqlite3.Connection:
    """Opens a file without reading it.

    Neither views, triggers, functions of the file nor other files are reached, whatever its tables are.

    Args:
        path: the file, as a refusal calls it.
        real: where it is.
        wait_seconds: how long another program may keep it.
        adds: whether rows are added; else it is opened to read, unless a run left a journal beside it.
        makes: whether it is made where there is none.

    Raises:
        InputError: it is no plain file, is too large, or has something beside it that no atlas has.
        OSError: it cannot be opened.
        sqlite3.Error: the same.
    """
    _require_plain(path, real)
    has_journal = _has_journal(path, Path(f"{real}-journal"))
    mode = "rwc" if makes else "rw" if adds or has_journal else "ro"
    connection = sqlite3.connect(
        f"file:{quote(str(real))}?mode={mode}", uri=True, check_same_thread=False, timeout=wait_seconds
    )
    for limit, most in _LIMITS.items():
        connection.setlimit(limit, most)
    connection.execute("PRAGMA trusted_schema = OFF")
    connection.execute("PRAGMA cell_size_check = ON")
    if sys.version_info >= (3, 12):
        connection.setconfig(sqlite3.SQLITE_DBCONFIG_DEFENSIVE)
        connection.setconfig(sqlite3.SQLITE_DBCONFIG_ENABLE_TRIGGER, False)
        connection.setconfig(sqlite3.SQLITE_DBCONFIG_ENABLE_VIEW, False)
    if not adds:
        connection.execute("PRAGMA query_only = ON")
    return connection


def real_path(path: Path, *, follows_link: bool) -> Path:
    """Where a file is, through links of folders.

    Args:
        path: the file.
        follows_link: whether it may be a link itself.

    Raises:
        InputError: no file can have such a name, or it is a link.
    """
    if "\0" in str(path):
        raise InputError("The name of the file holds the character U+0000. Leave it out.", "path")
    if follows_link:
        return Path(os.path.realpath(path))
    if path.is_symlink():
        raise link_refusal(path)
    return Path(os.path.realpath(path.parent), path.name)


class StepLimit:
    """Ends a statement of a connection that takes more steps than an atlas of this size needs.

    Args:
        connection: to the file.
    """

    def __init__(self, connection: sqlite3.Connection) -> None:
        self._connection = connection
        self._looks = 0

    def begin_schema(self) -> None:
        """The next statement is the first one, which reads what tables there are."""
        self._begin(SCHEMA_STEPS)

    def begin(self, state: os.stat_result) -> None:
        """The next statement begins.

        Args:
            state: of the file.
        """
        blocks = getattr(state, "st_blocks", state.st_size)
        size = min(state.st_size, _HOLES * 512 * blocks)
        self._begin(LEAST_STEPS + int(STEPS_A_BYTE * size))

    def _begin(self, steps: int) -> None:
        self._looks = 0
        self._connection.set_progress_handler(self._is_over, max(steps // _LOOKS, 1))

    def _is_over(self) -> int:
        self._looks += 1
        return int(self._looks > _LOOKS)


def allow_rows_alone(connection: sqlite3.Connection, *, adds: bool) -> None:
    """Lets a connection read the three tables alone, and add rows of gaits and of physics where `adds`."""
    connection.set_authorizer(_may_add if adds else _may_read)


_Authorizer = Callable[[int, str | None, str | None, str | None, str | None], int]


def _may_read(action: int, name: str | None, second: str | None, _base: str | None, inner: str | None) -> int:
    if action == sqlite3.SQLITE_SELECT:
        return sqlite3.SQLITE_OK
    if action == sqlite3.SQLITE_READ and inner is None and name in _TABLES | _SCHEMA:
        return sqlite3.SQLITE_OK
    if action == sqlite3.SQLITE_FUNCTION and second in _FUNCTIONS:
        return sqlite3.SQLITE_OK
    return sqlite3.SQLITE_DENY


_FUNCTIONS = frozenset({"count", "max", "min", "typeof"})


def _may_add(action: int, name: str | None, second: str | None, base: str | None, inner: str | None) -> int:
    if inner is None and (
        action == sqlite3.SQLITE_TRANSACTION
        or (action == sqlite3.SQLITE_INSERT and name in {"gaits", "physics", *_SCHEMA})
        or (action == sqlite3.SQLITE_CREATE_TABLE and name == "physics")
        or (action == sqlite3.SQLITE_UPDATE and name in _SCHEMA)
    ):
        return sqlite3.SQLITE_OK
    return _may_read(action, name, second, base, inner)


def _require_plain(path: Path, real: Path) -> None:
    """Raises InputError unless there is nothing, or a plain file that is not too large."""
    try:
        state = real.stat()
    except FileNotFoundError:
        return
    if not stat.S_ISREG(state.st_mode):
        kind = _KINDS.get(stat.S_IFMT(state.st_mode), "a device")
        raise InputError(f"{path} is {kind}, no atlas. Choose another file.", str(path))
    if state.st_size > MOST_BYTES:
        raise InputError(
            f"{path} has {state.st_size / 1e9:.1f} GB; an atlas has {MOST_BYTES / 1e9:.0f} at most. Choose "
            "another file.",
            str(path),
        )


def _has_journal(path: Path, journal: Path) -> bool:
    """Whether the journal of a run stands beside a file.

    Raises:
        InputError: it is none of an atlas, or there is something else that SQLite would open.
    """
    for end in ("-wal", "-shm"):
        beside = journal.with_name(journal.name.removesuffix("-journal") + end)
        if os.path.lexists(beside):
            raise written_ahead(path)
    try:
        state = journal.lstat()
    except FileNotFoundError:
        return False
    if not stat.S_ISREG(state.st_mode) or state.st_size > MOST_JOURNAL:
        raise _foreign(path, journal)
    try:
        with journal.open("rb") as file:
            file.seek(max(state.st_size - len(_END_OF_NAME), 0))
            end_of_file = file.read(len(_END_OF_NAME))
    except FileNotFoundError:  # the run that wrote it has ended
        return False
    if end_of_file == _END_OF_NAME:
        raise _foreign(path, journal)
    return True


def written_ahead(path: Path) -> InputError:
    """The refusal of a file that another program has set to write ahead (WAL)."""
    return InputError(
        f"{path} was opened by another program that keeps its writes in a second file (WAL); an atlas has "
        "none. Do PRAGMA journal_mode = DELETE there, or choose another file.",
        str(path),
    )


def _foreign(path: Path, beside: Path) -> InputError:
    return InputError(
        f"{beside.name} stands beside {path}, and no run of an atlas leaves such a file. Move it elsewhere.",
        str(path),
    )
