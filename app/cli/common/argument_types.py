"""The types of arguments: numbers within bounds, words of a closed set, and what a refusal says of them."""

import argparse
from collections.abc import Callable
from enum import StrEnum
from typing import TypeVar

from core.patterns.problem import MOST_SAMPLES
from core.pose_gaits.pose_problem import MOST_TURN
from core.robot.model import ROBOT_NAMES
from core.text.numbers import plain_number, plain_whole

Value = TypeVar("Value")

ROBOTS = ", ".join(ROBOT_NAMES)


def number(least: float, most: float, unit: str) -> Callable[[str], float]:
    """An argument type: a finite number within bounds."""

    def convert(text: str) -> float:
        try:
            value = plain_number(text)
        except ValueError as fault:
            raise argparse.ArgumentTypeError(str(fault)) from None
        if not (least <= value <= most):
            is_mm = unit == "m" and most < value and least <= value / 1000 <= most
            near = f"{value / 1000:.3f}" if round(value / 1000, 3) == value / 1000 else f"{value / 1000:g}"
            hint = f"; it is in m, did you mean {near}?" if is_mm else ""
            raise argparse.ArgumentTypeError(f"{text} must lie between {least} and {most} {unit}{hint}")
        return value

    return convert


def whole(least: int, most: int) -> Callable[[str], int]:
    """An argument type: a whole number within bounds."""

    def convert(text: str) -> int:
        try:
            value = plain_whole(text)
        except ValueError as fault:
            raise argparse.ArgumentTypeError(str(fault)) from None
        if not least <= value <= most:
            raise argparse.ArgumentTypeError(f"{text} must lie between {least} and {most}")
        return value

    return convert


def one_of(kind: type[StrEnum]) -> Callable[[str], StrEnum]:
    """An argument type: one of a closed set of words."""

    def convert(text: str) -> StrEnum:
        try:
            return kind(text)
        except ValueError:
            raise argparse.ArgumentTypeError(f"“{text}” must be one of {', '.join(kind)}") from None

    return convert


def words_of(kind: type[StrEnum]) -> str:
    """A closed set of words as help shows it."""
    return "{" + ",".join(kind) + "}"


def free_or(convert: Callable[[str], float]) -> Callable[[str], float | None]:
    """An argument type: a number, or `free`, which is None."""
    return lambda text: None if text == "free" else convert(text)


def zero_or(convert: Callable[[str], float]) -> Callable[[str], float]:
    """An argument type: a number, or 0, which lies outside its bounds."""

    def converted(text: str) -> float:
        try:
            is_zero = plain_number(text) == 0.0
        except ValueError:
            is_zero = False
        return 0.0 if is_zero else convert(text)

    return converted


def listed(convert: Callable[[str], Value]) -> Callable[[str], tuple[Value, ...]]:
    """An argument type: one or several values of a type, with commas between them."""
    return lambda text: tuple(convert(part.strip()) for part in text.split(","))


def turn_or_side(text: str) -> float | str:
    """An argument type: a turn a cycle in rad, or `left` or `right` for the fastest that way."""
    return text if text in ("left", "right") else number(-MOST_TURN, MOST_TURN, "rad")(text)


def rule_number(text: str) -> int | None:
    """An argument type: a rule's whole number, or off."""
    return None if text == "off" else whole(0, MOST_SAMPLES)(text)


def pair(text: str) -> tuple[float, float]:
    """An argument type: two finite numbers, `X,Y`."""
    parts = text.split(",")
    if len(parts) != 2:
        raise argparse.ArgumentTypeError(f"“{text}” must be two numbers X,Y")
    convert = number(-1.0, 1.0, "m")
    return convert(parts[0]), convert(parts[1])


def pixel(text: str) -> tuple[float, float]:
    """An argument type: a place in a picture, `X,Y`."""
    parts = text.split(",")
    if len(parts) != 2:
        raise argparse.ArgumentTypeError(f"“{text}” must be two numbers X,Y")
    convert = number(-100_000.0, 100_000.0, "px")
    return convert(parts[0]), convert(parts[1])


def foot_order(text: str) -> tuple[int, ...]:
    """An argument type: feet in order, `3,2,4,1`."""
    try:
        return tuple(plain_whole(part) for part in text.split(","))
    except ValueError:
        raise argparse.ArgumentTypeError(f"“{text}” must be feet such as 3,2,4,1") from None


def add_robot(parser: argparse.ArgumentParser, default: str) -> None:
    """The option that names a robot; `default` says what holds without it."""
    parser.add_argument(
        "--robot", type=robot_name, default=None, metavar="NAME", help=f"{ROBOTS} ({default})"
    )


def robot_name(text: str) -> str:
    """An argument type: a robot that comes with the program."""
    if text not in ROBOT_NAMES:
        raise argparse.ArgumentTypeError(f"“{text}” must be one of {ROBOTS}")
    return text
