"""The robot as the studio sees it: the bridge, the emulated robot behind it, and the record of runs."""

from __future__ import annotations

import secrets
import threading
import time
from collections.abc import Callable
from typing import Any

from app.bridge.course import WHOLE, Course
from app.bridge.emulated import EmulatedRobot, start_emulator
from app.bridge.faults import Fault
from app.bridge.robot import RobotBridge
from app.bridge.states import LinkState, RobotSnapshot, RunPlan
from app.open_gait import OpenGait
from app.plans import Plan
from app.robot_lease import LeaseDesk, TellPage
from app.robot_ports import RobotPorts
from app.robot_view import EMULATOR, RUNNING, RunOrigin, allowed, robot_view, run_end
from app.run_recorder import RunRecorder
from app.run_summary import run_summary, unwired
from app.runs.plan_content import run_plan_content
from app.store.database import Database
from core.errors import FootfallError, StateError

MOST_SHOWN = 200
"""Changes of state that a page shows."""


class RobotDesk:
    """Verbs on the robot, and what is shown of it.

    Args:
        database: where runs are kept.
        device: `emulator`, a serial device, or `socket://HOST:PORT`.
        changed: told with the robot's view whenever it changes.
        ports: which devices there are.
        tell_page: sends an event to one page.

    Attributes:
        lease: who holds the robot.
        ports: which devices there are.
    """

    def __init__(
        self,
        database: Database,
        device: str,
        changed: Callable[[dict[str, Any]], None],
        ports: RobotPorts,
        tell_page: TellPage = lambda page, event: None,
    ) -> None:
        self._database = database
        self._device = device
        self._emulator: EmulatedRobot | None = None
        self._connecting = threading.Lock()
        self._sending = threading.Lock()
        self._recording = threading.Lock()
        self._origin: RunOrigin | None = None
        self._record: dict[str, Any] | None = None
        self._previous: dict[str, Any] | None = None
        self._recorder = RunRecorder(database)
        self._interrupt_old_runs()
        self.bridge = RobotBridge(self._recorder.log)
        self._changed = changed
        self.ports = ports
        self.lease = LeaseDesk(self.bridge, self._show, tell_page)
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
        self.lease.close()
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
                self.ports.connected(wanted)
            self._device = wanted

    def ports_view(self) -> dict[str, Any]:
        """Serial devices, the one that was used last, and where a lost one is plugged in now."""
        is_lost = self.bridge.snapshot.link is LinkState.LOST and self._device != EMULATOR
        return self.ports.view(is_lost=is_lost)

    def transitions(self) -> list[dict[str, Any]]:
        """The last changes of link and robot with their causes, oldest first; `at` is seconds since 1970."""
        offset = time.time() - time.monotonic()
        return [
            {"at": one.time + offset, "link": one.link.value, "robot": one.robot.value, "cause": one.cause}
            for one in self.bridge.transitions[-MOST_SHOWN:]
        ]

    def disconnect(self) -> None:
        """Stops a run and closes the line; may take as long as the move that is on."""
        with self._connecting:
            self.bridge.disconnect()
            self._close_emulator()
        self.lease.drop()

    def strike(self, fault: Fault | None) -> None:
        """Has something go wrong with the emulated robot, or ends all that lasts.

        Raises:
            StateError: another robot is connected, or none.
        """
        if self._emulator is None:
            raise StateError("Only the emulated robot has faults on request. Connect it first.", "name")
        if fault is None:
            self._emulator.mend()
        else:
            self._emulator.inject(fault)

    def _close_emulator(self) -> None:
        if self._emulator is not None:
            self._emulator.close()
            self._emulator = None

    def send(
        self,
        open_gait: OpenGait,
        plan: Plan,
        waypoints_hash: str | None,
        by: str,
        course: Course = WHOLE,
    ) -> None:
        """Sends a gait's approved waypoints.

        Raises:
            StateError: there is no approval of exactly these waypoints, or the robot is not armed.
            InputError: the run cannot begin at that waypoint, or the gait cannot be repeated.
        """
        approval, way = open_gait.approval, plan.way
        if approval is None or way is None:
            raise StateError(
                f"“{open_gait.gait.name}” is not approved as it is now. Check it and approve it first.",
                "approve",
            )
        waypoints = way.waypoints
        if waypoints_hash is not None and waypoints_hash != waypoints.content_hash:
            raise StateError(
                "The gait changed since you looked at it; look at the run again.", "waypoints_hash"
            )
        if (reason := unwired(plan)) is not None:
            raise StateError(reason, "robot")
        run_plan = RunPlan(waypoints, approval, way.hold_ok, course)
        content = run_plan_content(plan, way, approval)
        origin = RunOrigin(secrets.token_hex(6), open_gait.id, open_gait.gait.name, waypoints, way.times)
        with self._sending:
            snapshot = self.bridge.snapshot
            self._end_record(snapshot)
            if self._record is not None and snapshot.robot in RUNNING:
                raise StateError("A run is on. Let it end, or stop it, then send again.", "send")
            self._begin(run_plan, origin, content, by)

    def _begin(self, run_plan: RunPlan, origin: RunOrigin, content: dict[str, Any], by: str) -> None:
        """Sends a run whose record begins before the first byte goes out."""
        course, before = run_plan.course, self._origin
        record = {
            "id": origin.run_id,
            "gait": origin.gait,
            "gait_name": origin.gait_name,
            "waypoints_hash": origin.waypoints.content_hash,
            "by": by,
            "from": course.first,
            "iterations": course.iterations,
            "started": time.time(),
            "started_monotonic": time.monotonic(),
            "ended": None,
            "state": "running",
            "sentence": "",
        }
        self._recorder.begin(record, content)
        self._record, self._origin = record, origin
        try:
            self.bridge.send(run_plan, by, origin.run_id)
        except FootfallError as refusal:
            self._record, self._origin = None, before
            self._recorder.end(
                {**record, "ended": time.time(), "state": "refused", "sentence": refusal.sentence}
            )
            raise

    def _heard(self, snapshot: RobotSnapshot) -> None:
        self._changed(self.view(snapshot))
        if self._record is not None:
            self._recorder.note(self.bridge.transitions)
        self._end_record(snapshot)

    def _end_record(self, snapshot: RobotSnapshot) -> None:
        """Completes the record of the run if it has ended."""
        run = snapshot.run
        if run is None or (snapshot.robot in RUNNING and snapshot.link is not LinkState.LOST):
            return
        with self._recording:
            record = self._record
            if record is None or run.run_id != record["id"]:
                return
            self._record = None
            reached = {"reached": run.reached, "count": run.count, "seconds": run.elapsed}
            state = {"state": run_end(snapshot, run), "sentence": snapshot.sentence}
            self._recorder.end({**record, **reached, **state, "ended": time.time()})

    def run_summary(self, open_gait: OpenGait, plan: Plan, course: Course = WHOLE) -> dict[str, Any]:
        """What a person should know before they press Send; see `app.run_summary`."""
        snapshot = self.bridge.snapshot
        reason = unwired(plan) or self._send_hindrance(open_gait, snapshot)
        return run_summary(plan, course, snapshot, reason)

    def _send_hindrance(self, open_gait: OpenGait, snapshot: RobotSnapshot) -> str | None:
        if open_gait.approval is None:
            return "This gait is not approved as it is now. Check it and approve it first."
        return allowed(snapshot)["send"]

    def view(self, snapshot: RobotSnapshot | None = None) -> dict[str, Any]:
        """The robot as JSON content."""
        return {
            **robot_view(snapshot or self.bridge.snapshot, self._device, self._origin),
            "previous_run": self._previous,
            "lease": self.lease.view(),
        }

    def _show(self) -> None:
        self._changed(self.view())
