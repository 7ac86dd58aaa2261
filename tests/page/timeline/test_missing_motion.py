"""Where a drawing has no motion: hatched cells, outlined phases, and flags that say why in a few words."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.support.page.opened import choose, opened_page
from tests.support.studio_process import StudioProcess

SHARES_STUDIO = True

MARKS = """async (plan) => {
  const { missingMotionByCell, missingPhases } = await import("/static/document/missing_motion.js");
  const blamed = [...missingMotionByCell(plan)].filter(([, { tone }]) => tone);
  const cells = Object.fromEntries(blamed.map(([place, { tone }]) => [place, tone]));
  return { phases: missingPhases(plan), cells };
}"""
PLACES = """async ([phases, total]) => {
  const { flagPlaces } = await import("/static/timeline/phase_flags.js");
  return flagPlaces(phases, total).map(({ left, width }) => [left, width]);
}"""
SHORT = """async (words) => {
  const { shortWords } = await import("/static/document/missing_motion.js");
  return shortWords(words);
}"""
HIT = """(flag) => {
  const { x, y, width } = flag.getBoundingClientRect();
  return document.elementFromPoint(x + width / 2, y + 20).className;
}"""


@pytest.fixture(scope="module")
def page(browser: Browser, studio: StudioProcess) -> Iterator[Page]:
    with opened_page(browser, studio.url, 1280, 800) as opened:
        yield opened


def lack(family: str, first: int, last: int, *feet: int, amount: float = 1.0, unit: str = "mm") -> Any:
    return {
        "family": family,
        "first": first,
        "last": last,
        "feet": feet,
        "amount": amount,
        "unit": unit,
        "sentence": f"{family} lacks {amount}.",
    }


def marks_of(page: Page, contact: tuple[str, ...], *lacks: Any) -> Any:
    """The phases and the hatched cells of a plan with these feet down (one text a sample) and these lacks."""
    rows = [[down == "1" for down in row] for row in contact]
    return page.evaluate(MARKS, {"contact": rows, "live": {"lacks": lacks}})


def words_of(page: Page, contact: str, missing: Any) -> str:
    (phase,) = marks_of(page, (contact,) * 20, missing)["phases"]
    words: str = phase["words"]
    return words


def test_of_balance_the_swings_are_to_blame_and_of_reach_the_foot(page: Page) -> None:
    contact = ("1111", "0101", "1101", "1111")
    balance = marks_of(page, contact, lack("body_torque", 1, 2, 1, 3))
    assert balance["cells"] == {"0,1": "bad", "2,1": "bad", "2,2": "bad"}
    reach = marks_of(page, contact, lack("margin", 0, 0, 1, 2), lack("workspace", 1, 2, 1))
    assert reach["cells"] == {"1,0": "bad", "2,0": "bad", "1,1": "caution", "1,2": "caution"}


def test_a_flag_says_why_in_a_few_words(page: Page) -> None:
    assert words_of(page, "0101", lack("body_torque", 4, 6, 1, 3)) == "feet 1 and 3 in the air"
    assert words_of(page, "000111", lack("margin", 4, 6, 3, 4)) == "margin 1.0 mm short"
    assert words_of(page, "001100", lack("margin", 4, 6, 3, 4)) == "feet 1, 2, 5 and 6 in the air"
    assert words_of(page, "0111", lack("margin", 4, 6, 1, 3, amount=0.84)) == "margin 0.8 mm short"
    assert words_of(page, "1111", lack("workspace", 4, 6, 1, amount=3.12)) == "foot 2: reach 3.1 mm short"
    assert words_of(page, "1110", lack("foot_speed", 4, 6, 3, unit="mm/s")) == "foot 4 too fast"
    assert words_of(page, "1111", lack("body_speed", 4, 6, unit="mm/s")) == "body too fast"
    assert words_of(page, "1111", lack("something new", 4, 6)) == "a limit is violated"


@pytest.mark.parametrize(
    ("words", "short"),
    [
        ("foot 2: reach 3.1 mm short", "foot 2"),
        ("feet 1 and 3 in the air", "feet 1 and 3"),
        ("margin 0.8 mm short", "margin"),
        ("foot 4 too fast", "foot 4"),
        ("feet 1 and 2 too close", "feet 1 and 2"),
        ("body height off by 2.0 mm", "body height"),
        ("a limit is violated", "a limit is violated"),
    ],
)
def test_where_there_is_no_room_a_flag_keeps_whole_words(page: Page, words: str, short: str) -> None:
    assert page.evaluate(SHORT, words) == short


def test_entries_that_meet_are_one_phase_and_the_three_worst_are_shown(page: Page) -> None:
    still = ("1111",) * 40
    meeting = marks_of(
        page, still, lack("workspace", 4, 8, 1), lack("margin", 2, 5, 0, 1), lack("margin", 9, 9)
    )
    assert meeting["phases"] == [
        {"first": 2, "last": 8, "words": "foot 2: reach 1.0 mm short"},
        {"first": 9, "last": 9, "words": "margin 1.0 mm short"},
    ]
    following = marks_of(page, still, lack("foot_speed", 4, 5, 1), lack("foot_speed", 6, 7, 1))
    assert [(phase["first"], phase["last"]) for phase in following["phases"]] == [(4, 7)]
    many = [lack("workspace", first, first + 1, 1) for first in (30, 10, 20, 0)]
    assert [phase["first"] for phase in marks_of(page, still, *many)["phases"]] == [10, 20, 30]


@pytest.mark.parametrize(
    ("phases", "total", "places"),
    [
        ([(100, 140, 90), (300, 340, 90)], 600, [[100, 90], [300, 90]]),
        ([(560, 600, 90)], 600, [[510, 90]]),
        ([(-50, 40, 90)], 600, [[0, 90]]),
        ([(10, 50, 90), (80, 120, 90), (400, 440, 90)], 600, [[10, 50], [80, 90], [400, 90]]),
        ([(10, 20, 90), (30, 40, 90)], 600, [[10, 16], [30, 90]]),
    ],
    ids=["room", "at the end", "begun before", "short words", "a mark"],
)
def test_flags_neither_lie_on_each_other_nor_are_cut(
    page: Page, phases: list[tuple[int, int, int]], total: int, places: list[list[int]]
) -> None:
    given = [{"left": left, "right": right, "width": width, "short": 50} for left, right, width in phases]
    assert page.evaluate(PLACES, [given, total]) == places


def test_two_feet_in_the_air_are_hatched_outlined_and_flagged_while_the_hand_draws(page: Page) -> None:
    choose(page, "Walk 10 mm")
    grid = page.get_by_role("grid", name="Footfall timeline")
    boxes = [
        grid.get_by_role("gridcell", name=f"foot 1, sample {sample}: stance", exact=True).bounding_box()
        for sample in (7, 13)
    ]
    row = grid.bounding_box()
    assert boxes[0]
    assert boxes[1]
    assert row
    page.mouse.move(boxes[0]["x"] + 3, boxes[0]["y"] + 5)
    page.mouse.down()
    page.mouse.move(boxes[1]["x"] + 3, boxes[1]["y"] + 5, steps=4)
    flag = page.locator(".phase-flag:visible")
    expect(flag).to_have_text("feet 1 and 3 in the air")
    expect(page.locator(".cell[data-lack]")).to_have_count(8)
    expect(page.locator(".cell[data-lack]").first).to_have_attribute("title", re.compile("Balance is"))
    outline = page.locator(".phase-box:visible").bounding_box()
    assert outline is not None
    assert outline["x"] == pytest.approx(boxes[0]["x"], abs=2)
    assert outline["height"] == pytest.approx(row["height"], abs=3)
    assert "cell" in str(flag.evaluate(HIT)), "flags and outlines let the pointer through"
    assert grid.bounding_box() == row, "the rows stay under the hand"
    page.keyboard.press("Escape")
    page.mouse.up()
    expect(flag).to_have_count(0)
    expect(page.locator(".cell[data-lack]")).to_have_count(0)


def test_why_a_drawing_is_refused_stands_in_the_inspector_alone(page: Page) -> None:
    choose(page, "Amble 10 mm")
    page.get_by_role("gridcell", name="foot 2, sample 45: stance", exact=True).click()
    expect(page.get_by_role("region", name="Why the gait is infeasible")).to_contain_text("No motion")
    expect(page.locator("#edit-note")).to_be_empty()
    page.get_by_role("button", name=re.compile("^Undo")).click()
    expect(page.get_by_role("region", name="Why the gait is infeasible")).to_be_hidden()
