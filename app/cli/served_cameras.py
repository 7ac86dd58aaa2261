"""The `--camera` words of `serve`."""

import re
from collections.abc import Sequence
from pathlib import Path

from app.cameras.address import DEVICE, CameraAddress
from core.errors import InputError


def served_cameras(words: Sequence[str]) -> tuple[CameraAddress, ...]:
    """Video files that are played as cameras.

    Args:
        words: each a name, an equals sign and a file.

    Raises:
        InputError: a word is none, a file is not there, two have one name, or one that cameras of the
            computer have.
    """
    found: dict[str, CameraAddress] = {}
    for word in words:
        name, _, path = word.partition("=")
        key = re.sub(r"[^a-z0-9]+", "-", name.lower()).strip("-")
        if not key or not path:
            raise InputError(f"“{word}” is no camera; write NAME=VIDEO, as in under=walk.avi.", "--camera")
        if DEVICE.fullmatch(key):
            raise InputError(
                f"“{name}” is the name of a camera of this computer; give “{path}” another name.",
                "--camera",
            )
        if key in found:
            raise InputError(f"Two cameras are called “{key}”; give each a name of its own.", "--camera")
        file = Path(path).expanduser().resolve()
        if not file.is_file():
            raise InputError(f"There is no file {path} to play as the camera “{name}”.", "--camera")
        found[key] = CameraAddress(key, name, str(file), True)
    return tuple(found.values())
