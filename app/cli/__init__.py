"""The command line: the commands, their arguments, output and exit status."""

import json
import logging
import sys
from collections.abc import Sequence
from typing import TextIO

from app.cli.common.output import INTERRUPTED, UNWRITABLE, drop, note, write
from app.cli.common.streams import LogFormatter, prepare_streams
from app.cli.parser import make_parser
from app.common.signals import Interrupted
from core.errors import (
    CheckError,
    FootfallError,
    InfeasibleError,
    InputError,
    RobotError,
    StateError,
    StorageError,
)

_EXIT: tuple[tuple[type[FootfallError], int], ...] = (
    (InputError, 2),
    (StorageError, 2),
    (InfeasibleError, 3),
    (CheckError, 4),
    (StateError, 4),
    (RobotError, 5),
)


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs one command.

    Args:
        arguments: without the program's name; those of the process where None.

    Returns:
        The exit status: 0 done, 2 bad input, 3 infeasible, 4 not fit, 5 robot, 130 interrupted.
    """
    prepare_streams()
    words = list(sys.argv[1:] if arguments is None else arguments)
    wants_json = "--json" in words
    _log_to(sys.stderr)
    try:
        options = make_parser().parse_args(words)
        options.words = words
        status: int = options.run(options)
        write(sys.stdout, "")
    except FootfallError as error:
        _report(error, wants_json)
        return next((code for kind, code in _EXIT if isinstance(error, kind)), 1)
    except (KeyboardInterrupt, Interrupted):
        _report(FootfallError("Interrupted.", "command"), wants_json)
        return INTERRUPTED
    except BrokenPipeError:
        # Whoever read our output is gone; keep the interpreter from complaining about it at its end.
        drop(sys.stdout)
        return 0
    return status


def _log_to(stream: TextIO) -> None:
    """Writes warnings and errors of the log to a stream, unless the log goes somewhere already."""
    if not logging.root.handlers:
        handler = logging.StreamHandler(stream)
        handler.setFormatter(LogFormatter("%(levelname)s %(name)s: %(message)s"))
        logging.basicConfig(level=logging.WARNING, handlers=[handler])


def _report(error: FootfallError, wants_json: bool) -> None:
    if wants_json and error.where != UNWRITABLE:
        write(sys.stdout, json.dumps({"error": error.sentence, "where": error.where}) + "\n")
    else:
        note(error.sentence)
