"""The list of gaits: starters first, all else under one fold, and a picture of the footfalls in each line."""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Locator, Page, expect

from tests.support.page.opened import opened_page
from tests.support.studio_process import StudioProcess

SHARES_STUDIO = True


@pytest.fixture
def page(browser: Browser, studio: StudioProcess) -> Iterator[Page]:
    """A new user's page."""
    with opened_page(browser, studio.url, 1280, 800, gait=None) as opened:
        expect(opened.get_by_label("Gait name")).not_to_have_value("")
        yield opened


def heading(page: Page, name: str) -> Locator:
    return page.get_by_role("list", name="Gaits").locator("button.group").filter(has_text=name)


def line(page: Page, name: str) -> Locator:
    return page.get_by_role("list", name="Gaits").get_by_role("button", name=re.compile(f"^{name}"))


@pytest.mark.heavy
def test_the_starters_are_open_and_the_examples_folded_until_somebody_opens_them(page: Page) -> None:
    expect(heading(page, "For this robot")).to_have_attribute("aria-expanded", "true")
    examples = heading(page, "Examples")
    expect(examples).to_have_attribute("aria-expanded", "false")
    expect(line(page, "Walk 10 mm")).to_have_count(0)
    examples.click()
    expect(line(page, "Walk 10 mm").first).to_be_attached()
    expect(heading(page, "By hand")).to_have_attribute("aria-expanded", "false")
    heading(page, "For this robot").click()
    page.reload()
    expect(heading(page, "For this robot")).to_have_attribute("aria-expanded", "true")  # of the shown gait
    expect(heading(page, "Examples")).to_have_attribute("aria-expanded", "true")
    heading(page, "Examples").click()
    page.reload()
    expect(heading(page, "Examples")).to_have_attribute("aria-expanded", "false")


def test_the_search_finds_in_folded_groups_and_the_group_of_the_chosen_gait_opens(page: Page) -> None:
    search = page.get_by_role("searchbox", name="Find a gait")
    search.fill("manual amble")
    found = line(page, "Manual amble, v1")
    found.click()
    expect(page.get_by_label("Gait name")).to_have_value("Manual amble, v1")
    search.press("Escape")
    expect(heading(page, "By hand")).to_have_attribute("aria-expanded", "true")
    expect(found).to_have_attribute("aria-current", "true")
    heading(page, "By hand").click()
    expect(found).to_have_count(0)


def test_each_line_is_low_and_shows_its_footfalls_and_its_pace(page: Page) -> None:
    walk = line(page, "Fast C-Gait")
    expect(walk.locator(".footfalls .swing")).to_have_count(12)  # four feet, three cycles
    row, picture = walk.bounding_box(), walk.locator(".picture").bounding_box()
    assert row is not None
    assert picture is not None
    assert row["height"] == 28
    assert (picture["width"], picture["height"]) == (44, 16)
    expect(walk.locator(".tag")).to_have_text("2.27")


def test_a_cut_name_is_shown_in_full_under_the_pointer_and_the_focus(page: Page) -> None:
    whole = page.locator(".whole-name")
    page.get_by_role("searchbox", name="Find a gait").fill("Hexapod, front pair up")
    long = page.get_by_role("list", name="Gaits").locator("button.gait").first
    name = "Hexapod, front pair up"
    expect(long.locator(".name")).to_have_text(re.compile(f"^{name}"))
    assert long.locator(".name").evaluate("name => name.scrollWidth > name.clientWidth")
    long.hover()
    expect(whole).to_have_text(re.compile(f"^{name}"))
    expect(whole).to_be_in_viewport(ratio=1)
    page.get_by_label("Gait name").hover()
    expect(whole).to_be_hidden()
    long.focus()
    expect(whole).to_be_visible()
    page.get_by_role("searchbox", name="Find a gait").focus()
    expect(whole).to_be_hidden()
