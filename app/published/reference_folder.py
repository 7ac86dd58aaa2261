"""The folder of the published data: named by a person, and remembered in the data folder."""

import json
import threading
from dataclasses import dataclass
from pathlib import Path

from app.common.json import Json
from app.published.reference import Reference, open_reference
from app.store.plain_file import read_plain_file, write_atomically
from app.store.tables.shapes import ShapeError, text
from core.errors import FootfallError, InputError
from core.text.documents import json_content

REFERENCE = "reference.json"
"""The file of the data folder that remembers it."""
_MOST_BYTES = 100_000


@dataclass(frozen=True)
class PublishedFolder:
    """The folder as it is now.

    Args:
        name: as a person named it; empty for none.
        reference: the published data; None where no folder is named, or it cannot be read.
        sentence: why it cannot be read; else empty.
    """

    name: str = ""
    reference: Reference | None = None
    sentence: str = ""

    @property
    def remedy(self) -> str:
        """A sentence that says how the published data comes to hand."""
        return self.sentence or "Name the folder of the published data."

    def content(self) -> Json:
        """Folder, and why it cannot be read, as JSON content."""
        return {"folder": self.name, "sentence": self.sentence}


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

    def read(self) -> PublishedFolder:
        """The folder as it is now."""
        with self._lock:
            folder, sentence = self._folder, self._sentence
        try:
            return PublishedFolder(folder, _reference(folder) if folder else None, sentence)
        except InputError as error:
            return PublishedFolder(folder, None, error.sentence)

    def _recall(self) -> tuple[str, str]:
        try:
            content = json_content(read_plain_file(self._memory, _MOST_BYTES), "the file")
            return text(content["folder"], "folder"), ""
        except FileNotFoundError:
            return "", ""
        except (FootfallError, ShapeError, KeyError, TypeError) as error:
            return "", f"{self._memory.name} in the data folder names no folder ({error}). Name it again."


def _reference(folder: str) -> Reference:
    if not folder.startswith(("/", "~")):
        raise InputError(f"{folder} is no full path. Write the folder's whole path.", "folder")
    return open_reference(folder)
