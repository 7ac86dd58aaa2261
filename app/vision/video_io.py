"""Pictures and video files, as OpenCV reads and writes them."""

import math
import os
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from app.vision.frame_source import Facts
from app.vision.opencv import cv2
from core.errors import InputError
from core.vision.image_header import require_readable

Picture = NDArray[np.uint8]
"""(height, width, 3) blue, green, red."""

NEAR = 40
"""Pictures ahead that are sooner read one after the other than sought."""

TELL_EVERY = 100
"""Pictures between two signs of life while a file's pictures are counted."""

QUALITY = 85
"""Of JPEG files, of 100."""

CONTAINERS = (
    "mov,matroska,avi,mpegts,mpeg,mpegvideo,asf,flv,ogg,mjpeg,jpeg_pipe,h264,hevc,m4v,mxf,ivf,yuv4mpegpipe,dv"
)
"""Kinds of files that are read (FFmpeg's names): those that hold pictures. Lists that name other files, such
as playlists, are left out, since whoever sends one would see what else is on the computer."""


def use_one_thread() -> None:
    """Keeps OpenCV in this process to one core, so that a robot's stop finds another one free."""
    cv2.setNumThreads(1)


class VideoFile:
    """A video file whose pictures are read one after the other, or sought; for one thread.

    Args:
        path: of the file.

    Raises:
        InputError: the file is no video, tells no frame rate, or has pictures that are too large.
    """

    def __init__(self, path: Path) -> None:
        self._path, self._name = path, path.name
        self._open()
        try:
            self.facts = self._facts()
        except InputError:
            self.close()
            raise
        # A bare row of pictures says nothing of their number and cannot be sought in.
        self._is_row = self.facts.count == 0

    def _open(self) -> None:
        # OpenCV passes on to FFmpeg what stands in this variable, and has no other way to say it.
        os.environ["OPENCV_FFMPEG_CAPTURE_OPTIONS"] = f"format_whitelist;{CONTAINERS}"
        # Other readers of OpenCV's take a file name with digits for a row of pictures.
        self._capture = cv2.VideoCapture(str(self._path), cv2.CAP_FFMPEG)
        if not self._capture.isOpened():
            raise InputError(f"{self._name} cannot be read as a video.", self._name)
        self._next = 0

    def _facts(self) -> Facts:
        rate = self._capture.get(cv2.CAP_PROP_FPS)
        if not (math.isfinite(rate) and rate > 0):
            raise InputError(f"{self._name} has no frame rate; save it again with one.", self._name)
        wide, high = (
            int(self._capture.get(p)) for p in (cv2.CAP_PROP_FRAME_WIDTH, cv2.CAP_PROP_FRAME_HEIGHT)
        )
        require_readable(wide, high, self._name)
        return Facts(rate, max(int(self._capture.get(cv2.CAP_PROP_FRAME_COUNT)), 0), (wide, high))

    def counted(self, tell: Callable[[], object] = lambda: None) -> Facts:
        """What the file says, and where it does not say how many pictures it holds, as many as there are.

        Args:
            tell: called again and again meanwhile.
        """
        if not self._is_row:
            return self.facts
        self._seek(0)
        while self.skip():
            if self._next % TELL_EVERY == 0:
                tell()
        return replace(self.facts, count=self._next)

    def close(self) -> None:
        """Closes the file."""
        self._capture.release()

    def read(self) -> Picture | None:
        """The next picture; None at the end."""
        there, frame = self._capture.read()
        if not there:
            return None
        self._next += 1
        return np.asarray(frame, dtype=np.uint8)

    def skip(self) -> bool:
        """Leaves the next picture out; false at the end."""
        there = bool(self._capture.grab())
        self._next += there
        return there

    def picture(self, number: int) -> Picture:
        """One picture.

        Raises:
            InputError: the file ends before it.
        """
        if not self._next <= number <= self._next + NEAR:
            self._seek(number)
        while self._next < number and self.skip():
            pass
        frame = self.read() if self._next == number else None
        if frame is None:
            raise InputError(f"{self._name} ends before picture {number}.", "frame")
        return frame

    def _seek(self, number: int) -> None:
        if not self._is_row:
            self._capture.set(cv2.CAP_PROP_POS_FRAMES, number)
            self._next = number
        elif number < self._next:
            self.close()
            self._open()

    def pictures(self) -> Iterator[tuple[float, Picture]]:
        """Every picture with its time after the first, s.

        Times are the file's own, since many phones take pictures as the light allows. A picture without one,
        or with one that does not follow, comes a usual interval after the picture before.
        """
        first: float | None = None
        time = -1.0 / self.facts.rate
        while (frame := self.read()) is not None:
            told = self._capture.get(cv2.CAP_PROP_POS_MSEC) / 1e3
            first = told if first is None else first
            time = told - first if told - first > time else time + 1.0 / self.facts.rate
            yield time, frame


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
