"""One compressed archive of a data folder and of what the studio that made it says of it."""

from __future__ import annotations

import io
import json
import sqlite3
import tarfile
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path
from typing import Any

DATA, CONTENTS = "data", "contents.json"


@dataclass(frozen=True)
class Unpacked:
    """A data folder, and what the program that made it said of it."""

    data: Path
    contents: dict[str, Any]


def pack(data: Path, contents: dict[str, Any], archive: Path) -> None:
    """Packs a folder that nobody has open, with the whole database in one file."""
    with closing(sqlite3.connect(data / "studio.sqlite3")) as database:
        database.execute("PRAGMA wal_checkpoint(TRUNCATE)")
    text = json.dumps(contents, indent=1, sort_keys=True).encode()
    with tarfile.open(archive, "w:xz", preset=9) as file:
        file.add(data, DATA, filter=_nobodys)
        entry = tarfile.TarInfo(CONTENTS)
        entry.size = len(text)
        file.addfile(entry, io.BytesIO(text))


def unpack(archive: Path, folder: Path) -> Unpacked:
    """Unpacks an archive into an empty folder."""
    with tarfile.open(archive) as file:
        file.extractall(folder, filter="data")
    return Unpacked(folder / DATA, json.loads((folder / CONTENTS).read_text()))


def _nobodys(entry: tarfile.TarInfo) -> tarfile.TarInfo:
    entry.uid = entry.gid = 0
    entry.uname = entry.gname = ""
    return entry
