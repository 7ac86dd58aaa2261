"""The emulated robot's motors: twelve sliders with hard stops, and the converter that reads them."""

from __future__ import annotations

from collections.abc import Sequence

from core.wire import MOTORS, QUANTUM_MM

FULL_SPEED_MM = 15.0
"""Speed in mm/s at a command of 255 (PROTOCOL, How far to trust it: no load, all equal)."""

FULL_COMMAND = 255
TRAVEL_MM = 20.0


class Motors:
    """Strokes that follow the last command at once, between hard stops at 0 and 20 mm.

    Args:
        strokes_mm: stroke of each motor at time 0, mm.
    """

    def __init__(self, strokes_mm: Sequence[float]) -> None:
        self._start_mm = [float(s) for s in strokes_mm]
        self._speed_mm = [0.0] * MOTORS
        self._since_us = [0] * MOTORS
        self._stuck: set[int] = set()

    def command(self, index: int, command: int, now_us: int) -> None:
        """Drives one motor with −255 to 255; 0 releases it."""
        speed = 0.0 if index in self._stuck else command / FULL_COMMAND * FULL_SPEED_MM
        if speed != self._speed_mm[index]:
            self._start_mm[index] = self.stroke_mm(index, now_us)
            self._since_us[index] = now_us
            self._speed_mm[index] = speed

    def jam(self, index: int, now_us: int) -> None:
        """Blocks one motor where it is, whatever it is told from now on."""
        self.command(index, 0, now_us)
        self._stuck.add(index)

    def stroke_mm(self, index: int, now_us: int) -> float:
        """True stroke of one motor in mm."""
        moved = self._start_mm[index] + self._speed_mm[index] * (now_us - self._since_us[index]) / 1e6
        return min(max(moved, 0.0), TRAVEL_MM)

    def reading_mm(self, index: int, now_us: int) -> float:
        """Stroke of one motor as the robot's converter sees it, a multiple of 0.012 mm."""
        return round(self.stroke_mm(index, now_us) / QUANTUM_MM) * QUANTUM_MM
