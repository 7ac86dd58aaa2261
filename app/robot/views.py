"""What is shown of the robot: JSON content from the bridge's snapshot."""

from dataclasses import asdict, dataclass
from functools import cached_property

import numpy as np

from app.bridge.states import LinkState, MotorTestState, RobotSnapshot, RobotState, RunProgress
from app.bridge.stop_confirmation import STOP_LIMIT
from app.common.json import Json
from app.emulator.motors import TRAVEL_MM
from core.arrays import Floats
from core.runs.pose import RanPlan
from core.wire import robot_time
from core.wire.messages import RESET_MM
from core.wire.waypoints import Waypoints

EMULATOR = "emulator"
"""Name of the studio's own emulated robot among devices."""

RESET_DISTANCE = (TRAVEL_MM - RESET_MM) / 1000.0
"""A reset's longest move: from the motors' far stop (docs/firmware.md, Times), m."""

RUNNING = frozenset({RobotState.MOVING, RobotState.PAUSING, RobotState.PAUSED, RobotState.STOPPING})
"""States in which a run has not ended."""


@dataclass(frozen=True)
class RunOrigin:
    """Which gait a run came from."""

    run_id: str
    gait: str
    gait_name: str
    waypoints: Waypoints
    times: Floats
    """(count,) the plan's time of each waypoint, s."""
    plan: RanPlan | None = None
    """The motion that the waypoints were made from; None where it is not known."""

    @cached_property
    def estimates(self) -> Floats:
        """(count,) expected seconds of each waypoint on the robot."""
        return robot_time.move_estimates(self.waypoints)


LEAVING = f"Disconnecting: the line is closed when the robot stands still, or after {STOP_LIMIT:.0f} s."


def robot_view(
    shown: RobotSnapshot, device: str, origin: RunOrigin | None, *, is_leaving: bool = False
) -> Json:
    """The robot for pages and scripts.

    Args:
        shown: the bridge's snapshot.
        device: what the studio calls the robot.
        origin: where the last run that this studio sent came from.
        is_leaving: somebody disconnects, and the line is not closed yet.
    """
    run = shown.run
    known = origin if run is not None and origin is not None and origin.run_id == run.run_id else None
    strokes_mm = None if shown.strokes is None else np.round(np.multiply(shown.strokes, 1e3), 3).tolist()
    return {
        "stamp": shown.number,  # orders answers and events, which may overtake each other
        "link": shown.link.value,
        "robot": shown.robot.value,
        "sentence": f"{LEAVING} {shown.sentence}" if is_leaving else shown.sentence,
        "disconnecting": is_leaving,
        "device": device,
        "emulated": device == EMULATOR,
        "strokes_mm": strokes_mm,
        "stop_text": None if shown.robot is RobotState.STOPPING else shown.stop_text,
        "unknown_lines": shown.unknown_lines,
        "last_error": shown.last_error,
        "run": None if run is None else _run_view(shown, run, known),
        "jog": None if shown.jog is None else asdict(shown.jog),
        "commanded_mm": None if run is None or known is None else _commanded_mm(run, known),
        "stop_seconds": _stop_seconds(shown, origin),
        "allowed": allowed(shown) | ({"disconnect": LEAVING} if is_leaving else {}),
    }


def stop_seconds(waypoints: Waypoints, snapshot: RobotSnapshot, approved: Waypoints | None = None) -> float:
    """Longest time until a stop takes effect, s, by the measured scan where there is one (`stop_time`)."""
    return robot_time.stop_time(waypoints, _scan(snapshot), approved)


def jog_stop_seconds(largest_move: float, snapshot: RobotSnapshot) -> float:
    """The same of a jog.

    Args:
        largest_move: largest distance of a motor in one of its moves, m.
        snapshot: of the robot.
    """
    return robot_time.stop_seconds(largest_move, _scan(snapshot))


def _scan(snapshot: RobotSnapshot) -> float:
    """The robot's error scan, s: measured, or the longest that was seen."""
    return snapshot.measured_scan or robot_time.LONGEST_SCAN


def _stop_seconds(shown: RobotSnapshot, origin: RunOrigin | None) -> float | None:
    """The same of what is on or was the last; a reset is one move, which nothing cuts."""
    if shown.jog is not None:
        return jog_stop_seconds(shown.jog.largest_move, shown)
    if shown.motor_test is not None and shown.motor_test.state is MotorTestState.RUNNING:
        return jog_stop_seconds(shown.motor_test.largest_move, shown)
    if shown.run is None and shown.robot in RUNNING:
        return robot_time.stop_seconds(RESET_DISTANCE, _scan(shown), off=0.0)
    return None if origin is None else stop_seconds(origin.waypoints, shown)


def run_end(shown: RobotSnapshot, run: RunProgress) -> str:
    """How a run ended, also where the robot was armed or cleared again since."""
    if shown.link is LinkState.LOST:
        return "lost"
    if shown.robot in (RobotState.ARMED, RobotState.DISARMED):
        return (RobotState.DONE if run.reached == run.count else RobotState.STOPPED).value
    return shown.robot.value


def _run_view(shown: RobotSnapshot, run: RunProgress, known: RunOrigin | None) -> Json:
    """The run that is on or was the last; where its gait is known, also where in the plan it is."""
    content: Json = {
        "id": run.run_id,
        "phase": run.phase.value if shown.robot in RUNNING else "ended",
        "end": None if shown.robot in RUNNING else run_end(shown, run),
        "sent": run.sent,
        "reached": run.reached,
        "count": run.count,
        "elapsed": run.elapsed,
        "iteration": run.iteration,
        "iterations": run.iterations,
        "operator": run.by,
        "gait": None,
        "gait_name": None,
        "waypoints_hash": None,
        "plan_time": None,
        "seconds_left": None,
    }
    if known is not None:
        content |= {
            "gait": known.gait,
            "gait_name": known.gait_name,
            "waypoints_hash": known.waypoints.content_hash,
            "plan_time": float(known.times[run.waypoint_reached]),
            "seconds_left": round(_seconds_left(run, known), 2),
        }
    return content


def _seconds_left(run: RunProgress, known: RunOrigin) -> float:
    """Expected time from the last waypoint reached to the end of all iterations, s."""
    # The iteration is that of the last waypoint sent, which may be the first of the next one.
    ahead = run.iterations - run.iteration + (run.waypoint_reached > run.waypoint_sent)
    rest = known.estimates[run.waypoint_reached + 1 :].sum()
    return float(rest + ahead * known.estimates.sum())


def _commanded_mm(run: RunProgress, known: RunOrigin) -> list[float]:
    row: list[float] = known.waypoints.strokes_mm[run.waypoint_sent].tolist()
    return row


def allowed(snapshot: RobotSnapshot) -> dict[str, str | None]:
    """Why each button is disabled; None where it may be pressed."""
    link, robot = snapshot.link, snapshot.robot
    is_ready = link is LinkState.READY
    linked = None if is_ready else "Connect the robot first."

    def only(states: set[RobotState], otherwise: str) -> str | None:
        return linked or (None if robot in states else otherwise)

    connected = link in (LinkState.CONNECTING, LinkState.READY)
    return {
        "connect": "The robot is connected." if connected else None,
        "disconnect": _why_not_disconnect(link, robot),
        "arm": only({RobotState.DISARMED, RobotState.DONE}, _why_not_arm(robot)),
        "send": only({RobotState.ARMED}, "Arm the robot first."),
        "pause": only({RobotState.MOVING} if snapshot.run else set(), _why_not_pause(robot)),
        "resume": only({RobotState.PAUSED}, "No run is paused."),
        "clear": only({RobotState.STOPPED, RobotState.FAULT, RobotState.STOPPING}, "Nothing is stopped."),
        "reset": only({RobotState.ARMED}, "Arm the robot first."),
        "jog": only({RobotState.ARMED}, _why_not_jog(robot)),
        "motor_test": only({RobotState.ARMED}, _why_not_jog(robot)),
    }


def _why_not_disconnect(link: LinkState, robot: RobotState) -> str | None:
    if link is LinkState.DISCONNECTED:
        return "No robot is connected."
    return "Stop the run first." if link is LinkState.READY and robot in RUNNING else None


def _why_not_pause(robot: RobotState) -> str:
    """Of a robot on which no run moves; a reset or a jog ends by itself."""
    return "Only a run can be paused; Stop ends this." if robot is RobotState.MOVING else "Nothing is moving."


def _why_not_jog(robot: RobotState) -> str:
    if robot is RobotState.PAUSED:
        return "A run is paused: resume it, or stop it and arm the robot again."
    return "It moves." if robot in RUNNING else "Arm the robot first."


def _why_not_arm(robot: RobotState) -> str:
    if robot is RobotState.ARMED:
        return "The robot is armed."
    if robot in (RobotState.STOPPED, RobotState.FAULT):
        return "Clear the stop first."
    return "Wait until the robot stands still."
