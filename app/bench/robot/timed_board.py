"""The emulated board in virtual time: how long each message takes it, and in how many ramps."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from app.emulator.firmware import Firmware
from app.emulator.profiles import PROFILES, ProfileName
from core.arrays import Floats
from core.wire.messages import encode_waypoint

DURATION = 0.4
"""Planned time of every message, s; the firmware does nothing with it."""

RAMP_FOLLOWS = b"Checked errors, reached point 0"


@dataclass(frozen=True, eq=False)
class TimedMoves:
    """Messages that were sent one after the other, each after the end line of the one before.

    Args:
        moves: (n, motors) planned distance of each motor, from the waypoint that it was last sent to, m.
        seconds: (n,) from one end line to the next.
        ramps: (n,) how many ramps the board made.
    """

    moves: Floats
    seconds: Floats
    ramps: NDArray[np.int64]


@dataclass(frozen=True)
class TimedMessage:
    """One message as the board took it.

    Args:
        seconds: from its sending to its end line.
        ramps: when each ramp of its motors begins and ends, s from its sending.
    """

    seconds: float
    ramps: tuple[tuple[float, float], ...]


class TimedBoard:
    """An emulated board that has started and stands near its first waypoint.

    Args:
        strokes: (4, 3) or (12,) the first waypoint, m.
        profile: timing of the board.
    """

    def __init__(self, strokes: Floats, profile: ProfileName = ProfileName.PUBLISHED) -> None:
        self.firmware = Firmware(PROFILES[profile], tuple(strokes.ravel() * 1000.0))
        self._program = self.firmware.run()
        while not self.firmware.completions:
            next(self._program)
        # The start moves the motors; what is measured begins where they stand at the first waypoint.
        self.send(strokes)

    def send(self, strokes: Floats, duration: float = DURATION) -> tuple[float, int]:
        """Sends one waypoint and waits for its end line; seconds and ramps of it."""
        message = self.timed(strokes, duration)
        return message.seconds, len(message.ramps)

    def timed(self, strokes: Floats, duration: float = DURATION) -> TimedMessage:
        """Sends one waypoint and waits for its end line.

        Args:
            strokes: (4, 3) or (12,) m.
            duration: planned time of the message, s.
        """
        firmware = self.firmware
        began, done = firmware.now, len(firmware.completions)
        ramps: list[tuple[float, float]] = []
        ramp_began: float | None = None
        firmware.board.inbox += encode_waypoint(strokes.reshape(4, 3), duration)
        while len(firmware.completions) == done:
            before = firmware.now
            next(self._program)
            sent = firmware.board.take_sent()
            if sent and ramp_began is not None:  # the board is mute during a ramp
                ramps.append((ramp_began, before - began))
                ramp_began = None
            if RAMP_FOLLOWS in b"".join(chunk.data for chunk in sent):
                ramp_began = sent[-1].time_us / 1e6 - began
        return TimedMessage(firmware.now - began, tuple(ramps))

    @property
    def strokes(self) -> Floats:
        """(4, 3) true strokes, m."""
        board = self.firmware.board
        strokes_mm = [board.motors.stroke_mm(motor, board.now_us) for motor in range(12)]
        return np.array(strokes_mm).reshape(4, 3) / 1000.0


def timed_moves(profile: ProfileName, waypoints: Floats) -> TimedMoves:
    """Sends waypoints, from the first one, where the board stands.

    Args:
        profile: timing of the board.
        waypoints: (n, 12) or (n, 4, 3) strokes, m.
    """
    board = TimedBoard(waypoints[0], profile)
    timed = [board.send(strokes) for strokes in waypoints[1:]]
    moves = np.abs(np.diff(np.reshape(waypoints, (len(waypoints), -1)), axis=0))
    return TimedMoves(moves, np.array([s for s, _ in timed]), np.array([r for _, r in timed]))
