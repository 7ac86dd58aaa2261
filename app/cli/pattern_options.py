"""What `pattern` is asked for, as a problem."""

from argparse import Namespace
from dataclasses import fields

import numpy as np

from core.arrays import Bools
from core.errors import InputError
from core.patterns.problem import (
    PatternKind,
    PatternProblem,
    PatternRules,
    free_cells,
    index_halves,
    transition_cells,
)

_VALUES = {"swing": 0, "stance": 1}


def asked_pattern(options: Namespace) -> PatternProblem:
    """The problem that the options describe, with F's sides: the halves of the limbs by number.

    Raises:
        InputError: an option is missing, belongs to the other kind of pattern, or cannot be read.
    """
    return _periodic(options) if options.periodic else _transition(options)


def _rules(options: Namespace) -> PatternRules:
    asked = vars(options)
    return PatternRules(
        **{rule.name: asked[rule.name] for rule in fields(PatternRules) if rule.name in asked}
    )


def _transition(options: Namespace) -> PatternProblem:
    start = _state(options.from_state, "--from", options.legs)
    end = _state(options.to_state, "--to", options.legs)
    locked = np.zeros(options.legs, dtype=bool)
    for part in _parts(options.locked):
        if ":" in part:
            raise InputError(
                f"--locked says “{part}”; in a transition a locked foot keeps its value of --from and --to. "
                f"Write {part.split(':')[0]} alone.",
                "--locked",
            )
        locked[_foot(part, locked)] = True
    cells = transition_cells(start, end, options.samples, locked)
    sides = index_halves(options.legs)
    return PatternProblem(PatternKind.TRANSITION, cells, ~locked, sides, _rules(options))


def _periodic(options: Namespace) -> PatternProblem:
    for state, name in ((options.from_state, "--from"), (options.to_state, "--to")):
        if state is not None:
            raise InputError(
                f"{name} belongs to a transition. Leave it out, or leave out --periodic.",
                name,
            )
    cells = free_cells(options.legs, options.samples)
    locked = np.zeros(options.legs, dtype=bool)
    for part in _parts(options.locked):
        foot, _, value = part.partition(":")
        if value not in _VALUES:
            raise InputError(
                f"--locked says “{part}”; in a periodic gait each locked foot says what it does, such as "
                "1:swing,4:stance.",
                "--locked",
            )
        limb = _foot(foot, locked)
        locked[limb], cells[limb] = True, _VALUES[value]
    sides = index_halves(options.legs)
    return PatternProblem(PatternKind.PERIODIC, cells, ~locked, sides, _rules(options))


def _state(bits: str | None, name: str, legs: int) -> Bools:
    if bits is None:
        raise InputError(
            f"A transition needs {name} with a 1 (stance) or 0 (swing) for each foot, such as {'1' * legs}. "
            "For a gait that repeats itself give --periodic.",
            name,
        )
    if len(bits) != legs:
        raise InputError(
            f"{name} has {len(bits)} characters; it needs one for each of {legs} feet, foot 1 first.", name
        )
    for foot, bit in enumerate(bits, start=1):
        if bit not in "01":
            raise InputError(f"{name} has “{bit}” for foot {foot}; it must be 1 (stance) or 0 (swing).", name)
    return np.array([bit == "1" for bit in bits])


def _parts(text: str | None) -> list[str]:
    return [] if text is None else text.split(",")


def _foot(text: str, locked: Bools) -> int:
    """The index of a foot that is not locked yet."""
    if not (text.isascii() and text.isdigit()):
        raise InputError(
            f"--locked has “{text}” where a foot's number belongs; write it such as 1,4.", "--locked"
        )
    if not 1 <= int(text) <= len(locked):
        raise InputError(
            f"--locked names foot {int(text)}; the feet are 1 to {len(locked)}.",
            "--locked",
        )
    if locked[int(text) - 1]:
        raise InputError(f"--locked names foot {int(text)} twice; name it once.", "--locked")
    return int(text) - 1
