"""Clocks that a test moves and sets."""

from app.common.clock import Clock


class SetClock(Clock):
    """A wall clock that can be set, and a boot clock that only passes.

    Args:
        wall: where the wall clock begins, s since 1970.
    """

    def __init__(self, wall: float = 1.8e9) -> None:
        self._wall, self._boot = wall, 1000.0
        super().__init__(lambda: self._wall, lambda: self._boot)

    def pass_seconds(self, seconds: float) -> None:
        """Lets time pass on both clocks, s."""
        self._wall += seconds
        self._boot += seconds

    def step(self, seconds: float) -> None:
        """Sets the wall clock ahead, or back where negative, s."""
        self._wall += seconds

    def set(self, wall: float) -> None:
        """Sets the wall clock, s since 1970."""
        self._wall = wall
