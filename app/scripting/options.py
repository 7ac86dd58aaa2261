"""Keyword arguments as the options of a command, so that both say and refuse the same."""

from argparse import Namespace
from collections.abc import Iterable
from difflib import get_close_matches
from typing import Any

import numpy as np

from app.cli.parser import make_parser, option_names
from core.errors import InputError


def command_options(
    command: str, words: Iterable[str] = (), without: Iterable[str] = (), **options: Any
) -> Namespace:
    """What a command is asked by keyword arguments.

    Args:
        command: such as `optimise`.
        words: its arguments that are no options.
        without: options of the command that mean nothing here.
        options: by the names of the command line, with underscores; None for one that is left out, True for
            one without a value, and a sequence where the command line has commas.

    Raises:
        InputError: there is no such option, or its value does not fit.
    """
    known = option_names(command) - set(without)
    for name in options:
        if name not in known:
            near = get_close_matches(name, known, 1)
            hint = f" Did you mean “{near[0]}”?" if near else f" Choose among {', '.join(sorted(known))}."
            raise InputError(f"{command} has no option “{name}”.{hint}", name)
    asked = [word for name, value in options.items() for word in _words(name, value)]
    return make_parser().parse_args([command, *asked, *(["--", *words] if words else [])])


def _words(name: str, value: Any) -> list[str]:
    option = f"--{name.replace('_', '-')}"
    if value is None or (isinstance(value, bool | np.bool_) and not value):
        return []
    return [option] if isinstance(value, bool | np.bool_) else [f"{option}={_text(value)}"]


def _text(value: Any) -> str:
    if isinstance(value, np.ndarray):
        value = value.tolist()
    if isinstance(value, list | tuple):
        return ",".join(map(_text, value))
    return repr(float(value)) if isinstance(value, float) else str(value)
