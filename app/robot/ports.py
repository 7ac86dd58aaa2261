"""Which devices a robot may be on: those of this computer, the last one, and where a lost one is now."""

import json
import logging
from collections.abc import Callable
from dataclasses import asdict
from pathlib import Path
from typing import Any

from app.bridge.devices import SerialDevice, found_again
from app.bridge.transport import serial_devices
from app.store.plain_file import read_plain_file, write_atomically
from core.errors import FootfallError
from core.text.documents import json_content

_MOST_BYTES = 100_000
"""Bytes of the file that names the last device."""
logger = logging.getLogger(__name__)


class RobotPorts:
    """Lists devices and remembers the last one in a file.

    Args:
        memory: the file.
        present: lists what is plugged in.
    """

    def __init__(
        self, memory: Path, present: Callable[[], tuple[SerialDevice, ...]] = serial_devices
    ) -> None:
        self._memory = memory
        self._present = present
        self._last = self._recall()

    def connected(self, device: str) -> None:
        """A line was opened; which board is on it is known now, and no more once it has hung up."""
        known = next((one for one in self._present() if one.device == device), SerialDevice(device))
        if known == self._last:
            return
        self._last = known
        try:
            write_atomically(self._memory, json.dumps(asdict(known)))
        except FootfallError as error:  # the line is open all the same
            logger.warning("The robot's device is not remembered: %s", error.sentence)

    def view(self, *, is_lost: bool) -> dict[str, Any]:
        """The devices as JSON content.

        Args:
            is_lost: whether the line hung up or fell silent; then its board is looked for.
        """
        present, last = self._present(), self._last
        again = found_again(last, present) if is_lost and last is not None else None
        return {
            "ports": [asdict(one) for one in present],
            "last": None if last is None else asdict(last),
            "again": None if again is None else asdict(again) | {"sentence": _again(last, again)},
        }

    def _recall(self) -> SerialDevice | None:
        try:
            return _parse(read_plain_file(self._memory, _MOST_BYTES))
        except FileNotFoundError:
            return None
        except (FootfallError, ValueError, TypeError, KeyError) as error:
            logger.warning("%s is left aside: it names no device (%s).", self._memory, error)
            return None


def _parse(data: bytes) -> SerialDevice:
    """Raises ValueError, TypeError or KeyError for anything that is no device."""
    content = json_content(data, "the file")
    device, description, number = (content[key] for key in ("device", "description", "serial_number"))
    if not (isinstance(device, str) and isinstance(description, str) and isinstance(number, str | None)):
        raise TypeError("its fields are no texts")
    return SerialDevice(device, description, number)


def _again(last: SerialDevice | None, again: SerialDevice) -> str:
    if last is None or last.device == again.device:
        return f"The robot’s board is plugged in at {again.device}."
    return (
        f"The board that was at {last.device} is at {again.device} now (serial number {again.serial_number})."
    )
