"""A camera's own process: takes its pictures, shows them, records them, and waits for it to be plugged in.

It stands back behind the bridge (see `solver_jobs.NICENESS`), and leaves when its parent's end of the pipe
closes.
"""

import time
from dataclasses import dataclass
from multiprocessing.connection import Connection

from app.cameras.address import CameraAddress
from app.cameras.source import CameraSource, open_source
from app.vision.recorder import Recorded, Recorder, RecordingJob
from app.vision.video_io import Picture, jpeg, scaled, silence_libraries, use_one_thread
from core.errors import InputError

RETRY_SECONDS = 0.3
"""Between two attempts to open a camera that is not there."""


@dataclass(frozen=True)
class Show:
    """To the camera: send the next picture, no wider than so many pixels."""

    number: int
    most: int | None


@dataclass(frozen=True)
class Record:
    """To the camera: record from now on."""

    order: RecordingJob


@dataclass(frozen=True)
class Finish:
    """To the camera: end the recording."""

    number: int


@dataclass(frozen=True)
class Shown:
    """From the camera: a picture as a JPEG file, or why there is none."""

    number: int
    picture: bytes
    refusal: str = ""


@dataclass(frozen=True, eq=False)
class Finished:
    """From the camera: what came of the recording; None where none was on."""

    number: int
    recorded: Recorded | None


@dataclass(frozen=True)
class Standing:
    """From the camera: whether it gives pictures, and of what kind.

    Args:
        is_live: whether it does.
        sentence: why not; empty where it does.
        size: width and height, px.
        rate: pictures a second, as it says.
    """

    is_live: bool
    sentence: str
    size: tuple[int, int] | None = None
    rate: float | None = None


def run_camera(pipe: Connection, address: CameraAddress) -> None:
    """Body of the process.

    Args:
        pipe: the worker's end.
        address: where the camera is.
    """
    use_one_thread()
    silence_libraries()
    try:
        _Camera(pipe, address).run()
    except (EOFError, ConnectionError):
        return


class _Camera:
    def __init__(self, pipe: Connection, address: CameraAddress) -> None:
        self._pipe, self._address = pipe, address
        self._source: CameraSource | None = None
        self._recorder: Recorder | None = None
        self._last: Finish | None = None
        self._asked: list[Show] = []
        self._told: Standing | None = None

    def run(self) -> None:
        """Goes on until the parent's end of the pipe closes."""
        while True:
            if self._source is None:
                self._open()
            is_there = self._source is not None and self._advance(self._source)
            if not is_there:
                self._lose()
            wait = 0.0 if is_there else RETRY_SECONDS
            while self._pipe.poll(wait):
                self._hear(self._pipe.recv())
                wait = 0.0

    def _advance(self, source: CameraSource) -> bool:
        """Takes the next picture where somebody wants it; false where the camera is gone."""
        is_known = self._told is not None and self._told.is_live
        if is_known and self._recorder is None and not self._asked:
            return source.skip()
        taken = source.next()
        if taken is not None:
            self._take(source, *taken)
        return taken is not None

    def _open(self) -> None:
        try:
            self._source = open_source(self._address)
        except InputError as refusal:
            name = self._address.name
            self._tell(
                Standing(
                    False, f"The camera “{name}” gives no pictures. Plug it in again. {refusal.sentence}"
                )
            )

    def _lose(self) -> None:
        """The camera is gone; whoever waits for a picture is told, and a recording has a gap."""
        if self._source is not None:
            self._source.close()
            self._source = None
            self._tell(Standing(False, f"The camera “{self._address.name}” is unplugged. Plug it in again."))
        if self._recorder is not None:
            self._recorder.miss(time.monotonic())
        self._finish()
        sentence = "" if self._told is None else self._told.sentence
        for show in self._asked:
            self._pipe.send(Shown(show.number, b"", sentence))
        self._asked.clear()

    def _take(self, source: CameraSource, when: float, picture: Picture) -> None:
        self._tell(Standing(True, "", (picture.shape[1], picture.shape[0]), source.rate))
        if self._recorder is not None:
            self._recorder.add(when, picture)
        self._finish()
        for show in self._asked:
            self._pipe.send(Shown(show.number, jpeg(scaled(picture, show.most))))
        self._asked.clear()

    def _tell(self, standing: Standing) -> None:
        if standing != self._told:
            self._told = standing
            self._pipe.send(standing)

    def _hear(self, message: object) -> None:
        if isinstance(message, Show):
            self._asked.append(message)
        elif isinstance(message, Record):
            if self._source is not None:
                self._source.begin_anew()
            self._recorder = Recorder(message.order)
        elif isinstance(message, Finish):
            self._last = message
            if self._source is None or self._recorder is None:
                self._finish()

    def _finish(self) -> None:
        """Ends the recording where that was asked; one more picture was taken, so that it shows the end."""
        if self._last is not None:
            recorded = None if self._recorder is None else self._recorder.finish()
            self._pipe.send(Finished(self._last.number, recorded))
            self._recorder = self._last = None
