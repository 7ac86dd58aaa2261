"""The emulated robot's program, in virtual time: one turn of its loop after the other (docs/firmware.md).

It is a generator that advances the board's clock: whoever drives it decides what a microsecond is, hands
over what the host has sent before each step, and takes what the board has sent after it.
"""

from collections.abc import Generator, Iterator, Sequence
from dataclasses import dataclass
from itertools import repeat

from app.emulator.board import Board
from app.emulator.c_text import Fields, c_string, padded_text, to_float, to_int
from app.emulator.memory import ARM, Layout, Memory
from app.emulator.profiles import Profile
from app.emulator.ramp import Controller, longest_ramp, motor_speeds, ramp_durations, ramp_reference, single
from core.wire.messages import MOTORS, RESET_MM, THRESHOLD_MM

BUFFER_BYTES = 20000
"""Longest payload that the robot's memory holds; it does not check (firmware.md, hazard 17)."""

LONGEST_PARTIAL = 65536
"""Bytes of an open message that the emulator keeps; a board would have died long before."""

POWER_UP_US = 5_000_000
BEGIN_US, BEGIN_WRITES = 45_600, 48
"""The board waits 5 s, then sets up its drivers (from the first line's time in the recordings)."""

TURN_US = 10_000
PASS_US = 1_000
"""Pauses of the sketch after a turn of a ramp and after a pass of the loop."""

ACCELERATION_MM, SETUP_ACCELERATION_MM = 15.0, 12.5
SILENCE_US = 20_000


@dataclass(frozen=True)
class Message:
    """A message as the robot took it: when, its payload, and the strokes in mm if it was one waypoint."""

    time: float
    payload: str
    strokes_mm: tuple[float, ...] | None


@dataclass(frozen=True)
class Completion:
    """An end of all trajectories: when, what had been asked, and the true strokes then, in mm."""

    time: float
    target_mm: tuple[float, ...]
    strokes_mm: tuple[float, ...]

    @property
    def worst_mm(self) -> float:
        """Largest distance of a motor from its target, mm."""
        return max(abs(t - s) for t, s in zip(self.target_mm, self.strokes_mm, strict=True))


class Firmware:
    """The robot's side of the wire.

    Args:
        profile: time that input and output take.
        strokes_mm: stroke of each motor at power-on; by default all drawn in.
        layout: of the variables that a message of several waypoints overwrites.

    Attributes:
        board: clock, line and motors.
        messages: every message that was taken, in order.
        completions: every completed trajectory, in order.
        fault: why the program died, or None; a dead program is silent and holds its motors' commands.
        spoilt: what has overwritten its memory, or None (firmware.md, hazard 7).
    """

    def __init__(
        self, profile: Profile, strokes_mm: Sequence[float] = (RESET_MM,) * MOTORS, layout: Layout = ARM
    ) -> None:
        self.board = Board(profile, strokes_mm)
        self.messages: list[Message] = []
        self.completions: list[Completion] = []
        self.fault: str | None = None
        self.spoilt: str | None = None
        self._layout = layout
        self._reset_asked = False
        self._clear_memory()

    @property
    def now(self) -> float:
        """Time since power-on, s."""
        return self.board.now_us / 1e6

    def stall(self, reason: str) -> None:
        """Kills the program: silent and deaf, every motor keeps its last command."""
        self.fault = reason

    def reset(self) -> None:
        """Restarts the controller while the motor drivers keep their power (firmware.md, hazard 20)."""
        self._reset_asked = True

    def power_cycle(self, off: float = 0.0) -> None:
        """Takes the power away for `off` s: motors stop where they are, nothing is remembered."""
        self.board.cut_power()
        self.board.now_us += round(off * 1e6)
        self.reset()

    def run(self) -> Iterator[None]:
        """Lives for ever; each step advances the clock to the next point where the world may look in."""
        while True:
            for _ in self._life():
                yield
                if self._reset_asked or self.fault is not None:
                    break
            while self.fault is not None and not self._reset_asked:
                self.board.now_us += SILENCE_US
                yield
            self._clear_memory()

    def _clear_memory(self) -> None:
        self._reset_asked = False
        self.fault = self.spoilt = None
        self._buffer = bytearray(BUFFER_BYTES + 1)
        self._partial: bytearray | None = None
        self._corruption: str | None = None
        self._stopped = False
        self._memory = Memory(self._layout)
        self._count, self._index, self._active = 0, 0, False
        self._controller = Controller()
        self._last_millis = 0

    def _life(self) -> Iterator[None]:
        yield from self._set_up()
        while True:
            yield
            taken = self._receive()
            self.board.write_line(b"new data tf ", b"1" if taken else b"0")
            if taken:
                self._act()
            if self._active and not self._stopped:
                yield from self._execute()
            self._update_state()
            self._publish()
            self.board.now_us += PASS_US

    def _set_up(self) -> Iterator[None]:
        board = self.board
        for _ in range(POWER_UP_US // SILENCE_US):
            board.now_us += SILENCE_US
            yield
        board.now_us += BEGIN_US + BEGIN_WRITES * board.profile.pwm_us
        board.release_all()
        self._read()
        self._publish()
        self._reset_motors()
        board.write_line(b"SETUP MOVING")
        yield from self._ramp(SETUP_ACCELERATION_MM)
        board.write_line(b"SETUP FINISHED")

    def _receive(self) -> bool:
        """Reads until a message is whole; the rest stays queued."""
        inbox = self.board.inbox
        while inbox:
            if self._partial is None:
                _, marker, rest = bytes(inbox).partition(b"<")
                inbox[:] = rest
                self._partial = bytearray() if marker else None
                continue
            payload, marker, rest = bytes(inbox).partition(b">")
            inbox[:] = rest
            self._partial += payload[: LONGEST_PARTIAL - len(self._partial)]
            if marker:
                self._store(bytes(self._partial))
                self._partial = None
                return True
        return False

    def _store(self, payload: bytes) -> None:
        if len(payload) > BUFFER_BYTES:
            self._corruption = f"A message of {len(payload)} bytes overran the robot's memory."
        self._buffer[: len(payload) + 1] = payload + b"\0"

    def _act(self) -> None:
        text = c_string(self._buffer)
        self.board.write_line(text)
        strokes = None
        if text.startswith(b"s"):
            self._stop(self._buffer[2] != ord("0"))
        elif text.startswith(b"r"):
            self._reset_motors()
        elif text.startswith(b"p"):
            strokes = self._read_trajectory()
        self.messages.append(Message(self.now, text.decode("latin-1"), strokes))

    def _stop(self, stopped: bool) -> None:
        self._stopped = stopped
        if stopped and not self._crashed():
            self._release_by_pins()

    def _release_by_pins(self) -> None:
        for index in range(MOTORS):
            self.board.motors.command(index, 0, self.board.now_us)
            self.board.now_us += 2 * self.board.profile.pwm_us

    def _crashed(self) -> bool:
        if self._corruption is not None and self.fault is None:
            self.stall(self._corruption)
        return self._corruption is not None

    def _reset_motors(self) -> None:
        self._memory.store(0, 0.0, [RESET_MM] * MOTORS)
        self._begin(1)

    def _begin(self, count: int) -> None:
        self._count, self._index, self._active = count, 0, True

    def _read_trajectory(self) -> tuple[float, ...] | None:
        board = self.board
        board.write_line()
        board.write(b"p ")
        fields = Fields(self._buffer)
        fields.take()
        count = to_int(fields.take())
        strokes = None
        for index in range(count):
            strokes = self._read_point(index, fields)
        self._begin(count)
        if count > 1:
            self.spoilt = f"A message of {count} waypoints overran the memory for one."
        board.write_line(b"Number of trajectory points \t", *_integer(count))
        return strokes if count == 1 else None

    def _read_point(self, index: int, fields: Fields) -> tuple[float, ...]:
        board = self.board
        duration = to_float(fields.take())
        board.write(b"durations i")
        board.write_number(duration, 2)
        board.write_line()
        strokes = tuple(single(to_float(fields.take())) for _ in range(MOTORS))
        self._memory.store(index, single(duration), strokes)
        text = b"p " + padded_text(duration, 2) + b" "
        text += b"".join(padded_text(stroke, 4) + b" " for stroke in strokes)
        board.now_us += (MOTORS + 1) * board.profile.text_us
        board.write_line(b"Trajectory Point ", str(index).encode(), b": \t", text)
        return strokes

    def _execute(self) -> Iterator[None]:
        board = self.board
        count = _integer(self._count)
        board.write_line(b"num pts ", *count, b" execute waypoints ")
        board.write_line()
        board.write_line(b"Curr point ", *_integer(self._index), b" Max pts ", *count)
        board.write_line()
        reached = yield from self._scan()
        board.write_line(b"Checked errors, reached point ", b"1" if reached else b"0")
        if reached:
            board.write_line(b"reached point, onto next trajectory")
            self._index += 1
        if self._index < self._count:
            yield from self._ramp(ACCELERATION_MM)
        else:
            self._complete()

    def _scan(self) -> Generator[None, None, bool]:
        board = self.board
        board.write(b"E, ")
        reached = True
        for index in range(MOTORS):
            self._read()
            error = single(single(board.readings_mm[index]) - single(self._wanted_mm[index]))
            self._memory.note_error(index, error)
            board.write_number(error, 4)
            board.write(b",")
            if abs(error) > THRESHOLD_MM:
                reached = False
            elif not self._crashed():
                board.drive(index, 0)
            yield
        board.write_line()
        return reached

    def _complete(self) -> None:
        board = self.board
        board.release_all()
        strokes = tuple(board.motors.stroke_mm(i, board.now_us) for i in range(MOTORS))
        self.completions.append(Completion(self.now, tuple(self._memory.wanted_mm(0)), strokes))
        board.write_line(b"end of all available trajectories")
        self._active = False

    def _ramp(self, acceleration_mm: float) -> Iterator[None]:
        """Moves all motors at once, deaf and mute until the longest ramp is over."""
        self._update_state()
        durations = ramp_durations(self._distances(), acceleration_mm)
        speeds = motor_speeds(durations)
        longest = longest_ramp(durations)
        start, time = self.board.millis, 0.0
        while time < longest:
            time = (self.board.millis - start) / 1000.0
            self._turn(time, speeds, acceleration_mm)
            if self._overrun(time):
                self.stall(self.spoilt or "")
            self.board.now_us += TURN_US
            yield

    def _turn(self, time: float, speeds: list[float], acceleration_mm: float) -> None:
        board = self.board
        before = list(board.readings_mm)
        wanted = list(map(ramp_reference, self._distances(), repeat(time), speeds, repeat(acceleration_mm)))
        elapsed = self._update_state()
        commands = [
            self._controller.command(
                i, before[i] + wanted[i][0] - board.readings_mm[i], wanted[i][1], elapsed
            )
            for i in range(MOTORS)
        ]
        survivors = 0 if self._crashed() else 1 if self._overrun(time) else MOTORS
        for index in range(survivors):
            board.drive(index, commands[index])

    def _overrun(self, time: float) -> bool:
        """Whether the program dies of a spoilt memory, with motor 1 driven."""
        return self._count > self._layout.survived and time > 0.0

    @property
    def _wanted_mm(self) -> list[float]:
        """Strokes of the present point; where one beyond the first lies, there are other variables."""
        return self._memory.wanted_mm(self._index)

    def _distances(self) -> list[float]:
        return [t - r for t, r in zip(self._wanted_mm, self.board.readings_mm, strict=True)]

    def _update_state(self) -> float:
        elapsed = (self.board.millis - self._last_millis) / 1000.0
        self._last_millis = self.board.millis
        self._read()
        return elapsed

    def _read(self) -> None:
        self.board.read_strokes()
        if self._corruption is not None:
            self.board.readings_mm = [0.0] * MOTORS
        self._memory.note_readings(self.board.readings_mm)

    def _publish(self) -> None:
        board = self.board
        board.now_us += MOTORS * board.profile.text_us
        board.write_line(b"j," + b"".join(f"{r:.4f},".encode() for r in board.readings_mm))


def _integer(value: int) -> list[bytes]:
    digits = str(abs(value)).encode()
    return [b"-", digits] if value < 0 else [digits]
