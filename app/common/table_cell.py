"""Cells of exported tables: texts that a spreadsheet would run as formulas are marked as text."""

import csv
import io
import re

_NUMBER = re.compile(r" *[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?\s*", re.ASCII | re.IGNORECASE)
_FORMULA = re.compile(r"'*([\t\r\n]|[\s\ufeff]*[=+\-@＝＋－＠])")


def table_cell(text: str) -> str:
    """A cell that a spreadsheet shows as it stands: an apostrophe goes before what would begin a formula.

    Numbers stay numbers, also negative ones. A text that begins with apostrophes before a formula gets one
    more, so that taking one away gives every text back (`app/static/lib/table_cell.js`).
    """
    return f"'{text}" if _FORMULA.match(text) and not _NUMBER.fullmatch(text) else text


def safe_header(text: str) -> str:
    """A CSV whose first line begins no formula; every other byte stays as it is.

    Args:
        text: of the file; below the header it holds numbers.
    """
    line, end, rest = text.partition("\n")
    header = line.removesuffix("\r")
    cells = next(csv.reader([header.replace("\r", " ")]), [])
    safe = [cell if cell.startswith("'") else table_cell(cell) for cell in cells]
    if safe == cells and "\r" not in header:
        return text
    written = io.StringIO()
    csv.writer(written, lineterminator="").writerow(safe)
    return written.getvalue() + ("\r" if line.endswith("\r") else "") + end + rest
