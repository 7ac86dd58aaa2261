"""The robot as the studio sees it: the bridge, the emulated robot behind it, and the record of runs."""

import secrets
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor, wait
from contextlib import ExitStack, contextmanager

from app.bridge.run_range import WHOLE, RunRange
from app.bridge.states import LinkState, RobotSnapshot, RunPlan
from app.bridge.stop_confirmation import STOP_LIMIT
from app.common.json import Json
from app.emulator.emulated_robot import EmulatedRobot, start_emulator
from app.emulator.faults import FaultRequest
from app.gaits.open_gait import OpenGait
from app.plans.plan import Plan
from app.robot.measured import MeasuredRobot, measured_robot
from app.robot.operator_lease import OperatorLease, TellPage
from app.robot.ports import RobotPorts
from app.robot.recorded_bridge import RecordedBridge, RecordedRun
from app.robot.run_summary import run_summary, unwired
from app.robot.transition_times import TransitionTimes
from app.robot.views import EMULATOR, RunOrigin, allowed, robot_view
from app.runs.plan_json import run_plan_content
from app.store.database import Database
from app.undo.history import Author
from core.errors import StateError
from core.runs.pose import RanPlan

MOST_SHOWN = 200
"""Changes of state that a page shows."""

DISCONNECT_SECONDS = 4.0
"""Who disconnects is answered after this long at most, whether or not the line is closed by then, s."""

CONNECT_PATIENCE = 0.5
"""Who connects waits this long for a line that is just being opened or closed, s."""


class RobotService:
    """Actions on the robot, and its view for the pages.

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
        changed: Callable[[Json], None],
        ports: RobotPorts,
        tell_page: TellPage = lambda page, event: None,
    ) -> None:
        self._device = device
        self._emulator: EmulatedRobot | None = None
        self._connecting = threading.Lock()
        self._disconnecting = threading.Lock()
        self._departures = ThreadPoolExecutor(1, "robot departure")
        self._departure: Future[None] | None = None
        self._is_leaving = False
        self._recorded_bridge = RecordedBridge(database, self._show)
        self.bridge = self._recorded_bridge.bridge
        self._changed = changed
        self.ports = ports
        self.lease = OperatorLease(self.bridge, self._show, tell_page)
        self._log_times = TransitionTimes(database.clock)
        self.bridge.subscribe(self._follow)

    def close(self) -> None:
        """Stops a run, closes the line and ends the emulated robot."""
        self.lease.close()
        self._recorded_bridge.close()
        self._departures.shutdown()
        self._close_emulator()

    def connect(self, device: str | None) -> None:
        """Opens the line to the studio's robot, or to another device.

        Raises:
            InputError: the device is the address of something else.
            StateError: a robot is connected, or a line is just being opened or closed.
            RobotError: the device is absent or busy.
        """
        wanted = device or self._device
        with self._line_changes():
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

    def ports_view(self) -> Json:
        """Serial devices, the one that was used last, and where a lost one is plugged in now."""
        is_lost = self.bridge.snapshot.link is LinkState.LOST and self._device != EMULATOR
        return self.ports.view(is_lost=is_lost)

    def transitions(self) -> list[Json]:
        """The last changes of link and robot with their causes, oldest first; `at` is seconds since 1970."""
        changes = self.bridge.transitions
        return [
            {"at": at, "link": one.link.value, "robot": one.robot.value, "cause": one.cause}
            for one, at in list(zip(changes, self._log_times.of(changes), strict=True))[-MOST_SHOWN:]
        ]

    def disconnect(self, author: Author) -> bool:
        """Stops a run and closes the line; nobody holds the robot then.

        The line is closed when the robot has confirmed the stop, or has not for `STOP_LIMIT`. What lasts
        longer than `DISCONNECT_SECONDS` goes on by itself; who asks meanwhile waits for the same.

        Args:
            author: who does it.

        Returns:
            Whether the line is closed.

        Raises:
            StateError: somebody else holds the robot.
        """
        with self._disconnecting:
            if self._departure is None or self._departure.done():
                held = ExitStack()
                held.enter_context(self.lease.held_by(author, ends=True))
                self._is_leaving = True
                self._departure = self._departures.submit(self._leave, held)
            departure = self._departure
        is_closed = bool(wait([departure], DISCONNECT_SECONDS).done)
        if is_closed:
            departure.result()
        return is_closed

    def _leave(self, held: ExitStack) -> None:
        with held:
            try:
                with self._connecting:
                    self.bridge.disconnect()
                    self._close_emulator()
            finally:
                self._is_leaving = False

    @contextmanager
    def _line_changes(self) -> Iterator[None]:
        """While a line is opened, nobody else opens or closes one."""
        if not self._connecting.acquire(timeout=CONNECT_PATIENCE):
            raise StateError(
                "The robot’s line is just being opened or closed, which takes "
                f"{STOP_LIMIT:.0f} s at most. Wait for that, then connect again.",
                "connect",
            )
        try:
            yield
        finally:
            self._connecting.release()

    def strike(self, fault: FaultRequest | None) -> None:
        """Injects a fault into the emulated robot, or ends all lasting faults.

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
        emulator, self._emulator = self._emulator, None
        if emulator is not None:
            emulator.close()

    def send(
        self,
        open_gait: OpenGait,
        plan: Plan,
        waypoints_hash: str | None,
        by: str,
        run_range: RunRange = WHOLE,
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
        run_plan = RunPlan(waypoints, approval, way.hold_ok, run_range)
        content = run_plan_content(plan, way, approval)
        ran = None if plan.trajectory is None else RanPlan(plan.model, waypoints, way.times, plan.trajectory)
        origin = RunOrigin(secrets.token_hex(6), open_gait.id, open_gait.gait.name, waypoints, way.times, ran)
        self._recorded_bridge.send(run_plan, RecordedRun(origin, content), by)

    def measured(self) -> MeasuredRobot:
        """The robot by its last measured strokes, where its run is on the plan; see `app.robot.measured`."""
        return measured_robot(self.bridge.snapshot, self._recorded_bridge.origin)

    def run_summary(self, open_gait: OpenGait, plan: Plan, run_range: RunRange = WHOLE) -> Json:
        """What a person should know before they press Send; see `app.robot.run_summary`."""
        snapshot = self.bridge.snapshot
        reason = unwired(plan) or self._send_hindrance(open_gait, snapshot)
        return run_summary(plan, run_range, snapshot, reason)

    def _send_hindrance(self, open_gait: OpenGait, snapshot: RobotSnapshot) -> str | None:
        if open_gait.approval is None:
            return "This gait is not approved as it is now. Check it and approve it first."
        return allowed(snapshot)["send"]

    def view(self, snapshot: RobotSnapshot | None = None) -> Json:
        """The robot as JSON content."""
        shown = snapshot or self.bridge.snapshot
        is_leaving = self._is_leaving and shown.link is not LinkState.DISCONNECTED
        return {
            **robot_view(shown, self._device, self._recorded_bridge.origin, is_leaving=is_leaving),
            "previous_run": self._recorded_bridge.previous,
            "record_trouble": self._recorded_bridge.trouble,
            "lease": self.lease.view(),
        }

    def _follow(self, snapshot: RobotSnapshot) -> None:
        self._log_times.of(self.bridge.transitions)
        self._changed(self.view(snapshot))

    def _show(self) -> None:
        self._changed(self.view())
