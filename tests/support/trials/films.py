"""Short films that a test makes itself, and what can be wrong with them."""

from __future__ import annotations

import struct
from pathlib import Path

import cv2
import numpy as np

from app.vision.video_io import Picture

RATE = 30.0
COUNT = 60
SIZE = (64, 48)
"""Width and height, px."""


BITS = 6
"""Fields of a picture, each light or dark, which hold its number."""


def number_of(picture: Picture) -> int:
    """Which picture of the film one is; turned ones have no number."""
    fields = np.array_split(picture.mean(axis=(0, 2)), BITS)
    return sum(1 << bit for bit, field in enumerate(fields) if field.mean() > 128)


def _drawn(number: int) -> Picture:
    fields = np.array_split(np.zeros((SIZE[1], SIZE[0], 3), dtype=np.uint8), BITS, axis=1)
    lit = [field + 225 * (number >> bit & 1) + 15 for bit, field in enumerate(fields)]
    return np.concatenate(lit, axis=1).astype(np.uint8)


def film(path: Path, code: str = "mp4v", count: int = COUNT) -> bytes:
    """Writes a film whose pictures hold their numbers.

    Args:
        path: of the file.
        code: of the codec (FourCC).
        count: of its pictures.

    Returns:
        The file's content.
    """
    writer = cv2.VideoWriter(str(path), cv2.CAP_FFMPEG, cv2.VideoWriter.fourcc(*code), RATE, SIZE)
    assert writer.isOpened(), code
    for number in range(count):
        writer.write(_drawn(number))
    writer.release()
    return path.read_bytes()


def with_codec(content: bytes, code: bytes) -> bytes:
    """An MP4 file that names another codec, as one of a camera whose codec is not known here."""
    return content.replace(b"esds", b"free").replace(b"mp4v", code)


def index_first(content: bytes) -> bytes:
    """An MP4 file whose index stands before its pictures, as phones and web sites write it."""
    (head,) = struct.unpack(">I", content[:4])
    begin = content.find(b"moov") - 4
    index = bytearray(content[begin:])
    at = index.find(b"stco") + 12
    (count,) = struct.unpack(">I", index[at - 4 : at])
    for place in range(at, at + 4 * count, 4):
        (offset,) = struct.unpack(">I", index[place : place + 4])
        index[place : place + 4] = struct.pack(">I", offset + len(index))
    return content[:head] + bytes(index) + content[head:begin]


def turned(content: bytes) -> bytes:
    """An MP4 file that says its pictures are to be turned by a quarter."""
    at = content.find(b"tkhd") + 44
    matrix = struct.pack(">9i", 0, 1 << 16, 0, -(1 << 16), 0, 0, 0, 0, 1 << 30)
    return content[:at] + matrix + content[at + 36 :]


def trimmed(content: bytes, begin: int) -> bytes:
    """An MP4 file whose edit list leaves out its beginning, in the units of its track."""
    at = content.find(b"elst") + 16
    return content[:at] + struct.pack(">i", begin) + content[at + 4 :]


def without_pictures(content: bytes) -> bytes:
    """An MP4 file whose tables name no picture, and which lasts 0 s."""
    tables = ((b"stsz", 12), (b"stts", 8), (b"stsc", 8), (b"stco", 8))
    for name, place in (*tables, (b"mvhd", 20), (b"mdhd", 20), (b"tkhd", 24), (b"elst", 12)):
        at = content.find(name) + place
        content = content[:at] + bytes(4) + content[at + 4 :]
    return content


def without_times(content: bytes) -> bytes:
    """An MP4 file of an even rate whose pictures last 0 s, so that all have the same time."""
    at = content.find(b"stts") + 16
    return content[:at] + bytes(4) + content[at + 4 :]


def blotted(content: bytes, share: float, size: int) -> bytes:
    """A file in which so many bytes of the pictures are zero, from a share of it on."""
    at = int(len(content) * share)
    return content[:at] + bytes(size) + content[at + size :]
