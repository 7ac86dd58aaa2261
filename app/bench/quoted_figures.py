"""Figures that the documents quote, compared with what their commands print now.

A comment below a paragraph or a table of a Markdown file names the command of its figures, and where each of
them stands in that command's JSON:

    <!-- footfall frontier walk --margin 0.003 --json
    28.5 mm = max_step * 1000
    -->

On the left stands a figure as the text has it, or the heading of a table's column. Each rule takes the first
such place that no rule has taken. With `=` the command has to print it to its last digit; with `~`, for
searches that end elsewhere on another processor, within a tenth. Of a figure with several numbers the command
has to print the same text. Other numbers of that paragraph or table are listed as not compared.

In a path, `[own gait]` are the rows that have this key, `[gait=walk]` those in which it has this value, `[0]`
is the first one, `[0:5]` are the first five, and `[*]` are all. `min`, `max`, `sum` or `count` before it make
one figure of several.
`slow:` before the command marks one that is not quick; `machine:` one whose figures depend on the machine, or
a test that compares them itself, so that none are listed.
"""

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from enum import StrEnum
from itertools import groupby, takewhile
from pathlib import Path
from typing import Self

from core.errors import InputError

FOLDER = "FOLDER"
"""Stands in a command for the folder of the published data."""

_COMMENT = re.compile(r"<!-- (?:(slow|machine): )?((?:footfall|python) [^\n]*?)\s*(?:\n(.*?))?-->", re.DOTALL)
_ANY_COMMENT = re.compile(r"<!--.*?(?:-->|\Z)", re.DOTALL)
_RULE = re.compile(
    r"(?P<text>.+?) (?P<sign>[=~]) (?:(?P<of>min|max|sum|count) )?"
    r"(?P<path>\S.*?)(?: \* (?P<factor>\d+(?:\.\d+)?))?"
)
NUMBER = re.compile(r"(?<!\w)-?\d+(?:,\d{3})*(?:\.\d+)?(?:e-?\d+)?")
_NUMBER_OR_DAY = re.compile(rf"(?!^\d+\. )(?:\d{{4}}-\d\d-\d\d|{NUMBER.pattern})")
_CELL = re.compile(r"(?<=\|)[^|]*(?=\|)")


class Kind(StrEnum):
    """A quick command is always run, a slow one where its benchmark is named, and the machine's never."""

    QUICK = "quick"
    SLOW = "slow"
    MACHINE = "machine"


@dataclass(frozen=True)
class Place:
    """A figure or a cell in a document.

    Args:
        line: from 1.
        begin: column of its first character, from 0.
        end: column after its last one.
        text: without the blanks around it.
    """

    line: int
    begin: int
    end: int
    text: str

    def overlaps(self, other: Self) -> bool:
        """True where both have a character in common."""
        return self.line == other.line and self.begin < other.end and other.begin < self.end


@dataclass(frozen=True)
class Figure:
    """A figure of the text, or the cells of a column, and where its command prints it.

    Args:
        text: of the rule.
        places: one, or the cells of a column from the first row on; none where the text has it no more.
        is_column: whether these are a column's cells, one for each value.
        path: in the command's JSON.
        summary: how several values become one; empty for none.
        factor: from the command's unit to the text's.
        is_near: whether a tenth more or less is the same.
    """

    text: str
    places: tuple[Place, ...]
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
class Uncompared:
    """Numbers of a line that no rule takes, though other figures of its paragraph or table are compared.

    Args:
        file: the document.
        line: from 1.
        numbers: as they stand there.
    """

    file: str
    line: int
    numbers: tuple[str, ...]


@dataclass(frozen=True)
class Document:
    """A document's commands, and the numbers beside their figures.

    Args:
        quotations: in the order of the text.
        uncompared: in the order of the text.
    """

    quotations: tuple[Quotation, ...]
    uncompared: tuple[Uncompared, ...]


def read_documents(root: Path) -> list[Document]:
    """README and the pages of a source tree.

    Raises:
        InputError: they are not there, as in an installed program; or a comment has another form.
    """
    if not (root / "docs" / "figures.md").exists():
        raise InputError(
            "The documents do not come with the installed program; run `python -m app bench --docs` in its "
            "source tree.",
            "--docs",
        )
    paths = [root / "README.md", *sorted(root.glob("docs/*.md"))]
    return [read_document(str(path.relative_to(root)), path.read_text(encoding="utf-8")) for path in paths]


def read_document(file: str, text: str) -> Document:
    """The commands of one document, and the numbers beside their figures.

    Raises:
        InputError: a comment has another form, or names a table's column that cannot be compared.
    """
    lines = plain(_ANY_COMMENT.sub(lambda comment: "\n" * comment[0].count("\n"), text)).split("\n")
    blocks: dict[int, _Block] = {}
    found = []
    for comment in _ANY_COMMENT.finditer(text):
        line = text.count("\n", 0, comment.start()) + 1
        match = _COMMENT.fullmatch(comment[0])
        if match is None:
            raise _refusal(file, line, "a comment must begin with a command: <!-- footfall … --json")
        kind = Kind(match[1] or Kind.QUICK)
        rules = [rule.strip() for rule in (match[3] or "").splitlines() if rule.strip()]
        if (kind is Kind.MACHINE) != (not rules):
            raise _refusal(file, line, f"a command with {len(rules)} figures cannot be {kind.value}")
        figures = []
        if rules:
            begin, end = _bounds(lines, line)
            block = blocks.setdefault(begin, _Block(lines[begin:end], begin + 1))
            figures = [_figure(file, line, rule, block) for rule in rules]
        found.append(Quotation(file, line, kind, match[2], tuple(figures)))
    numbers = [Uncompared(file, *left) for block in blocks.values() for left in block.numbers_left()]
    return Document(tuple(found), tuple(numbers))


def _refusal(file: str, line: int, words: str) -> InputError:
    return InputError(f"{file}, line {line}: {words}.", f"{file}:{line}")


def plain(text: str) -> str:
    """Text without emphasis, with a plain minus."""
    return text.replace("**", "").replace("−", "-")


def _bounds(lines: Sequence[str], end: int) -> tuple[int, int]:
    """First line and the one after the last, from 0, of the paragraph or table above a line."""
    while end > 0 and not lines[end - 1].strip():
        end -= 1
    begin = end
    while begin > 0 and lines[begin - 1].strip():
        begin -= 1
    return begin, end


class _Block:
    """A paragraph or a table, whose figures the rules take one after the other.

    Args:
        lines: its plain text.
        first: number of its first line, from 1.
    """

    def __init__(self, lines: Sequence[str], first: int) -> None:
        self.lines = list(enumerate(lines, first))
        self.taken: list[Place] = []

    def take_text(self, text: str) -> tuple[Place, ...]:
        """The first place of a text that is left, or none."""
        pattern = re.compile(rf"(?<![\w.,-]){re.escape(text)}(?!\w|[.,]\d)")
        for place in self._places(pattern):
            if self._is_left(place):
                self.taken.append(place)
                return (place,)
        return ()

    def take_column(self, heading: str) -> tuple[Place, ...]:
        """The cells below the first such heading of a table that is left, or none.

        Raises:
            ValueError: the column has no cells, or rows have more or fewer than the headings.
        """
        rows = [[*_in_line(_CELL, number, line)] for number, line in self.lines if line.startswith("|")]
        for index, cell in enumerate(rows[0] if rows else ()):
            if cell.text == heading and self._is_left(cell):
                if len(rows) < 3 or any(len(row) != len(rows[0]) for row in rows):
                    raise ValueError(f"the table has no whole column “{heading}”")
                cells = [row[index] for row in rows[2:]]
                if all(map(self._is_left, cells)):
                    self.taken += [cell, *cells]
                    return tuple(cells)
        return ()

    def numbers_left(self) -> Iterator[tuple[int, tuple[str, ...]]]:
        """Each line with numbers that no rule took, and these."""
        left = [place for place in self._places(_NUMBER_OR_DAY) if self._is_left(place)]
        for line, places in groupby(left, lambda place: place.line):
            yield line, tuple(place.text for place in places)

    def _places(self, pattern: re.Pattern[str]) -> Iterator[Place]:
        return (place for number, line in self.lines for place in _in_line(pattern, number, line))

    def _is_left(self, place: Place) -> bool:
        return not any(map(place.overlaps, self.taken))


def _in_line(pattern: re.Pattern[str], number: int, line: str) -> Iterator[Place]:
    return (Place(number, *match.span(), match[0].strip()) for match in pattern.finditer(line))


def _figure(file: str, line: int, rule: str, block: _Block) -> Figure:
    match = _RULE.fullmatch(plain(rule))
    if match is None:
        raise _refusal(file, line, f"“{rule}” is neither “figure = path” nor “figure ~ path”")
    text = match["text"]
    try:
        column = block.take_column(text)
    except ValueError as error:
        raise _refusal(file, line, str(error)) from None
    places = column or block.take_text(text)
    factor = float(match["factor"] or 1.0)
    return Figure(text, places, bool(column), match["path"], match["of"] or "", factor, match["sign"] == "~")
