"""The notes of a gait: typed, kept when the field is left, undone, and seen by another tab."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, BrowserContext, Locator, Page, expect

from tests.support.chromium import LONG_MS
from tests.support.page.opened import leave_scene_out
from tests.support.studio_process import StudioProcess, wait_for

pytestmark = pytest.mark.heavy

SHARES_STUDIO = True

WORDS = "Slips on tape.\nTry 2 mm more."


@pytest.fixture
def gait(studio: StudioProcess) -> str:
    made: str = studio.ask("POST", "/api/gaits?copy_of=s-gait&name=Noted").content["id"]
    return made


@pytest.fixture
def context(browser: Browser, gait: str) -> Iterator[BrowserContext]:
    opened = browser.new_context(viewport={"width": 1280, "height": 800})
    opened.set_default_timeout(LONG_MS)
    opened.add_init_script(f"localStorage.setItem('footfall.gait', '{gait}')")
    leave_scene_out(opened)
    yield opened
    opened.close()


def tab(context: BrowserContext, studio: StudioProcess) -> Page:
    page = context.new_page()
    page.goto(studio.url)
    return unfolded(page)


def unfolded(page: Page) -> Page:
    expect(page.get_by_label("Gait name")).to_have_value("Noted")
    page.locator("#optimise summary").filter(has_text="More").first.click()
    return page


def notes(page: Page) -> Locator:
    return page.get_by_role("textbox", name="Notes", exact=True)


def refusal(page: Page) -> Locator:
    return page.locator("#optimise .notes-field").get_by_role("alert")


def write(page: Page, words: str) -> None:
    notes(page).fill(words)
    notes(page).press("Tab")


def are(studio: StudioProcess, gait: str, words: str) -> None:
    wait_for(lambda: studio.document(gait)["notes"] == words, f"the notes say {words[:40]!r}")


def test_notes_are_kept_when_the_field_is_left_undone_by_name_and_seen_elsewhere(
    context: BrowserContext, studio: StudioProcess, gait: str
) -> None:
    before = studio.document(gait)["notes"]
    here, there = tab(context, studio), tab(context, studio)
    write(here, WORDS)
    are(studio, gait, WORDS)
    expect(notes(there)).to_have_value(WORDS)
    expect(here.locator("#undo-label")).to_have_text("notes")
    here.reload()
    expect(notes(unfolded(here))).to_have_value(WORDS)
    notes(here).press("Control+z")
    are(studio, gait, before)
    for page in (here, there):
        expect(notes(page)).to_have_value(before)


def test_escape_gives_up_what_is_typed_and_too_much_is_refused_beside_the_field(
    context: BrowserContext, studio: StudioProcess, gait: str
) -> None:
    before = studio.document(gait)["notes"]
    page = tab(context, studio)
    notes(page).fill("Never mind")
    notes(page).press("Escape")
    expect(notes(page)).to_have_value(before)
    write(page, "long " * 4001)
    expect(refusal(page)).to_contain_text("The notes have 20005 characters, but at most 20000 are possible.")
    expect(notes(page)).to_have_value("long " * 4001)
    assert studio.document(gait)["notes"] == before
    write(page, "short")
    expect(refusal(page)).to_be_hidden()
    are(studio, gait, "short")


def test_notes_that_the_studio_refuses_stay_with_its_reason(
    context: BrowserContext, studio: StudioProcess, gait: str
) -> None:
    before = studio.document(gait)["notes"]
    page = tab(context, studio)
    notes(page).focus()
    notes(page).evaluate("area => { area.value = `Slips ${String.fromCharCode(0xd83d)}`; }")
    notes(page).press("Tab")
    expect(refusal(page)).to_contain_text("half a character")
    assert notes(page).evaluate("area => area.value.startsWith('Slips ')")
    assert studio.document(gait)["notes"] == before
    write(page, WORDS)
    are(studio, gait, WORDS)
    expect(refusal(page)).to_be_hidden()


def test_typed_notes_survive_those_of_another_tab_which_are_one_undo_away(
    context: BrowserContext, studio: StudioProcess, gait: str
) -> None:
    here, there = tab(context, studio), tab(context, studio)
    notes(here).fill("Mine")
    write(there, "Theirs")
    expect(refusal(here)).to_contain_text("changed in another window")
    expect(notes(here)).to_have_value("Mine")
    notes(here).press("Tab")
    are(studio, gait, "Mine")
    expect(notes(there)).to_have_value("Mine")
    here.locator("#undo").click()
    are(studio, gait, "Theirs")
    expect(notes(here)).to_have_value("Theirs")
