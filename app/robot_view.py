"""What is shown of the robot: JSON content from the bridge's snapshot."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from app.bridge.run import START_MOVE_MM
from app.bridge.states import LinkState, RobotSnapshot, RobotState, RunProgress
from core.waypoints import Waypoints
from core.wire_timing import LONGEST_SCAN, stop_delay

EMULATOR = "emulator"
"""Name of the studio's own emulated robot among devices."""

RUNNING = frozenset({RobotState.MOVING, RobotState.PAUSING, RobotState.PAUSED, RobotState.STOPPING})
"""States in which a run has not ended."""


@dataclass(frozen=True)
class RunOrigin:
    """Which gait a run came from."""

    run_id: str
    gait: str
    gait_name: str
    waypoints: Waypoints


def robot_view(shown: RobotSnapshot, device: str, origin: RunOrigin | None) -> dict[str, Any]:
    """The robot for pages and scripts.

    Args:
        shown: the bridge's snapshot.
        device: what the studio calls the robot.
        origin: where the last run that this studio sent came from.
    """
    run = shown.run
    known = origin if run is not None and origin is not None and origin.run_id == run.run_id else None
    strokes_mm = None if shown.strokes is None else np.round(np.multiply(shown.strokes, 1e3), 3).tolist()
    return {
        "link": shown.link.value,
        "robot": shown.robot.value,
        "sentence": shown.sentence,
        "device": device,
        "emulated": device == EMULATOR,
        "strokes_mm": strokes_mm,
        "stop_text": None if shown.robot is RobotState.STOPPING else shown.stop_text,
        "unknown_lines": shown.unknown_lines,
        "last_error": shown.last_error,
        "run": None if run is None else _run_view(shown, run, known),
        "commanded_mm": None if run is None or known is None else _commanded_mm(run, known),
        "stop_seconds": None if origin is None else stop_seconds(origin.waypoints, shown),
        "allowed": allowed(shown),
    }


def stop_seconds(waypoints: Waypoints, snapshot: RobotSnapshot) -> float:
    """Longest time until a stop takes effect in a run of these waypoints, its start pose included, s."""
    scan = snapshot.measured_scan or LONGEST_SCAN
    return stop_delay(waypoints, scan, start_move=START_MOVE_MM / 1000.0)


def _run_view(shown: RobotSnapshot, run: RunProgress, known: RunOrigin | None) -> dict[str, Any]:
    """The run that is on or was the last; where its gait is known, also where in the plan it is."""
    content: dict[str, Any] = {
        "id": run.run_id,
        "phase": run.phase.value if shown.robot in RUNNING else "ended",
        "sent": run.sent,
        "reached": run.reached,
        "count": run.count,
        "elapsed": run.elapsed,
        "operator": run.by,
        "gait": None,
        "gait_name": None,
        "waypoints_hash": None,
        "plan_time": None,
    }
    if known is not None:
        clock = np.cumsum(known.waypoints.durations) - known.waypoints.durations[0]
        content |= {
            "gait": known.gait,
            "gait_name": known.gait_name,
            "waypoints_hash": known.waypoints.content_hash,
            "plan_time": float(clock[max(0, run.reached - 1)]),
        }
    return content


def _commanded_mm(run: RunProgress, known: RunOrigin) -> list[float]:
    row: list[float] = known.waypoints.strokes_mm[max(0, run.sent - 1)].tolist()
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
        "pause": only({RobotState.MOVING}, "Nothing is moving."),
        "resume": only({RobotState.PAUSED}, "No run is paused."),
        "clear": only({RobotState.STOPPED, RobotState.FAULT, RobotState.STOPPING}, "Nothing is stopped."),
        "reset": only({RobotState.ARMED}, "Arm the robot first."),
    }


def _why_not_disconnect(link: LinkState, robot: RobotState) -> str | None:
    if link is LinkState.DISCONNECTED:
        return "No robot is connected."
    return "Stop the run first." if link is LinkState.READY and robot in RUNNING else None


def _why_not_arm(robot: RobotState) -> str:
    if robot is RobotState.ARMED:
        return "The robot is armed."
    if robot in (RobotState.STOPPED, RobotState.FAULT):
        return "Clear the stop first."
    return "Wait until the robot stands still."
