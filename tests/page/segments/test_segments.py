"""The segment table on the page: typed like a spreadsheet, one selection with the timeline, nothing lost."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Literal

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.support.page.axe import findings
from tests.support.page.segments_page import (
    WALK,
    cell,
    choose,
    copy_of,
    grid,
    note,
    opened_segments,
    selected_samples,
    table,
    undo_label,
)
from tests.support.studio_process import StudioProcess, wait_for

SHARES_STUDIO = True


@pytest.fixture(scope="module")
def page(browser: Browser, studio: StudioProcess) -> Iterator[Page]:
    with opened_segments(browser, studio) as opened:
        yield opened


def test_keys_move_the_focus_and_the_selection_is_the_timelines(page: Page, studio: StudioProcess) -> None:
    copy_of(studio, WALK, "Keys")
    choose(page, "Keys")
    cell(page, 1, 1).click()
    page.keyboard.press("ArrowDown")
    page.keyboard.press("ArrowRight")
    expect(cell(page, 2, 2)).to_be_focused()
    assert selected_samples(page) == [f"foot 2, sample {sample}" for sample in range(6, 11)]
    page.keyboard.press("Shift+ArrowDown")
    page.keyboard.press("Shift+End")
    expect(grid(page).locator('[aria-selected="true"]')).to_have_count(6)
    assert len(selected_samples(page)) == 30
    page.keyboard.press("Home")
    expect(cell(page, 3, 1)).to_be_focused()
    page.keyboard.press("Control+End")
    expect(cell(page, "Link segment 1", 4)).to_be_focused()
    assert selected_samples(page) == []


def test_what_is_selected_on_the_timeline_is_selected_in_the_table(page: Page, studio: StudioProcess) -> None:
    copy_of(studio, WALK, "Other way", iterations=2)
    choose(page, "Other way")
    samples = page.get_by_role("grid", name="Footfall timeline")
    samples.get_by_role("gridcell", name=re.compile("^foot 3, sample 12:")).click(modifiers=["Control"])
    samples.get_by_role("gridcell", name=re.compile("^foot 3, sample 12:")).focus()
    page.keyboard.press("Shift+ArrowDown")
    page.keyboard.press("Shift+ArrowRight")
    expect(grid(page).locator('[aria-selected="true"]')).to_have_text(["Lift A", "Wait A"])


def test_the_first_letters_choose_and_one_change_is_one_undo(page: Page, studio: StudioProcess) -> None:
    gait = copy_of(studio, WALK, "Letters")
    choose(page, "Letters")
    cell(page, 6, 2).click()
    page.keyboard.press("Enter")
    page.keyboard.press("Tab")
    expect(cell(page, 6, 3)).to_be_focused()
    page.keyboard.type("le")
    options = page.get_by_role("listbox", name="Segments").get_by_role("option")
    expect(options).to_have_text([re.compile("Lean A"), re.compile("Lean B"), re.compile("Lean C")])
    page.keyboard.press("Escape")
    expect(cell(page, 6, 3)).to_be_focused()
    cell(page, 5, 3).click()
    page.keyboard.press("Enter")
    page.keyboard.type("wait d")
    page.keyboard.press("Enter")
    expect(note(page)).to_contain_text("Foot 3, segment 6")
    expect(cell(page, 6, 3)).to_be_focused()
    page.keyboard.type("z")
    page.keyboard.press("Enter")
    expect(note(page)).to_be_hidden()
    expect(undo_label(page)).to_have_text("foot 3, segment 6 to Zero A")
    wait_for(
        lambda: table(studio, gait)["feet"][2][4:6] == ["Wait D", "Zero A"], "both changes arrive at once"
    )
    page.keyboard.press("Control+z")
    wait_for(lambda: table(studio, gait)["feet"][2][4:6] == ["Zero A", "Wait A"], "they go together")
    expect(cell(page, 5, 3)).to_have_text("Zero A")


def test_names_that_start_elsewhere_are_grey_and_say_where(page: Page, studio: StudioProcess) -> None:
    copy_of(studio, WALK, "Grey")
    choose(page, "Grey")
    cell(page, 3, 1).click()
    page.keyboard.press("F2")
    expect(page.get_by_text("Foot 1 is at Home-Base")).to_be_visible()
    options = page.get_by_role("listbox", name="Segments").get_by_role("option")
    expect(options).to_have_count(13)
    grey = page.get_by_role("option", name=re.compile("^Step A"))
    expect(grey).to_have_attribute("data-why", "")
    expect(grey).to_contain_text("starts at Home-None")
    expect(page.get_by_role("option", name=re.compile("^Lift A"))).not_to_have_attribute("data-why", "")


def test_a_change_that_does_not_fit_stays_beside_the_last_table_until_a_button_mends_it(
    page: Page, studio: StudioProcess
) -> None:
    gait = copy_of(studio, WALK, "Repair")
    before = table(studio, gait)
    choose(page, "Repair")
    cell(page, 4, 1).click()
    page.keyboard.type("lift")
    page.keyboard.press("Enter")
    expect(cell(page, 4, 1)).to_have_text("Lift A")
    expect(cell(page, 5, 1)).to_have_attribute("aria-invalid", "true")
    expect(cell(page, 5, 1)).to_have_attribute("title", re.compile("the segment before it ends at Home-None"))
    assert table(studio, gait) == before
    note(page).get_by_role("button", name="Insert Push A").click()
    expect(note(page)).to_be_hidden()
    expect(cell(page, 12, 1)).to_be_visible()
    wait_for(lambda: table(studio, gait)["feet"][0][3:5] == ["Lift A", "Push A"], "the longer table")
    assert table(studio, gait)["repeat_to"] == before["repeat_to"] + 1
    page.get_by_role("button", name=re.compile("^Undo")).click()
    wait_for(lambda: table(studio, gait) == before, "one undo")


def test_undo_takes_back_what_does_not_fit_yet(page: Page, studio: StudioProcess) -> None:
    gait = copy_of(studio, WALK, "Take back")
    choose(page, "Take back")
    cell(page, 4, 1).click()
    page.keyboard.type("lift")
    page.keyboard.press("Enter")
    expect(note(page)).to_be_visible()
    expect(undo_label(page)).to_have_text("foot 1, segment 4 to Lift A")
    page.keyboard.press("Control+z")
    expect(note(page)).to_be_hidden()
    expect(cell(page, 4, 1)).to_have_text("Wait A")
    assert table(studio, gait)["feet"] == table(studio, WALK)["feet"]


def test_what_does_not_fit_yet_survives_a_reload_and_goes_when_the_table_changed(
    page: Page, studio: StudioProcess
) -> None:
    gait = copy_of(studio, WALK, "Reload")
    choose(page, "Reload")
    cell(page, 4, 1).click()
    page.keyboard.type("lift")
    page.keyboard.press("Enter")
    saved = page.locator("#saved-state")
    expect(saved).to_have_text("Table does not fit")
    page.reload()
    choose(page, "Reload")
    expect(cell(page, 4, 1)).to_have_text("Lift A")
    expect(cell(page, 5, 1)).to_have_attribute("aria-invalid", "true")
    expect(saved).to_have_text("Table does not fit")
    expect(undo_label(page)).to_have_text("foot 1, segment 4 to Lift A")
    changed = studio.document(gait)
    changed["segment_table"]["definitions"]["z"]["Base"] = 0.006
    assert studio.ask("PUT", f"/api/gaits/{gait}?label=Elsewhere", changed).status == 200
    expect(cell(page, 4, 1)).to_have_text("Wait A")
    expect(page.locator("#toasts")).to_contain_text("“Reload” was changed in another window")
    expect(note(page)).to_be_hidden()


def test_the_list_leaves_the_focus_where_the_pointer_takes_it_and_goes_with_its_table(
    page: Page, studio: StudioProcess
) -> None:
    gait = copy_of(studio, WALK, "List left")
    choose(page, "List left")
    names = page.get_by_role("listbox", name="Segments", exact=True)
    cell(page, 4, 1).dblclick()
    expect(names).to_be_visible()
    samples = page.get_by_role("spinbutton", name="Samples a segment")
    samples.click()
    expect(samples).to_be_focused()
    expect(names).to_have_count(0)
    cell(page, 4, 1).dblclick()
    expect(names).to_be_visible()
    drawn = {**studio.document(gait), "segment_table": None}
    assert studio.ask("PUT", f"/api/gaits/{gait}?label=Elsewhere", drawn).status == 200
    expect(names).to_have_count(0)


def test_what_does_not_fit_yet_goes_with_its_table(page: Page, studio: StudioProcess) -> None:
    gait = copy_of(studio, WALK, "No table")
    choose(page, "No table")
    cell(page, 4, 1).click()
    page.keyboard.type("lift")
    page.keyboard.press("Enter")
    expect(note(page)).to_be_visible()
    drawn = page.get_by_role("grid", name="Footfall timeline")
    drawn.get_by_role("gridcell", name="foot 2, sample 21: swing", exact=True).click()
    expect(page.locator("#toasts")).to_contain_text("“No table” was changed in another window")
    assert table(studio, gait) is None
    page.get_by_role("button", name=re.compile("^Undo")).click()
    expect(cell(page, 4, 1)).to_have_text("Wait A")


def test_a_repair_leaves_alone_what_was_typed_also_where_rows_moved(
    page: Page, studio: StudioProcess
) -> None:
    copy_of(studio, WALK, "Moved rows")
    choose(page, "Moved rows")
    cell(page, 4, 1).click()
    page.keyboard.type("lift")
    page.keyboard.press("Enter")
    expect(note(page)).to_be_visible()
    cell(page, 1, 1).click()
    assert kept_after(page, "Insert") == [[0, 4]]
    page.reload()
    choose(page, "Moved rows")
    expect(cell(page, 5, 1)).to_have_text("Lift A")
    assert kept_after(page, "Control+z") == [[0, 3]]


def kept_after(page: Page, key: str) -> list[list[int]]:
    """The cells, foot and segment from 0, that repairs are to leave alone after a key."""
    with page.expect_request("**/api/tables/repairs") as asked:
        page.keyboard.press(key)
    kept: list[list[int]] = (asked.value.post_data_json or {})["kept"]
    return kept


def test_message_and_numbers_stand_beside_the_table(page: Page, studio: StudioProcess) -> None:
    copy_of(studio, WALK, "Room")
    choose(page, "Room")
    samples = page.get_by_role("spinbutton", name="Samples a segment")
    assert samples.evaluate("field => getComputedStyle(field).appearance") == "textfield"
    cell(page, 10, 2).click()
    page.keyboard.type("lift")
    page.keyboard.press("Enter")
    expect(note(page)).to_be_visible()
    sheet, beside = grid(page).element_handle(), note(page).element_handle()
    gap = "([sheet, note]) => note.getBoundingClientRect().left - sheet.getBoundingClientRect().right"
    wait_for(lambda: page.evaluate(gap, [sheet, beside]) >= 0, "the note stands beside the table")
    page.keyboard.press("Control+z")
    expect(note(page)).to_be_hidden()


def test_columns_are_the_robots_own_feet_in_every_direction(page: Page, studio: StudioProcess) -> None:
    gait = copy_of(studio, WALK, "Turned", direction=2)
    choose(page, "Turned")
    expect(cell(page, 3, 4)).to_have_text("Lift A")
    cell(page, 5, 4).click()
    page.keyboard.type("wait d")
    page.keyboard.press("Enter")
    page.keyboard.type("z")
    page.keyboard.press("Enter")
    wait_for(lambda: table(studio, gait)["feet"][2][4:6] == ["Wait D", "Zero A"], "the row of direction 1")


@pytest.mark.heavy
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_list_note_and_vocabulary_have_no_serious_finding(
    page: Page, studio: StudioProcess, scheme: Literal["light", "dark"]
) -> None:
    copy_of(studio, WALK, f"Judged {scheme}")
    page.emulate_media(color_scheme=scheme)
    choose(page, f"Judged {scheme}")
    page.get_by_role("button", name="Vocabulary").click()
    cell(page, 4, 1).click()
    page.keyboard.type("lift")
    assert findings(page) == []
    page.keyboard.press("Enter")
    expect(note(page).get_by_role("button")).to_have_count(3)
    assert findings(page) == []
    page.keyboard.press("Control+z")
    expect(note(page)).to_be_hidden()
    page.get_by_role("button", name="Vocabulary").click()
