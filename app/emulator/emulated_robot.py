"""An emulated robot on a real line: the firmware's virtual time laid over the real one."""

import threading
import time
from collections.abc import Callable, Iterable, Iterator, Sequence

from app.emulator.faults import STRIKE_ONCE, FaultRequest, Troubles
from app.emulator.firmware import Firmware
from app.emulator.ports import Port, PtyPort, TcpPort
from app.emulator.profiles import PROFILES, ProfileName
from core.wire.messages import MOTORS, RESET_MM

NAP = 0.001
"""Waits shorter than this are not worth a sleep, s."""

WORST_LAG = 0.5
"""After falling further behind than this (a suspended machine), time is not caught up, s."""

PATIENCE = 2.0
"""A host whose reader is late by less than this loses nothing; a terminal alone holds 4 kB, s."""

FAULT_AT_WAYPOINT = 3
FAULT_AFTER = 0.4
"""A fault that strikes once and was asked for beforehand does so this long after that many waypoints were
taken, s; one that lasts is there from the start."""


class RealTime:
    """Lays the robot's time over the real one.

    Args:
        speed: seconds of the robot in a second.
    """

    def __init__(self, speed: float = 1.0) -> None:
        self._speed = speed
        self._start: float | None = None

    def __call__(self, now: float, interrupt: threading.Event) -> None:
        """Waits until the robot's time `now` has come, or until interrupted."""
        if self._start is None:
            self._start = time.monotonic() - now / self._speed
        wait = self._start + now / self._speed - time.monotonic()
        if wait < -WORST_LAG:
            self._start -= wait
        if wait >= NAP:
            interrupt.wait(wait)


Pace = Callable[[float, threading.Event], None]
"""Called after each step with the robot's time in s; returns when that time has come."""


class Outbox:
    """Bytes on their way to the host; what it does not fetch in time is lost (firmware.md, hazard 23).

    Args:
        port: the line.
    """

    def __init__(self, port: Port) -> None:
        self._port = port
        self._waiting = b""
        self._emptied = time.monotonic()

    def put(self, data: bytes) -> None:
        """Sends what fits and keeps the rest for a while."""
        self._waiting += data
        self._waiting = self._waiting[self._port.write(self._waiting) :] if self._waiting else b""
        now = time.monotonic()
        if not self._waiting:
            self._emptied = now
        elif now - self._emptied > PATIENCE:
            self._waiting = b""


class EmulatedRobot:
    """A robot that a host can open at `device`.

    Args:
        firmware: the program; give it a start pose or a profile of your own.
        port: the line; closed with the robot.
        pace: how fast the robot's time passes.
        faults: what shall go wrong in the first run.
        booted: the board was powered on long ago; its 5 s of silence and its first move are over.
        seed: of the faults' dice.

    Attributes:
        firmware: messages taken, completions and fault state, to be read at any time.
    """

    def __init__(
        self,
        firmware: Firmware,
        port: Port,
        *,
        pace: Pace | None = None,
        faults: Iterable[FaultRequest] = (),
        booted: bool = False,
        seed: int = 0,
    ) -> None:
        self.firmware = firmware
        self._port = port
        self._outbox = Outbox(port)
        self._pace = pace or RealTime()
        self._pending = set(faults)
        self._booted = booted
        self._asked: list[FaultRequest | None] = []
        self._troubles = Troubles(firmware, port.close, seed)
        self._closing = threading.Event()
        self._thread = threading.Thread(target=self._live, name="emulated robot", daemon=True)
        self._thread.start()

    @property
    def device(self) -> str:
        """What a host opens: a path, or `socket://…`."""
        return self._port.device

    def inject(self, fault: FaultRequest) -> None:
        """Makes something go wrong at once."""
        self._asked.append(fault)

    def mend(self) -> None:
        """Ends what lasts: the cable is whole and the motors are sound again."""
        self._asked.append(None)

    def change_speed(self, speed: float) -> None:
        """Lets its time pass at another speed from now on, seconds of the robot in a second."""
        self._pace = RealTime(speed)

    def close(self) -> None:
        """Ends the robot and hangs up; doing it twice does no harm."""
        self._closing.set()
        self._thread.join()
        self._port.close()

    def _live(self) -> None:
        program = self.firmware.run()
        if self._booted:
            self._boot_at_once(program)
        # The pace starts here, so that a board that was just powered on keeps its 5 s of silence.
        self._pace(self.firmware.now, self._closing)
        while not self._closing.is_set():
            next(program)
            self._pace(self.firmware.now, self._closing)
            self._exchange()
            self._strike()

    def _boot_at_once(self, program: Iterator[None]) -> None:
        while not self.firmware.completions:
            next(program)
        self.firmware.board.take_sent()

    def _exchange(self) -> None:
        board, now = self.firmware.board, self.firmware.now
        said = b"".join(chunk.data for chunk in board.take_sent())
        self._outbox.put(self._troubles.to_host.carry(said, now))
        board.inbox += self._troubles.to_robot.carry(self._port.read(), now)

    def _strike(self) -> None:
        is_time = self._is_time()
        due = {one for one in self._pending if is_time or one.fault not in STRIKE_ONCE}
        in_order = sorted(due, key=lambda one: one.fault)
        self._asked.extend(in_order)
        self._pending -= due
        while self._asked:
            request = self._asked.pop(0)
            if request is None:
                self._troubles.mend()
            else:
                self._troubles.strike(request.fault, request.motors)

    def _is_time(self) -> bool:
        taken = [m.time for m in self.firmware.messages if m.strokes_mm is not None]
        return len(taken) >= FAULT_AT_WAYPOINT and (
            self.firmware.now >= taken[FAULT_AT_WAYPOINT - 1] + FAULT_AFTER
        )


def start_emulator(
    profile: ProfileName | str = ProfileName.PUBLISHED,
    speed: float = 1.0,
    *,
    tcp: int | None = None,
    faults: Iterable[FaultRequest] = (),
    booted: bool = False,
    strokes_mm: Sequence[float] = (RESET_MM,) * MOTORS,
) -> EmulatedRobot:
    """Starts an emulated robot, which boots like the real one (5 s, then a move to 0.5 mm).

    Args:
        profile: timing of its input and output.
        speed: seconds of the robot in a second.
        tcp: port to listen on, 0 for a free one; None for a pseudo-terminal.
        faults: what shall go wrong in the first run.
        booted: leave out the boot, as if the board had been powered on long ago.
        strokes_mm: stroke of each motor at power-on.

    Raises:
        InputError: the TCP port is taken.
    """
    port: Port = PtyPort() if tcp is None else TcpPort(tcp)
    firmware = Firmware(PROFILES[ProfileName(profile)], strokes_mm)
    return EmulatedRobot(firmware, port, pace=RealTime(speed), faults=faults, booted=booted)
