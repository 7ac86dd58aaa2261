"""Values of the bridge: states of link, robot and run, snapshots, and the plan of a run."""

from dataclasses import dataclass
from enum import StrEnum

from app.bridge.run_range import WHOLE, RunRange
from core.errors import InputError
from core.findings import Approval
from core.jog.motor_test import TEST_MOVE, MotorFinding
from core.wire.waypoints import Waypoints


class LinkState(StrEnum):
    """State of the connection to the robot."""

    DISCONNECTED = "disconnected"
    CONNECTING = "connecting"
    READY = "ready"
    LOST = "lost"


class RobotState(StrEnum):
    """What the robot is doing, as far as it can be known."""

    UNKNOWN = "unknown"
    DISARMED = "disarmed"
    ARMED = "armed"
    MOVING = "moving"
    PAUSING = "pausing"
    PAUSED = "paused"
    STOPPING = "stopping"
    STOPPED = "stopped"
    DONE = "done"
    FAULT = "fault"


IN_RUN = frozenset({RobotState.MOVING, RobotState.PAUSING, RobotState.PAUSED})
"""States in which a run, a reset, a jog or a motor test is under way."""


class RunPhase(StrEnum):
    """Part of a run: on the way to the first waypoint, or through the approved ones."""

    START_POSE = "start pose"
    STREAMING = "streaming"


class Direction(StrEnum):
    """Which way bytes went."""

    TO_ROBOT = "to robot"
    FROM_ROBOT = "from robot"


@dataclass(frozen=True)
class RunPlan:
    """Approved waypoints for one run.

    Args:
        waypoints: strokes to reach one after the other.
        approval: must be of exactly these waypoints.
        hold_ok: for each waypoint whether all feet are down there, so that a pause may end at it.
        run_range: from which waypoint on they are sent, and how many times over.
    """

    waypoints: Waypoints
    approval: Approval
    hold_ok: tuple[bool, ...]
    run_range: RunRange = WHOLE

    def __post_init__(self) -> None:
        if len(self.hold_ok) != self.waypoints.count:
            raise InputError(
                f"{len(self.hold_ok)} hold marks for {self.waypoints.count} waypoints; give one for each.",
                "hold_ok",
            )
        self.run_range.require_fit(self.waypoints, self.hold_ok)


@dataclass(frozen=True)
class RunProgress:
    """How far a run has come.

    Args:
        run_id: given by whoever sent it, or made when the run began.
        by: who sent it.
        phase: start pose or streaming.
        sent: number of approved waypoints sent so far.
        reached: number of approved waypoints that were confirmed as reached.
        count: number of approved waypoints that the run sends, those of all its iterations.
        elapsed: time since the run began, until its end, s.
        waypoint_sent: index among the approved waypoints of the last one sent; before that, of the first.
        waypoint_reached: the same of the last one reached.
        iteration: number of the iteration of the last waypoint sent, from 1.
        iterations: number of iterations.
    """

    run_id: str
    by: str
    phase: RunPhase
    sent: int
    reached: int
    count: int
    elapsed: float
    waypoint_sent: int = 0
    waypoint_reached: int = 0
    iteration: int = 1
    iterations: int = 1


@dataclass(frozen=True)
class JogProgress:
    """How far a jog has come.

    Args:
        text: what is moved, for a person.
        by: who moves it.
        reached: number of its moves that were confirmed as reached.
        count: number of its moves.
        largest_move: largest distance of a motor in one of them, m.
    """

    text: str
    by: str
    reached: int
    count: int
    largest_move: float


class MotorTestState(StrEnum):
    """How far a motor test is."""

    RUNNING = "running"
    DONE = "done"
    CANCELLED = "cancelled"
    STOPPED = "stopped"
    """By Stop, a fault or a lost cable."""


@dataclass(frozen=True)
class MotorTestProgress:
    """How far a motor test has come.

    Args:
        by: who tests.
        state: how far it is.
        motor: 0-based motor under test; None after the end.
        findings: of the motors so far, in their order.
        largest_move: largest distance of a motor in one ramp as it is sent, m.
    """

    by: str
    state: MotorTestState
    motor: int | None
    findings: tuple[MotorFinding, ...]
    largest_move: float = TEST_MOVE


@dataclass(frozen=True)
class RobotSnapshot:
    """Everything there is to show about the robot at one moment.

    Args:
        link: state of the cable.
        robot: state of the robot.
        sentence: what that means and what can be done.
        strokes: (12,) measured strokes in m, or None before the first telemetry.
        run: the run that is under way or was the last.
        stop_text: “stopped at 12.4 s by NAME” as long as the stop stands.
        unknown_lines: lines that fit no kind, since connecting.
        device: what is or was connected.
        last_error: sentence of the last fault or loss.
        measured_scan: longest error scan seen since connecting, s (see `core.wire.robot_time.stop_time`).
        number: counts the snapshots of a bridge, so that who gets two knows the later one.
        jog: the steps by hand that are under way.
        motor_test: the motor test that is under way or was the last.
    """

    link: LinkState
    robot: RobotState
    sentence: str
    strokes: tuple[float, ...] | None
    run: RunProgress | None
    stop_text: str | None
    unknown_lines: int
    device: str | None
    last_error: str | None
    measured_scan: float | None
    number: int
    jog: JogProgress | None = None
    motor_test: MotorTestProgress | None = None


@dataclass(frozen=True)
class Transition:
    """A change of state with its cause.

    Args:
        time: of the bridge's clock, s.
        link: state of the cable from then on.
        robot: state of the robot from then on.
        cause: sentence.
        number: counts the changes of a bridge, from 1.
    """

    time: float
    link: LinkState
    robot: RobotState
    cause: str
    number: int
