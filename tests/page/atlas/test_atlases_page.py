"""The dialog *Atlases* and its jobs: an atlas is made, cancelled, gone on with, looked at and deleted."""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Locator, Page, expect

from tests.support.page.axe import findings
from tests.support.page.opened import opened_page
from tests.support.studio_process import StudioProcess, wait_for

pytestmark = [pytest.mark.heavy, pytest.mark.alone]


@pytest.fixture
def page(browser: Browser, studio: StudioProcess) -> Iterator[Page]:
    with opened_page(browser, studio.url, 1280, 900) as opened:
        expect(opened.get_by_label("Gait name")).not_to_have_value("")
        opened.get_by_role("button", name=re.compile("^Jobs")).click()
        yield opened


def open_dialog(page: Page) -> Locator:
    page.get_by_role("button", name="Atlases…").click()
    dialog = page.get_by_role("dialog", name="Atlases")
    expect(dialog).to_be_visible()
    return dialog


def make(page: Page, name: str, gaits: str) -> Locator:
    """Starts a run; gives its job in the list."""
    dialog = open_dialog(page)
    dialog.get_by_label("Name of the atlas").fill(name)
    dialog.get_by_label("Gaits", exact=True).fill(gaits)
    dialog.get_by_role("button", name="Make").click()
    expect(dialog).to_be_hidden()
    return page.get_by_role("list", name="Jobs").get_by_role("listitem").filter(has_text=f"“{name}”").first


def test_an_atlas_is_made_and_leads_to_its_map(page: Page, studio: StudioProcess) -> None:
    job = make(page, "mine", "30")
    expect(job).to_contain_text("done")
    expect(job).to_contain_text(re.compile("30 gaits, [0-9]+ solved"))
    dialog = open_dialog(page)
    row = dialog.get_by_role("row").filter(has_text="mine")
    expect(row).to_contain_text(re.compile(r"[0-9]\.[0-9]{2} mm/s"))
    assert findings(page) == []
    with page.context.expect_page() as opened:
        row.get_by_role("link", name="Map of mine").click()
    expect(opened.value.get_by_role("heading", level=1)).to_contain_text("Atlas")
    opened.value.close()
    with page.expect_download() as saved:
        row.get_by_role("link", name="mine as CSV").click()
    assert saved.value.suggested_filename == "mine.csv"


def test_a_run_shows_how_far_it_is_is_cancelled_and_goes_on(page: Page, studio: StudioProcess) -> None:
    job = make(page, "long", "100000")
    expect(job).to_contain_text(re.compile("of 100,000 gaits, [0-9,]+ solved, about [0-9]+ (min|h) left"))
    dialog = open_dialog(page)
    expect(dialog.get_by_role("button", name="Make")).to_be_disabled()
    dialog.get_by_label("Name of the atlas").press("Enter")
    expect(dialog.get_by_role("alert").filter(has_text="An atlas is being made.")).to_be_visible()
    dialog.get_by_role("button", name="Close").click()
    page.reload()
    job = page.get_by_role("list", name="Jobs").get_by_role("listitem").filter(has_text="“long”").first
    job.get_by_role("button", name="Cancel job").click()
    expect(job).to_contain_text("cancelled")
    kept = studio.ask("GET", "/api/atlases/long").content["gaits"]
    job.get_by_role("button", name="Atlas “long”").click()
    dialog = page.get_by_role("dialog", name="Atlases")
    gaits = dialog.get_by_label("Gaits", exact=True)
    expect(gaits).not_to_have_value(str(kept))
    gaits.fill(str(kept + 20))
    dialog.get_by_role("button", name="Go on").click()
    wait_for(lambda: studio.ask("GET", "/api/atlases/long").content["gaits"] == kept + 20, "the run went on")


def test_an_atlas_is_deleted_and_undo_brings_it_back(page: Page) -> None:
    expect(make(page, "gone", "4")).to_contain_text("done")
    dialog = open_dialog(page)
    row = dialog.get_by_role("row").filter(has_text="gone")
    row.get_by_role("button", name="Delete gone").click()
    expect(row).to_have_count(0)
    dialog.get_by_role("button", name="Close").click()
    page.get_by_role("button", name="Undo", exact=True).last.click()
    dialog = open_dialog(page)
    expect(dialog.get_by_role("row").filter(has_text="gone")).to_have_count(1)


def test_what_is_missing_or_refused_is_said_at_the_field(page: Page) -> None:
    dialog = open_dialog(page)
    dialog.get_by_label("Name of the atlas").fill("")
    dialog.get_by_role("button", name="Make").click()
    expect(dialog.get_by_role("alert").filter(has_text="Give the atlas a name.")).to_be_visible()
    dialog.get_by_label("Name of the atlas").fill("../x")
    dialog.get_by_label("Gaits", exact=True).fill("0")
    dialog.get_by_role("button", name="Make").click()
    expect(dialog.get_by_text("must be a whole number between 1 and 1000000")).to_be_visible()
    dialog.get_by_label("Gaits", exact=True).fill("5")
    dialog.get_by_role("button", name="Make").click()
    expect(dialog.get_by_text("letters, digits, spaces")).to_be_visible()
