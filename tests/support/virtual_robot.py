"""The bridge's session and the emulated robot, joined without threads in the robot's own time."""

from collections.abc import Sequence

import numpy as np

from app.bridge.bridge import LATE
from app.bridge.states import Direction, LinkState, RobotSnapshot, RobotState, RunPlan
from app.emulator.virtual_link import VirtualLink
from core.findings import Approval
from core.wire.waypoints import Waypoints

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


class VirtualRobot(VirtualLink):
    """A session on an emulated robot, with a person's usual ways."""

    unseen = 0.0
    """Time in which the host did not run, s."""

    @property
    def now(self) -> float:
        return self.firmware.now - self.unseen

    def away(self, seconds: float, kept: int) -> None:
        """The host does not run; the line keeps so many bytes of what the robot says meanwhile."""
        begin, waiting = self.firmware.now, bytearray()
        while self.firmware.now < begin + seconds:
            next(self._program)
            waiting += b"".join(chunk.data for chunk in self.firmware.board.take_sent())
        passed = self.firmware.now - begin
        self.unseen += passed - LATE
        self.machine.away(passed, self.now)
        self.machine.received(bytes(waiting[:kept]), self.now)
        self.machine.listen_anew(self.now)
        self.machine.tick(self.now)

    @property
    def sent(self) -> list[bytes]:
        return [data for way, data in self.log if way is Direction.TO_ROBOT]

    def until_robot(self, *states: RobotState) -> RobotSnapshot:
        return self.until(lambda s: s.robot in states)

    def connect(self) -> None:
        self.open()
        self.until(lambda s: s.link is LinkState.READY)

    def arm(self) -> None:
        self.connect()
        self.machine.arm("Ada")

    def begin(self, plan: RunPlan) -> None:
        self.arm()
        self.machine.send(plan, "Ada", self.now)


def payloads(robot: VirtualRobot) -> list[str]:
    """What the robot took of all messages, in their order."""
    return [m.payload for m in robot.firmware.messages]
