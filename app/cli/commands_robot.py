"""`serve`, `send` and `emulate`."""

import getpass
import re
import signal
import sys
import threading
from argparse import Namespace
from datetime import UTC, datetime
from pathlib import Path
from types import FrameType
from typing import Any

from app.bridge.states import LinkState, RobotSnapshot, RobotState, RunPlan
from app.cli.common.output import INTERRUPTED, NOT_FIT, end_on_signals, note, show, verdict_lines, write
from app.cli.served_cameras import served_cameras
from app.cli.streaming import run_of_file, stream
from app.common.signals import ending_signals
from app.emulator.emulated_robot import start_emulator
from app.export.trajectory_files import read_waypoints
from app.gaits.views import approval_view, verdict_view
from app.store.gait_files import default_data_folder
from core.checks.rules import check_waypoints
from core.errors import CheckError, InputError, RobotError
from core.findings import Approval, Severity, Verdict, approve
from core.robot.model import load_robot

LOOK_SECONDS = 0.2
"""How often an emulated robot is looked at for fault states."""
ROBOT_FAILED = 5
BAD_INPUT = frozenset({"stroke", "duration"})
"""Rules that name a number of the file; what breaks them is bad input."""
LEAST_TOKEN, MOST_TOKEN = 12, 200
"""Characters of a token."""
_TOKEN = re.compile(rf"[!-~]{{{LEAST_TOKEN},{MOST_TOKEN}}}")


def run_serve(options: Namespace) -> int:
    """Serves the studio until a signal ends it."""
    cameras = served_cameras(options.camera)
    token: str | None = options.token
    if token and not _TOKEN.fullmatch(token):
        raise InputError(
            f"A token has {LEAST_TOKEN} to {MOST_TOKEN} letters, digits and signs without blanks; "
            "--token alone makes one.",
            "--token",
        )
    _require_device(options.robot)
    # The web server and the 3D scene take a second to load; the other commands do without them.
    from app.server.launch import ServeOptions, serve

    serve(
        ServeOptions(
            host=options.host,
            port=options.port,
            device=options.robot,
            data=(options.data or default_data_folder()).expanduser(),
            token=token,
            opens_browser=not options.no_browser,
            cameras=cameras,
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


def _announce(url: str, who: str) -> None:
    write(sys.stdout, f"Footfall Studio is ready at {url}\n")
    note(who)


def run_emulate(options: Namespace) -> int:
    """Runs an emulated robot until a signal ends it."""
    ended = threading.Event()

    def end(number: int, frame: FrameType | None) -> None:
        del number, frame
        ended.set()

    for number in (signal.SIGINT, *ending_signals()):
        signal.signal(number, end)
    robot = start_emulator(options.profile, options.speed, tcp=options.tcp, faults=options.fault)
    try:
        show(options, {"device": robot.device}, [robot.device])
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
    """Checks, approves and streams a waypoint file as a run that is kept; Ctrl-C is Stop."""
    end_on_signals()
    waypoints, model = read_waypoints(options.file), load_robot("deltawalker")
    verdict = check_waypoints(model, waypoints)
    if not verdict.passed:
        return _refuse(options, verdict)
    plan = RunPlan(waypoints, _approval(verdict, options), (True,) * waypoints.count)
    data = (options.data or default_data_folder()).expanduser()
    clears_stop: bool = options.clear_stop
    ended = stream(plan, run_of_file(model, plan, options.file), options.robot, data, clears_stop=clears_stop)
    status = _report(options, ended.snapshot, plan)
    return INTERRUPTED if ended.is_interrupted else status


def _refuse(options: Namespace, verdict: Verdict) -> int:
    """A number out of its range is bad input; everything else is not fit."""
    errors = [f for f in verdict.findings if f.severity is Severity.ERROR]
    out_of_range = [f for f in errors if f.rule in BAD_INPUT]
    if out_of_range:
        first = min(out_of_range, key=lambda f: f.sample or 0)
        raise InputError(first.sentence, f"{options.file}:{(first.sample or 0) + 2}")
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
        if _answer() not in ("y", "yes"):
            raise CheckError("Not approved; nothing was sent.", str(options.file))
    return approve(verdict, name, datetime.now(UTC), accept_warnings=True)


def _answer() -> str:
    try:
        return sys.stdin.readline().strip().lower()
    except OSError:  # the terminal is closed
        return ""


def _report(options: Namespace, snapshot: RobotSnapshot, plan: RunPlan) -> int:
    run, waypoints = snapshot.run, plan.waypoints
    content: dict[str, Any] = {
        "run": run.run_id if run else None,
        "state": "lost" if snapshot.link is LinkState.LOST else snapshot.robot.value,
        "sentence": snapshot.sentence,
        "sent": run.sent if run else 0,
        "reached": run.reached if run else 0,
        "count": waypoints.count,
        "seconds": run.elapsed if run else 0.0,
        "waypoints_hash": waypoints.content_hash,
        "approval": approval_view(plan.approval),
    }
    is_done = snapshot.robot is RobotState.DONE
    if not is_done:
        content |= {"error": snapshot.sentence, "where": "robot"}
    show(options, content, [snapshot.sentence])
    return 0 if is_done else ROBOT_FAILED
