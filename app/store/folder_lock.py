"""Locks of the data folder: one studio at a time, and who has the database open.

The system holds them and lets them go however a program ends, so that a crash leaves none behind.
"""

import contextlib
import fcntl
import json
import os
import socket
import time
from pathlib import Path

from app.common.json import Json
from core.errors import InputError

STUDIO, DATABASE_USERS = "studio.lock", "database.lock"
"""Files in the data folder that are locked; what stands in them counts only while they are."""

_LOOKS, _LOOK_SECONDS = 20, 0.05
"""How often, and how far apart, is looked for the address of a studio that is just starting."""


class _Lock:
    """A locked file.

    Args:
        path: made where it does not exist.
        operation: of `fcntl.flock`.

    Raises:
        BlockingIOError: somebody else has it.
        OSError: the file cannot be opened, or the file system has no locks.
    """

    def __init__(self, path: Path, operation: int) -> None:
        self._file = os.open(path, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o644)
        try:
            fcntl.flock(self._file, operation | fcntl.LOCK_NB)
        except OSError:
            os.close(self._file)
            raise

    def write(self, content: Json) -> None:
        """Says who has it; without room on the disk, it is locked all the same."""
        with contextlib.suppress(OSError):
            os.ftruncate(self._file, 0)
            os.pwrite(self._file, json.dumps(content).encode(), 0)

    def close(self) -> None:
        """Unlocks it; doing it twice does no harm."""
        if self._file >= 0:
            os.close(self._file)
            self._file = -1


class StudioLock:
    """Held by the one program that may change gaits in a data folder.

    Args:
        data: the data folder.
        program: what is called the holder.

    Raises:
        InputError: another program holds it, or the folder takes no lock.
    """

    def __init__(self, data: Path, program: str = "studio") -> None:
        path = data / STUDIO
        try:
            self._lock = _Lock(path, fcntl.LOCK_EX)
        except BlockingIOError:
            raise InputError(_held(data, path), "--data") from None
        except OSError as error:
            raise _no_lock(path, error) from error
        self._content = {"program": program, "process": os.getpid(), "computer": socket.gethostname()}
        self._lock.write(self._content)

    def tell(self, address: str) -> None:
        """Says where the holder can be reached."""
        self._lock.write({**self._content, "address": address})

    def close(self) -> None:
        """Lets the folder go."""
        self._lock.close()


def studio_address(data: Path) -> str | None:
    """Where the studio of a data folder can be reached; None where none is running."""
    path = data / STUDIO
    if not os.path.exists(path):  # or nobody may look
        return None
    try:
        _Lock(path, fcntl.LOCK_SH).close()
    except BlockingIOError:
        address = _holder(path).get("address")
        return address if isinstance(address, str) else None
    except OSError as error:
        raise _no_lock(path, error) from error
    return None


class DatabaseUse:
    """Held with others by each program that has the database open, and by one alone that replaces it.

    Args:
        data: the data folder.
        alone: whether nobody else may have it open.

    Raises:
        InputError: another program has it open or replaces it, or the folder takes no lock.
    """

    def __init__(self, data: Path, *, alone: bool = False) -> None:
        path = data / DATABASE_USERS
        try:
            self._lock = _Lock(path, fcntl.LOCK_EX if alone else fcntl.LOCK_SH)
        except BlockingIOError:
            who = "has the database open, such as `footfall send`" if alone else "replaces the database"
            raise InputError(f"Another program {who}. Wait until it has ended.", "--data") from None
        except OSError as error:
            raise _no_lock(path, error) from error

    def close(self) -> None:
        """Lets the database go."""
        self._lock.close()


def _no_lock(path: Path, error: OSError) -> InputError:
    return InputError(
        f"The data folder cannot be used: {path} cannot be locked ({error.strerror}). Give a folder that you "
        "may write to, on a disk of this computer, with --data.",
        "--data",
    )


def _held(data: Path, path: Path) -> str:
    """Who has the folder, and what to do."""
    holder = _holder(path)
    program = f"Another {holder.get('program', 'studio')}"
    process = holder.get("process")
    who = program if process is None else f"{program}, process {process}"
    if holder.get("computer", socket.gethostname()) != socket.gethostname():
        who += f" on {holder['computer']}"
    where = f" at {holder['address']}" if "address" in holder else ""
    return (
        f"{who}, has the data folder {data} open{where}. Use that one, end it first, or give another folder "
        "with --data."
    )


def _holder(path: Path) -> Json:
    """What the holder says of itself; an address comes a moment after the lock."""
    found: Json = {}
    for _ in range(_LOOKS):
        with contextlib.suppress(OSError, ValueError):
            content = json.loads(path.read_bytes())
            found = content if isinstance(content, dict) else {}
        if "address" in found or found.get("program", "studio") != "studio":
            break
        time.sleep(_LOOK_SECONDS)
    return found
