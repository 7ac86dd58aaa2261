"""How values show themselves in a notebook: small tables and pictures, as HTML."""

from collections.abc import Iterable, Sequence
from html import escape

Cell = str | float | int | None


def table(heads: Sequence[str], rows: Iterable[Sequence[Cell]], caption: str = "") -> str:
    """A table; numbers with four digits, to the right.

    Args:
        heads: of the columns.
        rows: of as many cells.
        caption: above it, plain text.
    """
    head = "".join(f"<th>{escape(one)}</th>" for one in heads)
    body = "".join(f"<tr>{''.join(map(_cell, row))}</tr>" for row in rows)
    title = f"<caption>{escape(caption)}</caption>" if caption else ""
    return f"<table>{title}<thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"


def _cell(value: Cell) -> str:
    if value is None:
        return "<td>–</td>"
    if isinstance(value, float):
        return f'<td style="text-align:right">{value:.4g}</td>'
    return f"<td>{escape(str(value))}</td>"


def paragraph(sentences: Iterable[str]) -> str:
    """Sentences, plain text."""
    text = " ".join(filter(None, sentences))
    return f"<p>{escape(text)}</p>" if text else ""
