"""From the text of a CSV to rows of cells, in whatever dialect a spreadsheet or pandas wrote it.

Read is what is unambiguous: commas, or in every row semicolons, tabs or blanks, then also with a decimal
comma; quotes; a first column that counts the rows or has no name; empty columns at the right, and
empty rows at the end.
What is unusual for the lab's programs is said in `notes`.
"""

import csv
import math
import re
import sys
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from core.arrays import Floats
from core.errors import InputError
from core.text.decoding import MARK, without_mark
from core.text.numbers import number_fault, plain_number, reads_plainly, shortened

_SEP_LINE = re.compile(r'"?sep=([,;\t| ])"?[ \t]*', re.IGNORECASE)
"""A first line by which Excel is told what stands between the cells."""
_OTHER_ENDS = {
    "\r": "carriage return",
    "\x0c": "form feed",
    "\x85": "next line (U+0085)",
    "\u2028": "line separator (U+2028)",
    "\u2029": "paragraph separator (U+2029)",
}
_OTHER_END = re.compile(f"[{''.join(_OTHER_ENDS)}]")
_SIGN_NAMES = {";": ";", "\t": "tabs", " ": "blanks", ",": ",", "|": "|"}
_BEHIND_COMMA = re.compile(r"[0-9]+(?:[eE][+-]?[0-9]+)?")
_WAY_OUT = "Write decimal points, or ; between the numbers"
_COUNTED = "The first column counts the rows and was left out."
_NAMELESS = "The first column has no name and was left out."
_SECOND = re.compile(r"1|(?:.*\D)?2")
"""The name of a second column, so that the name that is missing before it is the first one's."""
_OTHERS = "other numbers have a decimal comma; use one of them"
_SEPARATE = " Separate the numbers by commas, and write decimal points."


@dataclass(frozen=True, eq=False)
class Table:
    """Rows of cells.

    Args:
        name: of the file, for messages.
        rows: of cells, as they stand in the file.
        lines: the line of each row, counted from 1.
        notes: sentences on what was unusual in the file's form.
        has_decimal_comma: whether the numbers have a comma for a decimal point.
        simple_from: row from which on `float` reads no cell that is not plain.
        columns_left_out: columns of the file before the first cell of each row.
    """

    name: str
    rows: list[list[str]]
    lines: Sequence[int]
    notes: tuple[str, ...] = ()
    has_decimal_comma: bool = False
    simple_from: int = sys.maxsize
    columns_left_out: int = 0

    @property
    def head(self) -> list[str]:
        """The cells of the first row up to the last one with words, without blanks around them."""
        return [cell.strip() for cell in self.rows[0][: _filled(self.rows[0])]] if self.rows else []

    def numbers(self, first: int, width: int | None = None, *, has_gaps: bool = False) -> Floats:
        """The numbers from a row on.

        Args:
            first: row with which they begin.
            width: how many numbers a row has; None where the first row says.
            has_gaps: whether an empty cell is a number that is not known.

        Returns:
            (rows, width); nan where a cell is empty. Empty columns at the right are left out.

        Raises:
            InputError: naming line and column of the first thing that is wrong.
        """
        rows = _without_empty_columns(self.rows[first:], width)
        wanted = width or (len(rows[0]) if rows else 0)
        is_simple = first >= self.simple_from
        values: list[float] = []
        for index, row in enumerate(rows, first):
            if width is not None and len(row) != width and any(map(str.strip, row)):
                raise self._other_width(index, len(row), wanted, f"a row has {width}")
            numbers = _floats(row, has_gaps=has_gaps) if is_simple else None
            values += self._read(row, index, has_gaps=has_gaps) if numbers is None else numbers
            if len(row) != wanted:
                raise self._other_width(index, len(row), wanted, f"the lines before have {wanted}")
        table = np.array(values, dtype=np.float64).reshape(len(rows), wanted)
        for row, column in np.argwhere(np.isinf(table))[:1].tolist():
            raise self.refusal(first + row, column, number_fault(rows[row][column]))
        return table

    def refusal(self, row: int, column: int, fault: str) -> InputError:
        """What a cell is refused with.

        Args:
            row: of the cell, 0-based.
            column: of the cell, 0-based.
            fault: what is wrong, as a clause.
        """
        cell, place = self.rows[row][column], f"{self.name}:{self.lines[row]}"
        if not any(map(str.strip, self.rows[row])):
            fault += "; the row is empty, delete it"
        elif row > 0 and len(self.rows[row]) > 1 and all(one.strip()[:1].isalpha() for one in self.rows[row]):
            fault += "; only the first line may hold words"
        parts = re.split(r"[; \t]+", cell.strip("; \t"))
        help_ = _SEPARATE if len(parts) > 1 and all(map(_is_plain, parts)) else ""
        return InputError(f"{place}, column {column + 1 + self.columns_left_out}: {fault}.{help_}", place)

    def header_refusal(self, wanted: str, names: Sequence[str]) -> InputError:
        """What the first row is refused with.

        Args:
            wanted: what it must read.
            names: the cells that it must have; where it differs from them first is said.
        """
        line = self.lines[0] if self.rows else 1
        head = self.head
        found = f"it reads “{shortened(', '.join(head))}”" if head else "it is empty"
        pairs = enumerate(zip(head, names, strict=False), 1 + self.columns_left_out)
        other = next((pair for pair in pairs if pair[1][0].lower() != pair[1][1].lower()), None)
        if other is not None:
            column, (cell, name) = other
            found += f", in column {column} “{shortened(cell)}” in place of “{name}”"
        elif head:
            found += f" and has {len(head)} columns"
        return InputError(
            f"{self.name}, line {line}: the header must read {wanted}; {found}.", f"{self.name}:{line}"
        )

    def _other_width(self, row: int, width: int, wanted: int, rule: str) -> InputError:
        line = self.lines[row]
        numbers = "1 number" if width == 1 else f"{width} numbers"
        hint = f" {_WAY_OUT}, if there are decimal commas." if width == 2 * wanted else ""
        return InputError(f"{self.name}, line {line}: {numbers}; {rule}.{hint}", f"{self.name}:{line}")

    def _read(self, row: list[str], index: int, *, has_gaps: bool) -> list[float]:
        return [self.number(index, column, has_gaps=has_gaps) for column in range(len(row))]

    def number(self, row: int, column: int, *, has_gaps: bool = False) -> float:
        """The number in a cell; nan where it is empty and the table has gaps.

        Raises:
            InputError: naming line and column, it is none.
        """
        cell = self.rows[row][column]
        if has_gaps and not cell.strip(" \t"):
            return math.nan
        if self.has_decimal_comma and "." in cell:
            raise self.refusal(row, column, f"“{cell}” has a decimal point, {_OTHERS}")
        try:
            return plain_number(cell.replace(",", ".") if self.has_decimal_comma else cell)
        except ValueError:
            raise self.refusal(row, column, number_fault(cell)) from None

    def without_count(self, first: int = 1) -> "Table":
        """The table without a first column that counts the rows from one on; itself where there is none.

        Args:
            first: row with which the count begins.
        """
        if not _counts([row[0] for row in self.rows[first:]]):
            return self
        is_headed = first > 0 and len(self.rows[0]) == len(self.rows[first])
        return self._without_first_column(0 if is_headed else first, _COUNTED)

    def without_index(self) -> "Table":
        """The table without a first column that its header shows to be an index: it has no name there.

        Raises:
            InputError: the name that is missing may be that of a column of numbers.
        """
        if len(self.rows) < 2:
            return self
        head, cells = self.head, [row[0] for row in self.rows[1:]]
        is_one_more = len(self.rows) > 3 and {len(row) for row in self.rows[1:]} == {len(head) + 1}
        is_nameless = len(head) > 1 and head[0] in ("", "Unnamed: 0") and _are_names(head[1:])
        if (is_nameless or is_one_more) and _counts(cells):
            return self._without_first_column(0 if is_nameless else 1, _COUNTED)
        if not is_nameless:
            return self
        if head[0] == "" and _SECOND.fullmatch(head[1]):
            place = f"{self.name}:{self.lines[0]}"
            raise InputError(
                f"{place}, column 1: the first column has no name, so that it may be an index or numbers. "
                "Write its name, or take the column out.",
                place,
            )
        return self._without_first_column(0, _NAMELESS)

    def _without_first_column(self, first: int, note: str) -> "Table":
        rows = [row[1:] if index >= first else row for index, row in enumerate(self.rows)]
        left_out = self.columns_left_out + 1
        return replace(self, rows=rows, notes=(*self.notes, note), columns_left_out=left_out)


def read_table(text: str, name: str, *, has_empty_rows: bool = False) -> Table:
    """Reads a CSV.

    Args:
        text: the file's text.
        name: the file's name, for messages.
        has_empty_rows: whether a row of empty cells at the end says something.

    Raises:
        InputError: quotes or line ends in it are damaged, it is JSON, or commas stand both between numbers
            and in them.
    """
    if text.lstrip(f"{MARK} \t\r\n").startswith("{"):
        raise InputError(f"{name} holds JSON; a table of numbers is wanted here.", name)
    notes: list[str] = []
    text = _with_one_line_end(without_mark(text), name, notes)
    lines = text.split("\n")
    while lines and not lines[-1].strip(" "):
        lines.pop()
    told = _SEP_LINE.fullmatch(lines[0]) if lines else None
    begin = 0 if told is None else 1
    lines = lines[begin:]
    sign = _sign_between(text, lines) if told is None else told[1]
    rows, numbers = _cells(lines, sign, begin + 1, name)
    if rows and all(len(row) == 1 and "," in row[0] for row in rows):
        why = f"line 1 says that {sign} stands between the cells, and it is a comma. Take that line out"
        if sign == ",":
            why = "each row stands in one pair of quotes as a whole. Take the quotes out"
        raise InputError(f"{name}: {why}.", f"{name}:1")
    if not has_empty_rows:
        _drop_empty(rows, notes)
    if sign == ",":
        _require_points(rows, numbers, name)
    has_decimal_comma = sign != "," and any("," in cell for row in rows[1:] or rows for cell in row)
    if sign != "," or told is not None:
        comma = " and a decimal comma" if has_decimal_comma else ""
        notes.insert(0, f"Read with {_SIGN_NAMES[sign]} between the numbers{comma}.")
    simple_from = sys.maxsize if has_decimal_comma else _simple_from(text)
    table = Table(name, rows, numbers, tuple(notes), has_decimal_comma, simple_from)
    return table.without_index()


def _simple_from(text: str) -> int:
    """Row from which on `float` reads no cell that is no plain number."""
    if '"' in text:
        return sys.maxsize
    return next(
        (row for row in (0, 1) if reads_plainly(text.split("\n", 1)[-1] if row else text)), sys.maxsize
    )


def _floats(row: list[str], *, has_gaps: bool) -> list[float] | None:
    """The numbers of a row, None where a cell is no number."""
    try:
        if has_gaps and "" in row:
            return [float(cell) if cell else math.nan for cell in row]
        return list(map(float, row))
    except ValueError:
        return None


def _with_one_line_end(text: str, name: str, notes: list[str]) -> str:
    text = text.replace("\r\r\n", "\n").replace("\r\n", "\n") if "\r" in text else text
    if "\r" in text and "\n" not in text:
        notes.append("Read with carriage returns as the ends of lines.")
        text = text.replace("\r", "\n")
    found = _OTHER_END.search(text)
    if found is None:
        return text
    line = text.count("\n", 0, found.start()) + 1
    raise InputError(
        f"{name}, line {line}: a {_OTHER_ENDS[found[0]]} stands within the line. End every line in the "
        "same way, by a line feed.",
        f"{name}:{line}",
    )


def _sign_between(text: str, lines: list[str]) -> str:
    """What stands between the cells: a comma, or another sign that every row has as often."""
    for sign in ";\t":
        if sign not in text or f",{sign}" in text or f"{sign}," in text:
            continue
        filled = [line for line in lines if line.strip(f"{sign} ")]
        every, inner = (
            {line.count(sign) for line in found} for found in (filled, [x.rstrip(sign) for x in filled])
        )
        if 0 not in every and (len(every) == 1 or len(inner) == 1 or "," not in text):
            return sign
    if not any(sign in text for sign in ",;\t") and lines:
        counts = {len(line.split()) for line in lines}
        if len(counts) == 1 and counts != {1} and all(map(_is_plain, lines[-1].split())):
            return " "
    return ","


def _cells(lines: list[str], sign: str, begin: int, name: str) -> tuple[list[list[str]], Sequence[int]]:
    """Rows of cells, and the line of each."""
    if sign == " ":
        return [line.split() for line in lines], range(begin, begin + len(lines))
    if not any('"' in line for line in lines):
        return [line.split(sign) for line in lines], range(begin, begin + len(lines))
    rows, numbers = [], []
    reader = csv.reader([f"{line}\n" for line in lines], delimiter=sign, skipinitialspace=True, strict=True)
    number = begin
    try:
        for row in reader:
            rows.append(row or [""])
            numbers.append(number)
            number = begin + reader.line_num
    except csv.Error as error:
        raise InputError(
            f"{name}, line {number}: quotes stand in a cell or are not closed ({error}). Take them out.",
            f"{name}:{number}",
        ) from None
    return rows, numbers


def _drop_empty(rows: list[list[str]], notes: list[str]) -> None:
    """Takes rows of empty cells away from the end."""
    count = len(rows)
    while rows and not any(map(str.strip, rows[-1])):
        rows.pop()
    if count > len(rows):
        empty = count - len(rows)
        notes.append(f"{empty} empty {'row' if empty == 1 else 'rows'} at the end were left out.")


def _require_points(rows: list[list[str]], lines: Sequence[int], name: str) -> None:
    """Raises InputError where each number seems to be two: what is before and behind a decimal comma."""
    body = rows[1:] or rows
    if not body or any("." in cell for cell in body[0]):
        return
    behind = [cell for row in body for cell in row[1::2]]
    is_doubled = all(len(row) % 2 == 0 for row in body) and all(map(_BEHIND_COMMA.fullmatch, behind))
    if is_doubled and any(cell[0] == "0" and cell[1:2].isdigit() for cell in behind):
        line = lines[-len(body)]
        raise InputError(
            f"{name}, line {line}: commas stand between the numbers and, it seems, for decimal points: "
            f"“{shortened(','.join(body[0]))}”. {_WAY_OUT}.",
            f"{name}:{line}",
        )


def _without_empty_columns(rows: list[list[str]], width: int | None) -> list[list[str]]:
    """Rows without the cells that are empty at the right of every row, or beyond a width."""
    if not any(row and not row[-1].strip() for row in rows):
        return rows
    most = width or max(_filled(row) for row in rows)
    return [row[: max(most, _filled(row))] for row in rows]


def _filled(row: list[str]) -> int:
    """How many cells a row has up to the last one that is not empty."""
    return next((place for place in range(len(row), 0, -1) if row[place - 1].strip()), 0)


def _are_names(cells: list[str]) -> bool:
    """Whether cells of a header are words, or count 0, 1, 2, … as the lab's files do."""
    return not any(map(_is_plain, cells)) or (_counts(cells) and cells[0] in ("0", "1"))


def _counts(cells: list[str]) -> bool:
    """Whether cells are whole numbers, each as much more than the one before: 0, 1, 2, … or 0.0, 2.0, …."""
    try:
        values = [plain_number(cell.replace(",", ".")) for cell in cells]
    except ValueError:
        return False
    if not values or any(value % 1 for value in values):
        return False
    if len(values) == 1:
        return values[0] in (0, 1)
    steps = set(np.diff(values).tolist())
    return len(steps) == 1 and min(steps) > 0


def _is_plain(cell: str) -> bool:
    try:
        plain_number(cell)
    except ValueError:
        return False
    return True
