"""Random drawings that cannot walk: each kind has what it is called after, and a seed gives it again."""

from __future__ import annotations

import json
from functools import cache

import numpy as np
import pytest

from app.bench.common.random_drawings import Drawing, Family, is_refused, random_drawing
from app.documents.gait_json import gait_content, gait_from_content

SEED = 3
KINDS = ("locks", "held", "direction", "turn")
"""Of special drawings, by number."""

NUMBERS = range(8)


@cache
def special(number: int) -> Drawing:
    return random_drawing(SEED, number, Family.SPECIAL)


@pytest.mark.parametrize("number", NUMBERS)
def test_a_special_drawing_has_what_its_kind_says(number: int) -> None:
    gait = special(number).gait
    has = (bool(gait.timeline.locked.any()), gait.held.any, gait.direction > 1, gait.step[2] != 0.0)
    assert has == tuple(kind == KINDS[number % len(KINDS)] for kind in KINDS)


@pytest.mark.parametrize("number", [1, 5, 9, 17])
def test_held_feet_are_in_the_air_where_they_are_held(number: int) -> None:
    gait = special(number).gait
    for feet, sample in ((gait.held.start, 0), (gait.held.end, -1)):
        assert not gait.timeline.stance[[foot - 1 for foot in feet], sample].any()
    throughout = [foot for foot in gait.held.both if not gait.timeline.stance[foot - 1].any()]
    assert len(throughout) == len(gait.held.both) <= (1 if gait.timeline.leg_count == 6 else 0)


def test_a_foot_of_six_is_held_up_throughout() -> None:
    assert special(17).gait.held.both


@pytest.mark.parametrize("number", [3, 7, 15, 19])
def test_turns_lie_between_5_and_25_degrees(number: int) -> None:
    drawing = special(number)
    assert 5.0 <= abs(np.degrees(drawing.gait.step[2])) <= 25.0
    assert ("on the spot" in drawing.words) == (drawing.gait.step[:2] == (0.0, 0.0))


@pytest.mark.parametrize("family", Family)
@pytest.mark.parametrize("number", [1, 4])
def test_the_same_seed_gives_the_same_drawing_which_cannot_walk(family: Family, number: int) -> None:
    first, second = (random_drawing(SEED, number, family) for _ in range(2))
    other = random_drawing(SEED + 1, number, family)
    contents = [json.dumps(gait_content(drawing.gait)) for drawing in (first, second, other)]
    assert contents[0] == contents[1] != contents[2]
    assert is_refused(first.gait) is first.refused


@pytest.mark.parametrize("number", NUMBERS)
def test_a_special_drawing_is_a_document(number: int) -> None:
    gait = special(number).gait
    assert gait_content(gait_from_content(gait_content(gait))) == gait_content(gait)


def test_the_families_differ() -> None:
    plain, special = (random_drawing(SEED, 2, family).words for family in Family)
    assert plain != special
