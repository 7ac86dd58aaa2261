"""One camera's process, as the studio drives it."""

import itertools
import logging
import threading
import time
from collections.abc import Callable
from concurrent.futures import Future
from typing import Any

from app.cameras.address import CameraAddress
from app.cameras.worker import Finish, Finished, Record, Show, Shown, Standing, run_camera
from app.vision.recorder import Recorded, RecordingJob
from core.errors import RobotError, StateError
from core.running_time import RunningClock, wait_within
from solver_jobs import WorkerEndedError, WorkerProcess

_log = logging.getLogger(__name__)

POLL_SECONDS = 0.05
"""How soon an end is noticed; pictures are passed on as they come."""

IDLE_SECONDS = 15.0
"""A camera that nobody has looked at for so long is left to others."""


SILENCE_SECONDS = 60.0
"""A process that answers nothing for so long while somebody waits hangs, and is ended."""


class CameraError(RobotError):
    """A camera gives no pictures."""


class CameraProcess:
    """A camera that is looked at or stands by to record; every method may be called from any thread.

    Args:
        address: where it is.
        changed: called from a thread of the link's when `standing` is another.

    Attributes:
        address: where it is.
        standing: whether it gives pictures; None while it starts.
        is_kept: whether it stands by though nobody looks.
    """

    def __init__(self, address: CameraAddress, changed: Callable[[], object]) -> None:
        self.address = address
        self.standing: Standing | None = None
        self.is_kept = False
        self._changed = changed
        self._worker = WorkerProcess(address, run_camera, f"footfall camera {address.id}")
        self._numbers = itertools.count(1)
        self._lock = threading.Lock()
        self._waiting: dict[int, Future[Any]] = {}
        self._running = RunningClock(time.monotonic)
        self._looked = 0.0
        self._closing = threading.Event()
        self._order: RecordingJob | None = None
        self._worker.ensure_started()
        self._thread = threading.Thread(target=self._run, name=f"camera {address.id}", daemon=True)
        self._thread.start()

    @property
    def is_open(self) -> bool:
        """Whether its process goes on."""
        return self._thread.is_alive() and not self._closing.is_set()

    @property
    def process_id(self) -> int | None:
        """The process's number, or None where none runs."""
        return self._worker.process_id

    @property
    def is_recording(self) -> bool:
        """Whether a recording is on."""
        return self._order is not None

    def picture(self, most: int | None, timeout: float) -> bytes:
        """The next picture as a JPEG file.

        Raises:
            CameraError: the camera gives none.
        """
        self._looked = self._running()
        number, answer = self._ask()
        self._send(Show(number, most))
        try:
            shown: Shown = wait_within(answer.result, timeout, time.monotonic)
        except TimeoutError:
            raise CameraError(f"The camera “{self.address.name}” gives no picture.", "camera") from None
        if shown.refusal:
            raise CameraError(shown.refusal, "camera")
        return shown.picture

    def record(self, order: RecordingJob) -> None:
        """Records from now on."""
        self._order = order
        self._send(Record(order))

    def finish(self, timeout: float) -> Recorded:
        """Ends the recording.

        Raises:
            CameraError: the camera's process ended, or does not answer.
        """
        self._order = None
        number, answer = self._ask()
        self._send(Finish(number))
        try:
            finished: Finished = wait_within(answer.result, timeout, time.monotonic)
        except TimeoutError:
            raise CameraError(f"The camera “{self.address.name}” does not answer.", "camera") from None
        if finished.recorded is None:
            raise CameraError("The camera's process ended while it recorded.", "camera")
        return finished.recorded

    def close(self) -> None:
        """Ends the process."""
        self._closing.set()
        self._thread.join()

    def _ask(self) -> tuple[int, Future[Any]]:
        with self._lock:
            number = next(self._numbers)
            self._waiting[number] = Future()
            return number, self._waiting[number]

    def _send(self, message: object) -> None:
        try:
            with self._lock:
                self._worker.send(message)
        except WorkerEndedError as ended:
            raise self._ended(ended) from ended

    def _ended(self, reason: object) -> CameraError:
        return CameraError(f"The process of the camera “{self.address.name}” ended ({reason}).", "camera")

    def _run(self) -> None:
        reason: object = "it was closed"
        try:
            heard = self._running()
            while not self._closing.is_set() and not self._is_idle():
                message = self._worker.receive(POLL_SECONDS)
                if isinstance(message, Standing | Shown | Finished) or not self._waiting:
                    heard = self._running()
                elif self._running() - heard > SILENCE_SECONDS:
                    reason = f"it gave no sign of life for {SILENCE_SECONDS:.0f} s"
                    _log.warning("The process of the camera %s was ended: %s.", self.address.id, reason)
                    break
                if isinstance(message, Standing):
                    self.standing = message
                    self._changed()
                elif isinstance(message, Shown | Finished):
                    self._answer(message)
        except WorkerEndedError as ended:
            _log.warning("The process of the camera %s ended (%s).", self.address.id, ended)
            reason = ended
        finally:
            self._closing.set()
            self._worker.kill()
            self._fail(self._ended(reason))
            self._changed()

    def _is_idle(self) -> bool:
        self._running.look()
        if self.is_kept or self.is_recording:
            return False
        return self._running() - self._looked > IDLE_SECONDS

    def _answer(self, message: Shown | Finished) -> None:
        with self._lock:
            future = self._waiting.pop(message.number, None)
        if future is not None:
            future.set_result(message)

    def _fail(self, error: StateError | RobotError) -> None:
        with self._lock:
            waiting, self._waiting = self._waiting, {}
        for future in waiting.values():
            future.set_exception(error)
