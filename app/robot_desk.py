"""The robot as the studio sees it: the bridge, the emulated robot behind it, and the record of runs."""

from __future__ import annotations

import secrets
import threading
import time
from collections.abc import Callable
from typing import Any

from app.bridge.emulated import EmulatedRobot, start_emulator
from app.bridge.robot import RobotBridge
from app.bridge.run import start_targets
from app.bridge.states import LinkState, RobotSnapshot, RunPlan
from app.open_gait import OpenGait
from app.plans import Plan
from app.robot_view import EMULATOR, RUNNING, RunOrigin, allowed, robot_view, stop_seconds
from app.run_recorder import RunRecorder
from app.store.database import Database
from core.errors import FootfallError, StateError
from core.waypoint_path import estimate_seconds
from core.wire_timing import largest_moves


class RobotDesk:
    """Verbs on the robot, and what is shown of it.

    Args:
        database: where runs are kept.
        device: `emulator`, a serial device, or `socket://HOST:PORT`.
        changed: told with the robot's view whenever it changes.
    """

    def __init__(self, database: Database, device: str, changed: Callable[[dict[str, Any]], None]) -> None:
        self._database = database
        self._device = device
        self._emulator: EmulatedRobot | None = None
        self._connecting = threading.Lock()
        self._origin: RunOrigin | None = None
        self._record: dict[str, Any] | None = None
        self._previous: dict[str, Any] | None = None
        self._recorder = RunRecorder(database)
        self._interrupt_old_runs()
        self.bridge = RobotBridge(self._recorder.log)
        self._changed = changed
        self.bridge.subscribe(self._heard)

    def _interrupt_old_runs(self) -> None:
        for content in reversed(self._database.runs()):
            if content["state"] == "running":
                sentence = "The studio ended while this run was on; nothing resumes by itself."
                content |= {"state": "interrupted", "sentence": sentence}
                self._database.put_run(content)
            self._previous = content

    def close(self) -> None:
        """Stops a run, closes the line and ends the emulated robot."""
        self.bridge.close()
        self._close_emulator()
        self._recorder.close()

    def connect(self, device: str | None) -> None:
        """Opens the line to the studio's robot, or to another device."""
        wanted = device or self._device
        with self._connecting:
            if self.bridge.snapshot.link in (LinkState.CONNECTING, LinkState.READY):
                raise StateError("The robot is connected already. Disconnect it first.", "connect")
            self._close_emulator()
            if wanted == EMULATOR:
                self._emulator = start_emulator()
                self.bridge.connect(self._emulator.device)
            else:
                self.bridge.connect(wanted)
            self._device = wanted

    def disconnect(self) -> None:
        """Stops a run and closes the line; may take as long as the move that is on."""
        with self._connecting:
            self.bridge.disconnect()
            self._close_emulator()

    def _close_emulator(self) -> None:
        if self._emulator is not None:
            self._emulator.close()
            self._emulator = None

    def send(self, open_gait: OpenGait, plan: Plan, waypoints_hash: str | None, by: str) -> None:
        """Sends a gait's approved waypoints.

        Raises:
            StateError: there is no approval of exactly these waypoints, or the robot is not armed.
        """
        approval, waypoints = open_gait.approval, plan.waypoints
        if approval is None or waypoints is None or plan.trajectory is None:
            raise StateError(
                f"“{open_gait.gait.name}” is not approved as it is now. Check it and approve it first.",
                "approve",
            )
        if waypoints_hash is not None and waypoints_hash != waypoints.content_hash:
            raise StateError(
                "The gait changed since you looked at it; look at the run again.", "waypoints_hash"
            )
        if not plan.model.wired:
            raise StateError(f"{plan.model.title} exists on paper only; it has no cable.", "robot")
        hold_ok = tuple(bool(row.all()) for row in plan.trajectory.contact)
        run_id = secrets.token_hex(6)
        self._origin = RunOrigin(run_id, open_gait.id, open_gait.gait.name, waypoints)
        record = {
            "id": run_id,
            "gait": open_gait.id,
            "gait_name": open_gait.gait.name,
            "waypoints_hash": waypoints.content_hash,
            "by": by,
            "started": time.time(),
            "started_monotonic": time.monotonic(),
            "ended": None,
            "state": "running",
            "sentence": "",
        }
        # The record begins before the first byte goes out.
        self._recorder.begin(record)
        self._record = record
        try:
            self.bridge.send(RunPlan(waypoints, approval, hold_ok), by, run_id)
        except FootfallError as refusal:
            self._record = None
            self._recorder.end(
                {**record, "ended": time.time(), "state": "refused", "sentence": refusal.sentence}
            )
            raise

    def _heard(self, snapshot: RobotSnapshot) -> None:
        self._changed(self.view(snapshot))
        record, run = self._record, snapshot.run
        ended = snapshot.robot not in RUNNING or snapshot.link is LinkState.LOST
        if record is not None and run is not None and run.run_id == record["id"] and ended:
            self._record = None
            state = "lost" if snapshot.link is LinkState.LOST else snapshot.robot.value
            reached = {"reached": run.reached, "count": run.count, "seconds": run.elapsed}
            self._recorder.end(
                {**record, **reached, "ended": time.time(), "state": state, "sentence": snapshot.sentence}
            )

    def run_summary(self, open_gait: OpenGait, plan: Plan) -> dict[str, Any]:
        """What a person should know before they press Send."""
        if plan.waypoints is None:
            sentence = "This gait has no waypoints." if plan.refusal is None else plan.refusal.sentence
            raise StateError(sentence, "plan")
        snapshot = self.bridge.snapshot
        first_mm = tuple(float(h) for h in plan.waypoints.strokes_mm[0])
        distance_mm, moves = None, None
        if snapshot.strokes is not None:
            here_mm = tuple(h * 1000.0 for h in snapshot.strokes)
            distance_mm = max(abs(a - b) for a, b in zip(first_mm, here_mm, strict=False))
            moves = len(start_targets(here_mm, first_mm)) if len(here_mm) == len(first_mm) else None
        reason = self._send_hindrance(open_gait, snapshot)
        return {
            "waypoints": plan.waypoints.count,
            "waypoints_hash": plan.waypoints.content_hash,
            "start_distance_mm": distance_mm,
            "start_moves": moves,
            "estimated_seconds": estimate_seconds(plan.waypoints),
            "largest_move_mm": float(largest_moves(plan.waypoints).max(initial=0.0)) * 1000.0,
            "stop_seconds": stop_seconds(plan.waypoints, snapshot),
            "robot_ready": reason is None,
            "reason": reason,
        }

    def _send_hindrance(self, open_gait: OpenGait, snapshot: RobotSnapshot) -> str | None:
        if open_gait.approval is None:
            return "This gait is not approved as it is now. Check it and approve it first."
        return allowed(snapshot)["send"]

    def view(self, snapshot: RobotSnapshot | None = None) -> dict[str, Any]:
        """The robot as JSON content."""
        return {
            **robot_view(snapshot or self.bridge.snapshot, self._device, self._origin),
            "previous_run": self._previous,
        }
