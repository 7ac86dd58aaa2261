"""The arguments of each command."""

import argparse
import math
from collections.abc import Callable
from pathlib import Path
from typing import NoReturn

from app.cli import (
    commands_bench,
    commands_doctor,
    commands_fastest,
    commands_files,
    commands_frontier,
    commands_gait,
    commands_pattern,
    commands_plan,
    commands_restore,
    commands_robot,
    commands_simulate,
    commands_trial,
)
from app.cli.atlas.options import add_atlas_commands
from app.cli.bench_options import add_bench_options
from app.cli.command_groups import grouped_commands
from app.cli.common.argument_types import (
    add_robot,
    foot_order,
    free_or,
    number,
    one_of,
    pair,
    pixel,
    rule_number,
    turn_or_side,
    whole,
    words_of,
    zero_or,
)
from app.cli.gait_options import Method
from app.common.version import VERSION
from app.emulator.faults import Fault
from app.emulator.profiles import ProfileName
from app.export.formats import ExportFormat
from core.errors import InputError
from core.gait.options import LEAST_PHASE_KNOTS, MOST_CLOSING_KNOTS, MOST_PHASE_KNOTS
from core.gait.poses import MOST_SWAY
from core.patterns.problem import LEAST_SAMPLES, MOST_LEGS, MOST_SAMPLES, PatternRules
from core.physics.parameters import physics_sets
from core.physics.problem import Rig
from core.physics.variations import MOST_VARIATIONS
from core.pose_gaits.pose_problem import MOST_CYCLES, POSE_BOUNDS, PoseBounds
from core.problem.motion_problem import Boundary, Cost, Workspace

PATTERN_RULES = {
    "--shortest-swing": ("shortest_swing", "samples that a swing lasts at least"),
    "--feet-down": ("feet_down", "feet that stand at least"),
    "--each-side": ("feet_down_each_side", "feet that stand at least on each side"),
    "--workload": ("workload", "samples that the stances of two walking limbs differ by at most"),
    "--limb-changes": ("limb_changes", "times that a limb changes at most"),
    "--shortest-stance": ("shortest_stance", "samples that a stance lasts at least"),
    "--least-swing": ("least_swing", "samples that a walking limb swings at least"),
}
"""The options of `pattern` for rules: which rule, and what its number means."""


class _Parser(argparse.ArgumentParser):
    """Usage errors become refusals like every other."""

    def error(self, message: str) -> NoReturn:
        raise InputError(f"{message}. See {self.prog} --help.", "command line")


def make_parser() -> argparse.ArgumentParser:
    """The parser of `footfall`; each command sets `run`."""
    parser = _Parser(
        prog="footfall",
        usage="footfall [-h] [--version] COMMAND ...",
        description="Footfall Studio: gaits for delta-legged walking robots.",
        epilog=grouped_commands(),
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    parser.add_argument("--version", action="version", version=f"footfall {VERSION}")
    commands = parser.add_subparsers(
        required=True, prog="footfall", metavar="COMMAND", help=argparse.SUPPRESS, parser_class=_Parser
    )

    def command(name: str, run: Callable[[argparse.Namespace], int], text: str) -> argparse.ArgumentParser:
        added = commands.add_parser(name, description=text, allow_abbrev=False)
        added.set_defaults(run=run)
        added.add_argument("--json", action="store_true", help="print one JSON object")
        return added

    _serve_options(command("serve", commands_robot.run_serve, "Serve the studio and print its address."))
    text = "Look at Python, solvers, port, serial devices and data folder, and say what to do about each."
    doctor = command("doctor", commands_doctor.run_doctor, text)
    doctor.add_argument("--data", type=Path, default=None, help="data folder")
    _gaits_options(command("gaits", commands_gait.run_gaits, "List built-in and saved gaits."))
    _manual_options(command("manual", commands_gait.run_manual, "Trajectory of a gait made by hand."))
    _optimise_options(command("optimise", commands_gait.run_optimise, "Optimised trajectory of a gait."))
    text = "Largest step of a gait, and what limits it; --step and --goal say only which way."
    _frontier_options(command("frontier", commands_frontier.run_frontier, text))
    text = "The walk with the most millimetres a second of the robot's own time, as waypoints."
    _fastest_options(command("fastest", commands_fastest.run_fastest, text))
    text = "Evaluate thousands of gaits: how fast, how steady, at what price; and use what was found."
    add_atlas_commands(commands.add_parser("atlas", description=text, allow_abbrev=False))
    text = "The best footfall pattern: a transition between two states, or a periodic gait."
    _pattern_options(command("pattern", commands_pattern.run_pattern, text))
    _waypoint_options(command("waypoints", commands_plan.run_waypoints, "Motor waypoints of a trajectory."))
    check = command("check", commands_plan.run_check, "Check a trajectory, waypoints or a gait.")
    check.add_argument("file", type=Path, help="TRAJ.csv, WAY.csv or GAIT.json")
    add_robot(check, "default the gait's own, else deltawalker")
    text = "Run waypoints, or those of a trajectory or a gait, in a physics model."
    _simulate_options(command("simulate", commands_simulate.run_simulate, text))
    text = "Write a gait or a recorded motion in another form."
    _export_options(command("export", commands_files.run_export, text))
    _import_options(command("import", commands_files.run_import, "Make a gait of another program's file."))
    _send_options(command("send", commands_robot.run_send, "Check, approve and stream a waypoint file."))
    text = "List the backups of the database, or go back to one; what was there is kept aside."
    _restore_options(command("restore", commands_restore.run_restore, text))
    _emulate_options(command("emulate", commands_robot.run_emulate, "Run an emulated robot on a line."))
    text = "How far recorded foot tracks went, in cm and degrees, beside what was wanted."
    _trial_options(command("trial", commands_trial.run_trial, text))
    bench = command("bench", commands_bench.run_bench, "Measure what users feel.")
    add_bench_options(bench)
    return parser


def option_names(command: str) -> frozenset[str]:
    """What the options of a command are called as keyword arguments, but for those that only print."""
    for action in make_parser()._actions:
        if isinstance(action.choices, dict):
            options = action.choices[command]._option_string_actions
            names = {name.removeprefix("--").replace("-", "_") for name in options if name.startswith("--")}
            return frozenset(names - {"help", "json", "output"})
    raise AssertionError(command)


def _serve_options(parser: argparse.ArgumentParser) -> None:
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
    add("--no-browser", action="store_true", help="do not open a browser")


def _gaits_options(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add("--data", type=Path, default=None, help="data folder")
    add("--schema", action="store_true", help="print the JSON Schema of the gait document instead")


def _manual_options(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add("gait", help="walk, amble or s-gait")
    add("--version", type=whole(0, 9), default=0, help="0, 1 or 2 (default 0)")
    add("--step", type=number(0.0, 0.2, "m"), default=0.010, help="m (default 0.010)")
    add("--direction", type=whole(1, 4), default=1)
    add("--iterations", type=whole(1, 20), default=1)
    add("--segment-samples", type=whole(LEAST_PHASE_KNOTS, MOST_PHASE_KNOTS), default=5)
    add_robot(parser, "default deltawalker")
    add("-o", "--output", type=Path, default=None, help="trajectory CSV to write")


def _optimise_options(parser: argparse.ArgumentParser) -> None:
    _gait_options(parser)
    text = "take the Nth of what would help, where the gait has no motion"
    parser.add_argument("--remedy", type=whole(1, 4), metavar="N", default=None, help=text)


def _frontier_options(parser: argparse.ArgumentParser) -> None:
    _gait_options(parser)
    parser.add_argument("--free-phases", action="store_true", help="phases may also be longer")


def _gait_options(parser: argparse.ArgumentParser) -> None:
    """A gait and everything that can be asked of it; what is left out stays as the gait has it."""
    add = parser.add_argument
    add("gait", help="walk, amble, s-gait, c-gait, rotate, or a gait file")
    add_robot(parser, "default the gait's own; with other legs it is drawn anew")
    travel = parser.add_mutually_exclusive_group()
    travel.add_argument("--step", type=number(0.0, 0.2, "m"), default=None, help="m an iteration")
    travel.add_argument(
        "--goal", type=pair, default=None, metavar="X,Y", help="total travel at direction 1, m"
    )
    add("--yaw", type=number(-math.pi, math.pi, "rad"), default=None, help="rad an iteration")
    add("--direction", type=whole(1, 4), default=None)
    add("--order", type=foot_order, default=None, help="feet such as 3,2,4,1")
    add("--iterations", type=whole(1, 20), default=None)
    phase, closing = whole(LEAST_PHASE_KNOTS, MOST_PHASE_KNOTS), whole(0, MOST_CLOSING_KNOTS)
    add("--phase-knots", type=phase, default=None, help="samples of each stance phase and of each swing")
    add("--closing-knots", type=closing, default=None, help="samples of stance after the last swing")
    add("--knot-time", type=number(0.01, 10.0, "s"), default=None, help="s between samples (default 0.4)")
    _limit_options(parser)
    add("--boundary", type=one_of(Boundary), metavar=words_of(Boundary), default=None)
    text = "what is minimised (default goal, of a gait file its own)"
    add("--cost", type=one_of(Cost), metavar=words_of(Cost), default=None, help=text)
    add(
        "--method",
        type=one_of(Method),
        metavar=words_of(Method),
        default=Method.NLP,
        help="live: convex, given footholds and heights; nlp: exact (default)",
    )
    add("-o", "--output", type=Path, default=None, help="trajectory CSV to write")


def _limit_options(parser: argparse.ArgumentParser) -> None:
    """What a motion keeps."""
    add = parser.add_argument
    add("--clearance", type=number(0.0, 0.02, "m"), default=None, help="m that a swing rises (default 0.003)")
    add(
        "--margin",
        type=number(0.0, 0.05, "m"),
        default=None,
        help="m that the centre of pressure stays inside the support polygon (default the robot's own)",
    )
    add("--body-speed", type=number(0.0005, 1.0, "m/s"), default=None, help="m/s (default 0.015)")
    add("--foot-speed", type=number(0.0005, 1.0, "m/s"), default=None, help="m/s (default 0.015)")
    height = number(0.03, 0.1, "m")
    add("--plane-height", type=height, default=None, help="actuator plane at the start, m")
    add("--end-plane-height", type=height, default=None, help="and at the goal, m")
    add("--workspace", type=one_of(Workspace), metavar=words_of(Workspace), default=None)
    add("--friction", type=number(0.01, 10.0, ""), default=None, help="coefficient")
    add(
        "--motor-speed",
        type=number(0.0005, 1.0, "m/s"),
        default=None,
        help="limit of every motor, m/s (default none)",
    )
    add(
        "--motor-acceleration",
        type=number(0.0005, 10.0, "m/s²"),
        default=None,
        help="limit of every motor, m/s² (default none)",
    )


def _fastest_options(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    text = "walk (default), amble, s-gait, c-gait, rotate, or a gait file: foot order and direction"
    add("gait", nargs="?", default=None, help=text)
    add(
        "--order",
        type=foot_order,
        default=None,
        help="feet such as 3,2,4,1 at direction 1, instead of the gait's own",
    )
    text = "choose foot order, direction and overlaps too: try all that differ, print them, take the fastest"
    add("--search", action="store_true", help=text)
    text = "the same, and what other margins and stop bounds cost; a few minutes"
    add("--front", action="store_true", help=text)
    step = "m a cycle, free for the fastest, or 0 for a turn on the spot (default free)"
    add("--step", type=free_or(zero_or(number(0.0005, 0.2, "m"))), default=None, metavar="M|free", help=step)
    turn = "rad a cycle, to the left above 0; on the spot also left or right: as fast as possible (default 0)"
    add("--turn", type=turn_or_side, default=None, metavar="RAD|left|right", help=turn)
    text = (
        "how far the heading may differ from an even turn, rad (default 0): sway makes a gait faster, but "
        "soles pivot on the ground, which is not tested with flat shoes yet"
    )
    add("--sway", type=number(0.0, MOST_SWAY, "rad"), default=0.0, metavar="RAD", help=text)
    text = "from the standard stance to rest (default 1)"
    add("--cycles", type=whole(1, MOST_CYCLES), default=1, metavar="N", help=text)
    bounds = PoseBounds()
    for name, (factor, unit, text) in _POSE_LIMITS.items():
        least, most = POSE_BOUNDS[name]
        words = f"{text} (default {getattr(bounds, name):g})"
        option = f"--{name.replace('_', '-')}"
        add(option, type=number(least, most, unit), default=getattr(bounds, name), metavar=factor, help=words)
    add("--direction", type=whole(1, 4), default=None, help="1 to 4 (default the gait's own)")
    add_robot(parser, "default the gait's own; with other legs in one of its orders")
    add("-o", "--output", type=Path, default=None, help="WAY.csv with a companion, or GAIT.json")


_POSE_LIMITS = {
    "margin": ("M", "m", "m that the body stays inside the support polygon, everywhere"),
    "clearance": ("M", "m", "m that a foot rises above the plane of the standing ones"),
    "stop_bound": ("S", "s", "s for which the robot hears no Stop at most"),
    "slip": ("M", "m", "m that a standing foot may leave its foothold within a move"),
    "shoe_distance": ("M", "m", "m between the middles of two feet at least"),
    "arm_distance": ("M", "m", "m between the arms of neighbouring legs at least; 0 where they may touch"),
}
"""Limits of a pose gait: how each is written, its unit, and what it means."""


def _pattern_options(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add("--legs", type=whole(2, MOST_LEGS), required=True, metavar="N")
    samples = whole(LEAST_SAMPLES, MOST_SAMPLES)
    text = "how many, both ends of a transition included"
    add("--samples", type=samples, required=True, metavar="M", help=text)
    text = "first state, foot 1 first: 1 stance, 0 swing"
    add("--from", dest="from_state", default=None, metavar="BITS", help=text)
    add("--to", dest="to_state", default=None, metavar="BITS", help="last state")
    add("--periodic", action="store_true", help="a gait: the first sample follows the last")
    text = "feet that keep one state: 1,4; in a periodic gait 1:swing,4:stance"
    add("--locked", default=None, metavar="FEET", help=text)
    text = "the fewest samples that work, up to --samples"
    add("--shortest", action="store_true", help=text)
    add("--best", type=whole(1, 50), default=1, metavar="K", help="how many patterns")
    seconds = number(0.001, 3600.0, "s")
    add("--seconds", type=seconds, default=30.0, help="longest search (default 30)")
    for option, (rule, text) in PATTERN_RULES.items():
        default = getattr(PatternRules(), rule)
        words = f"{text} (default {default})"
        add(option, dest=rule, type=rule_number, default=default, metavar="N|off", help=words)


def _waypoint_options(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add("file", type=Path, help="trajectory CSV")
    add_robot(parser, "default deltawalker")
    _way_options(parser)
    add("-o", "--output", type=Path, default=None, help="waypoint CSV to write")


def _way_options(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    merge = "leave out waypoints this near the motors' straight way; 0.001 is the firmware's own tolerance"
    add("--merge", type=number(0.0, 0.02, "m"), default=None, metavar="M", help=merge)
    bound = "cut moves so that Stop is heard within this time, at least 0.77 s"
    add("--stop-bound", type=number(0.1, 60.0, "s"), default=None, metavar="S", help=bound)


def _simulate_options(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add("file", type=Path, help="TRAJ.csv, WAY.csv or GAIT.json")
    add_robot(parser, "default the gait's own, else deltawalker")
    _way_options(parser)
    text = f"parameters: {', '.join(physics_sets())}, or a learned set (default the robot's usual one)"
    add("--physics", default=None, metavar="SET", help=text)
    add("--data", type=Path, default=None, help="data folder, where learned sets are kept")
    add("--rig", type=one_of(Rig), metavar=words_of(Rig), default=Rig.WALKING)
    text = "try so many seeded variations of the parameters as well"
    add("--variations", type=whole(0, MOST_VARIATIONS), default=0, metavar="N", help=text)
    add("--seed", type=whole(0, 2**31), default=0, help="of the variations (default 0)")


def _export_options(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add("source", help="a gait's id, GAIT.json, TRAJ.csv or MOTION.npz")
    add("--format", type=one_of(ExportFormat), metavar=words_of(ExportFormat), required=True)
    add(
        "--method",
        type=one_of(Method),
        metavar=words_of(Method),
        default=Method.NLP,
        help="what makes the plan of a gait, as for optimise (default nlp)",
    )
    add("--data", type=Path, default=None, help="data folder")
    add("-o", "--output", type=Path, default=None, help="file to write")


def _import_options(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add("file", type=Path, help="TRAJ.csv, WAY.csv, MOTION.npz, PHASES.json or GAIT.json")
    add("--name", default=None, help="of the gait; the file's where left out")
    add("--robot", default=None, help="robot of the motion (default the first one with as many feet)")
    add("--sample-time", type=number(0.001, 60.0, "s"), default=None, help="of a phase list, s")
    add("-o", "--output", type=Path, default=None, help="gait file to write")


def _send_options(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add("file", type=Path, help="waypoint CSV")
    add("--robot", required=True, help="emulator, a serial device, or socket://HOST:PORT")
    add("--yes", action="store_true", help="approve in your name without being asked")
    add("--clear-stop", action="store_true", help="lift a stop that the robot holds from another program")
    add("--data", type=Path, default=None, help="data folder, where the run is kept")


def _trial_options(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add("files", type=Path, nargs="+", metavar="TRACK.csv|VIDEO", help="X_D1, Y_D1, …, a row a frame")
    text = "the files are videos: how their camera sees the platform, as the studio exports it"
    add("--setup", type=Path, default=None, metavar="SETUP.json", help=text)
    length = number(0.01, 1000.0, "cm")
    add("--expect", type=length, required=True, metavar="CM", help="the whole wanted way")
    text = "find the ends of so many iterations, and print each"
    add("--iterations", type=whole(1, 50), default=None, metavar="N", help=text)
    rate = number(0.1, 1000.0, "Hz")
    add("--frame-rate", type=rate, default=None, metavar="HZ", help="frames a second (13)")
    text = "the files are in pixels, y downwards, 0,0 a gap: how many are a centimetre"
    add("--pixels-per-cm", type=number(0.1, 10_000.0, "px"), default=None, help=text)
    text = "pixel of the platform's centre"
    add("--origin", type=pixel, default=None, metavar="X,Y", help=text)


def _restore_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--data", type=Path, default=None, help="data folder")
    chosen = parser.add_mutually_exclusive_group()
    text = "go back to this one: a name that the list shows, or a file"
    chosen.add_argument("--backup", type=Path, default=None, metavar="FILE", help=text)
    text = "begin with an empty database; saved gaits stay"
    chosen.add_argument("--empty", action="store_true", help=text)


def _emulate_options(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add("--tcp", type=whole(0, 65535), default=None, metavar="PORT", help="a port, 0 any free")
    add("--profile", type=one_of(ProfileName), metavar=words_of(ProfileName), default="published")
    add("--speed", type=number(0.01, 1000.0, ""), default=1.0)
    add("--fault", type=one_of(Fault), metavar=words_of(Fault), nargs="+", default=[])
