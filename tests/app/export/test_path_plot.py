"""Plots of ways from above: to scale, with plan and simulation, and words for who cannot see them."""

from __future__ import annotations

import xml.etree.ElementTree as ElementTree
from dataclasses import replace

import numpy as np
import pytest

from app.export.drawing import Trace
from app.export.path_plot import EDGE, HEAD, SIZE, Ways, way_plot
from app.export.png import png
from app.export.svg import svg

COLOURS = ("#2e9e5b", "#d64545", "#e08a1e", "#3b78d8")
CORNERS = np.array([[0.04, 0.0], [0.0, 0.04], [-0.04, 0.0], [0.0, -0.04]])


def ways() -> Ways:
    shares = np.linspace(0.0, 1.0, 5)[:, None]
    body = shares * [0.010, 0.0]
    feet = CORNERS + body[:, None]
    return Ways("Walk", body, feet, body * 0.9, feet - [0.0, 0.002])


def traces(drawn: Ways) -> list[Trace]:
    return [shape for shape in way_plot(drawn, COLOURS, 0.050).shapes if isinstance(shape, Trace)]


def test_body_and_feet_have_a_planned_and_a_simulated_way() -> None:
    found = traces(ways())
    assert len(found) == 2 * 5
    assert {trace.colour for trace in found} >= set(COLOURS)
    assert all(wide.width > thin.width for wide, thin in zip(found[::2], found[1::2], strict=True))


def test_places_are_to_scale_with_y_upwards() -> None:
    planned_body, body = traces(ways())[:2]
    assert planned_body.points[0] == pytest.approx((EDGE + SIZE / 2, HEAD + SIZE / 2))
    assert planned_body.points[-1][0] - body.points[-1][0] == pytest.approx(0.001 * SIZE / 0.100)
    second = traces(ways())[4]
    assert second.points[0][1] == pytest.approx(HEAD + SIZE * 0.1)


def test_the_words_tell_ends_and_distances() -> None:
    words = way_plot(ways(), COLOURS, 0.05).description
    assert "the body ends at (9.0, 0.0) mm, planned (10.0, 0.0) mm" in words
    assert "foot 3 2.0 mm" in words


def test_a_page_may_hold_several_drawings() -> None:
    drawing = way_plot(ways(), COLOURS, 0.05)
    page = f"<page>{svg(drawing, 'one')}{svg(drawing, 'two')}</page>"
    names = [
        element.attrib["id"] for element in ElementTree.fromstring(page).iter() if "id" in element.attrib
    ]
    assert sorted(names) == ["one-title", "one-words", "two-title", "two-words"]


def test_names_are_escaped() -> None:
    drawn = replace(ways(), title="<b>& walk")
    assert "&lt;b&gt;&amp; walk" in svg(way_plot(drawn, COLOURS, 0.05))


def test_the_picture_shows_what_the_drawing_says() -> None:
    drawing = way_plot(ways(), COLOURS, 0.05)
    bare = replace(drawing, shapes=tuple(s for s in drawing.shapes if not isinstance(s, Trace)))
    assert png(drawing) != png(bare)
