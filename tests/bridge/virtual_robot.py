"""The bridge's session and the emulated robot, joined without threads in the robot's own time."""

from collections.abc import Callable, Sequence

import numpy as np

from app.bridge.firmware import Firmware
from app.bridge.gate import Gate
from app.bridge.profiles import PROFILES, ProfileName
from app.bridge.robot_session import RobotSession
from app.bridge.states import Direction, LinkState, RobotSnapshot, RobotState, RunPlan
from core.findings import Approval
from core.waypoints import Waypoints

REST_MM = (0.5,) * 12


def make_plan(rows_mm: Sequence[Sequence[float]], hold_ok: Sequence[bool] | None = None) -> RunPlan:
    """An approved plan of (n, 12) strokes in mm."""
    strokes = np.array(rows_mm).reshape(-1, 4, 3) / 1000.0
    waypoints = Waypoints(strokes, np.full(len(rows_mm), 0.4))
    approval = Approval("verdict", waypoints.content_hash, "Ada", "2026-01-01T00:00:00+00:00")
    return RunPlan(waypoints, approval, tuple(hold_ok or [True] * len(rows_mm)))


def random_plan(seed: int, count: int) -> RunPlan:
    """An approved plan of random waypoints."""
    return make_plan(np.random.default_rng(seed).uniform(0.5, 19.5, (count, 12)).tolist())


class VirtualRobot:
    """A session on an emulated robot; each step is one step of the robot's program."""

    def __init__(
        self, profile: ProfileName = ProfileName.PUBLISHED, strokes_mm: Sequence[float] = REST_MM
    ) -> None:
        self.firmware = Firmware(PROFILES[profile], strokes_mm)
        self.log: list[tuple[Direction, bytes]] = []
        self.heard: list[bytes] = []
        self.to_robot: Callable[[bytes], bytes] = bytes
        self.from_robot: Callable[[bytes], bytes] = bytes
        self.gate = Gate(lambda way, data, _: self.log.append((way, data)), lambda: self.now)
        self.session = RobotSession(self.gate)
        self._program = self.firmware.run()

    @property
    def now(self) -> float:
        return self.firmware.now

    @property
    def snapshot(self) -> RobotSnapshot:
        return self.session.snapshot(self.now)

    @property
    def sent(self) -> list[bytes]:
        return [data for way, data in self.log if way is Direction.TO_ROBOT]

    def write(self, data: bytes) -> None:
        self.firmware.board.inbox += self.to_robot(data)

    def step(self) -> None:
        next(self._program)
        data = self.from_robot(b"".join(chunk.data for chunk in self.firmware.board.take_sent()))
        if data:
            self.heard.append(data)
            self.session.received(data, self.now)
        self.session.tick(self.now)

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
        end = self.now + limit
        while not condition(self.snapshot):
            self.step()
            if self.now > end:
                raise TimeoutError(f"not within {limit} s: {self.snapshot}")
        return self.snapshot

    def until_robot(self, *states: RobotState) -> RobotSnapshot:
        return self.until(lambda s: s.robot in states)

    def wait(self, seconds: float) -> None:
        end = self.now + seconds
        while self.now < end:
            self.step()

    def stop(self, by: str = "Ada") -> None:
        self.gate.stop()
        self.session.stop(by, self.now)

    def connect(self) -> None:
        self.gate.attach(self)
        self.session.opened("virtual", self.now)
        self.until(lambda s: s.link is LinkState.READY)

    def arm(self) -> None:
        self.connect()
        self.session.arm("Ada", self.now)

    def begin(self, plan: RunPlan) -> None:
        self.arm()
        self.session.send(plan, "Ada", self.now)

    @property
    def strokes_mm(self) -> list[float]:
        return [self.firmware.board.motors.stroke_mm(i, self.firmware.board.now_us) for i in range(12)]
