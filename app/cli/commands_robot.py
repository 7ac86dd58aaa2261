"""`serve`, `send` and `emulate`."""

from __future__ import annotations

import getpass
import signal
import sys
import threading
import time
from argparse import Namespace
from datetime import UTC, datetime
from pathlib import Path
from types import FrameType
from typing import Any

from app.bridge.delivery import HELD_STOP
from app.bridge.emulated import EmulatedRobot, start_emulator
from app.bridge.robot import RobotBridge
from app.bridge.states import LinkState, RobotSnapshot, RobotState, RunPlan
from app.cli.report import Interrupted, end_on_sigterm, note, show, verdict_lines
from app.robot_view import EMULATOR
from app.store.files import default_data_folder
from app.trajectory_files import read_waypoints
from app.views import verdict_view
from core.checks import check_waypoints
from core.errors import CheckError, InputError, RobotError, StateError
from core.findings import Approval, Severity, Verdict, approve
from core.robot import load_robot
from core.waypoints import Waypoints

READY_SECONDS = 20.0
"""The board needs about 8 s; later than this nothing will come."""
CLEAR_SECONDS = 10.0
"""A stop is confirmed or overdue by then."""
LOOK_SECONDS = 0.2
"""How often an emulated robot is looked at for fault states."""
ROBOT_FAILED = 5
NOT_FIT = 4
_ENDS = frozenset({RobotState.DONE, RobotState.STOPPED, RobotState.FAULT})


def run_serve(options: Namespace) -> int:
    """Serves the studio until a signal ends it."""
    # The web server and the 3D scene take a second to load; the other commands do without them.
    from app.serve import ServeOptions, serve

    token: str | None = options.token
    if token is not None and len(token) < 12:
        raise InputError("The token must have at least 12 characters.", "--token")
    _require_device(options.robot)
    serve(
        ServeOptions(
            host=options.host,
            port=options.port,
            device=options.robot,
            data=(options.data or default_data_folder()).expanduser(),
            token=token,
            opens_browser=not options.no_browser,
        ),
        _announce,
    )
    return 0


def _require_device(device: str) -> None:
    if device.startswith("/") and not Path(device).exists():
        raise RobotError(
            f"There is no serial device {device}. Plug the robot in and look for its name, or leave --robot "
            "out for the emulated robot.",
            "--robot",
        )


def _announce(url: str) -> None:
    sys.stdout.write(f"Footfall Studio is ready at {url}\n")
    sys.stdout.flush()


def run_emulate(options: Namespace) -> int:
    """Runs an emulated robot until a signal ends it."""
    ended = threading.Event()

    def end(number: int, frame: FrameType | None) -> None:
        del number, frame
        ended.set()

    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, end)
    robot = start_emulator(options.profile, options.speed, tcp=options.tcp, faults=options.fault)
    try:
        show(options, {"device": robot.device}, [robot.device])
        sys.stdout.flush()
        told: str | None = None
        while not ended.wait(LOOK_SECONDS):
            wrong = robot.firmware.fault or robot.firmware.spoilt
            if wrong is not None and wrong != told:
                note(f"The emulated robot is in a fault state. {wrong}")
            told = wrong
    finally:
        robot.close()
    return 0


def run_send(options: Namespace) -> int:
    """Checks, approves and streams a waypoint file; Ctrl-C is Stop."""
    end_on_sigterm()
    waypoints = read_waypoints(options.file)
    verdict = check_waypoints(load_robot("deltawalker"), waypoints)
    if not verdict.passed:
        return _refuse(options, verdict)
    approval = _approval(verdict, options)
    emulator = start_emulator() if options.robot == EMULATOR else None
    bridge = RobotBridge()
    try:
        watch = _Watch(bridge)
        bridge.connect(options.robot if emulator is None else emulator.device)
        plan = RunPlan(waypoints, approval, (True,) * waypoints.count)
        ended = _run(bridge, watch, plan)
        if ended.robot is RobotState.FAULT and HELD_STOP in ended.sentence:
            note("The robot held a stop from before. It is cleared, and the run begins again.")
            watch.clear(approval.by)
            ended = _run(bridge, watch, plan)
        return _report(options, ended, waypoints)
    except (KeyboardInterrupt, Interrupted):
        bridge.stop(approval.by)
        note("Stop was sent; it takes effect after the move that is running.")
        raise
    finally:
        bridge.close()
        _close(emulator)


def _run(bridge: RobotBridge, watch: _Watch, plan: RunPlan) -> RobotSnapshot:
    watch.wait_ready()
    bridge.arm(plan.approval.by)
    bridge.send(plan, plan.approval.by)
    return watch.wait_end()


def _close(emulator: EmulatedRobot | None) -> None:
    if emulator is not None:
        emulator.close()


def _refuse(options: Namespace, verdict: Verdict) -> int:
    """Out of range is bad input; everything else is not fit."""
    errors = [f for f in verdict.findings if f.severity is Severity.ERROR]
    out_of_range = [f for f in errors if f.rule == "stroke"]
    if out_of_range:
        raise InputError(out_of_range[0].sentence, f"{options.file}:{(out_of_range[0].sample or 0) + 2}")
    show(
        options,
        {"error": errors[0].sentence, "where": str(options.file), **verdict_view(verdict)},
        verdict_lines(verdict),
    )
    return NOT_FIT


def _approval(verdict: Verdict, options: Namespace) -> Approval:
    """Asks for the user's word, and gives it in their name.

    Raises:
        CheckError: they did not give it.
    """
    name = getpass.getuser()
    note("\n".join(verdict_lines(verdict)))
    if not options.yes:
        note(
            f"{options.file}: the robot will move, slowly to the start pose first. Stop is Ctrl-C, in effect "
            f"after the move that is running. Approve as {name} and send? [y/N]"
        )
        if sys.stdin.readline().strip().lower() not in ("y", "yes"):
            raise CheckError("Not approved; nothing was sent.", str(options.file))
    return approve(verdict, name, datetime.now(UTC))


class _Watch:
    """Waits for states of the bridge."""

    def __init__(self, bridge: RobotBridge) -> None:
        self._bridge = bridge
        self._changed = threading.Event()
        bridge.subscribe(lambda snapshot: self._changed.set())

    def wait_ready(self) -> None:
        """Waits until the robot answers.

        Raises:
            RobotError: it does not.
        """
        deadline = threading.Event()
        timer = threading.Timer(READY_SECONDS, deadline.set)
        timer.start()
        try:
            while self._bridge.snapshot.robot is not RobotState.DISARMED:
                if deadline.is_set() or self._bridge.snapshot.link is LinkState.LOST:
                    raise RobotError(
                        f"No robot answered within {READY_SECONDS:.0f} s: {self._bridge.snapshot.sentence}",
                        "--robot",
                    )
                self._step()
        finally:
            timer.cancel()

    def clear(self, by: str) -> None:
        """Clears a stop as soon as the robot has confirmed it and stands still.

        Raises:
            StateError: it does not within its time.
        """
        deadline = time.monotonic() + CLEAR_SECONDS
        while True:
            try:
                self._bridge.clear(by)
                return
            except StateError:
                if time.monotonic() > deadline:
                    raise
            self._step()

    def wait_end(self) -> RobotSnapshot:
        """Waits until the run has ended, saying how far it is."""
        told = -1
        while True:
            snapshot = self._bridge.snapshot
            run = snapshot.run
            if run is not None and run.reached != told:
                told = run.reached
                note(f"{run.reached} of {run.count} waypoints reached, {run.elapsed:.1f} s")
            if snapshot.robot in _ENDS or snapshot.link is LinkState.LOST:
                return snapshot
            self._step()

    def _step(self) -> None:
        self._changed.wait(0.1)
        self._changed.clear()


def _report(options: Namespace, snapshot: RobotSnapshot, waypoints: Waypoints) -> int:
    run = snapshot.run
    content: dict[str, Any] = {
        "state": "lost" if snapshot.link is LinkState.LOST else snapshot.robot.value,
        "sentence": snapshot.sentence,
        "sent": run.sent if run else 0,
        "reached": run.reached if run else 0,
        "count": waypoints.count,
        "seconds": run.elapsed if run else 0.0,
        "waypoints_hash": waypoints.content_hash,
    }
    is_done = snapshot.robot is RobotState.DONE
    if not is_done:
        content |= {"error": snapshot.sentence, "where": "robot"}
    show(options, content, [snapshot.sentence])
    return 0 if is_done else ROBOT_FAILED
