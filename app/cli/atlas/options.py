"""The options of the commands of atlases."""

import argparse
from collections.abc import Callable
from pathlib import Path

from app.atlas.physics_choice import physics_rule
from app.atlas.stored_values import MOST_GAITS
from app.cli.atlas import commands
from app.cli.common.argument_types import add_robot, whole
from app.cli.common.command import set_command
from app.store.named_file import file_path
from core.atlas.space import MOST_SEED

DEFAULT_COUNT = 10_000
ATLAS_HELP = "atlas file, or deltawalker-small: the one that comes with the program"
MOST_WORKERS = 256


def atlas_command(parser: argparse.ArgumentParser) -> None:
    """Makes the parser of `atlas` with its commands `run`, `front`, `export` and `open`."""
    parser.description = (
        "Evaluate thousands of gaits: how fast, how steady, at what price; and use what was found."
    )
    added = parser.add_subparsers(required=True, metavar="run|front|export|open", parser_class=type(parser))

    def command(name: str, run: Callable[[argparse.Namespace], int], text: str) -> argparse.ArgumentParser:
        one = added.add_parser(name, help=text, allow_abbrev=False)
        set_command(one, run, text)
        return one

    _run_options(
        command("run", commands.run_atlas_run, "Evaluate the gaits of a space; goes on with a file.")
    )
    _front_options(command("front", commands.run_atlas_front, "The gaits that no other one beats."))
    text = "Write all gaits as CSV or Parquet, or a map of them as one HTML page."
    export = command("export", commands.run_atlas_export, text)
    export.add_argument("atlas", type=Path, metavar="ATLAS", help=ATLAS_HELP)
    export.add_argument(
        "-o",
        "--output",
        type=file_path,
        required=True,
        metavar="FILE",
        help="FILE.csv, FILE.parquet or FILE.html",
    )
    text = "Solve a gait again, say whether the answer differs, and write it as a gait file."
    opened = command("open", commands.run_atlas_open, text)
    opened.add_argument("atlas", type=Path, metavar="ATLAS", help=ATLAS_HELP)
    opened.add_argument("id", type=whole(0, MOST_GAITS - 1), metavar="ID", help="number of the gait")
    opened.add_argument(
        "-o", "--output", type=file_path, default=None, metavar="GAIT.json", help="gait file to write"
    )


def _run_options(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add_robot(parser, "default that of the space, else deltawalker")
    add(
        "--space",
        type=Path,
        default=None,
        metavar="SPACE.toml",
        help="what varies (default: a space of the robot)",
    )
    text = f"how many gaits the atlas is to have (default {DEFAULT_COUNT})"
    add("--count", type=whole(1, MOST_GAITS), default=DEFAULT_COUNT, metavar="N", help=text)
    text = "of the draw: the same seed gives the same gaits (default that of the space)"
    add("--seed", type=whole(0, MOST_SEED), default=None, metavar="K", help=text)
    text = "processes on this computer (default: one for each core)"
    add("--workers", type=whole(1, MOST_WORKERS), default=None, metavar="N", help=text)
    text = "work on a Dask cluster: “local”, or the scheduler's address such as tcp://node1:8786"
    add("--dask", default=None, metavar="local|ADDRESS", help=text)
    text = "simulate solved gaits with variations: those of the front, all, or a sample of N"
    add("--physics", type=_physics_rule, default=None, metavar="front|all|N", help=text)
    text = "ATLAS.sqlite, made or gone on with"
    add("-o", "--output", type=file_path, required=True, metavar="ATLAS.sqlite", help=text)


def _physics_rule(text: str) -> str | int:
    """An argument type: which gaits are simulated."""
    return physics_rule(text, "--physics")


def _front_options(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add("atlas", type=Path, metavar="ATLAS", help=ATLAS_HELP)
    add("--x", default="margin", metavar="KEY", help="a figure or a parameter (default margin)")
    add("--y", default="speed", metavar="KEY", help="another one (default speed)")
