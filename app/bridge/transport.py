"""The host's end of the cable: a serial device or a socket, read at once and written with a deadline."""

import errno
import os
import selectors
import threading
import time
from collections.abc import Callable
from typing import Protocol

import serial
from serial.tools import list_ports

from app.bridge.devices import SerialDevice
from app.bridge.network_line import CONNECT_DEADLINE, SCHEME, NetworkLine
from core.errors import InputError, RobotError
from core.running_time import Deadline

BAUD = 9600
"""As the sketch asks for; the board's own USB ignores it. Never 1200, which starts the boot loader."""

WRITE_DEADLINE = 0.5
"""A message of 110 bytes that is not out after this long never will be, s."""

SLICE = 0.05
"""The longest wait at a time for a line to take bytes, s."""

READ_LIMIT = 0.2
"""Longest time for reading what has waited at the line, s; a robot may go on sending without a pause."""

CHUNK_BYTES = 65536


def serial_devices() -> tuple[SerialDevice, ...]:
    """What is plugged in, boards with a serial number first, then by name."""
    found = (
        SerialDevice(port.device, _said(port.description), port.serial_number or None)
        for port in list_ports.comports()
    )
    return tuple(sorted(found, key=lambda one: (one.serial_number is None, one.device)))


def _said(description: str | None) -> str:
    return "" if description in (None, "n/a") else str(description)


class _Line(Protocol):
    """An open device or socket."""

    def fileno(self) -> int: ...

    def close(self) -> None: ...


class Transport:
    """An open line to the robot.

    Args:
        device: path of a serial device, or `socket://HOST:PORT`.
        on_data: called by the reader's thread with what arrived; must return at once.
        on_lost: called once by the reader's thread with a sentence when the line hangs up by itself.

    Raises:
        InputError: it is the address of something else, or has options.
        RobotError: the device is absent, busy or not allowed; the sentence says what to do.
    """

    def __init__(self, device: str, on_data: Callable[[bytes], None], on_lost: Callable[[str], None]) -> None:
        self.device = device
        self._port = _open(device)
        self._on_data = on_data
        self._on_lost = on_lost
        self._hands_on = False
        self._closing = threading.Event()
        self._close_lock = threading.Lock()
        self._wake_read, self._wake_write = os.pipe()
        self._thread = threading.Thread(target=self._read_all, name="robot reader", daemon=True)
        self._thread.start()

    def write(self, data: bytes) -> None:
        """Sends a whole message.

        Raises:
            RobotError: the line took no bytes in time, or has hung up.
        """
        deadline = Deadline(WRITE_DEADLINE, time.monotonic, most=2 * SLICE)
        try:
            while data:
                data = data[self._write_some(data) :]
                if data and deadline.is_over:
                    raise RobotError(
                        f"{self.device} took no message for {WRITE_DEADLINE} s. Check cable and power.",
                        self.device,
                    )
        except (serial.SerialException, OSError) as error:
            raise RobotError(_hung_up(self.device), self.device) from error

    def wait_read(self) -> None:
        """Waits until the reader has handed on what the robot sent before."""
        deadline = Deadline(READ_LIMIT, time.monotonic)
        while not deadline.is_over and (self._hands_on or self._is_ready(selectors.EVENT_READ)):
            time.sleep(0.001)

    def _is_ready(self, event: int, seconds: float = 0.0) -> bool:
        """Whether the line has bytes or takes some, within a time; false once it is closed."""
        try:
            with selectors.DefaultSelector() as selector:
                selector.register(self._port.fileno(), event)
                return bool(selector.select(seconds))
        except (OSError, ValueError):
            return False

    def _write_some(self, data: bytes) -> int:
        try:
            # Don't poll for writability first: a pty blocks until input arrives.
            return os.write(self._port.fileno(), data)
        except BlockingIOError:
            self._is_ready(selectors.EVENT_WRITE, SLICE)
            return 0

    def close(self) -> None:
        """Closes the line; doing it twice does no harm."""
        with self._close_lock:
            if self._closing.is_set():
                return
            self._closing.set()
        os.write(self._wake_write, b"x")
        if threading.current_thread() is not self._thread:
            self._thread.join()
        self._port.close()
        os.close(self._wake_read)
        os.close(self._wake_write)

    def _read_all(self) -> None:
        with selectors.DefaultSelector() as selector:
            selector.register(self._port.fileno(), selectors.EVENT_READ)
            selector.register(self._wake_read, selectors.EVENT_READ)
            while not self._closing.is_set():
                selector.select()
                if self._closing.is_set():
                    return
                self._hands_on = True
                data = self._read()
                if data is None:
                    self._on_lost(_hung_up(self.device))
                    return
                self._on_data(data)
                self._hands_on = False

    def _read(self) -> bytes | None:
        try:
            return os.read(self._port.fileno(), CHUNK_BYTES) or None
        except BlockingIOError:
            return b""
        except OSError:
            return None


def _open(device: str) -> _Line:
    try:
        if device.startswith(SCHEME):
            return NetworkLine(device)
        _require_device(device)
        port: _Line = serial.serial_for_url(device, baudrate=BAUD, timeout=0, exclusive=True)
        return port
    except (serial.SerialException, OSError, ValueError) as error:
        raise RobotError(_refusal(device, error), device) from error


def _require_device(device: str) -> None:
    """Refuses pyserial's own addresses: some are no line, and one writes a file of the caller's choice."""
    if "://" in device:
        raise InputError(
            f"{device} is not a line to a robot. Name a serial device such as /dev/ttyACM0, or socket://HOST:PORT.",
            "device",
        )


def _refusal(device: str, error: Exception) -> str:
    text = str(error).lower()
    number = getattr(error, "errno", None)
    if "lock" in text or number == errno.EBUSY:
        return f"{device} is in use by another program. Close that program, then connect again."
    if number == errno.EACCES:
        return f"{device} may not be opened by this user. Ask for the right to use serial ports (dialout)."
    if device.startswith(SCHEME):
        return (
            f"Nothing answers at {device} (limit {CONNECT_DEADLINE:.0f} s). Start the robot's server there, "
            "or correct host and port."
        )
    if number == errno.ENOENT or "no such file" in text:
        return f"There is no device {device}. Plug the robot in, or choose another device."
    return f"{device} cannot be opened as a serial line: {error}. Choose another device."


def _hung_up(device: str) -> str:
    return f"{device} has hung up. Check cable and power, then connect again."
