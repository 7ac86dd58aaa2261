"""`doctor`: whether this computer has what the program needs, and what to do where it has not."""

import getpass
import os
import shutil
import socket
import sys
from argparse import ArgumentParser, Namespace
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass
from enum import StrEnum
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from app.bridge.transport import serial_devices
from app.cli.common.command import set_command
from app.cli.common.output import NOT_FIT, show
from app.common.version import VERSION
from app.store.folder_lock import studio_address
from app.store.gait_files import GaitFiles, default_data_folder, require_folder
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
    text = "Look at Python, solvers, port, serial devices and data folder, and say what to do about each."
    set_command(parser, run_doctor, text)
    parser.add_argument("--data", type=Path, default=None, help="data folder")


def run_doctor(options: Namespace) -> int:
    """Looks at Python, libraries, solvers, port, serial devices and the data folder."""
    folder = (options.data or default_data_folder()).expanduser()
    found = [
        _python(),
        *(_library(name, use) for name, use in _LIBRARIES.items()),
        _solver("live optimiser", lambda: solve_live(_problem()).status),
        _solver("exact optimiser", lambda: solve_motion(_problem()).status),
        _port(folder),
        *_serial(),
        _data(folder),
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


def _port(folder: Path) -> Diagnosis:
    try:
        address = studio_address(folder)
    except FootfallError:
        address = None
    if address is not None:
        return Diagnosis("studio", State.OK, f"running at {address}.")
    with socket.socket() as probe:
        try:
            probe.bind(("127.0.0.1", PORT))
        except OSError:
            remedy = f"Another program uses it: start the studio with --port {PORT + 1}."
            return Diagnosis("studio", State.WARNING, f"not running; port {PORT} is busy.", remedy)
    return Diagnosis("studio", State.OK, f"not running; port {PORT} is free.")


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


def _data(folder: Path) -> Diagnosis:
    if not folder.exists():
        return Diagnosis("data folder", State.OK, f"{folder} does not exist yet; the studio makes it.")
    try:
        require_folder(folder)
        count = len(GaitFiles(folder).ids())
    except FootfallError as refusal:
        return Diagnosis("data folder", State.ERROR, refusal.sentence)
    free = shutil.disk_usage(folder).free
    sentence = f"{folder}, {count} saved gaits, {free / 1e9:.1f} GB free."
    if free < LEAST_FREE:
        return Diagnosis("data folder", State.WARNING, sentence, "Free some space on the disk.")
    return Diagnosis("data folder", State.OK, sentence)
