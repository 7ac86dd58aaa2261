"""Figures that documents quote, compared with the JSON of their commands."""

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from decimal import Decimal
from typing import Any

from app.bench.quoted_figures import NUMBER, Figure, Quotation, plain
from app.common.json import Json

NEAR = 0.1
"""A figure that is near its value is off by at most this share of itself."""

_STEP = re.compile(r"\.?([^.\[\]]+)|\[([^\]]*)\]")
_PLACES = re.compile(r"(\d+)(?::(\d+))?")
_SUMMARIES: dict[str, Callable[[list[Any]], Any]] = {"min": min, "max": max, "sum": sum, "count": len}


@dataclass(frozen=True)
class Difference:
    """A figure that its command does not print again.

    Args:
        file: the document.
        line: of the figure.
        figure: as it stands there.
        printed: what the command prints now, or why it prints nothing.
        command: that prints it.
    """

    file: str
    line: int
    figure: str
    printed: str
    command: str


def lost_figures(quotation: Quotation) -> list[Difference]:
    """The figures that the text above a comment has no more, or not as often as rules name them."""
    return [
        _difference(quotation, quotation.line, figure.text, "not in the text above")
        for figure in quotation.figures
        if not figure.places
    ]


def differences(quotation: Quotation, content: Json) -> list[Difference]:
    """The figures of the text that a command's JSON does not have as they are quoted."""
    if "error" in content:
        return [_difference(quotation, quotation.line, "every figure", content["error"])]
    return [
        one
        for figure in quotation.figures
        if figure.places
        for one in _differences(quotation, figure, content)
    ]


def _difference(quotation: Quotation, line: int, figure: str, printed: object) -> Difference:
    return Difference(quotation.file, line, figure, str(printed), quotation.command)


def _differences(quotation: Quotation, figure: Figure, content: Json) -> Iterator[Difference]:
    values = selected(content, figure.path)
    line, text = figure.places[0].line, figure.places[0].text
    if figure.summary == "count" or (figure.summary and values):
        if figure.summary != "count" and not all(map(_is_number, values)):
            yield _difference(quotation, line, text, f"not numbers alone at {figure.path}")
            return
        values = [_SUMMARIES[figure.summary](values)]
    if len(values) != len(figure.places):
        kind = "rows of a column" if figure.is_column else "figure"
        said = f"{len(values)} values at {figure.path} for {len(figure.places)} {kind}"
        yield _difference(quotation, line, text, said)
        return
    for place, value in zip(figure.places, values, strict=True):
        scaled = value * figure.factor if _is_number(value) else value
        if not agrees(place.text, scaled, figure.is_near):
            yield _difference(quotation, place.line, place.text, _as_quoted(place.text, scaled))


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def selected(content: Any, path: str) -> list[Any]:
    """Every value at a path of JSON, as `app/bench/quoted_figures.py` describes it."""
    values = [content]
    for name, choice in _STEP.findall(path):
        if name:
            values = [value[name] for value in values if isinstance(value, dict) and name in value]
            continue
        rows = [row for value in values for row in (value if isinstance(value, list) else [value])]
        if places := _PLACES.fullmatch(choice):
            first = int(places[1])
            values = rows[first : int(places[2] or first + 1)]
        else:
            key, _, wanted = choice.partition("=")
            values = [row for row in rows if choice == "*" or _has(row, key, wanted)]
    return values


def _has(row: Any, key: str, wanted: str) -> bool:
    return isinstance(row, dict) and key in row and wanted in ("", plain(str(row[key])))


def agrees(text: str, value: Any, is_near: bool = False) -> bool:
    """True where a figure is a value to the digits that it has, or the same text, or that text's number.

    Args:
        text: of a document; with several numbers it agrees with the same text alone.
        value: of a command's JSON.
        is_near: whether a tenth more or less is the same.
    """
    if value is None or value == "":
        return text == "–"
    if isinstance(value, bool):
        return text == ("yes" if value else "no")
    number = _decimal(text)
    if isinstance(value, str):
        return plain(value) in (text, str(number))
    if number is None or not _is_number(value):
        return False
    allowed = 0.5 * 10.0 ** _exponent(number) * (1.0 + 1e-9) + 1e-12 * abs(value)
    if is_near:
        allowed += NEAR * abs(float(number))
    return bool(abs(value - float(number)) <= allowed)


def _decimal(text: str) -> Decimal | None:
    """The number of a figure that has one and no more."""
    numbers = NUMBER.findall(text)
    return Decimal(numbers[0].replace(",", "")) if len(numbers) == 1 else None


def _exponent(number: Decimal) -> int:
    exponent = number.as_tuple().exponent
    return exponent if isinstance(exponent, int) else 0


def _as_quoted(text: str, value: Any) -> str:
    """A value with as many digits as a figure."""
    number = _decimal(text)
    if not _is_number(value) or number is None:
        return str(value)
    exponent = _exponent(number)
    return f"{value:.{-exponent}f}" if -6 <= exponent <= 0 else f"{value:.0e}"
