"""Serial devices by name, and by the serial number that outlasts a name."""

from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True)
class SerialDevice:
    """A serial device of this computer.

    Args:
        device: path under which it is opened; may be another one after it was unplugged.
        description: what it says it is.
        serial_number: of the board; None where it has none.
    """

    device: str
    description: str = ""
    serial_number: str | None = None


def found_again(lost: SerialDevice, present: Sequence[SerialDevice]) -> SerialDevice | None:
    """Finds a lost device by its serial number; None if it has none or more than one matches.

    Args:
        lost: as it was when it was connected.
        present: what is plugged in.
    """
    if not lost.serial_number:
        return None
    same = [one for one in present if one.serial_number == lost.serial_number]
    under_its_name = next((one for one in same if one.device == lost.device), None)
    return under_its_name or (same[0] if len(same) == 1 else None)
