"""What a camera process takes its pictures from: a camera of this computer, or a video file played as one."""

import time
from pathlib import Path
from typing import Protocol

from app.cameras.address import CameraAddress
from app.vision.video_file import VideoFile
from app.vision.video_io import Device, Picture
from core.errors import InputError


class CameraSource(Protocol):
    """Pictures as they come; for one thread."""

    rate: float | None

    def next(self) -> tuple[float, Picture] | None:
        """Waits for the next picture; its time by the monotonic clock. None where the camera is gone."""

    def skip(self) -> bool:
        """Waits as long as for a picture that nobody wants; false where the camera is gone."""

    def begin_anew(self) -> None:
        """Starts a file from its beginning; a real camera goes on."""

    def close(self) -> None:
        """Leaves the camera."""


class PlayedFile:
    """Loops a video file as a camera; reports "unplugged" while the file is missing.

    A picture whose time has passed is left out, as a camera would not wait either.

    Args:
        path: of the file.

    Raises:
        InputError: it is not there, or no video.
    """

    def __init__(self, path: Path) -> None:
        if not path.exists():
            raise InputError(f"There is no file {path}.", str(path))
        self._path = path
        self._file = VideoFile(path)
        self.rate: float | None = self._file.facts.rate
        self.begin_anew()

    def begin_anew(self) -> None:
        """Starts from the beginning."""
        self._file.close()
        self._file = VideoFile(self._path)
        self._begun = time.monotonic()

    def next(self) -> tuple[float, Picture] | None:
        """Waits for the next picture."""
        while self._due(1) <= time.monotonic() and self._file.skip():
            pass
        due = self._due(0)
        time.sleep(max(0.0, due - time.monotonic()))
        if not self._path.exists():
            return None
        picture = self._file.read()
        if picture is None:
            self.begin_anew()
            due, picture = self._begun, self._file.read()
        return None if picture is None else (due, picture)

    def _due(self, later: int) -> float:
        """When the next picture is due, or one so many later, by the monotonic clock, s."""
        times, number = self._file.times, self._file.at + 1 + later
        after = max(number - (times.size - 1), 0) / self._file.facts.rate
        return self._begun + float(times[min(number, times.size - 1)]) + after

    def skip(self) -> bool:
        """Waits; a film that nobody sees stands still."""
        interval = 1.0 / self._file.facts.rate
        time.sleep(interval)
        self._begun += interval
        return self._path.exists()

    def close(self) -> None:
        """Closes the file."""
        self._file.close()


class LiveDevice:
    """A camera of this computer.

    Args:
        path: `/dev/video0`, say.

    Raises:
        InputError: it is not there, or another program uses it.
    """

    def __init__(self, path: str) -> None:
        self._device = Device(path)
        self.rate = self._device.rate

    def begin_anew(self) -> None:
        """A camera goes on."""

    def next(self) -> tuple[float, Picture] | None:
        """Waits for the next picture."""
        picture = self._device.read()
        return None if picture is None else (time.monotonic(), picture)

    def skip(self) -> bool:
        """Leaves a picture out."""
        return self._device.skip()

    def close(self) -> None:
        """Leaves the camera."""
        self._device.close()


def open_source(address: CameraAddress) -> CameraSource:
    """A camera's pictures.

    Raises:
        InputError: it gives none.
    """
    return PlayedFile(Path(address.path)) if address.is_file else LiveDevice(address.path)
