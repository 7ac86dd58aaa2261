"""The clocks of the program: the wall clock, which may be set, and one that counts on whatever happens."""

import sys
import time
from collections.abc import Callable
from dataclasses import dataclass, field


def boot_seconds() -> float:
    """Seconds that only grow and go on while the machine is suspended, as a person's watch does.

    `time.monotonic` stands still during a suspension on Linux and macOS.
    """
    if sys.platform == "linux":
        return time.clock_gettime(time.CLOCK_BOOTTIME)
    if sys.platform == "darwin":
        return time.clock_gettime(time.CLOCK_MONOTONIC)
    return time.monotonic()


@dataclass(eq=False)
class Clock:
    """The wall clock, and the clock by which durations are measured.

    Args:
        wall: s since 1970; may step in either direction.
        boot: s; only grows, and goes on while the machine is suspended.
    """

    wall: Callable[[], float] = time.time
    boot: Callable[[], float] = boot_seconds

    def start(self) -> "Span":
        """Returns a span that begins now."""
        return Span(self.wall(), self.boot(), self)


CLOCK = Clock()
"""The clocks of this machine."""


@dataclass(frozen=True)
class Span:
    """What began at a time; every later time in it is that time plus the measured duration.

    Args:
        started: by the wall clock, s since 1970.
        boot: by `Clock.boot`, s.
        clock: by which it is measured.
    """

    started: float
    boot: float
    clock: Clock = field(default=CLOCK, repr=False, compare=False)

    @property
    def seconds(self) -> float:
        """Time since the start, s."""
        return self.clock.boot() - self.boot

    @property
    def now(self) -> float:
        """The present time in this span, s since 1970; never before the start."""
        return self.started + self.seconds
