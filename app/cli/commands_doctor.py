"""`doctor`: whether this computer has what the program needs, and what to do where it has not."""

import getpass
import os
import sys
from argparse import ArgumentParser, Namespace
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass
from enum import StrEnum
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from app.bridge.transport import serial_devices
from app.cli.common.argument_types import whole
from app.cli.common.command import set_command
from app.cli.common.output import NOT_FIT, show
from app.common.version import VERSION
from app.store.folder_lock import studio_address
from app.store.gait_files import default_data_folder
from app.studio.start_check import check_start
from core.data.tables import package_files
from core.errors import FootfallError
from core.gait.gait import motion_problem
from core.library.library import optimised_entry
from core.problem.motion_problem import MotionProblem
from core.robot.model import load_robot
from solver_jobs import SolveStatus, solve_live, solve_motion

LEAST_PYTHON = (3, 11)
PORT = 8400
LEAST_FREE = 500e6
"""Free space below which the data folder is warned of, bytes."""
_LIBRARIES = {
    "casadi": "the optimiser",
    "mujoco-core": "physics",
    "ortools": "the pattern search",
    "viser": "the 3D preview",
    "opencv-python-headless": "cameras and videos",
    "pyserial": "the robot's cable",
}


class State(StrEnum):
    """How something stands."""

    OK = "ok"
    WARNING = "warning"
    ERROR = "error"


@dataclass(frozen=True)
class Diagnosis:
    """One thing that was looked at.

    Args:
        name: what it is.
        state: how it stands.
        sentence: what was found.
        remedy: what to do; nothing where all is well.
    """

    name: str
    state: State
    sentence: str
    remedy: str = ""


def doctor_command(parser: ArgumentParser) -> None:
    """Makes the parser of `doctor`."""
    text = (
        "Look at Python, solvers, page, port, serial devices and data folder, and say what to do about each; "
        "tries what serve does, and leaves nothing behind."
    )
    set_command(parser, run_doctor, text)
    add = parser.add_argument
    add("--host", default="127.0.0.1", help="address that the studio is to listen on (default 127.0.0.1)")
    add("--port", type=whole(1, 65535), default=None, help=f"its port (default {PORT})")
    add("--data", type=Path, default=None, help="data folder")


def run_doctor(options: Namespace) -> int:
    """Looks at Python, libraries, solvers, port, serial devices and the data folder."""
    folder = (options.data or default_data_folder()).expanduser()
    address = _address(folder)
    found = [
        _python(),
        *(_library(name, use) for name, use in _LIBRARIES.items()),
        _solver("live optimiser", lambda: solve_live(_problem()).status),
        _solver("exact optimiser", lambda: solve_motion(_problem()).status),
        _page(),
        _port(options, address),
        *_serial(),
        _data(folder, address),
    ]
    has_passed = all(one.state is not State.ERROR for one in found)
    content = {"version": VERSION, "passed": has_passed, "checks": [asdict(one) for one in found]}
    show(options, content, [f"Footfall Studio {VERSION}", *map(_line, found)])
    return 0 if has_passed else NOT_FIT


def _line(one: Diagnosis) -> str:
    remedy = f" {one.remedy}" if one.remedy else ""
    return f"  {one.state.value:8} {one.name}: {one.sentence}{remedy}"


def _python() -> Diagnosis:
    has = ".".join(map(str, sys.version_info[:3]))
    where = f"{has} at {sys.executable}, {os.cpu_count()} cores."
    if sys.version_info[:2] >= LEAST_PYTHON:
        return Diagnosis("Python", State.OK, where)
    least = ".".join(map(str, LEAST_PYTHON))
    return Diagnosis("Python", State.ERROR, where, f"Install Python {least} or later.")


def _library(name: str, use: str) -> Diagnosis:
    try:
        return Diagnosis(name, State.OK, f"{version(name)}, for {use}.")
    except PackageNotFoundError:
        return Diagnosis(
            name, State.ERROR, f"missing, needed for {use}.", "Install the program again, as README says."
        )


def _problem() -> MotionProblem:
    gait = optimised_entry("walk").gait
    return motion_problem(gait, load_robot(gait.robot))


def _solver(name: str, solve: Callable[[], SolveStatus]) -> Diagnosis:
    remedy = "Install the program again, as README says; if that does not help, report the sentence."
    try:
        status = solve()
    except Exception as error:  # whatever a library that does not load raises
        return Diagnosis(name, State.ERROR, f"does not run: {error}.", remedy)
    if status is SolveStatus.SOLVED:
        return Diagnosis(name, State.OK, "solves the walk.")
    return Diagnosis(name, State.ERROR, f"answers “{status.value}” for the walk.", remedy)


def _page() -> Diagnosis:
    """The page, put together as the studio does."""
    from app.web.page import ModulePage

    try:
        state = ModulePage(Path(str(package_files("app").joinpath("static")))).now()
    except OSError as error:
        remedy = "Install the program again, as README says."
        return Diagnosis("page", State.ERROR, f"cannot be read: {error}.", remedy)
    return Diagnosis("page", State.OK, f"{len(state.stamps)} files.")


def _port(options: Namespace, address: str | None) -> Diagnosis:
    """The port, opened as the studio does."""
    if address is not None:
        return Diagnosis("studio", State.OK, f"running at {address}.")
    # The web server takes a second to load; it has to load for the studio too.
    from app.server.launch import listen

    try:
        listen(options.host, options.port or PORT).close()
    except FootfallError as refusal:
        state = State.WARNING if options.port is None and refusal.where == "--port" else State.ERROR
        return Diagnosis("studio", state, f"not running. {refusal.sentence}")
    return Diagnosis("studio", State.OK, f"not running; port {options.port or PORT} is free.")


def _serial() -> Iterator[Diagnosis]:
    devices = serial_devices()
    if not devices:
        yield Diagnosis("robot", State.OK, "no serial device is plugged in; the emulated robot needs none.")
    for one in devices:
        name = f"robot on {one.device}"
        if os.access(one.device, os.R_OK | os.W_OK):
            yield Diagnosis(name, State.OK, "can be opened.")
            continue
        remedy = (
            f"Let your account use it: sudo usermod -aG {_group(one.device)} {getpass.getuser()}, then log "
            "out and in again."
        )
        yield Diagnosis(name, State.ERROR, "may not be opened by this account.", remedy)


def _group(device: str) -> str:
    try:
        return Path(device).group()
    except (OSError, KeyError):
        return "dialout"


def _address(folder: Path) -> str | None:
    """Where the studio of the data folder is running; None where none is, or nobody can know."""
    try:
        return studio_address(folder)
    except FootfallError:
        return None


def _data(folder: Path, address: str | None) -> Diagnosis:
    """The data folder, opened as the studio does; one that a studio has open is left to it."""
    if address is not None:
        return Diagnosis("data folder", State.OK, f"{folder}, open in the studio at {address}.")
    try:
        found = check_start(folder)
    except FootfallError as refusal:
        return Diagnosis("data folder", State.ERROR, refusal.sentence)
    sentence = f"{folder}, {found.gaits} saved gaits, {found.free / 1e9:.1f} GB free."
    if found.is_new:
        sentence += " It does not exist yet; the studio makes it, which was tried."
    if found.is_outdated:
        sentence += " The next start brings its database up to date and keeps a backup of it."
    if found.free < LEAST_FREE:
        return Diagnosis("data folder", State.WARNING, sentence, "Free some space on the disk.")
    return Diagnosis("data folder", State.OK, sentence)
