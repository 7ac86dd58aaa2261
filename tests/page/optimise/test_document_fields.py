"""Orientation and sample time of a gait: changed in fields, undone by name, and not there in a sequence."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Locator, Page, expect

from tests.support.page.opened import choose, opened_page
from tests.support.studio_process import StudioProcess, wait_for

pytestmark = pytest.mark.heavy


@pytest.fixture
def page(browser: Browser, studio: StudioProcess) -> Iterator[Page]:
    with opened_page(browser, studio.url, 1024, 768, has_scene=False) as opened:
        yield opened


def more(page: Page, gait: str) -> None:
    choose(page, gait)
    unfold(page)


def unfold(page: Page) -> None:
    page.locator("#optimise summary").filter(has_text="More").first.click()


def orientation(page: Page) -> Locator:
    return page.get_by_role("combobox", name="Orientation", exact=True)


def sample_time(page: Page) -> Locator:
    return page.get_by_role("spinbutton", name="Sample time", exact=True)


def first_foot(page: Page) -> Locator:
    return page.get_by_role("grid", name="Footfall timeline").get_by_role("rowheader").first


def test_another_orientation_renames_the_feet_and_leaves_the_step(page: Page, studio: StudioProcess) -> None:
    more(page, "Walk 10 mm")
    step = studio.document("walk")["step"]
    expect(first_foot(page)).to_contain_text("FR")
    orientation(page).select_option("FBS")
    expect(first_foot(page)).not_to_contain_text("FR")
    assert studio.document("walk")["orientation"] == "FBS"
    assert studio.document("walk")["step"] == step
    expect(page.locator("#undo-label")).to_have_text("orientation to FBS")
    page.locator("#undo").click()
    expect(orientation(page)).to_have_value("FB")
    expect(first_foot(page)).to_contain_text("FR")


def test_another_sample_time_keeps_the_drawing_and_changes_how_long_it_takes(
    page: Page, studio: StudioProcess
) -> None:
    more(page, "C-Gait 10 mm")
    drawn = studio.document("c-gait")["timeline"]
    sample_time(page).fill("9")
    sample_time(page).press("Enter")
    alert = page.locator("#optimise").get_by_role("alert")
    expect(alert.filter(has_text="Sample time is 9 s; it must lie between 0.05 and 5 s.")).to_be_visible()
    assert studio.document("c-gait")["timeline"] == drawn
    sample_time(page).fill("0.5")
    sample_time(page).press("Enter")
    timed = {**drawn, "sample_time": 0.5}
    wait_for(lambda: studio.document("c-gait")["timeline"] == timed, "only the sample time is another")
    expect(page.get_by_label("Time", exact=True)).to_contain_text("22.0 s")
    expect(page.locator("#undo-label")).to_have_text("sample time to 0.5 s")
    page.locator("#undo").click()
    expect(sample_time(page)).to_have_value("0.4")


def test_a_sequence_has_notes_of_its_own_and_all_else_from_its_parts(
    page: Page, studio: StudioProcess
) -> None:
    asked = {"name": "Chain", "parts": [{"gait": "walk", "times": 1}]}
    made = studio.ask("POST", "/api/sequences", asked).content["id"]
    page.get_by_role("list", name="Gaits").get_by_role("button", name="Chain").click()
    expect(page.get_by_label("Gait name")).to_have_value("Chain")
    unfold(page)
    expect(orientation(page)).to_be_hidden()
    expect(sample_time(page)).to_be_hidden()
    notes = page.get_by_role("textbox", name="Notes", exact=True)
    notes.fill("Round the table")
    notes.press("Tab")
    wait_for(lambda: studio.document(made)["notes"] == "Round the table", "the notes are kept")
