"""Figures that the documents quote, compared with what their commands print now.

A comment below a paragraph or a table of a Markdown file names the command of its figures, and where each of
them stands in that command's JSON:

    <!-- footfall frontier walk --margin 0.003 --json
    28.5 mm = max_step * 1000
    -->

On the left stands a figure as the text has it, or the heading of a table's column. With `=` the command has
to print it to its last digit; with `~`, for searches that end elsewhere on another processor, within a tenth.
In a path, `[own gait]` are the rows that have this key, `[gait=walk]` those in which it has this value, `[0]`
is the first one, and `[*]` are all. `min`, `max`, `sum` or `count` before it make one figure of several.
`slow:` before the command marks one that is not quick; `machine:` one whose figures depend on the machine, or
a test that compares them itself, so that none are listed.
"""

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from decimal import Decimal
from enum import StrEnum
from itertools import takewhile
from pathlib import Path
from typing import Any

from app.common.json import Json
from core.errors import InputError

FOLDER = "FOLDER"
"""Stands in a command for the folder of the published data."""

NEAR = 0.1
"""A figure that is near its value is off by at most this share of itself."""

_COMMENT = re.compile(r"<!-- (?:(slow|machine): )?((?:footfall|python) [^\n]*?)\s*(?:\n(.*?))?-->", re.DOTALL)
_ANY_COMMENT = re.compile(r"<!--")
_RULE = re.compile(
    r"(?P<text>.+?) (?P<sign>[=~]) (?:(?P<of>min|max|sum|count) )?(?P<path>\S.*?)(?: \* (?P<factor>[\d.]+))?"
)
_STEP = re.compile(r"\.?([^.\[\]]+)|\[([^\]]*)\]")
_NUMBER = re.compile(r"-?\d[\d,]*(?:\.\d+)?(?:e-?\d+)?")
_SUMMARIES: dict[str, Callable[[list[Any]], Any]] = {"min": min, "max": max, "sum": sum, "count": len}


class Kind(StrEnum):
    """When a command is run: always, where its benchmark is named, or never, since its figures are times."""

    QUICK = "quick"
    SLOW = "slow"
    MACHINE = "machine"


@dataclass(frozen=True)
class Figure:
    """A figure of the text, or the cells of a column, and where its command prints it.

    Args:
        cells: the line of each and its text; one, or those of a column from the first row on.
        is_column: whether these are a column's cells, one for each value.
        path: in the command's JSON.
        summary: how several values become one; empty for none.
        factor: from the command's unit to the text's.
        is_near: whether a tenth more or less is the same.
    """

    cells: tuple[tuple[int, str], ...]
    is_column: bool
    path: str
    summary: str
    factor: float
    is_near: bool


@dataclass(frozen=True)
class Quotation:
    """A command, and the figures of it that a document quotes.

    Args:
        file: the document, from the program's folder.
        line: of the comment.
        kind: when the command is run.
        command: as a person types it.
        figures: what it prints.
    """

    file: str
    line: int
    kind: Kind
    command: str
    figures: tuple[Figure, ...]

    @property
    def benchmarks(self) -> tuple[str, ...]:
        """Names of the benchmarks that are run."""
        words = self.command.split()
        named = takewhile(lambda word: not word.startswith("-"), words[2:])
        return tuple(named) if words[:2] == ["footfall", "bench"] else ()


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


def documents(root: Path) -> list[Path]:
    """The Markdown files of a source tree that quote figures.

    Raises:
        InputError: they are not there, as in an installed program.
    """
    if not (root / "docs" / "figures.md").exists():
        raise InputError(
            "The documents do not come with the installed program; run `python -m app bench --docs` in its "
            "source tree.",
            "--docs",
        )
    return [root / "README.md", *sorted(root.glob("docs/*.md"))]


def quotations(root: Path) -> list[Quotation]:
    """Every command whose figures the documents quote.

    Raises:
        InputError: there are no documents; or a comment has another form, or names no figure of its text.
    """
    return [
        quotation
        for path in documents(root)
        for quotation in quoted(str(path.relative_to(root)), path.read_text(encoding="utf-8"))
    ]


def quoted(file: str, text: str) -> Iterator[Quotation]:
    """The commands of one document.

    Raises:
        InputError: a comment has another form, or names no figure of its text.
    """
    comments = {match.start(): match for match in _COMMENT.finditer(text)}
    for begin in (match.start() for match in _ANY_COMMENT.finditer(text)):
        line = text.count("\n", 0, begin) + 1
        match = comments.get(begin)
        if match is None:
            raise _refusal(file, line, "a comment must begin with a command: <!-- footfall … --json")
        kind = Kind(match[1] or Kind.QUICK)
        rules = [rule.strip() for rule in (match[3] or "").splitlines() if rule.strip()]
        if (kind is Kind.MACHINE) != (not rules):
            raise _refusal(file, line, f"a command with {len(rules)} figures cannot be {kind.value}")
        block = _block(text.splitlines(), line - 1)
        figures = tuple(_figure(file, line, rule, block) for rule in rules)
        yield Quotation(file, line, kind, match[2], figures)


def _refusal(file: str, line: int, words: str) -> InputError:
    return InputError(f"{file}, line {line}: {words}.", f"{file}:{line}")


def _block(lines: Sequence[str], end: int) -> list[tuple[int, str]]:
    """Lines, from 1, of the paragraph or the table above a comment and the comments before it."""
    while end > 0 and (not lines[end - 1].strip() or lines[end - 1].rstrip().endswith("-->")):
        end -= 1
        if lines[end].rstrip().endswith("-->"):
            while not lines[end].startswith("<!--"):
                end -= 1
    begin = end
    while begin > 0 and lines[begin - 1].strip():
        begin -= 1
    return [(number + 1, _plain(lines[number])) for number in range(begin, end)]


def _plain(text: str) -> str:
    """Text without emphasis, with a plain minus."""
    return text.replace("**", "").replace("−", "-")


def _figure(file: str, line: int, rule: str, block: Sequence[tuple[int, str]]) -> Figure:
    match = _RULE.fullmatch(_plain(rule))
    if match is None:
        raise _refusal(file, line, f"“{rule}” is neither “figure = path” nor “figure ~ path”")
    text = match["text"]
    column = _column(text, block)
    pattern = re.compile(rf"(?<![\d.,-]){re.escape(text)}(?!\d|[.,]\d)")
    cells = column or [(number, text) for number, content in block if pattern.search(content)][:1]
    if not cells:
        raise _refusal(file, line, f"the text above does not have “{text}”")
    factor = float(match["factor"] or 1.0)
    return Figure(tuple(cells), bool(column), match["path"], match["of"] or "", factor, match["sign"] == "~")


def _column(heading: str, block: Sequence[tuple[int, str]]) -> list[tuple[int, str]]:
    """Cells below a heading; none where the block is no table that has it."""
    rows = [(number, _cells(line)) for number, line in block if line.startswith("|")]
    if not rows or heading not in rows[0][1]:
        return []
    index = rows[0][1].index(heading)
    return [(number, cells[index]) for number, cells in rows[2:]]


def _cells(line: str) -> list[str]:
    return [cell.strip() for cell in line.strip().strip("|").split("|")]


def differences(quotation: Quotation, content: Json) -> list[Difference]:
    """The figures that a command's JSON does not have as they are quoted."""
    if "error" in content:
        return [_difference(quotation, quotation.line, "every figure", content["error"])]
    return [one for figure in quotation.figures for one in _differences(quotation, figure, content)]


def _difference(quotation: Quotation, line: int, figure: str, printed: object) -> Difference:
    return Difference(quotation.file, line, figure, str(printed), quotation.command)


def _differences(quotation: Quotation, figure: Figure, content: Json) -> Iterator[Difference]:
    values = selected(content, figure.path)
    if figure.summary and (values or figure.summary == "count"):
        values = [_SUMMARIES[figure.summary](values)]
    if len(values) != len(figure.cells):
        kind = "rows of a column" if figure.is_column else "figure"
        line, text = figure.cells[0]
        said = f"{len(values)} values at {figure.path} for {len(figure.cells)} {kind}"
        yield _difference(quotation, line, text, said)
        return
    for (line, text), value in zip(figure.cells, values, strict=True):
        scaled = value * figure.factor if isinstance(value, int | float) else value
        if not agrees(text, scaled, figure.is_near):
            yield _difference(quotation, line, text, _as_quoted(text, scaled))


def selected(content: Any, path: str) -> list[Any]:
    """Every value at a path of JSON; see this module."""
    values = [content]
    for name, choice in _STEP.findall(path):
        if name:
            values = [value[name] for value in values if isinstance(value, dict) and name in value]
            continue
        rows = [row for value in values for row in (value if isinstance(value, list) else [value])]
        if choice.isdecimal():
            values = rows[int(choice) : int(choice) + 1]
        else:
            key, _, wanted = choice.partition("=")
            values = [row for row in rows if choice == "*" or _has(row, key, wanted)]
    return values


def _has(row: Any, key: str, wanted: str) -> bool:
    return isinstance(row, dict) and key in row and wanted in ("", _plain(str(row[key])))


def agrees(text: str, value: Any, is_near: bool = False) -> bool:
    """Whether a figure is a value, to the digits that it has; a text is one that is the same, or its number.

    Args:
        text: of a document.
        value: of a command's JSON.
        is_near: whether a tenth more or less is the same.
    """
    if value is None:
        return text == "–"
    number = _decimal(text)
    if isinstance(value, str):
        return _plain(value) in (text, str(number))
    if number is None or isinstance(value, bool):
        return text == {True: "yes", False: "no"}.get(value)
    allowed = 0.5 * 10.0 ** _exponent(number) * (1.0 + 1e-9) + 1e-12 * abs(value)
    if is_near:
        allowed += NEAR * abs(float(number))
    return bool(abs(value - float(number)) <= allowed)


def _decimal(text: str) -> Decimal | None:
    match = _NUMBER.search(text)
    return None if match is None else Decimal(match[0].replace(",", ""))


def _exponent(number: Decimal) -> int:
    exponent = number.as_tuple().exponent
    return exponent if isinstance(exponent, int) else 0


def _as_quoted(text: str, value: Any) -> str:
    """A value with as many digits as a figure."""
    number = _decimal(text)
    if value is None or isinstance(value, bool | str) or number is None:
        return str(value)
    exponent = _exponent(number)
    return f"{value:.{-exponent}f}" if -6 <= exponent <= 0 else f"{value:.0e}"
