"""The emulated robot's motors: twelve sliders with hard stops, and the converter that reads them."""

from collections.abc import Callable, Sequence

from core.wire.messages import MOTORS, QUANTUM_MM

FULL_SPEED_MM = 15.0
"""Speed in mm/s at a command of 255 (docs/firmware.md: no load, all equal)."""

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
        self._command = [0] * MOTORS
        self._strength = [1.0] * MOTORS
        self._driven = list(range(MOTORS))
        self._dead_mm: dict[int, float] = {}
        self._noise: Callable[[], float] | None = None

    def command(self, output: int, command: int, now_us: int) -> None:
        """Drives the motor at one of the board's outputs with −255 to 255; 0 releases it."""
        self._drive(self._driven[output], command, now_us)

    def _drive(self, index: int, command: int, now_us: int) -> None:
        self._command[index] = command
        self._start_mm[index] = self.stroke_mm(index, now_us)
        self._since_us[index] = now_us
        self._speed_mm[index] = self._strength[index] * command / FULL_COMMAND * FULL_SPEED_MM

    def way(self, output: int) -> int:
        """The way on which an output drives its motor: 1 out, −1 in, 0 if it is released."""
        command = self._command[self._driven[output]]
        return (command > 0) - (command < 0)

    def weaken(self, index: int, share: float, now_us: int) -> None:
        """Gives one motor a share of its speed from now on; below 0 it turns the wrong way."""
        self._strength[index] = share
        self._drive(index, self._command[index], now_us)

    def jam(self, index: int, now_us: int) -> None:
        """Blocks one motor where it is, whatever it is told from now on."""
        self.weaken(index, 0.0, now_us)

    def swap(self, one: int, other: int, now_us: int) -> None:
        """Has two outputs drive each other's motor from now on; potentiometers stay where they are."""
        for output in (one, other):
            self.command(output, 0, now_us)
        self._driven[one], self._driven[other] = self._driven[other], self._driven[one]

    def blind(self, index: int, now_us: int) -> None:
        """Has one potentiometer read for ever what it reads now."""
        self._dead_mm[index] = self.reading_mm(index, now_us)

    def disturb(self, noise: Callable[[], float]) -> None:
        """Adds to each reading what `noise` gives, mm."""
        self._noise = noise

    def mend(self, now_us: int) -> None:
        """Ends all faults of motors and potentiometers."""
        self._dead_mm.clear()
        self._noise = None
        for index in range(MOTORS):
            self.weaken(index, 1.0, now_us)
            if self._driven[index] != index:
                self.command(index, 0, now_us)
        self._driven = list(range(MOTORS))

    def stroke_mm(self, index: int, now_us: int) -> float:
        """True stroke of one motor in mm."""
        moved = self._start_mm[index] + self._speed_mm[index] * (now_us - self._since_us[index]) / 1e6
        return min(max(moved, 0.0), TRAVEL_MM)

    def reading_mm(self, index: int, now_us: int) -> float:
        """Stroke of one motor as the robot's converter sees it, a multiple of 0.012 mm."""
        if index in self._dead_mm:
            return self._dead_mm[index]
        seen = self.stroke_mm(index, now_us)
        if self._noise is not None:
            seen = max(seen + self._noise(), 0.0)
        return round(seen / QUANTUM_MM) * QUANTUM_MM
