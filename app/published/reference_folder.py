"""The folder of the published data: named by a person, and remembered in the data folder."""

import json
import threading
from pathlib import Path

from app.common.json import Json
from app.published.reference import Reference
from app.store.plain_file import read_plain_file, write_atomically
from core.errors import FootfallError, InputError
from core.text.documents import json_content

REFERENCE = "reference.json"
"""The file of the data folder that remembers it."""
_MOST_BYTES = 100_000


class ReferenceFolder:
    """The folder, or none. Thread-safe.

    Args:
        memory: the file that remembers it.
    """

    def __init__(self, memory: Path) -> None:
        self._memory = memory
        self._lock = threading.Lock()
        self._folder, self._sentence = self._recall()

    def name(self, folder: str) -> None:
        """Names the folder; an empty name forgets it.

        Raises:
            InputError: it is not there, or lacks the data.
            StorageError: it cannot be remembered.
        """
        path = str(_reference(folder).folder) if folder else ""
        with self._lock:
            write_atomically(self._memory, json.dumps({"folder": path}))
            self._folder, self._sentence = path, ""

    def reference(self) -> Reference | None:
        """The published data; None where no folder is named, or it cannot be read now."""
        with self._lock:
            folder = self._folder
        try:
            return _reference(folder) if folder else None
        except InputError:
            return None

    def content(self) -> Json:
        """Folder, and why it cannot be read, as JSON content."""
        with self._lock:
            folder, sentence = self._folder, self._sentence
        try:
            if folder:
                _reference(folder)
        except InputError as error:
            sentence = error.sentence
        return {"folder": folder, "sentence": sentence}

    def _recall(self) -> tuple[str, str]:
        try:
            folder = json_content(read_plain_file(self._memory, _MOST_BYTES), "the file")["folder"]
            if not isinstance(folder, str):
                raise InputError("its folder is no text", self._memory.name)
        except FileNotFoundError:
            return "", ""
        except (FootfallError, KeyError, TypeError) as error:
            return "", f"{self._memory.name} in the data folder names no folder ({error}). Name it again."
        return folder, ""


def _reference(folder: str) -> Reference:
    path = Path(folder).expanduser()
    if not path.is_absolute():
        raise InputError(f"{folder} is no full path. Write the folder's whole path.", "folder")
    if not path.is_dir():
        raise InputError(f"There is no folder {folder}. Correct its name.", "folder")
    return Reference(path)
