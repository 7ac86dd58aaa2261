"""Which pictures of an AVI file are missing: its index names them all, also those that are overwritten."""

from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO

import numpy as np

from core.arrays import Bools

ENTRY = 16
"""Bytes of an entry of the index: chunk, flags, place and length."""

MOST_ENTRIES = 1 << 22
"""Entries of an index that are read; a damaged length may claim the whole film."""

MOST_CHUNKS = 16
"""Lists and chunks of a file among which pictures and index are looked for."""


@dataclass(frozen=True)
class AviLayout:
    """Places in an AVI file, bytes.

    Args:
        pictures: where the list of the pictures begins, at its name “movi”.
        index: where the entries of the index begin.
        index_length: of the entries.
    """

    pictures: int
    index: int
    index_length: int


def pictures_there(path: Path) -> Bools | None:
    """Whether each picture that the index of an AVI file names stands at its place.

    A chunk is overwritten where another name or length stands at its place than in the index.

    Returns:
        (n,) in the order of the file; None where the file is no AVI or its index is missing.
    """
    with path.open("rb") as file:
        layout = _layout(file)
        if layout is None:
            return None
        file.seek(layout.index)
        content = file.read(min(layout.index_length, MOST_ENTRIES * ENTRY))
        entries = [content[at : at + ENTRY] for at in range(0, len(content) - ENTRY + 1, ENTRY)]
        entries = [entry for entry in entries if entry[2:4] in (b"dc", b"db")]
        for base in (layout.pictures, 0):  # some programs write places from the beginning of the file
            there = np.array([_is_there(file, entry, base) for entry in entries], dtype=np.bool_)
            if there.any():
                return there
    return None


def _layout(file: BinaryIO) -> AviLayout | None:
    head = file.read(12)
    if head[:4] != b"RIFF" or head[8:12] != b"AVI ":
        return None
    pictures, at = 0, 12
    for _ in range(MOST_CHUNKS):
        file.seek(at)
        chunk = file.read(12)
        length = int.from_bytes(chunk[4:8], "little")
        if chunk[8:12] == b"movi":
            pictures = at + 8
        elif chunk[:4] == b"idx1" and pictures:
            return AviLayout(pictures, at + 8, length)
        at += 8 + length + length % 2
    return None


def _is_there(file: BinaryIO, entry: bytes, base: int) -> bool:
    file.seek(base + int.from_bytes(entry[8:12], "little"))
    return file.read(8) == entry[:4] + entry[12:16]
