"""The room on the page: the answer stands where one edits, the lower part is as high as one wants it."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Locator, Page, expect

from tests.support.page.opened import opened_page
from tests.support.studio_process import StudioProcess, wait_for

pytestmark = pytest.mark.heavy


@pytest.fixture
def page(browser: Browser, studio: StudioProcess) -> Iterator[Page]:
    with opened_page(browser, studio.url, 1280, 800) as opened:
        expect(opened.get_by_label("Gait name")).not_to_have_value("")
        yield opened


def edge(page: Page) -> Locator:
    return page.get_by_role("separator", name="Height of timeline and plots")


def height(page: Page) -> int:
    found: int = page.locator(".lower").evaluate("lower => lower.offsetHeight")
    return found


def strip_height(page: Page) -> int:
    found: int = page.locator("#plots .strip").first.evaluate("strip => strip.offsetHeight")
    return found


@pytest.mark.parametrize(
    "size",
    [*(pytest.param(size, marks=pytest.mark.soak) for size in ((1280, 800), (1280, 720))), (1024, 768)],
)
def test_reason_and_ways_out_are_seen_without_scrolling(page: Page, size: tuple[int, int]) -> None:
    page.set_viewport_size({"width": size[0], "height": size[1]})
    step = page.get_by_role("spinbutton", name="Step", exact=True)
    step.fill("30")
    step.press("Enter")
    why = page.get_by_role("region", name="Why the gait is infeasible")
    first = why.get_by_role("group", name="What would help").get_by_role("listitem").first
    expect(first).to_contain_text("The robot walks in the simulation.", timeout=30_000)
    page.locator("#sections").evaluate("panel => { panel.scrollTop = 0; }")
    panel = page.locator("#sections").bounding_box()
    assert panel is not None
    for part in (why.locator(".first"), first):
        box = part.bounding_box()
        assert box is not None
        assert panel["y"] <= box["y"]
        assert box["y"] + box["height"] <= panel["y"] + panel["height"]
    page.get_by_role("button", name="Undo").click()
    expect(why).to_be_hidden()


def test_what_is_worked_on_keeps_its_place_and_the_verdict_stays_in_sight(page: Page) -> None:
    edge(page).press("End")
    step = page.get_by_role("spinbutton", name="Step", exact=True)
    step.fill("30")
    step.press("Enter")
    why = page.get_by_role("region", name="Why the gait is infeasible")
    expect(why.get_by_role("group", name="What would help").get_by_role("listitem").first).to_be_visible()
    expect(step).to_be_in_viewport(ratio=1)
    expect(why.get_by_role("heading", name="No motion for this drawing")).to_be_in_viewport(ratio=1)
    page.get_by_role("button", name="Undo").click()
    edge(page).press("Enter")


def test_the_lower_part_is_dragged_set_by_keys_and_remembered(page: Page) -> None:
    usual, strip = height(page), strip_height(page)
    box = edge(page).bounding_box()
    assert box is not None
    page.mouse.move(500, box["y"] + box["height"] / 2)
    page.mouse.down()
    page.mouse.move(500, box["y"] + box["height"] / 2 - 100, steps=4)
    page.mouse.up()
    wait_for(lambda: abs(height(page) - usual - 100) <= 2, "it is 100 pixels higher")
    assert strip_height(page) > strip + 8
    expect(edge(page)).to_have_attribute("aria-valuenow", str(height(page)))
    edge(page).press("ArrowDown")
    wait_for(lambda: abs(height(page) - usual - 84) <= 2, "an arrow moves it by 16 pixels")
    page.reload()
    wait_for(lambda: abs(height(page) - usual - 84) <= 2, "a reload keeps it")
    edge(page).dblclick()
    wait_for(lambda: abs(height(page) - usual) <= 1, "a double click brings the usual height back")


def test_a_small_lower_part_scrolls_and_the_playhead_reaches_down(page: Page) -> None:
    usual = height(page)
    edge(page).press("Home")
    expect(edge(page)).to_have_attribute("aria-valuenow", edge(page).get_attribute("aria-valuemin") or "")
    chart = page.locator("#chart")
    assert chart.evaluate("chart => chart.scrollHeight > chart.clientHeight")
    wait_for(
        lambda: bool(
            chart.evaluate(
                "chart => document.getElementById('playhead').offsetHeight >= chart.scrollHeight - 2"
            )
        ),
        "the playhead goes down to the last plot",
    )
    page.get_by_role("button", name="Edit", exact=True).click()
    page.get_by_role("menuitem", name="Stretch…").click()
    expect(page.get_by_role("dialog", name="Stretch")).to_be_in_viewport(ratio=1)
    page.keyboard.press("Escape")
    edge(page).press("Enter")
    wait_for(lambda: abs(height(page) - usual) <= 1, "Enter brings the usual height back")
