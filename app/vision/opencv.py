"""OpenCV, loaded by whoever first needs it, so that the server, which only asks its processes, does not."""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import cv2 as cv2
else:

    class _Later:
        def __getattr__(self, name: str) -> Any:
            return getattr(import_module("cv2"), name)

    cv2 = _Later()
