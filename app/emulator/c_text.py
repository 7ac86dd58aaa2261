"""How the robot's C library reads and prints numbers and fields."""

import math
import re

_INTEGER = re.compile(rb"[ \t\n\v\f\r]*([+-]?\d{1,9})")
_HEX = re.compile(rb"[ \t\n\v\f\r]*([+-]?)0[xX]([0-9a-fA-F]{1,12})")
_FLOAT = re.compile(
    rb"[ \t\n\v\f\r]*([+-]?(?:\d+\.?\d*(?:[eE][+-]?\d{1,3})?|\.\d+(?:[eE][+-]?\d{1,3})?|inf|nan))",
    re.IGNORECASE,
)

OVERFLOW = 4294967040.0
"""Beyond this a number is printed as `ovf`."""


def c_string(buffer: bytes | bytearray, start: int = 0) -> bytes:
    """Returns the bytes from `start` up to the next NUL."""
    end = buffer.find(0, start)
    return bytes(buffer[start:]) if end < 0 else bytes(buffer[start:end])


class Fields:
    """Takes a C string apart at commas as `strtok` does, writing a NUL after each field.

    Args:
        buffer: the text; it is changed, as the robot's is.
    """

    def __init__(self, buffer: bytearray) -> None:
        self._buffer = buffer
        self._at = 0
        self._end = len(c_string(buffer))

    def take(self) -> bytes:
        """Returns the next field; empty fields are skipped, and a missing one is empty text."""
        while self._at < self._end and self._buffer[self._at] == ord(","):
            self._at += 1
        start = self._at
        comma = self._buffer.find(b",", start, self._end)
        if comma < 0:
            self._at = self._end
            return bytes(self._buffer[start : self._end])
        self._buffer[comma] = 0
        self._at = comma + 1
        return bytes(self._buffer[start:comma])


def to_int(text: bytes) -> int:
    """Reads an integer as `atoi` does: what does not begin like one is 0."""
    match = _INTEGER.match(text)
    return int(match[1]) if match else 0


def to_float(text: bytes) -> float:
    """Reads a number as `atof` does: `5mm` is 5, `0x8` is 8, `nan` and `inf` count, else 0."""
    if match := _HEX.match(text):
        return float(int(match[2], 16)) * (-1.0 if match[1] == b"-" else 1.0)
    match = _FLOAT.match(text)
    return float(match[1]) if match else 0.0


def print_pieces(value: float, decimals: int) -> list[bytes]:
    """Prints a number digit by digit, the way it trickles out: sign, whole part, point, each decimal."""
    if math.isnan(value):
        return [b"nan"]
    if math.isinf(value):
        return [b"inf"]
    if abs(value) > OVERFLOW:
        return [b"ovf"]
    sign = [b"-"] if value < 0 else []
    whole, _, digits = f"{abs(value):.{decimals}f}".encode().partition(b".")
    return [*sign, whole, b".", *(digits[i : i + 1] for i in range(decimals))]


def padded_text(value: float, decimals: int) -> bytes:
    """Turns a number into text as the robot's strings do; `nan` and `inf` are padded."""
    if math.isfinite(value):
        return f"{value:.{decimals}f}".encode()
    return f"{value:>{decimals + 2}}".encode()
