"""What `pattern` is asked for, as a problem."""

from argparse import ArgumentParser, Namespace
from dataclasses import fields

import numpy as np

from app.cli.common.argument_types import number, rule_number, whole
from core.arrays import Bools
from core.errors import InputError
from core.patterns.problem import (
    LEAST_SAMPLES,
    MOST_LEGS,
    MOST_SAMPLES,
    PatternKind,
    PatternProblem,
    PatternRules,
    free_cells,
    index_halves,
    transition_cells,
)
from core.text.numbers import plain_whole

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

_VALUES = {"swing": 0, "stance": 1}


def add_pattern_options(parser: ArgumentParser) -> None:
    """Adds the options of `pattern`."""
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
    try:
        foot = plain_whole(text)
    except ValueError:
        raise InputError(
            f"--locked has “{text}” where a foot's number belongs; write it such as 1,4.", "--locked"
        ) from None
    if not 1 <= foot <= len(locked):
        raise InputError(f"--locked names foot {foot}; the feet are 1 to {len(locked)}.", "--locked")
    if locked[foot - 1]:
        raise InputError(f"--locked names foot {foot} twice; name it once.", "--locked")
    return foot - 1
