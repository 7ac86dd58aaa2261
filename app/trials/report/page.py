"""Parts of a report: one HTML file without scripts that opens offline and prints on A4."""

import base64
import time
from collections.abc import Iterable, Mapping, Sequence
from datetime import UTC, datetime
from html import escape

from app.common.version import VERSION
from app.export.drawing import Drawing
from app.export.svg import svg
from core.data.tables import package_files

MINUS = "\u2212"
NET_HEAD = ("net cm", "angle °", "error %")
"""Heads of the columns of a net movement, as on the page."""


def page(title: str, parts: Iterable[str], origin: str) -> str:
    """The file.

    Args:
        title: of the page, plain text.
        parts: HTML.
        origin: where it comes from, plain text.
    """
    style = package_files("app.export").joinpath("page", "report.css").read_text("utf-8")
    head = (
        '<!doctype html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f"<title>{text(title)}</title>\n<style>\n{style}</style>\n</head>\n<body>\n<h1>{text(title)}</h1>\n"
    )
    return f"{head}{chr(10).join(parts)}\n<footer>{text(origin)}</footer>\n</body>\n</html>\n"


def text(words: str) -> str:
    """Plain text as HTML."""
    return escape(words, quote=True)


def number(value: float | None, decimals: int) -> str:
    """A number as people read it; a dash where there is none."""
    if value is None:
        return "–"
    # Adding 0 turns a rounded −0 into 0.
    return f"{round(value, decimals) + 0.0:.{decimals}f}".replace("-", MINUS)


def net_cells(movement: Mapping[str, float]) -> list[str]:
    """The cells of a net movement."""
    return [
        number(movement["net_distance"], 2),
        number(movement["net_angle_deg"], 1),
        number(movement["net_error_percent"], 0),
    ]


def facts(pairs: Iterable[tuple[str, str]]) -> str:
    """Names with their values."""
    return "<dl>" + "".join(f"<dt>{text(name)}</dt><dd>{text(value)}</dd>" for name, value in pairs) + "</dl>"


def table(caption: str, head: Sequence[str], rows: Iterable[tuple[str, Sequence[str]]]) -> str:
    """A table.

    Args:
        caption: plain text.
        head: of the columns, plain text.
        rows: the first cell as HTML, the others as plain text.
    """
    titles = "".join(f'<th scope="col">{text(title)}</th>' for title in head)
    lines = (
        f'<tr><th scope="row">{first}</th>' + "".join(f"<td>{text(cell)}</td>" for cell in cells) + "</tr>"
        for first, cells in rows
    )
    return (
        f"<table><caption>{text(caption)}</caption><thead><tr>{titles}</tr></thead>"
        f"<tbody>{''.join(lines)}</tbody></table>"
    )


def foot_name(foot: int, colours: Sequence[str]) -> str:
    """A foot with its colour, as HTML; 0-based."""
    return f'<span class="foot" style="background:{colours[foot]}"></span>foot {foot + 1}'


def plot(drawing: Drawing, name: str, caption: str) -> str:
    """A drawing within the page; each needs a name of its own."""
    return f"<figure>{svg(drawing, name)}<figcaption>{text(caption)}</figcaption></figure>"


def photo(jpeg: bytes, caption: str) -> str:
    """A picture within the page."""
    data, words = base64.b64encode(jpeg).decode(), text(caption)
    picture = f'<img src="data:image/jpeg;base64,{data}" alt="{words}">'
    return f"<figure>{picture}<figcaption>{words}</figcaption></figure>"


def moment(seconds: float) -> str:
    """A moment in s since the epoch, as clocks show it where the studio runs."""
    return datetime.fromtimestamp(seconds, UTC).astimezone().strftime("%Y-%m-%d %H:%M")


def footer() -> str:
    """Which program wrote a report, and when."""
    return f"Written by Footfall Studio {VERSION}, {moment(time.time())}."
