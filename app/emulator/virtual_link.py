"""The bridge's state machine joined to an emulated robot, without threads, in the robot's own time."""

from collections.abc import Callable, Sequence

from app.bridge.state_machine import RobotStateMachine
from app.bridge.states import Direction, RobotSnapshot
from app.bridge.write_gate import WriteGate
from app.emulator.faults import Troubles
from app.emulator.firmware import Firmware
from app.emulator.profiles import PROFILES, ProfileName
from core.errors import RobotError
from core.wire.messages import MOTORS, RESET_MM

DEVICE = "virtual"


class VirtualLink:
    """A session on an emulated robot; each step is one step of the robot's program.

    Args:
        profile: timing of the robot.
        strokes_mm: stroke of each motor at power-on.
        seed: of the faults' dice.

    Attributes:
        firmware: the robot.
        machine: the host.
        troubles: what is wrong with the robot and its cable.
        log: every piece of bytes both ways, as the host sent and received it.
        to_robot, from_robot: what happens to bytes before the troubles, or after them.
    """

    def __init__(
        self,
        profile: ProfileName = ProfileName.PUBLISHED,
        strokes_mm: Sequence[float] = (RESET_MM,) * MOTORS,
        seed: int = 0,
    ) -> None:
        self.firmware = Firmware(PROFILES[profile], strokes_mm)
        self.log: list[tuple[Direction, bytes]] = []
        self.heard: list[bytes] = []
        self.to_robot: Callable[[bytes], bytes] = bytes
        self.from_robot: Callable[[bytes], bytes] = bytes
        self.gate = WriteGate(lambda way, data, _: self.log.append((way, data)), lambda: self.now)
        self.machine = RobotStateMachine(self.gate, lambda: self.now)
        self.troubles = Troubles(self.firmware, self._pull, seed)
        self._plugged = True
        self._program = self.firmware.run()

    @property
    def now(self) -> float:
        """Time since power-on, s."""
        return self.firmware.now

    @property
    def snapshot(self) -> RobotSnapshot:
        """Everything there is to show, now."""
        return self.machine.snapshot()

    @property
    def strokes_mm(self) -> list[float]:
        """True stroke of each motor, mm."""
        board = self.firmware.board
        return [board.motors.stroke_mm(i, board.now_us) for i in range(MOTORS)]

    def write(self, data: bytes) -> None:
        """Takes a message of the host.

        Raises:
            RobotError: the cable is out.
        """
        if not self._plugged:
            raise RobotError("The cable is out.", DEVICE)
        self.firmware.board.inbox += self.troubles.to_robot.carry(self.to_robot(data), self.now)

    def step(self) -> None:
        """Lets the robot go on to the next point where the world may look in, and the host with it."""
        next(self._program)
        if self._plugged:
            self.firmware.board.inbox += self.troubles.to_robot.carry(b"", self.now)
        said = b"".join(chunk.data for chunk in self.firmware.board.take_sent())
        data = self.from_robot(self.troubles.to_host.carry(said, self.now)) if self._plugged else b""
        if data:
            self.heard.append(data)
            self.machine.received(data, self.now)
        self.machine.tick(self.now)

    def boot(self) -> None:
        """Lets the board boot before anyone listens."""
        while not self.firmware.completions:
            next(self._program)
        self.run_unheard(0.1)

    def run_unheard(self, seconds: float) -> None:
        """Lets time pass while nobody listens."""
        end = self.now + seconds
        while self.now < end:
            next(self._program)
        self.firmware.board.take_sent()

    def until(self, condition: Callable[[RobotSnapshot], bool], limit: float = 120.0) -> RobotSnapshot:
        """Steps until the host's state meets a condition.

        Raises:
            TimeoutError: not within `limit` s of the robot's time.
        """
        end = self.now + limit
        while not condition(self.snapshot):
            self.step()
            if self.now > end:
                raise TimeoutError(f"not within {limit} s: {self.snapshot}")
        return self.snapshot

    def wait(self, seconds: float) -> None:
        """Steps for some time of the robot."""
        end = self.now + seconds
        while self.now < end:
            self.step()

    def stop(self, by: str = "Ada") -> None:
        """Does what `RobotBridge.stop` does."""
        is_sent = True
        try:
            self.gate.stop()
        except RobotError as error:
            is_sent = False
            self.machine.hung_up(error.sentence, self.now)
        self.machine.stop(by, self.now, is_sent=is_sent)

    def open(self) -> None:
        """Plugs the cable in and opens the line."""
        self._plugged = True
        self.gate.attach(self)
        self.machine.opened(DEVICE, self.now)

    def _pull(self) -> None:
        self._plugged = False
        self.machine.hung_up(f"{DEVICE} has hung up.", self.now)
