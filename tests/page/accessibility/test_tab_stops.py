"""Each list, grid, toolbar and row of tabs is one stop of Tab; the arrow keys go on from there."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import partial

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.support.page.drawers import open_drawer
from tests.support.page.keyboard import focused, tab_stops, tab_to
from tests.support.page.opened import opened_page
from tests.support.studio_process import StudioProcess, wait_for

pytestmark = pytest.mark.heavy


@pytest.fixture(scope="module")
def page(browser: Browser, studio: StudioProcess) -> Iterator[Page]:
    with opened_page(browser, studio.url, 1280, 800) as opened:
        expect(opened.get_by_role("status", name="Verdict")).to_contain_text("Plan margin")
        expect(opened.get_by_role("button", name="Simulate", exact=True)).to_be_visible()
        yield opened


def is_one_stop(page: Page, part: str) -> None:
    """The items of a part become one stop a moment after they are drawn."""
    wait_for(lambda: tab_stops(page, part) == 1, f"{part} is one stop, not {tab_stops(page, part)}")


@pytest.mark.parametrize(
    "part",
    [
        "[role=tablist][aria-label=Steps]",
        "[role=tablist][aria-label='Timeline views']",
        "#timeline",
        "#tools",
        "#stage-tools",
        "#view-cube",
        "#gaits",
    ],
)
def test_a_part_is_one_stop(page: Page, part: str) -> None:
    is_one_stop(page, part)


def test_arrows_move_through_the_list_of_gaits_from_the_shown_one(page: Page) -> None:
    tab_to(page, "Find a gait")
    page.keyboard.press("Tab")
    assert focused(page).startswith("Walk 10 mm")
    page.keyboard.press("ArrowUp")
    before = focused(page)
    assert not before.startswith("Walk 10 mm")
    page.keyboard.press("ArrowDown")
    assert focused(page).startswith("Walk 10 mm")
    is_one_stop(page, "#gaits")
    page.keyboard.press("Home")
    first = focused(page)
    page.keyboard.press("ArrowUp")
    assert focused(page) == first
    page.keyboard.press("Shift+Tab")
    page.keyboard.press("Tab")
    assert focused(page) == first, "the list keeps its stop"


def test_a_group_that_is_folded_or_searched_away_leaves_one_stop(page: Page) -> None:
    heading = page.get_by_role("list", name="Gaits").get_by_role("button", name=re.compile("^For this robot"))
    heading.click()
    is_one_stop(page, "#gaits")
    heading.click()
    page.get_by_label("Find a gait").fill("amble")
    expect(page.locator("#gaits [data-gait=walk]")).to_have_count(0)
    is_one_stop(page, "#gaits")
    page.get_by_label("Find a gait").fill("")


def test_left_and_right_move_in_a_toolbar_and_scrub_from_a_list(page: Page) -> None:
    page.keyboard.press("Home")
    clock = page.locator("#clock b")
    page.get_by_label("Find a gait").focus()
    page.keyboard.press("Tab")
    page.keyboard.press("ArrowRight")
    expect(clock).not_to_have_text("0.0")
    shown = clock.inner_text()
    tab_to(page, "Paint")
    page.keyboard.press("ArrowRight")
    assert focused(page) == "Select"
    page.keyboard.press("End")
    assert focused(page) == "Fit"
    page.keyboard.press("Home")
    assert focused(page) == "Paint"
    expect(clock).to_have_text(shown)


def is_done(studio: StudioProcess, job: str) -> bool:
    """Whether a job has come to its end."""
    return bool(studio.ask("GET", f"/api/jobs/{job}").content["state"] == "done")


def test_jobs_and_the_segment_table_are_one_stop_each(page: Page, studio: StudioProcess) -> None:
    for gait in ("walk", "walk-manual-0"):
        job = studio.ask("POST", "/api/jobs", {"kind": "simulate", "gait": gait}).content["id"]
        wait_for(partial(is_done, studio, job), "it is done")
    jobs = open_drawer(page, "Jobs")
    expect(jobs.locator(".job")).to_have_count(2)
    is_one_stop(page, "#jobs")
    jobs.get_by_role("button", name="Walk 10 mm").focus()
    page.keyboard.press("ArrowUp")
    assert focused(page) == "Manual walk, v0"
    open_drawer(page, "Gaits")
    page.get_by_label("Find a gait").fill("Manual walk, v0")
    page.get_by_role("list", name="Gaits").get_by_role("button", name="Manual walk, v0").first.click()
    page.get_by_role("tab", name="Segments").click()
    expect(page.get_by_role("grid", name="Segment table").get_by_role("row").first).to_be_visible()
    is_one_stop(page, "[role=grid][aria-label='Segment table']")
    is_one_stop(page, "[role=toolbar][aria-label='Segment table']")


PARTS = "header, nav, #drawers, .stage, #verdict, .transport, #chart, #sections, .inspector-foot"
"""Where the key F6 leads, beginning after the top bar."""


def test_f6_goes_from_part_to_part_and_round(page: Page) -> None:
    page.get_by_role("tab", name="Cells").click()
    page.locator("#gait-name").focus()
    reached = []
    for _ in PARTS.split(", "):
        page.keyboard.press("F6")
        reached.append(page.evaluate("(parts) => document.activeElement.closest(parts).outerHTML", PARTS))
    assert len(set(reached)) == len(PARTS.split(", "))
    assert reached[-1].startswith("<header")
    page.keyboard.press("Shift+F6")
    assert page.evaluate("document.activeElement.closest('.inspector-foot') !== null")
