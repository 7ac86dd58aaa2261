"""A recording while it is made: pictures on disk, feet found at once, what was missing said."""

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from app.vision.blobs import find_feet
from app.vision.recording_file import RecordingWriter
from app.vision.tracking import VideoTrack, track_of_pixels
from app.vision.video_io import Picture, jpeg
from core.arrays import Floats
from core.errors import FootfallError
from core.vision.setup import TrackingSetup

MOST_BYTES = 4_000_000_000
"""Of one recording's pictures; feet are followed on after that."""


@dataclass(frozen=True)
class RecordingJob:
    """What is to be recorded.

    Args:
        folder: made for it.
        began: the recording's clock begins here, by `boot_seconds`.
        setup: for finding feet; None where none are looked for.
        name: of the camera, for sentences.
    """

    folder: Path
    began: float
    setup: TrackingSetup | None
    name: str


@dataclass(frozen=True, eq=False)
class Recorded:
    """What came of a recording.

    Args:
        count: pictures on disk.
        size: their bytes.
        shape: width and height of the pictures, px; None where there was none.
        rate: pictures a second.
        seconds: from the first picture to the last.
        found: the feet's track; None where none was looked for, or none could be made.
        refusal: why there is no track.
        remarks: sentences about what is missing.
    """

    count: int
    size: int
    shape: tuple[int, int] | None
    rate: float
    seconds: float
    found: VideoTrack | None
    refusal: str
    remarks: tuple[str, ...]


@dataclass(eq=False)
class Recorder:
    """Takes pictures as they come.

    Args:
        order: what is to be recorded.
    """

    order: RecordingJob
    times: list[float] = field(default_factory=list)
    pixels: list[Floats] = field(default_factory=list)
    remarks: list[str] = field(default_factory=list)
    shape: tuple[int, int] | None = None
    _gone_since: float | None = None
    _writer: RecordingWriter | None = None
    _is_full: bool = False
    _closed: tuple[int, int] = (0, 0)

    def __post_init__(self) -> None:
        try:
            self._writer = RecordingWriter(self.order.folder)
        except OSError as error:
            self.remarks.append(f"The pictures could not be kept: {error.strerror}.")

    def add(self, time: float, picture: Picture) -> None:
        """Takes a picture.

        Args:
            time: when it was taken, by `boot_seconds`.
            picture: as it is.
        """
        at = time - self.order.began
        if self.times and at <= self.times[-1]:
            return
        shape = (picture.shape[1], picture.shape[0])
        if self.shape is not None and shape != self.shape:
            return  # another camera was plugged in: its pictures are missing ones
        self.shape = shape
        self._come_back(at)
        self.times.append(at)
        self._write(jpeg(picture), at)
        setup = self.order.setup
        if setup is not None:
            self.pixels.append(find_feet(picture, setup.colours, setup.limits))

    def miss(self, time: float) -> None:
        """Says that the camera gives no pictures."""
        if self._gone_since is None:
            self._gone_since = time - self.order.began

    def _come_back(self, at: float) -> None:
        if self._gone_since is not None:
            until = f"until {at:.1f} s"
            self.remarks.append(self._missing(self._gone_since, until))
            self._gone_since = None

    def _missing(self, since: float, until: str) -> str:
        name = self.order.name
        return f"The camera “{name}” gave no pictures from {max(since, 0.0):.1f} s {until} of the run."

    def _write(self, file: bytes, at: float) -> None:
        if self._writer is None:
            return
        try:
            self._writer.add(file, at)
        except OSError as error:
            self._stop_writing(f"The recorded pictures end at {at:.1f} s: {error.strerror}.")
            return
        if self._writer.size > MOST_BYTES:
            self._stop_writing(
                f"The recorded pictures end at {at:.1f} s: a recording has at most {MOST_BYTES / 1e9:g} GB."
            )

    def _stop_writing(self, sentence: str) -> None:
        self.remarks.append(sentence)
        self._close_writer()

    def _close_writer(self) -> None:
        if self._writer is not None:
            self._closed = (self._writer.count, self._writer.size)
            self._writer.close()
            self._writer = None

    def finish(self) -> Recorded:
        """Ends the recording and makes the track."""
        self._close_writer()
        if self._gone_since is not None:
            self.remarks.append(self._missing(self._gone_since, "until the end"))
        gaps = np.diff(self.times)
        rate = float(1.0 / np.median(gaps)) if len(gaps) else 0.0
        seconds = self.times[-1] - self.times[0] if self.times else 0.0
        found, refusal = self._track()
        count, size = self._closed
        return Recorded(count, size, self.shape, rate, seconds, found, refusal, tuple(self.remarks))

    def _track(self) -> tuple[VideoTrack | None, str]:
        setup = self.order.setup
        if setup is None:
            return None, ""
        try:
            if self.shape is not None:
                setup.require_size(self.shape)
            pixels = np.array(self.pixels).reshape(len(self.times), -1, 2)
            return track_of_pixels(np.array(self.times), pixels, setup, self.order.name), ""
        except FootfallError as error:
            return None, error.sentence
