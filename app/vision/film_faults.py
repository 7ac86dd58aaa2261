"""Why a file gives no pictures, and what a person can do about it; the file's own bytes tell."""

import re
from pathlib import Path

import numpy as np

from core.errors import InputError

LOOKED = 1 << 16
"""Bytes at the beginning of a file in which marks of its kind are looked for."""

MOST_INDEX = 1 << 26
"""Bytes of a file's index that are read; a damaged length may claim the whole film."""

TRIMMED = 0.25
"""An edit list that begins later than this trims the film, s; encoders begin a few pictures later."""

CODECS = {
    "apch": "ProRes",
    "apcn": "ProRes",
    "av01": "AV1",
    "avc1": "H.264",
    "ffv1": "FFV1",
    "fmp4": "MPEG-4",
    "h264": "H.264",
    "hev1": "HEVC (H.265)",
    "hevc": "HEVC (H.265)",
    "hvc1": "HEVC (H.265)",
    "mjpg": "Motion JPEG",
    "mp4v": "MPEG-4",
    "vp08": "VP8",
    "vp09": "VP9",
    "vp80": "VP8",
    "vp90": "VP9",
    "vvc1": "VVC (H.266)",
    "v_av1": "AV1",
    "v_mpegh/iso/hevc": "HEVC (H.265)",
    "v_mpegi/iso/vvc": "VVC (H.266)",
}
"""Names of codecs by how files mark them, in small letters."""

ALWAYS_READ = {"FFV1", "Motion JPEG", "MPEG-4", "VP8", "VP9"}
"""Codecs that every OpenCV with FFmpeg decodes, so that a file of them without a picture is damaged."""

_REPAIR = (
    "Copy it from the camera again; if it is no better there, a repair tool such as untrunc may rebuild the "
    "index from another film of the same camera."
)
_SOUND = (b"ID3", b"fLaC", b"#!AMR")
_MATROSKA, _AVI_FILM, _MATROSKA_CODEC = b"\x1a\x45\xdf\xa3", b"vids", re.compile(rb"V_[A-Z0-9/]{2,30}")


def nothing_opens(path: Path, codec: str | None, count: int) -> InputError:
    """The refusal of a file that OpenCV does not open.

    Args:
        path: of the file.
        codec: four characters, where FFmpeg finds pictures in it; else None.
        count: how many it finds.
    """
    name = path.name
    with path.open("rb") as file:
        head = file.read(LOOKED)
    if not head:
        return InputError(f"{name} is empty; choose a video.", name)
    if b"\0" not in head[:1024]:
        return InputError(f"{name} cannot be read as a video: it holds text. Choose the film itself.", name)
    if _is_sound(path, head):
        return InputError(f"{name} cannot be read as a video: it holds sound and no pictures.", name)
    marked = codec or _marked_codec(head)
    if marked:
        return _cannot_decode(path, codec_name(marked), count)
    if head[4:8] == b"ftyp" and b"moov" not in _boxes(path):
        return InputError(
            f"{name} cannot be read as a video: its index (the box “moov”) is missing, because the recording "
            f"or the copy of it was broken off. {_REPAIR}",
            name,
        )
    return InputError(
        f"{name} cannot be read as a video: its kind is not known here, or it is damaged. {_convert(path)}",
        name,
    )


def nothing_decodes(path: Path, codec: str, count: int, told_count: int) -> InputError:
    """The refusal of a file that opens and gives no picture.

    Args:
        path: of the file.
        codec: four characters; "" where OpenCV knows none.
        count: how many pictures are found in the file.
        told_count: how many it should hold.
    """
    if not count and told_count > 0:
        return InputError(
            f"No picture of {path.name} can be found, though it should hold some: its index is damaged or "
            f"cut off. {_REPAIR}",
            path.name,
        )
    if not count:
        return InputError(
            f"{path.name} is a film without pictures: it lasts 0 s. Record it again.", path.name
        )
    with path.open("rb") as file:
        name = codec_name(codec or _marked_codec(file.read(LOOKED)) or "")
    if name in ALWAYS_READ:
        return InputError(
            f"None of the {count} pictures of {path.name} decodes: the file is damaged (its codec, {name}, "
            "can be read here). Copy it from the camera again.",
            path.name,
        )
    return _cannot_decode(path, name, count)


def codec_name(mark: str) -> str:
    """A codec as people call it; the mark itself where it has no other name."""
    return CODECS.get(mark.lower(), f"“{mark}”" if mark.isprintable() and mark.strip() else "unknown")


def _cannot_decode(path: Path, codec: str, count: int) -> InputError:
    pictures = f"None of the {count} pictures of {path.name}" if count else f"No picture of {path.name}"
    return InputError(
        f"{pictures} decodes: the codec is {codec}, for which OpenCV has no decoder on this computer, or the "
        f"file is damaged. {_convert(path)}",
        path.name,
    )


def _convert(path: Path) -> str:
    return (
        f'Convert it, then choose the new file: ffmpeg -i "{path.name}" -c:v libx264 -crf 16 -an '
        "-fps_mode passthrough converted.mp4"
    )


def _boxes(path: Path) -> dict[bytes, tuple[int, int]]:
    """An MP4 file's outer boxes by name, with where each begins and ends (ISO/IEC 14496-12)."""
    found: dict[bytes, tuple[int, int]] = {}
    size, at = path.stat().st_size, 0
    with path.open("rb") as file:
        while at + 8 <= size:
            file.seek(at)
            head = file.read(16)
            length = int.from_bytes(head[:4], "big")
            length = int.from_bytes(head[8:16], "big") if length == 1 else length
            found[head[4:8]] = (at, at + length)
            if length < 8:
                break
            at += length
    return found


def _index(path: Path) -> bytes:
    """The index of an MP4 file, its box “moov”, as far as `MOST_INDEX`; empty where there is none."""
    begin, end = _boxes(path).get(b"moov", (0, 0))
    with path.open("rb") as file:
        file.seek(begin)
        return file.read(min(end - begin, MOST_INDEX))


def begins_later(path: Path) -> bool:
    """Whether an MP4 file's edit list leaves out a part at its beginning, as a film that was trimmed does."""
    for track in _index(path).split(b"trak")[1:]:
        head, cut = track.find(b"mdhd"), track.find(b"elst")
        if min(head, cut) >= 0:
            scale = int.from_bytes(track[head + 16 : head + 20], "big")
            begin = int.from_bytes(track[cut + 16 : cut + 20], "big", signed=True)
            if begin >= TRIMMED * scale:
                return True
    return False


def require_times(path: Path) -> None:
    """Raises InputError where an MP4 file's index gives all of several pictures the same time."""
    for track in _index(path).split(b"trak")[1:]:
        at = track.find(b"stts")
        if at < 0 or b"vide" not in track:
            continue
        count = int.from_bytes(track[at + 8 : at + 12], "big")
        table = np.frombuffer(track[at + 12 : at + 12 + 8 * count], dtype=">u4")
        pictures, lasting = table[: table.size // 2 * 2].reshape(-1, 2).T.astype(np.int64)
        if pictures.sum() > 1 and not (pictures * lasting).any():
            raise InputError(
                f"The times of {path.name} cannot be used: all its pictures have the same one. Save it again "
                "with the rate at which it was taken, here 30 pictures a second, then choose the new file: "
                f'ffmpeg -i "{path.name}" -vf setpts=N/30/TB -r 30 -c:v libx264 -crf 16 -an converted.mp4',
                path.name,
            )


def _is_sound(path: Path, head: bytes) -> bool:
    """Whether marks of sound are in a file, and none of pictures."""
    if head.startswith(_SOUND) or (head[:4] == b"RIFF" and head[8:12] == b"WAVE"):
        return True
    if head[:4] == b"RIFF":
        return b"auds" in head and _AVI_FILM not in head
    if head.startswith(_MATROSKA):
        return b"A_" in head and _MATROSKA_CODEC.search(head) is None
    index = _index(path) if head[4:8] == b"ftyp" else b""
    return b"soun" in index and b"vide" not in index


def _marked_codec(head: bytes) -> str | None:
    """The codec that an AVI or Matroska file names in its head; None where none is."""
    if head[:4] == b"RIFF" and (at := head.find(_AVI_FILM)) >= 0:
        return head[at + 4 : at + 8].decode("ascii", "replace")
    found = _MATROSKA_CODEC.search(head) if head.startswith(_MATROSKA) else None
    return None if found is None else found.group().decode()
