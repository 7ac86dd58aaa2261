"""How long the emulated board spends on its input and output (docs/firmware.md, Times)."""

from dataclasses import dataclass
from enum import StrEnum

from core.wire.messages import MOTORS

SERIAL_PACKET = 64
"""Bytes of one packet to the host; each costs one serial write."""

RELEASE_WRITES = 3
"""Writes to the motor driver for a new motor command: speed and two direction pins."""


@dataclass(frozen=True)
class Profile:
    """Microseconds for one reading of a stroke, one motor pin, one serial write, one number as text."""

    adc_us: int
    pwm_us: int
    serial_us: int
    text_us: int

    @property
    def read_us(self) -> int:
        """Reading all strokes once."""
        return MOTORS * self.adc_us

    @property
    def drive_us(self) -> int:
        """Giving one motor a command."""
        return RELEASE_WRITES * self.pwm_us

    @property
    def scan(self) -> float:
        """Longest error scan in s: every stroke read once a motor, printed, and every motor released."""
        printing = MOTORS * 8 * self.serial_us + 2 * self.serial_us
        return (MOTORS * (self.read_us + self.drive_us) + printing) / 1e6

    def print_us(self, text: bytes) -> int:
        """Sending `text` with one call."""
        return self.serial_us * max(1, -(-len(text) // SERIAL_PACKET))


class ProfileName(StrEnum):
    """Timings to choose from; `published` makes the published walk last its published 30 s."""

    PUBLISHED = "published"
    NOMINAL = "nominal"
    SLOW = "slow"


PROFILES: dict[ProfileName, Profile] = {
    ProfileName.PUBLISHED: Profile(adc_us=1850, pwm_us=400, serial_us=40, text_us=100),
    ProfileName.NOMINAL: Profile(adc_us=1000, pwm_us=155, serial_us=40, text_us=100),
    ProfileName.SLOW: Profile(adc_us=2400, pwm_us=560, serial_us=60, text_us=150),
}
"""Nominal and slow as the recordings were made; published lies between (docs/firmware.md, Times)."""
