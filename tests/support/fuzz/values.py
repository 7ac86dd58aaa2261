"""Values that break programs, changes of JSON documents, and texts that `json` would not write."""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from dataclasses import dataclass
from random import Random
from typing import Any


@dataclass(frozen=True)
class Raw:
    """JSON text that is put in as it stands, such as NaN or a number of 5,000 digits."""

    text: str


@dataclass(frozen=True)
class Pairs:
    """An object with its keys in order, which may stand there twice."""

    items: tuple[tuple[str, Any], ...]


def encoded(value: Any) -> str:
    """The value as JSON text; halves of characters are escaped."""
    if isinstance(value, Raw):
        return value.text
    if isinstance(value, Pairs):
        return "{" + ",".join(f"{json.dumps(key)}:{encoded(one)}" for key, one in value.items) + "}"
    if isinstance(value, dict):
        return encoded(Pairs(tuple(value.items())))
    if isinstance(value, list | tuple):
        return "[" + ",".join(encoded(one) for one in value) + "]"
    return json.dumps(value)


def nested(opening: str, closing: str, depth: int = 100_000) -> Raw:
    """Something in something in something."""
    return Raw(opening * depth + "0" + closing * depth)


NUMBERS: tuple[Any, ...] = (
    *(0, -1, 1, 2, 3, 7, 50, 51, 1000, 10**6, 2**31, 2**53 + 1, 2**63, 2**64, 2**70, -(2**63) - 1, -(2**70)),
    *(0.1, -0.0, 1e-9, 1e-300, 5e-324, 0.5, 1.5, -0.02, 1e9, 1e18, 1e300, -1e300),
    *(
        Raw(text)
        for text in ("NaN", "Infinity", "-Infinity", "1e308", "-1e308", "1e400", "-1e400", "9" * 5000)
    ),
)

TEXTS: tuple[str, ...] = (
    *("", " ", "0", "-1", "a", "²", "١٢", "NaN", "1e999", str(2**70), "9999-12-31", "0001-01-01", "None"),
    *(
        "\0",
        "a\0b",
        "\ud800",
        "a\udc00b",
        "\ud83d",
        "\u200b",
        "\u2060\u3164",
        "\u202egnp",
        "\ufeff",
        "\r\nx: y",
    ),
    *(
        "../../../../etc/passwd",
        "..\\..\\x",
        "/etc/passwd",
        "/dev/zero",
        "/",
        ".",
        "..",
        "~",
        "con",
        "a/b",
        "a%2fb",
    ),
    *(
        "=1+1",
        "@x",
        "-2+3",
        "\t1",
        "%s%n%x",
        "%00",
        "{{7*7}}",
        "${x}",
        "'; DROP TABLE gaits;--",
        "<script>1</script>",
    ),
    *("💥" * 40, "e\u0301" * 60, "x" * 81, "x" * 121, "x" * 201, "x" * 5000, "é" * 70_000),
)

CONTAINERS: tuple[Any, ...] = (
    *(True, False, None, [], {}, [[]], [None], [[[]]], {"": None}, {"__proto__": {"a": 1}}, {"$ref": "#"}),
    *([0] * 5000, [""] * 3000, [[0, 0]] * 2000, ["101010"] * 300, {str(key): key for key in range(1000)}),
)

DEEP = (nested("[", "]"), nested('{"a":', "}"), Raw("[" * 100_000), Raw('{"a":' * 5_000))


def hostile(rng: Random) -> Any:
    """Any value at all."""
    kind = rng.random()
    if kind < 0.02:
        return rng.choice(DEEP)
    if kind < 0.4:
        return rng.choice(NUMBERS)
    return rng.choice(TEXTS if kind < 0.75 else CONTAINERS)


def hostile_text(rng: Random, *, is_number: bool = False) -> str:
    """Any text at all, such as stands in an address.

    Args:
        rng: what chooses.
        is_number: whether a number is wanted there; then it is one more often.
    """
    if rng.random() < (0.7 if is_number else 0.2):
        number = rng.choice(NUMBERS)
        return number.text if isinstance(number, Raw) else str(number)
    return rng.choice(TEXTS)


def mutated(value: Any, rng: Random, times: int | None = None) -> Any:
    """The document with a few changes in some places; the given one stays as it is."""
    for _ in range(rng.choice((1, 1, 1, 2, 3)) if times is None else times):
        value = _changed(value, rng, rng.randrange(9))
    return value


def _changed(value: Any, rng: Random, depth: int) -> Any:
    """One change, in the value or somewhere within it."""
    if depth > 0 and isinstance(value, dict) and value:
        key = rng.choice(list(value))
        return {**value, key: _changed(value[key], rng, depth - 1)}
    if depth > 0 and isinstance(value, list) and value:
        at = rng.randrange(len(value))
        return [*value[:at], _changed(value[at], rng, depth - 1), *value[at + 1 :]]
    changes: list[Callable[[Any, Random], Any]] = [_replaced]
    if isinstance(value, dict):
        changes += [_with_another_key, _with_a_key_twice, _without_a_key]
    elif isinstance(value, list):
        changes += [_longer, _shorter, _shuffled]
    elif isinstance(value, int | float) and not isinstance(value, bool):
        changes += [_nearby, _nearby, _nearby]
    elif isinstance(value, str):
        changes += [_rewritten]
    return rng.choice(changes)(value, rng)


def _replaced(value: Any, rng: Random) -> Any:
    del value
    return hostile(rng)


def _with_another_key(value: dict[str, Any], rng: Random) -> Any:
    return {**value, rng.choice(TEXTS): hostile(rng)}


def _with_a_key_twice(value: dict[str, Any], rng: Random) -> Any:
    key = rng.choice([*value, "name"])
    return Pairs((*value.items(), (key, hostile(rng))))


def _without_a_key(value: dict[str, Any], rng: Random) -> Any:
    gone = rng.choice([*value, ""])
    return {key: one for key, one in value.items() if key != gone}


def _longer(value: list[Any], rng: Random) -> Any:
    more = rng.choice((1, 2, 30, 1000))
    return [*value, *[rng.choice(value) if value else hostile(rng)] * more]


def _shorter(value: list[Any], rng: Random) -> Any:
    return value[: rng.randrange(len(value) + 1)]


def _shuffled(value: list[Any], rng: Random) -> Any:
    return rng.sample(value, len(value))


def _nearby(value: float, rng: Random) -> Any:
    """A number beside this one: near-valid values find more than wild ones."""
    if isinstance(value, int):
        beside = (value + 1, value - 1, -value, 2 * value, value * 1000, value + 0.5, str(value))
        return rng.choice((*beside, 0, -1, 2**31, 2**53, 2**63, 2**70))
    near = math.nextafter(value, math.inf)
    return rng.choice((near, -value, value * 2, value * 10, value / 1000, value * 1e6, value + 1, str(value)))


def _rewritten(value: str, rng: Random) -> Any:
    at = rng.randrange(len(value) + 1)
    word = rng.choice(TEXTS)
    return rng.choice(
        (value.upper(), value + word, value[:at] + word + value[at:], value[:at], [value], value * 50)
    )
