"""A data folder's own time: the wall clock's, but a step of that moves it by a day at most."""

import json
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from app.common.clock import CLOCK, Clock
from app.common.json import Json
from app.store.plain_file import read_plain_file, write_atomically
from core.errors import FootfallError

FILE = "time.json"
_MOST_BYTES = 100_000

MOST_AWAY = 86_400.0
"""Time without the program counts as so much at most, s: nothing tells it from a step of the clock."""


@dataclass(frozen=True)
class LastBackup:
    """The last daily backup.

    Args:
        time: of the folder when it was made, s.
        state: of the database then: name, size and time of writing of each of its files.
    """

    time: float
    state: list[Any]


class FolderTime:
    """By this time old things go and backups are made, whatever the wall clock is set to.

    While the program runs it counts with the clock that nobody sets. It begins as the wall clock.

    Args:
        data: the data folder.
        clock: the clocks of the machine.

    Attributes:
        last_backup: the last daily backup; None where none is known.
    """

    def __init__(self, data: Path, clock: Clock = CLOCK) -> None:
        self._path, self._clock, self._span = data / FILE, clock, clock.start()
        self._begin, self.last_backup = self._span.started, None
        # Without the file, or with a damaged one, the folder's time begins anew.
        with suppress(FootfallError, OSError, ValueError, KeyError, TypeError):
            kept = json.loads(read_plain_file(self._path, _MOST_BYTES))
            away = min(max(self._span.started - float(kept["wall"]), 0.0), MOST_AWAY)
            self._begin = float(kept["time"]) + away
            backup = kept["backup"]
            self.last_backup = None if backup is None else LastBackup(float(backup["time"]), backup["state"])

    @property
    def now(self) -> float:
        """The folder's time, s; never before what it was."""
        return self._begin + self._span.seconds

    def backed_up(self, state: list[Any]) -> None:
        """Remembers that a daily backup was made now of a state of the database.

        Raises:
            StorageError: the disk does not take it.
        """
        self.last_backup = LastBackup(self.now, state)
        self.keep()

    def keep(self) -> None:
        """Writes how late it is, for the next start of the program.

        Raises:
            StorageError: the disk does not take it.
        """
        backup = None if self.last_backup is None else vars(self.last_backup)
        content: Json = {"time": self.now, "wall": self._clock.wall(), "backup": backup}
        write_atomically(self._path, json.dumps(content))
