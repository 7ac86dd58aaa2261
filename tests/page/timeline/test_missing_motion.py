"""Where a drawing has no motion: hatched cells, outlined phases, and flags that say why in a few words."""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.support.page.opened import choose, opened_page
from tests.support.studio_process import StudioProcess

SHARES_STUDIO = True

HIT = """(flag) => {
  const { x, y, width } = flag.getBoundingClientRect();
  return document.elementFromPoint(x + width / 2, y + 20).className;
}"""


@pytest.fixture(scope="module")
def page(browser: Browser, studio: StudioProcess) -> Iterator[Page]:
    with opened_page(browser, studio.url, 1280, 800) as opened:
        yield opened


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
