"""Video files, as OpenCV's FFmpeg reads them: each picture is known by its own time in the file."""

import os
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from app.vision.avi_index import pictures_there
from app.vision.film_faults import begins_later, nothing_decodes, nothing_opens, require_times
from app.vision.frame_source import Facts, increasing_times, rate_of
from app.vision.opencv import cv2
from app.vision.video_io import Picture
from core.arrays import Bools, Floats
from core.errors import InputError
from core.vision.image_header import require_readable

NEAR = 40
"""Pictures ahead that are sooner read one after the other than sought."""

TELL_EVERY = 100
"""Pictures between two signs of life while a file is looked through."""

STRIDE = 10
"""Pictures from one place to the next at which a film goes on behind some that do not decode."""

ATTEMPTS = 4
"""How often OpenCV is asked for the next picture of a film with a gap: it ends at each that is damaged."""

SAME = 5e-4
"""Times in a file that differ by less are one picture's, s."""

BACK_SECONDS = (0.0, 1.0, 4.0, 16.0, 64.0)
"""How far before a picture is sought, one attempt after the other, where FFmpeg lands behind it, s."""

SHORTER = 0.9
"""A film that is shorter than this share of the length that it tells was cut off."""

CONTAINERS = (
    "mov,matroska,avi,mpegts,mpeg,mpegvideo,asf,flv,ogg,mjpeg,jpeg_pipe,h264,hevc,m4v,mxf,ivf,yuv4mpegpipe,dv"
)
"""Kinds of files that are read (FFmpeg's names): those that hold pictures. Lists that name other files, such
as playlists, are left out, since whoever sends one would see what else is on the computer."""


@dataclass(frozen=True, eq=False)
class Packets:
    """What a file holds of its pictures, whether or not they decode.

    Args:
        codec: by which they are packed, four characters; "" where that is not known.
        times: (n,) in the file, s, in the order in which they are shown.
    """

    codec: str
    times: Floats


class VideoFile:
    """A video file whose pictures are read one after the other, or sought; for one thread.

    Args:
        path: of the file.
        tell: called again and again while a long file is looked through.

    Attributes:
        facts: rate, number and size of the pictures that decode.
        times: (n,) of each picture after the first, s, increasing.

    Raises:
        InputError: the file is no video, nothing in it decodes, it tells no frame rate or no times, or has
            pictures that are too large.
    """

    def __init__(self, path: Path, tell: Callable[[], object] = lambda: None) -> None:
        self._path, self._name, self._attempts = path, path.name, 1
        packets = _read_packets(path, tell)
        self._open()
        try:
            self._facts(packets, tell)
        except InputError:
            self.close()
            raise

    def _open(self) -> None:
        self._capture, self._at = _opened(self._path), -1
        if not self._capture.isOpened():
            packets = _read_packets(self._path, lambda: None)
            codec, count = (None, 0) if packets is None else (packets.codec, packets.times.size)
            raise nothing_opens(self._path, codec, count)

    def _facts(self, packets: Packets | None, tell: Callable[[], object]) -> None:
        size = (self._number(cv2.CAP_PROP_FRAME_WIDTH), self._number(cv2.CAP_PROP_FRAME_HEIGHT))
        held = packets or Packets("", np.zeros(0))
        require_times(self._path)
        if held.times.size:
            require_readable(*size, self._name)
        # A bare row of pictures says nothing of their number and cannot be sought in.
        told_count = self._number(cv2.CAP_PROP_FRAME_COUNT)
        self._file_times, self._is_row = held.times, told_count <= 0
        told_rate = self._capture.get(cv2.CAP_PROP_FPS)
        is_short = held.times.size < told_count and told_rate > 0
        there = pictures_there(self._path) if is_short else None
        has_gap = there is not None and not there.all()
        self._attempts = ATTEMPTS if has_gap else 1
        if not self._is_row and (has_gap or not self._decodes_from_end_to_end()):
            self._file_times = self._decoded_times(tell)
        if not self._file_times.size:
            raise nothing_decodes(self._path, held.codec, held.times.size, told_count)
        times = self._file_times
        remark = ""
        if there is not None and has_gap:
            times, remark = _with_gaps(held.times, times, there, told_rate)
        rate = rate_of(times, told_rate)
        if rate is None:
            raise InputError(f"{self._name} has no frame rate; save it again with one.", self._name)
        # Behind a gap OpenCV finds another picture where it seeks than where it reads on.
        self._is_row |= has_gap or bool((np.diff(self._file_times) <= SAME).any())
        self.times = increasing_times(times, rate)
        if told_rate > 0 and not self._is_row:
            remark = self._remark(held.times.size, told_count / told_rate, rate)
        self.facts = Facts(rate, self._file_times.size, size, remark)
        self._open_anew()

    def _number(self, which: int) -> int:
        return max(int(self._capture.get(which)), 0)

    def _decodes_from_end_to_end(self) -> bool:
        """Whether the first and the last picture of the file decode, each at its time."""
        times = self._file_times
        if not times.size or (np.diff(times) <= SAME).any():
            return False
        if not self._capture.grab() or abs(self._told() - times[0]) > SAME:
            return False
        self._seek(times.size - 1)
        while self._grab():
            pass
        return bool(self._at == times.size - 1 and abs(self._told() - times[-1]) <= SAME)

    def _decoded_times(self, tell: Callable[[], object]) -> Floats:
        """Times of all pictures that decode, in the order in which they come."""
        self._open_anew()
        times: list[float] = []
        while self._grab_next():
            times.append(self._told())
            if len(times) % TELL_EVERY == 0:
                tell()
        return np.array(times)

    def _remark(self, held: int, told_seconds: float, rate: float) -> str:
        """What is missing of the film, in a sentence; "" where nothing is."""
        count = self._file_times.size
        lasts = self.times[-1] * count / (count - 1) if count > 1 else 1.0 / rate
        if lasts >= SHORTER * told_seconds or begins_later(self._path):
            return ""
        if count < held:
            return (
                f"Only {count} of its {held} pictures decode: the file is damaged, or its first pictures "
                "lack the one that they follow from. What decodes can be tracked."
            )
        return (
            f"The film is cut off: it should last {told_seconds:.1f} s and its pictures end after "
            f"{lasts:.1f} s. What is there can be tracked; for the rest, copy it from the camera again."
        )

    def close(self) -> None:
        """Closes the file."""
        self._capture.release()

    @property
    def at(self) -> int:
        """Number of the picture that was read last; -1 before the first."""
        return self._at

    def read(self) -> Picture | None:
        """The next picture; None at the end."""
        return self._picture() if self._grab() else None

    def skip(self) -> bool:
        """Leaves the next picture out; false at the end."""
        return self._grab()

    def picture(self, number: int) -> Picture:
        """One picture.

        Raises:
            InputError: the file ends before it, or it does not decode.
        """
        if not 0 <= number < self.facts.count:
            raise InputError(f"{self._name} ends before picture {number}.", "frame")
        if not 0 <= self._at <= number <= self._at + NEAR:
            self._seek(number)
        if not self._goes_on_to(number):  # older OpenCVs end early behind a place that was sought
            self._open_anew()
            self._goes_on_to(number)
        frame = self._picture() if self._at == number else None
        if frame is None:
            raise InputError(
                f"Picture {number} of {self._name} does not decode: the file is damaged there.", "frame"
            )
        return frame

    def _goes_on_to(self, number: int) -> bool:
        """Leaves pictures out up to one; whether that is there."""
        while self._at < number and self._grab():
            pass
        return self._at == number

    def pictures(self) -> Iterator[tuple[float, Picture]]:
        """Every picture with its time after the first, s.

        Times are the file's own, since many phones take pictures as the light allows. A picture without one,
        or with one that does not follow, comes a usual interval after the picture before.
        """
        while (frame := self.read()) is not None:
            yield float(self.times[self._at]), frame

    def _told(self) -> float:
        return float(self._capture.get(cv2.CAP_PROP_POS_MSEC)) / 1e3

    def _grab(self) -> bool:
        if self._at + 1 >= self._file_times.size:
            return False
        if not self._grab_next():
            return not self._is_row and self._resume()
        own = 0 if self._is_row else self._own_number()
        self._at = min(max(own, self._at + 1), self._file_times.size - 1)
        return True

    def _grab_next(self) -> bool:
        return any(self._capture.grab() for _ in range(self._attempts))

    def _own_number(self) -> int:
        """Number of the picture that was grabbed, by its time."""
        return int(np.searchsorted(self._file_times, self._told() - SAME))

    def _resume(self) -> bool:
        """Goes on behind pictures that do not decode, where OpenCV ends; false where nothing follows."""
        for number in range(self._at + 2, self._file_times.size, STRIDE):
            self._capture.set(cv2.CAP_PROP_POS_MSEC, self._file_times[number] * 1e3)
            if self._capture.grab() and self._own_number() > self._at:
                self._at = min(self._own_number(), self._file_times.size - 1)
                return True
        return False

    def _picture(self) -> Picture | None:
        there, frame = self._capture.retrieve()
        return np.asarray(frame, dtype=np.uint8) if there else None

    def _seek(self, number: int) -> None:
        """Goes to a picture, or to one before it from which the others follow.

        OpenCV counts frames by the nominal rate; only a picture's time says which one it is.
        """
        if self._is_row:
            if number < self._at or self._at < 0:
                self._open_anew()
            return
        for back in BACK_SECONDS:
            begin = self._file_times[number] - back
            if begin <= self._file_times[0]:
                break
            self._capture.set(cv2.CAP_PROP_POS_MSEC, begin * 1e3)
            self._at = -1
            if self._grab() and self._at <= number:
                return
        self._open_anew()

    def _open_anew(self) -> None:
        self.close()
        self._open()


def _with_gaps(held: Floats, decoded: Floats, there: Bools, rate: float) -> tuple[Floats, str]:
    """The times of the pictures of an AVI file of which some are overwritten, and a remark on that.

    OpenCV counts the pictures that are left and takes no notice of the missing ones.

    Args:
        held: (m,) times of the pictures that are left, as OpenCV counts them, s.
        decoded: (n,) those of them that decode.
        there: (k,) whether each picture of the film is left.
        rate: of the pictures, 1/s.
    """
    first, last = (int(place) for place in np.flatnonzero(~there)[[0, -1]])
    count = int(np.count_nonzero(~there))
    missing = (
        f"{count} of its {there.size} pictures {'is' if count == 1 else 'are'} missing, between "
        f"{first / rate:.2f} s and {(last + 1) / rate:.2f} s: the file is damaged there."
    )
    if np.count_nonzero(there) == held.size:
        numbers = np.flatnonzero(there)[np.searchsorted(held, decoded - SAME).clip(max=held.size - 1)]
        return numbers / rate, f"{missing} The others have the times at which they were taken."
    return decoded, (
        f"{missing} The times of the pictures after {first / rate:.2f} s cannot be known. "
        "Copy the film from the camera again."
    )


def _opened(path: Path, *settings: int) -> "cv2.VideoCapture":
    # OpenCV passes on to FFmpeg what stands in this variable, and has no other way to say it.
    os.environ["OPENCV_FFMPEG_CAPTURE_OPTIONS"] = f"format_whitelist;{CONTAINERS}"
    # Other readers of OpenCV's take a file name with digits for a row of pictures.
    return cv2.VideoCapture(str(path), cv2.CAP_FFMPEG, list(settings))


def _read_packets(path: Path, tell: Callable[[], object]) -> Packets | None:
    """Reads a file's pictures without unpacking them; None where FFmpeg finds no film in it."""
    capture = _opened(path, cv2.CAP_PROP_FORMAT, -1)
    if not capture.isOpened():
        return None
    times: list[float] = []
    while capture.grab():
        times.append(float(capture.get(cv2.CAP_PROP_POS_MSEC)) / 1e3)
        if len(times) % TELL_EVERY == 0:
            tell()
    code = int(capture.get(cv2.CAP_PROP_FOURCC))
    capture.release()
    codec = code.to_bytes(4, "little").decode("ascii", "replace") if code > 0 else ""
    return Packets(codec, np.sort(np.array(times)))
