"""The emulated board's hardware: a clock in microseconds, a serial line, motors and their readings."""

from collections.abc import Sequence
from dataclasses import dataclass

from app.emulator.c_text import print_pieces
from app.emulator.motors import Motors
from app.emulator.profiles import Profile
from core.wire.messages import MOTORS


@dataclass(frozen=True)
class Chunk:
    """Bytes that the board has sent, and when the last of them was written, in µs."""

    time_us: int
    data: bytes


class Board:
    """What the sketch runs on; every call advances the clock by what it costs.

    Args:
        profile: the costs.
        strokes_mm: stroke of each motor at power-on, mm.
    """

    def __init__(self, profile: Profile, strokes_mm: Sequence[float]) -> None:
        self.profile = profile
        self.motors = Motors(strokes_mm)
        self.now_us = 0
        self.readings_mm = [0.0] * MOTORS
        self.inbox = bytearray()
        self._sent: list[Chunk] = []

    @property
    def millis(self) -> int:
        """The board's own clock in ms."""
        return self.now_us // 1000

    def cut_power(self) -> None:
        """Releases every motor at once and forgets what waits on the line."""
        for index in range(MOTORS):
            self.motors.command(index, 0, self.now_us)
        self.inbox.clear()
        self._sent.clear()

    def take_sent(self) -> list[Chunk]:
        """Returns what was sent since the last call."""
        sent, self._sent = self._sent, []
        return sent

    def write(self, text: bytes) -> None:
        """Sends text."""
        self.now_us += self.profile.print_us(text)
        self._sent.append(Chunk(self.now_us, text))

    def write_line(self, *pieces: bytes) -> None:
        """Sends pieces, each with a call of its own, and the end of the line."""
        for piece in pieces:
            self.write(piece)
        self.write(b"\r\n")

    def write_number(self, value: float, decimals: int) -> None:
        """Sends a number digit by digit."""
        for piece in print_pieces(value, decimals):
            self.write(piece)

    def read_strokes(self) -> None:
        """Reads every stroke, one after the other."""
        for index in range(MOTORS):
            self.now_us += self.profile.adc_us
            self.readings_mm[index] = self.motors.reading_mm(index, self.now_us)

    def drive(self, index: int, command: int) -> None:
        """Gives a motor a command: the speed changes with the first of three writes, the way with the last.

        Between them a motor that shall turn round goes on the old way at the new speed; one that was
        released has no way until then.
        """
        before = self.motors.way(index)
        self.motors.command(index, before * abs(command), self.now_us + self.profile.pwm_us)
        self.now_us += self.profile.drive_us
        self.motors.command(index, command, self.now_us)

    def release_all(self) -> None:
        """Releases every motor."""
        for index in range(MOTORS):
            self.drive(index, 0)
