"""The words of each command."""

from __future__ import annotations

import argparse
import math
from collections.abc import Callable
from pathlib import Path
from typing import NoReturn

from app.bridge.emulated import Fault
from app.bridge.profiles import ProfileName
from app.cli import commands_gait, commands_plan, commands_robot
from app.version import VERSION
from core.errors import InputError
from core.motion_problem import Cost, Workspace


class _Parser(argparse.ArgumentParser):
    """Usage errors become refusals like every other."""

    def error(self, message: str) -> NoReturn:
        raise InputError(f"{message}. See {self.prog} --help.", "command line")


def number(least: float, most: float, unit: str) -> Callable[[str], float]:
    """An argument type: a finite number within bounds."""

    def convert(text: str) -> float:
        try:
            value = float(text)
        except ValueError:
            raise argparse.ArgumentTypeError(f"“{text}” is not a number") from None
        if not (math.isfinite(value) and least <= value <= most):
            raise argparse.ArgumentTypeError(f"{text} must lie between {least} and {most} {unit}")
        return value

    return convert


def whole(least: int, most: int) -> Callable[[str], int]:
    """An argument type: a whole number within bounds."""

    def convert(text: str) -> int:
        try:
            value = int(text)
        except ValueError:
            raise argparse.ArgumentTypeError(f"“{text}” is not a whole number") from None
        if not least <= value <= most:
            raise argparse.ArgumentTypeError(f"{text} must lie between {least} and {most}")
        return value

    return convert


def pair(text: str) -> tuple[float, float]:
    """An argument type: two finite numbers, `X,Y`."""
    parts = text.split(",")
    if len(parts) != 2:
        raise argparse.ArgumentTypeError(f"“{text}” must be two numbers X,Y")
    convert = number(-1.0, 1.0, "m")
    return convert(parts[0]), convert(parts[1])


def foot_order(text: str) -> tuple[int, ...]:
    """An argument type: feet in order, `3,2,4,1`."""
    try:
        return tuple(int(part) for part in text.split(","))
    except ValueError:
        raise argparse.ArgumentTypeError(f"“{text}” must be feet such as 3,2,4,1") from None


def make_parser() -> argparse.ArgumentParser:
    """The parser of `footfall`; each command sets `run`."""
    parser = _Parser(
        prog="footfall",
        description="Footfall Studio: gaits for delta-legged walking robots.",
        allow_abbrev=False,
    )
    parser.add_argument("--version", action="version", version=f"footfall {VERSION}")
    commands = parser.add_subparsers(required=True, metavar="COMMAND", parser_class=_Parser)

    def command(name: str, run: Callable[[argparse.Namespace], int], text: str) -> argparse.ArgumentParser:
        added = commands.add_parser(name, help=text, description=text, allow_abbrev=False)
        added.set_defaults(run=run)
        added.add_argument("--json", action="store_true", help="print one JSON object")
        return added

    _serve_words(command("serve", commands_robot.run_serve, "Serve the studio and print its address."))
    command("gaits", commands_gait.run_gaits, "List built-in and saved gaits.").add_argument(
        "--data", type=Path, default=None, help="data folder"
    )
    _manual_words(command("manual", commands_gait.run_manual, "Trajectory of a gait made by hand."))
    _optimise_words(command("optimise", commands_gait.run_optimise, "Optimised trajectory of a gait."))
    _waypoint_words(command("waypoints", commands_plan.run_waypoints, "Motor waypoints of a trajectory."))
    check = command("check", commands_plan.run_check, "Check a trajectory or a gait by every rule.")
    check.add_argument("file", type=Path, help="TRAJ.csv or GAIT.json")
    _send_words(command("send", commands_robot.run_send, "Check, approve and stream a waypoint file."))
    _emulate_words(command("emulate", commands_robot.run_emulate, "Run an emulated robot on a line."))
    bench = command("bench", commands_plan.run_bench, "Measure what users feel.")
    bench.add_argument("names", nargs="*", metavar="NAME", help="which benchmarks; all where none is named")
    return parser


def _serve_words(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--host", default="127.0.0.1", help="address to listen on (default 127.0.0.1)")
    parser.add_argument("--port", type=whole(0, 65535), default=8400, help="port (default 8400; 0 any free)")
    parser.add_argument(
        "--robot", default="emulator", help="emulator, a serial device, or socket://HOST:PORT"
    )
    parser.add_argument("--data", type=Path, default=None, help="data folder")
    parser.add_argument("--token", default=None, help="demanded of every request; made where host is public")
    parser.add_argument("--no-browser", action="store_true", help="do not open a browser")


def _manual_words(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("gait", help="walk")
    parser.add_argument("--version", type=whole(0, 9), default=0, help="0, 1 or 2 (default 0)")
    parser.add_argument("--step", type=number(0.0, 0.2, "m"), default=0.010, help="m (default 0.010)")
    parser.add_argument("--direction", type=whole(1, 4), default=1)
    parser.add_argument("--iterations", type=whole(1, 20), default=1)
    parser.add_argument("--segment-samples", type=whole(2, 50), default=5)
    parser.add_argument("-o", "--output", type=Path, default=None, help="trajectory CSV to write")


def _optimise_words(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("gait", help="walk, amble, s-gait, c-gait, or a gait file")
    travel = parser.add_mutually_exclusive_group()
    travel.add_argument("--step", type=number(0.0, 0.2, "m"), default=None, help="m an iteration")
    travel.add_argument(
        "--goal", type=pair, default=None, metavar="X,Y", help="total travel at direction 1, m"
    )
    parser.add_argument("--yaw", type=number(-math.pi, math.pi, "rad"), default=None, help="rad an iteration")
    parser.add_argument("--direction", type=whole(1, 4), default=None)
    parser.add_argument("--order", type=foot_order, default=None, help="feet such as 3,2,4,1")
    parser.add_argument("--iterations", type=whole(1, 20), default=None)
    parser.add_argument("--phase-knots", type=whole(2, 50), default=None)
    parser.add_argument("--closing-knots", type=whole(0, 100), default=None)
    parser.add_argument("--knot-time", type=number(0.01, 10.0, "s"), default=None)
    parser.add_argument("--clearance", type=number(0.0, 0.02, "m"), default=None)
    parser.add_argument("--margin", type=number(-0.05, 0.05, "m"), default=None)
    parser.add_argument("--body-speed", type=number(0.0005, 1.0, "m/s"), default=None)
    parser.add_argument("--workspace", type=Workspace, choices=list(Workspace), default=None)
    parser.add_argument("--cost", type=Cost, choices=list(Cost), default=None)
    parser.add_argument("--method", choices=["nlp"], default="nlp", help="nlp (default)")
    parser.add_argument("-o", "--output", type=Path, default=None, help="trajectory CSV to write")


def _waypoint_words(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("file", type=Path, help="trajectory CSV")
    parser.add_argument("--merge", type=number(0.0, 0.02, "m"), default=None, metavar="M")
    parser.add_argument("--stop-bound", type=number(0.1, 60.0, "s"), default=None, metavar="S")
    parser.add_argument("-o", "--output", type=Path, default=None, help="waypoint CSV to write")


def _send_words(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("file", type=Path, help="waypoint CSV")
    parser.add_argument("--robot", required=True, help="emulator, a serial device, or socket://HOST:PORT")
    parser.add_argument("--yes", action="store_true", help="approve in your name without being asked")


def _emulate_words(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--tcp", type=whole(0, 65535), default=None, metavar="PORT", help="a port, 0 any free"
    )
    parser.add_argument("--profile", type=ProfileName, choices=list(ProfileName), default="published")
    parser.add_argument("--speed", type=number(0.01, 1000.0, ""), default=1.0)
    parser.add_argument("--fault", type=Fault, choices=list(Fault), nargs="+", default=[], metavar="NAME")
