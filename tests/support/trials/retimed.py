"""An MP4 file whose pictures come at other times, as a phone's do."""

from __future__ import annotations

import struct
from collections.abc import Sequence

HOLDING = (b"moov", b"trak", b"mdia", b"minf", b"stbl")
"""Boxes that hold others (ISO/IEC 14496-12)."""


def retimed(content: bytes, lengths: Sequence[int]) -> bytes:
    """The file with other times from each picture to the next.

    Args:
        content: a file whose index follows its pictures, as OpenCV writes it.
        lengths: for each picture, in its usual length.
    """
    found, at = b"", 0
    while at < len(content):
        size, name = struct.unpack(">I4s", content[at : at + 8])
        body = content[at + 8 : at + size]
        if name in HOLDING:
            body = retimed(body, lengths)
        elif name == b"stts":
            body = _times(body, lengths)
        # The list of cuts would end the film at its old length.
        kept = b"free" if name == b"edts" else name
        found += struct.pack(">I4s", 8 + len(body), kept) + body
        at += size
    return found


def _times(body: bytes, lengths: Sequence[int]) -> bytes:
    (usual,) = struct.unpack(">I", body[12:16])
    entries = b"".join(struct.pack(">II", 1, length * usual) for length in lengths)
    return struct.pack(">II", 0, len(lengths)) + entries
