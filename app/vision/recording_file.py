"""A camera's recording on disk: JPEG pictures one after the other, and a table of where each is and when.

Both files only grow, so that whatever ends the program, what was written before can be read.
`pictures.mjpeg` is played by common players; its times are in the table alone.
"""

import struct
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from app.vision.frame_source import PICTURES, TABLE, Facts
from app.vision.video_io import Picture, read_picture
from core.arrays import Floats
from core.errors import InputError

_ROW = struct.Struct("<qqd")
_ROWS = np.dtype([("begin", "<i8"), ("length", "<i8"), ("time", "<f8")])

USUAL_RATE = 30.0
"""Frames a second of a recording too short to tell."""


class RecordingWriter:
    """Adds pictures to a recording.

    Args:
        folder: made for it.

    Attributes:
        size: bytes of pictures so far.
        count: pictures so far.
    """

    def __init__(self, folder: Path) -> None:
        folder.mkdir(parents=True)
        self._pictures = (folder / PICTURES).open("wb")
        self._table = (folder / TABLE).open("wb")
        self.size = self.count = 0

    def add(self, picture: bytes, time: float) -> None:
        """Adds a JPEG file.

        Args:
            picture: its bytes.
            time: s on the recording's clock.
        """
        self._pictures.write(picture)
        self._pictures.flush()
        self._table.write(_ROW.pack(self.size, len(picture), time))
        self._table.flush()
        self.size += len(picture)
        self.count += 1

    def close(self) -> None:
        """Closes the files."""
        self._pictures.close()
        self._table.close()


@dataclass(frozen=True, eq=False)
class RecordingTable:
    """Where each picture of a recording is, and when it was taken.

    Args:
        rows: (n,) begin and length in bytes, time in s.
    """

    rows: NDArray[np.void]

    @property
    def times(self) -> Floats:
        """(n,) s."""
        return np.asarray(self.rows["time"], dtype=np.float64)

    @property
    def rate(self) -> float:
        """Frames a second, as most pictures came."""
        gaps = np.diff(self.times)
        return float(1.0 / np.median(gaps)) if len(gaps) and np.median(gaps) > 0 else USUAL_RATE


def read_table(folder: Path) -> RecordingTable:
    """The table of a recording; pictures that were not written whole are left out.

    Raises:
        InputError: there is no recording.
    """
    try:
        content = (folder / TABLE).read_bytes()
        size = (folder / PICTURES).stat().st_size
    except OSError:
        raise InputError(f"The recording {folder.name} is not on the disk any more.", folder.name) from None
    rows = np.frombuffer(content[: len(content) // _ROW.size * _ROW.size], dtype=_ROWS)
    return RecordingTable(rows[rows["begin"] + rows["length"] <= size])


class Recording:
    """A recording whose pictures are read; for one thread.

    Args:
        folder: where it is.

    Raises:
        InputError: there is none, or it holds no picture.
    """

    def __init__(self, folder: Path) -> None:
        self._table = read_table(folder)
        if not len(self._table.rows):
            raise InputError(f"The recording {folder.name} holds no picture.", folder.name)
        self._file = (folder / PICTURES).open("rb")
        height, width = self.picture(0).shape[:2]
        self.times = self._table.times - self._table.times[0]
        self.facts = Facts(self._table.rate, len(self._table.rows), (width, height))

    def close(self) -> None:
        """Closes the file."""
        self._file.close()

    def file(self, number: int) -> bytes:
        """One picture as the JPEG file that was kept.

        Raises:
            InputError: there is none of that number.
        """
        if not 0 <= number < len(self._table.rows):
            raise InputError(f"The recording ends before picture {number}.", "frame")
        begin, length, _ = self._table.rows[number]
        self._file.seek(int(begin))
        return self._file.read(int(length))

    def picture(self, number: int) -> Picture:
        """One picture."""
        return read_picture(self.file(number), f"picture {number}")

    def pictures(self) -> Iterator[tuple[float, Picture]]:
        """Every picture with its time, s."""
        for number, time in enumerate(self._table.times):
            yield float(time), self.picture(number)
