"""Where videos are in the data folder: uploads as they came, recordings in a folder each."""

import contextlib
import hashlib
import os
import re
import shutil
from pathlib import Path

from app.store.gait_files import require_folder
from app.store.plain_file import sweep_partials
from core.errors import InputError, StateError

MOST_BYTES = 4_000_000_000
"""Of an uploaded video."""

LEAST_FREE = 1_000_000_000
"""Bytes that an upload or a recording leaves free on the disk."""

MOST_RECORDED = 20_000_000_000
"""Bytes of all recordings together; then the oldest ones go."""

_ENDING = re.compile(r"\.[a-z0-9]{1,5}")


class Upload:
    """A video on its way into the data folder; it is kept whole or not at all.

    Args:
        partial: where it is written meanwhile.
        name: of the file, for messages.
    """

    def __init__(self, partial: Path, name: str) -> None:
        self.partial, self.name = partial, name
        self.size = 0
        self._hash = hashlib.sha256()
        self._file = partial.open("wb")

    def add(self, data: bytes) -> None:
        """Takes the next bytes.

        Raises:
            InputError: they are too many.
            StateError: the disk does not take them.
        """
        self.size += len(data)
        self._hash.update(data)
        if self.size > MOST_BYTES:
            raise too_large(self.size)
        try:
            self._file.write(data)
        except OSError as error:
            raise _not_written(error) from error

    @property
    def content_hash(self) -> str:
        """SHA-256 of what came, hexadecimal."""
        return self._hash.hexdigest()

    def finish(self) -> None:
        """Ends the writing.

        Raises:
            StateError: the disk does not take the last bytes.
        """
        try:
            self._file.flush()
            os.fsync(self._file.fileno())
            self._file.close()
        except OSError as error:
            raise _not_written(error) from error

    def discard(self) -> None:
        """Takes away what was written."""
        with contextlib.suppress(OSError):  # a full disk does not take the last bytes here either
            self._file.close()
        self.partial.unlink(missing_ok=True)


def _not_written(error: OSError) -> StateError:
    return StateError(
        f"The video cannot be written: {error.strerror}. Make room on the disk of the data folder.", "file"
    )


def too_large(size: int) -> InputError:
    """The refusal of an upload of so many bytes."""
    return InputError(
        f"The video has {size / 1e9:.1f} GB or more; at most {MOST_BYTES / 1e9:g} GB are taken. Cut it, or "
        "save it with a stronger compression.",
        "file",
    )


class VideoFiles:
    """The folder `videos`.

    Args:
        data: the data folder.
    """

    def __init__(self, data: Path) -> None:
        self.folder = data / "videos"
        require_folder(self.folder)
        sweep_partials(self.folder, lambda partial, state: True)

    def begin(self, video: str, name: str, size: int | None) -> Upload:
        """Starts an upload.

        Args:
            video: its id.
            name: of the file, as a person has it.
            size: in bytes, where that is known.

        Raises:
            InputError: it is too large.
            StateError: there is no room for it.
        """
        if size is not None and size > MOST_BYTES:
            raise too_large(size)
        self.require_room(size or 0)
        return Upload(self.folder / f".{video}{ending_of(name)}.partial", name)

    def require_room(self, size: int) -> None:
        """Refuses where the disk has no room for so many bytes.

        Raises:
            StateError: saying what there is.
        """
        free = shutil.disk_usage(self.folder).free
        if free < size + LEAST_FREE:
            raise StateError(
                f"The disk of the data folder has {free / 1e9:.1f} GB left, and {LEAST_FREE / 1e9:g} GB stay "
                "free. Make room on it.",
                "file",
            )

    def path(self, file: str) -> Path:
        """A kept file or folder."""
        return self.folder / file

    def remove(self, file: str) -> None:
        """Takes a file or a recording's folder away."""
        path = self.path(file)
        if path.is_dir():
            shutil.rmtree(path, ignore_errors=True)
        else:
            path.unlink(missing_ok=True)


def ending_of(name: str) -> str:
    """A file name's ending where it is one of letters and digits, else nothing."""
    ending = Path(name).suffix.lower()
    return ending if _ENDING.fullmatch(ending) else ""
