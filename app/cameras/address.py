"""Where a camera is."""

import re
from dataclasses import dataclass

DEVICE = re.compile(r"video\d+")
"""Ids of the computer's own cameras, as Linux names them."""


@dataclass(frozen=True)
class CameraAddress:
    """Where a camera is.

    Args:
        id: in addresses and settings.
        name: what a person calls it.
        path: of the device or the file.
        is_file: whether a video file is played as a camera.
    """

    id: str
    name: str
    path: str
    is_file: bool
