"""Kind and size of a picture file by its first bytes, before anybody unpacks it."""

import struct
from dataclasses import dataclass

from core.errors import InputError

MOST_PIXELS = 50_000_000
"""Of a picture; unpacked it takes three bytes for each."""

_PNG = b"\x89PNG\r\n\x1a\n"
_JPEG = b"\xff\xd8"
_SIZED = frozenset(range(0xC0, 0xD0)) - {0xC4, 0xC8, 0xCC}
"""Markers of a JPEG frame's header; the three others of that row are tables."""
_BARE = frozenset({0x01, *range(0xD0, 0xD8)})
"""Markers that nothing belongs to."""


@dataclass(frozen=True)
class PictureSize:
    """What a picture file says of itself.

    Args:
        kind: `png` or `jpeg`.
        width: px.
        height: px.
    """

    kind: str
    width: int
    height: int


def require_readable(width: int, height: int, name: str) -> None:
    """Refuses a picture that would take too much memory, before it is unpacked.

    Raises:
        InputError: it has too many pixels.
    """
    if width * height > MOST_PIXELS:
        raise InputError(
            f"{name} has {width} × {height} pixels; at most {MOST_PIXELS // 1_000_000} million are read. "
            "Make it smaller.",
            name,
        )


def picture_size(content: bytes, name: str) -> PictureSize:
    """Kind and size of a PNG or JPEG file.

    Raises:
        InputError: it is neither, or it ends before it says its size.
    """
    size = None
    if content.startswith(_PNG) and content[12:16] == b"IHDR" and len(content) >= 24:
        size = PictureSize("png", *struct.unpack(">II", content[16:24]))
    elif content.startswith(_JPEG):
        size = _jpeg_size(content)
    if size is None or min(size.width, size.height) < 1:
        raise InputError(f"{name} is no PNG or JPEG picture, or it is cut short. Give one of these.", name)
    return size


def _jpeg_size(content: bytes) -> PictureSize | None:
    """Of the first frame's header; None where there is none."""
    at = len(_JPEG)
    while at + 9 <= len(content) and content[at] == 0xFF:
        marker = content[at + 1]
        if marker == 0xFF:  # padding
            at += 1
        elif marker in _BARE:
            at += 2
        elif marker in _SIZED:
            height, width = struct.unpack(">HH", content[at + 5 : at + 9])
            return PictureSize("jpeg", width, height)
        else:
            at += 2 + int(struct.unpack(">H", content[at + 2 : at + 4])[0])
    return None
