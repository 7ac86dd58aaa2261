"""The studio's SQLite file (WAL); each of its tables has a store in `app.store.tables`.

Every write is committed before its method returns, so that what was acknowledged survives a kill.
"""

import logging
import os
import sqlite3
import threading
from collections.abc import Callable, Iterable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path
from typing import Any

from app.common.clock import CLOCK, Clock
from app.store.backups import MIGRATION, RESCUE, damaged_sentence, make_backup
from app.store.database_files import DatabaseFiles
from app.store.folder_lock import DatabaseUse
from app.store.folder_time import FolderTime
from app.store.quick_check import damage_of, missing_sentence
from app.store.row_damage import DamagedText, RowDamage
from app.store.schema import bring_up_to_date, is_outdated, try_write
from app.store.storage_errors import storage_error
from core.errors import FootfallError, StorageDamagedError

logger = logging.getLogger(__name__)

DATABASE = "studio.sqlite3"
"""Name of the file in a data folder."""


class Database:
    """The studio's database.

    Args:
        path: the file; made where it does not exist.
        clock: the clocks of the machine.

    Attributes:
        path: the file.
        clock: from which whoever keeps something in the database takes its times.
        folder_time: by which old things in the data folder go.
        damage: says that the file is damaged, and how to get back; nothing is written to it then, since going
            back to a backup would lose it again. None where nothing of the kind is known.
        is_new: whether there was no such file.
        row_damages: rows that could not be read, by table and number. All others are as they were.
        files: the files of the database.
        damaged: called, from any thread, once `damage` is set, and when there are new rows in `row_damages`.

    Raises:
        InputError: a newer program wrote it, or the data folder cannot be used.
        StorageError: it cannot be read or brought up to date.
    """

    def __init__(self, path: Path, clock: Clock = CLOCK) -> None:
        self.path, self.clock = path, clock
        self.folder_time = FolderTime(path.parent, clock)
        self.damage: str | None = None
        self.row_damages: dict[tuple[str, int], RowDamage] = {}
        self.damaged: Callable[[], None] = lambda: None
        self._looked_at: set[str] = set()
        self._lock = threading.Lock()
        self.is_new = not os.path.exists(path)  # also where that cannot be looked at
        with ExitStack() as opened:
            opened.callback(DatabaseUse(path.parent).close)
            with self._sentences():
                self._connection = sqlite3.connect(path, check_same_thread=False)
                opened.callback(self._connection.close)
                self._connection.text_factory = _text
                self._connection.execute("PRAGMA journal_mode=WAL")
                self._connection.execute("PRAGMA synchronous=FULL")
                if is_outdated(self._connection):
                    make_backup(path, MIGRATION)
                bring_up_to_date(self._connection)
                missing = missing_sentence(self._connection)
                if missing:
                    raise StorageDamagedError(f"The database {path} is damaged ({missing}).", str(path))
                try_write(self._connection)
                self.files = DatabaseFiles(path)
            self._opened = opened.pop_all()

    def close(self) -> None:
        """Closes the file."""
        with self._lock:
            self._opened.close()

    @contextmanager
    def writing(self) -> Iterator[sqlite3.Connection]:
        """One transaction; it is on disk when this ends without an error, and nothing of it is otherwise.

        Raises:
            StorageError: the disk or the database does not take it, or a file of the database was taken away.
        """
        with self._sentences(), self._lock:
            self._require_whole()
            with self._connection:
                yield self._connection
            self._require_whole()

    def look_at_files(self) -> None:
        """Finds out whether a file of the database was taken away, though nothing is written."""
        with suppress(StorageDamagedError), self._sentences(), self._lock:
            self._require_whole()

    def rows(self, query: str, *values: Any) -> list[tuple[Any, ...]]:
        """What a query finds.

        Raises:
            StorageError: it cannot be read.
        """
        with self._sentences(), self._lock:
            return self._connection.execute(query, values).fetchall()

    def take_row_damage(self, damage: RowDamage, columns: Iterable[Any]) -> bool:
        """Keeps in mind that a row cannot be read, for as long as it is there; tells whether that is new.

        Whoever reads rows calls `damaged` once for all new ones.

        Args:
            damage: what is wrong.
            columns: the row's; the first time in a table that one is no text any more, the file is looked at.
        """
        place = (damage.table, damage.row)
        if place in self.row_damages:
            return False
        self.row_damages[place] = damage
        logger.warning("%s", damage.sentence)
        is_text_lost = any(isinstance(column, DamagedText) for column in columns)
        if is_text_lost and damage.table not in self._looked_at:
            self._looked_at.add(damage.table)
            found = damage_of(self.path, is_open=True)
            if found is not None:
                self.take_damage(f"The database {self.path} is damaged ({found}).")
        return True

    def _require_whole(self) -> None:
        """The database is not damaged, and its files are still its own.

        Raises:
            StorageDamagedError: they are not. What the database holds was copied to a backup.
        """
        if self.damage is not None:
            raise StorageDamagedError(self.damage, str(self.path))
        fault = self.files.fault()
        if fault is None:
            return
        self.damage = fault  # whoever waits for the lock makes no second copy
        try:
            backup = make_backup(self.path, RESCUE, self._connection)
            kept = f"Everything that was stored until then is in the backup {backup.path.name}."
        except FootfallError as error:
            kept = f"What was stored since the last backup may be lost: {error.sentence}"
        self.damage = None
        self.take_damage(f"{fault} {kept}")
        raise StorageDamagedError(self.damage or fault, str(self.path))

    def take_damage(self, sentence: str) -> None:
        """Refuses to write from now on, since the file is damaged."""
        if self.damage is None:
            self.damage = damaged_sentence(sentence, self.path.parent)
            logger.error("%s", self.damage)
            self.damaged()

    @contextmanager
    def _sentences(self) -> Iterator[None]:
        """Turns what SQLite refuses into sentences."""
        try:
            yield
        except (sqlite3.Error, StorageDamagedError) as error:
            refusal = storage_error(error, self.path) if isinstance(error, sqlite3.Error) else error
            if refusal is None:
                raise
            if isinstance(refusal, StorageDamagedError):
                self.take_damage(refusal.sentence)
                raise StorageDamagedError(self.damage or refusal.sentence, refusal.where) from error
            raise refusal from error


def _text(content: bytes) -> str | DamagedText:
    """A stored text; where a page was overwritten it is none any more, or ends in zeros."""
    try:
        if content.strip(b"\0") == content:  # within a text an older version may have kept one
            return content.decode()
    except UnicodeDecodeError:
        pass
    return DamagedText(content)
