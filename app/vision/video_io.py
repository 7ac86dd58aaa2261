"""Pictures as OpenCV reads and writes them, and cameras of this computer."""

import os
import sys
from collections.abc import Callable
from typing import cast

import numpy as np
from numpy.typing import NDArray

from app.vision.opencv import cv2
from core.errors import InputError
from core.text.printable import PrintableStream, printable_stream

Picture = NDArray[np.uint8]
"""(height, width, 3) blue, green, red."""

QUALITY = 85
"""Of JPEG files, of 100."""


def use_one_thread() -> None:
    """Keeps OpenCV in this process to one core, so that a robot's stop finds another one free."""
    cv2.setNumThreads(1)


def silence_libraries() -> Callable[[], None]:
    """Keeps what C libraries print in this process off the terminal and the log.

    libpng and libjpeg write on descriptor 2 by themselves, whatever OpenCV is told.
    Python's own lines still go to where that led, without control characters.

    Returns:
        Gives descriptor 2 back to everybody.
    """
    try:
        shown = os.dup(2)
    except OSError:  # it is closed, and shows nothing
        return lambda: None
    stream = _python_lines()
    before = None if stream is None else stream.stream
    if stream is not None:
        stream.flush()
        stream.stream = open(shown, "w", buffering=1, closefd=False)  # noqa: SIM115
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 2)
    os.close(nowhere)

    def undo() -> None:
        if stream is not None and before is not None:
            stream.flush()
            stream.stream = before
        os.dup2(shown, 2)
        os.close(shown)

    return undo


def _python_lines() -> PrintableStream | None:
    """`sys.stderr`, from then on without control characters; None where it is not on descriptor 2."""
    try:
        if sys.stderr is None or sys.stderr.fileno() != 2:
            return None
    except (OSError, ValueError):  # a notebook's, say, is on none
        return None
    sys.stderr = printable_stream(sys.stderr)
    return cast(PrintableStream, sys.stderr)


class Device:
    """A camera of this computer; for one thread.

    Args:
        path: `/dev/video0`, say.

    Raises:
        InputError: it is not there, or another program uses it.
    """

    def __init__(self, path: str) -> None:
        self._capture = cv2.VideoCapture(path, cv2.CAP_V4L2)
        if not self._capture.isOpened():
            raise InputError(f"Is another program using it? Nothing comes from {path}.", path)
        self._capture.set(cv2.CAP_PROP_FOURCC, cv2.VideoWriter.fourcc(*"MJPG"))
        self._capture.set(cv2.CAP_PROP_BUFFERSIZE, 1)
        self.rate = self._capture.get(cv2.CAP_PROP_FPS) or None

    def close(self) -> None:
        """Leaves the camera to others."""
        self._capture.release()

    def read(self) -> Picture | None:
        """The next picture, as soon as it is there; None where the camera is gone."""
        there, frame = self._capture.read()
        return np.asarray(frame, dtype=np.uint8) if there else None

    def skip(self) -> bool:
        """Waits for the next picture without unpacking it; false where the camera is gone."""
        return bool(self._capture.grab())


def read_picture(content: bytes, name: str) -> Picture:
    """A picture file's content.

    Raises:
        InputError: it is no picture.
    """
    data = np.frombuffer(content, dtype=np.uint8)
    picture = cv2.imdecode(data, cv2.IMREAD_COLOR) if data.size else None
    if picture is None:
        raise InputError(f"{name} is no picture that can be read; use PNG or JPEG.", name)
    return np.asarray(picture, dtype=np.uint8)


def jpeg(picture: Picture) -> bytes:
    """A picture as a JPEG file."""
    _, content = cv2.imencode(".jpg", picture, [cv2.IMWRITE_JPEG_QUALITY, QUALITY])
    return content.tobytes()


def scaled(picture: Picture, most: int | None) -> Picture:
    """A picture no wider than so many pixels; None leaves it as it is."""
    height, width = picture.shape[:2]
    if most is None or width <= most:
        return picture
    size = (most, max(1, round(height * most / width)))
    return np.asarray(cv2.resize(picture, size, interpolation=cv2.INTER_AREA), dtype=np.uint8)
