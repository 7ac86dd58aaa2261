"""A recording that the motors cannot make, as the page offers to keep it."""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Locator, Page, expect

from core.wire.trajectory_csv import format_trajectory_csv
from tests.page.optimise.test_origin import choose_files
from tests.support.beyond_range import lowered
from tests.support.page.opened import opened_page
from tests.support.studio_process import StudioProcess

pytestmark = pytest.mark.heavy


@pytest.fixture
def page(browser: Browser, studio: StudioProcess) -> Iterator[Page]:
    with opened_page(browser, studio.url, 1280, 800) as opened:
        expect(opened.get_by_role("status", name="Verdict")).to_contain_text("Plan margin")
        yield opened


def card(page: Page) -> Locator:
    return page.get_by_role("region", name="Why the gait is infeasible")


def import_walk(page: Page, by: float, name: str) -> None:
    """Imports the library's walk with its body lower by so many m, without its companion."""
    text = format_trajectory_csv(lowered(by))
    choose_files(page, [{"name": f"{name}.csv", "mimeType": "text/csv", "buffer": text.encode()}])
    expect(page.get_by_label("Gait name")).to_have_value(name)


def test_a_recording_beyond_the_range_is_kept_within_it_and_says_where_it_was_cut(page: Page) -> None:
    import_walk(page, 0.002, "low")
    expect(card(page)).to_contain_text("The recording does not fit the robot")
    expect(card(page)).to_contain_text("outside its workspace")
    expect(card(page).get_by_role("listitem")).to_have_count(3)
    expect(card(page)).to_contain_text("The robot walks in the simulation.")
    card(page).get_by_role("button", name="Use this: Keep within the motors' range").click()
    expect(card(page)).to_be_hidden()
    expect(page.get_by_role("status", name="Verdict")).to_contain_text("Plan recorded")
    summary = page.get_by_text(re.compile(r"^Clipped by up to \d\.\d\d mm, in \d places?$"))
    summary.click()
    places = page.get_by_role("list", name="Clipped strokes").get_by_role("button")
    expect(places.first).to_have_text(re.compile(r"^Foot \d, samples? \d+"))
    page.get_by_role("button", name="Leave the strokes as recorded").click()
    expect(card(page)).to_contain_text("The recording does not fit the robot")
    page.get_by_role("button", name=re.compile("^Undo")).click()
    expect(card(page)).to_be_hidden()
    expect(summary).to_be_visible()


def test_a_way_out_that_was_simulated_needs_no_other_simulation(page: Page) -> None:
    import_walk(page, 0.002, "tried")
    first = card(page).get_by_role("listitem").first
    expect(first).to_contain_text("in the simulation.")
    first.get_by_role("button").click()
    expect(card(page)).to_be_hidden()
    check = page.get_by_role("button", name="Check", exact=True).and_(page.locator(".primary"))
    expect(check).to_be_visible()


def test_heights_in_another_frame_are_asked_about(page: Page) -> None:
    import_walk(page, 0.020, "plane")
    expect(card(page)).to_contain_text("The heights of the body are 20 mm too low")
    card(page).get_by_role("button", name="Use this: Correct the heights").click()
    expect(card(page)).to_be_hidden()
    expect(page.get_by_role("status", name="Plan", exact=True)).to_contain_text("body 20.0 mm higher")


def test_the_check_of_a_recording_beyond_the_range_lists_every_finding(page: Page) -> None:
    import_walk(page, 0.002, "checked")
    expect(card(page)).to_contain_text("The recording does not fit the robot")
    page.get_by_role("tab", name="Check & approve").click()
    page.get_by_role("button", name="Check", exact=True).click()
    expect(page.get_by_text(re.compile(r"Motor \d of foot \d would go to")).first).to_be_visible()
    expect(page.get_by_role("button", name="Approve", exact=True)).to_have_attribute("aria-disabled", "true")
