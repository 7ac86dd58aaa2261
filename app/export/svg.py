"""A drawing as SVG."""

import re
from html import escape

from app.export.drawing import Box, Dot, Drawing, Rule, Shape, Trace, Words

FONT = "system-ui, -apple-system, 'Segoe UI', Roboto, 'DejaVu Sans', sans-serif"
_NOT_IN_XML = re.compile(r"[^\t\n\r\u0020-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


def svg(drawing: Drawing, name: str = "diagram") -> str:
    """Writes a drawing as one SVG element that stands alone or within a page.

    Args:
        drawing: what is written.
        name: with which its parts' identifiers begin; another one for each drawing of a page.
    """
    width, height = _number(drawing.width), _number(drawing.height)
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" '
        f'height="{height}" role="img" aria-labelledby="{name}-title {name}-words" font-family="{FONT}">',
        f'<title id="{name}-title">{_text(drawing.title)}</title>',
        f'<desc id="{name}-words">{_text(drawing.description)}</desc>',
        f'<rect width="{width}" height="{height}" fill="{drawing.background}"/>',
        *(_element(shape) for shape in drawing.shapes),
        "</svg>",
    ]
    return "\n".join(lines) + "\n"


def _element(shape: Shape) -> str:
    match shape:
        case Box(x, y, width, height, fill, radius):
            rounded = f' rx="{_number(radius)}"' if radius else ""
            place = f'x="{_number(x)}" y="{_number(y)}"'
            return (
                f'<rect {place} width="{_number(width)}" height="{_number(height)}" fill="{fill}"{rounded}/>'
            )
        case Rule(x1, y1, x2, y2, colour, width):
            ends = f'x1="{_number(x1)}" y1="{_number(y1)}" x2="{_number(x2)}" y2="{_number(y2)}"'
            return f'<line {ends} stroke="{colour}" stroke-width="{_number(width)}"/>'
        case Trace(points, colour, width):
            places = " ".join(f"{_number(x)},{_number(y)}" for x, y in points)
            return (
                f'<polyline points="{places}" fill="none" stroke="{colour}" stroke-width="{_number(width)}" '
                'stroke-linejoin="round" stroke-linecap="round"/>'
            )
        case Dot(x, y, radius, fill):
            return f'<circle cx="{_number(x)}" cy="{_number(y)}" r="{_number(radius)}" fill="{fill}"/>'
        case Words(x, y, text, size, colour, anchor, bold):
            weight = ' font-weight="650"' if bold else ""
            return (
                f'<text x="{_number(x)}" y="{_number(y)}" font-size="{_number(size)}" fill="{colour}" '
                f'text-anchor="{anchor}"{weight}>{_text(text)}</text>'
            )


def _number(value: float) -> str:
    return f"{value:.2f}".rstrip("0").rstrip(".")


def _text(words: str) -> str:
    """Text for XML; characters that XML cannot hold become the replacement character."""
    return escape(_NOT_IN_XML.sub("\ufffd", words), quote=True)
