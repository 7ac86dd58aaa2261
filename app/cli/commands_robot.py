"""`serve`, `send` and `emulate`."""

import getpass
import re
import signal
import sys
import threading
from argparse import ArgumentParser, ArgumentTypeError, Namespace
from datetime import UTC, datetime
from pathlib import Path
from types import FrameType
from typing import Any

from app.bridge.states import LinkState, RobotSnapshot, RobotState, RunPlan
from app.cli.common.argument_types import number, one_of, whole, words_of
from app.cli.common.command import set_command
from app.cli.common.output import INTERRUPTED, NOT_FIT, end_on_signals, note, show, verdict_lines, write
from app.cli.served_cameras import served_cameras
from app.cli.streaming import run_of_file, stream
from app.common.signals import ending_signals
from app.emulator.emulated_robot import start_emulator
from app.emulator.faults import Fault, FaultRequest
from app.emulator.profiles import ProfileName
from app.export.trajectory_files import finds_companion, read_waypoints
from app.export.way_files import checked_way, read_way_file
from app.gaits.verdict_views import approval_view, override_view, override_words, verdict_view
from app.published.reference import open_reference
from app.store.gait_files import default_data_folder
from core.checks.rules import check_plan, check_waypoints
from core.errors import CheckError, InputError, RobotError
from core.findings import Approval, Verdict, approve, override_all
from core.robot.model import RobotModel, load_robot
from core.wire.waypoints import Waypoints

LOOK_SECONDS = 0.2
"""How often an emulated robot is looked at for fault states."""
ROBOT_FAILED = 5
BAD_INPUT = frozenset({"stroke", "duration"})
"""Rules that name a number of the file; what breaks them is bad input."""
LEAST_TOKEN, MOST_TOKEN = 12, 200
"""Characters of a token."""
_TOKEN = re.compile(rf"[!-~]{{{LEAST_TOKEN},{MOST_TOKEN}}}")


def serve_command(parser: ArgumentParser) -> None:
    """Makes the parser of `serve`."""
    set_command(parser, run_serve, "Serve the studio and print its address.")
    add = parser.add_argument
    add("--host", default="127.0.0.1", help="address to listen on (default 127.0.0.1)")
    add("--port", type=whole(0, 65535), default=8400, help="port (default 8400; 0 any free)")
    add("--robot", default="emulator", help="emulator, a serial device, or socket://HOST:PORT")
    add("--data", type=Path, default=None, help="data folder")
    text = (
        "require this token on every request; without a value one is made, and a public host always needs one"
    )
    add("--token", nargs="?", const="", default=None, help=text)
    text = "play a video file as a camera of that name; may be given several times"
    add("--camera", action="append", default=[], metavar="NAME=VIDEO", help=text)
    text = "folder of the published data, for the published experiments; it is remembered"
    add("--reference", type=Path, default=None, metavar="FOLDER", help=text)
    add("--no-browser", action="store_true", help="do not open a browser")


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
    reference = None if options.reference is None else open_reference(options.reference).folder
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
            reference=reference,
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


def emulate_command(parser: ArgumentParser) -> None:
    """Makes the parser of `emulate`."""
    set_command(parser, run_emulate, "Run an emulated robot on a line.")
    add = parser.add_argument
    add("--tcp", type=whole(0, 65535), default=None, metavar="PORT", help="a port, 0 any free")
    add("--profile", type=one_of(ProfileName), metavar=words_of(ProfileName), default="published")
    add("--speed", type=number(0.01, 1000.0, ""), default=1.0)
    add(
        "--fault",
        type=_fault,
        metavar=words_of(Fault),
        nargs="+",
        default=[],
        help="of motors also with their numbers: stuck-motor:5, swapped-motors:4,5",
    )


def _fault(text: str) -> FaultRequest:
    """An argument type: a fault, of motors also with their numbers."""
    try:
        return FaultRequest.parse(text)
    except InputError as error:
        raise ArgumentTypeError(error.sentence) from None


def run_emulate(options: Namespace) -> int:
    """Runs an emulated robot until a signal ends it."""
    ended = threading.Event()

    def end(number: int, frame: FrameType | None) -> None:
        del number, frame
        ended.set()

    for ending in (signal.SIGINT, *ending_signals()):
        signal.signal(ending, end)
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


def send_command(parser: ArgumentParser) -> None:
    """Makes the parser of `send`."""
    set_command(parser, run_send, "Check, approve and stream a waypoint file.")
    add = parser.add_argument
    add("file", type=Path, help="waypoint CSV")
    add("--robot", required=True, help="emulator, a serial device, or socket://HOST:PORT")
    add("--yes", action="store_true", help="approve in your name without being asked")
    add("--clear-stop", action="store_true", help="lift a stop that the robot holds from another program")
    text = "send in spite of errors that may be overridden; the reason is kept with the run"
    add("--override", default=None, metavar="REASON", help=text)
    add("--data", type=Path, default=None, help="data folder, where the run is kept")


def run_send(options: Namespace) -> int:
    """Checks, approves and streams a waypoint file as a run that is kept; Ctrl-C is Stop."""
    end_on_signals()
    waypoints, model = read_waypoints(options.file), load_robot("deltawalker")
    verdict, hold_ok = _verdict(options.file, model, waypoints)
    _require_numbers(options.file, verdict)
    if not verdict.passed and options.override is None:
        return _refuse(options, verdict)
    plan = RunPlan(waypoints, _approval(verdict, options), hold_ok)
    data = (options.data or default_data_folder()).expanduser()
    clears_stop: bool = options.clear_stop
    ended = stream(plan, run_of_file(model, plan, options.file), options.robot, data, clears_stop=clears_stop)
    status = _report(options, ended.snapshot, plan)
    return INTERRUPTED if ended.is_interrupted else status


def _verdict(file: Path, model: RobotModel, waypoints: Waypoints) -> tuple[Verdict, tuple[bool, ...]]:
    """By every rule where the file's companion has the motion, else by what waypoints alone can show.

    Returns:
        The verdict, and for each waypoint whether all feet are known to be down there.
    """
    hold_ok = (False,) * waypoints.count
    if finds_companion(file):
        read = read_way_file(file, model.name)
        for assumption in read.assumptions:
            note(assumption)
        if read.motion is not None:
            return check_plan(checked_way(model, read.motion, read)), read.hold_ok
        hold_ok = read.hold_ok
    return check_waypoints(model, waypoints), hold_ok


def _require_numbers(file: Path, verdict: Verdict) -> None:
    """A number out of its range is bad input, with its line."""
    out_of_range = [f for f in verdict.errors if f.rule in BAD_INPUT]
    if out_of_range:
        first = min(out_of_range, key=lambda f: f.sample or 0)
        raise InputError(first.sentence, f"{file}:{(first.sample or 0) + 2}")


def _refuse(options: Namespace, verdict: Verdict) -> int:
    lines = verdict_lines(verdict)
    if all(error.is_overridable for error in verdict.errors):
        lines.append("  --override REASON sends in spite of these errors, in your name.")
    error = {"error": verdict.errors[0].sentence, "where": str(options.file)}
    show(options, {**error, **verdict_view(verdict)}, lines)
    return NOT_FIT


def _approval(verdict: Verdict, options: Namespace) -> Approval:
    """Asks for the user's word, and gives it in their name.

    Raises:
        CheckError: they did not give it.
        InputError: errors cannot be overridden as they ask.
    """
    name, reason = getpass.getuser(), options.override
    override = None if reason is None else override_all(verdict, reason)
    note(*verdict_lines(verdict))
    if not options.yes:
        spite = "" if override is None else f" in spite of errors of {', '.join(override.rules)}"
        note(
            f"{options.file}: the robot will move, slowly to the start pose first. Stop is Ctrl-C, in effect "
            f"after the move that is running. Approve{spite} as {name} and send? [y/N]"
        )
        if _answer() not in ("y", "yes"):
            raise CheckError("Not approved; nothing was sent.", str(options.file))
    return approve(verdict, name, datetime.now(UTC), accept_warnings=True, override=override)


def _answer() -> str:
    try:
        return sys.stdin.readline().strip().lower()
    except (OSError, ValueError):  # the terminal is closed; bytes that are no text
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
        "override": override_view(plan.approval),
    }
    is_done = snapshot.robot is RobotState.DONE
    if not is_done:
        content |= {"error": snapshot.sentence, "where": "robot"}
    lines = [snapshot.sentence]
    if content["override"] is not None:
        lines.append(f"Approved in spite of: {override_words(content['override'])}")
    show(options, content, lines)
    return 0 if is_done else ROBOT_FAILED
