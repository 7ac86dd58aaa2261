"""OpenCV, loaded by whoever first needs it, so that the server, which only asks its processes, does not.

It and its FFmpeg print nothing: what went wrong with a picture or film is a sentence of the program's own.
"""

import os
from functools import cache
from importlib import import_module
from typing import TYPE_CHECKING, Any

_QUIET = {"OPENCV_LOG_LEVEL": "SILENT", "OPENCV_FFMPEG_LOGLEVEL": "-8"}
"""Read by OpenCV when it is loaded and when its FFmpeg begins; −8 is FFmpeg's AV_LOG_QUIET."""

if TYPE_CHECKING:
    import cv2 as cv2
else:

    @cache
    def _loaded() -> Any:
        os.environ.update(_QUIET)
        return import_module("cv2")

    class _Later:
        def __getattr__(self, name: str) -> Any:
            return getattr(_loaded(), name)

    cv2 = _Later()
