"""A drawing as PNG."""

import io
from functools import cache

from PIL import Image, ImageDraw, ImageFont

from app.export.drawing import Anchor, Box, Dot, Drawing, Rule, Shape, Trace, Words

SCALE = 2
"""Pixels of the picture a pixel of the drawing."""
FINER = 2
"""Painted so many times larger and then reduced, for smooth edges."""
DOTS_PER_INCH = 96 * SCALE
_ANCHORS = {Anchor.START: "ls", Anchor.MIDDLE: "ms", Anchor.END: "rs"}


def png(drawing: Drawing) -> bytes:
    """Paints a drawing."""
    size = (round(drawing.width * SCALE), round(drawing.height * SCALE))
    image = Image.new("RGB", (size[0] * FINER, size[1] * FINER), drawing.background)
    painter = ImageDraw.Draw(image)
    for shape in drawing.shapes:
        _paint(painter, shape)
    buffer = io.BytesIO()
    reduced = image.resize(size, Image.Resampling.BOX)
    reduced.save(buffer, "PNG", optimize=True, dpi=(DOTS_PER_INCH, DOTS_PER_INCH))
    return buffer.getvalue()


def _paint(painter: ImageDraw.ImageDraw, shape: Shape) -> None:
    fine = SCALE * FINER
    match shape:
        case Box(x, y, width, height, fill, radius):
            # Pillow paints the last column and row too; without −1 neighbours would overlap.
            box = (x * fine, y * fine, max(x + width, x) * fine - 1, (y + height) * fine - 1)
            if box[2] >= box[0]:
                painter.rounded_rectangle(box, radius * fine, fill)
        case Rule(x1, y1, x2, y2, colour, width):
            ends = (x1 * fine, y1 * fine, x2 * fine, y2 * fine)
            painter.line(ends, colour, max(round(width * fine), 1))
        case Trace(points, colour, width):
            fine_points = [(x * fine, y * fine) for x, y in points]
            painter.line(fine_points, colour, max(round(width * fine), 1), joint="curve")
        case Dot(x, y, radius, fill):
            painter.circle((x * fine, y * fine), radius * fine, fill)
        case Words(x, y, text, size, colour, anchor, bold):
            painter.text(
                (x * fine, y * fine),
                text,
                colour,
                _font(size * fine),
                _ANCHORS[anchor],
                stroke_width=size * fine * 0.022 if bold else 0,
            )


@cache
def _font(size: float) -> ImageFont.FreeTypeFont:
    """Pillow's own typeface, so that a picture is the same on every machine."""
    font = ImageFont.load_default(size)
    if not isinstance(font, ImageFont.FreeTypeFont):
        raise RuntimeError("Pillow was built without FreeType; install the published wheel of Pillow.")
    return font
