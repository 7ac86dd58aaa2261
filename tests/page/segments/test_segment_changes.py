"""Larger changes of a segment table on the page: pastes, rows, numbers, words of its own, drawings."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.support.page.segments_page import (
    WALK,
    cell,
    choose,
    copy_of,
    note,
    opened_segments,
    put_on_clipboard,
    table,
    undo_label,
)
from tests.support.studio_process import StudioProcess, wait_for

SHARES_STUDIO = True


@pytest.fixture(scope="module")
def page(browser: Browser, studio: StudioProcess) -> Iterator[Page]:
    with opened_segments(browser, studio) as opened:
        yield opened


@pytest.mark.heavy
def test_copies_go_to_other_cells_and_come_from_a_spreadsheet(page: Page, studio: StudioProcess) -> None:
    gait = copy_of(studio, WALK, "Clipboard")
    choose(page, "Clipboard")
    cell(page, 3, 3).click()
    cell(page, 5, 3).click(modifiers=["Shift"])
    page.keyboard.press("Control+c")
    copied = "() => navigator.clipboard.readText()"
    wait_for(lambda: page.evaluate(copied) == "Lift A\nStep A\nZero A", "the segments are copied")
    page.keyboard.press("Delete")
    wait_for(lambda: table(studio, gait)["feet"][2] == ["Push A", *["Wait A"] * 10], "the foot waits")
    cell(page, 8, 3).click()
    page.keyboard.press("Control+v")
    wait_for(lambda: table(studio, gait)["feet"][2][7:10] == ["Lift A", "Step A", "Zero A"], "the paste")
    expect(undo_label(page)).to_have_text("paste into foot 3, segments 8–10")
    put_on_clipboard(page, 'wait a,"Wait A"\nLIFT A,Wait A\nStep A,Wait A\nzero a,Wait A\n')
    cell(page, 3, 3).click()
    page.keyboard.press("Control+v")
    wait_for(lambda: table(studio, gait)["feet"][2][2:6] == ["Wait A", "Lift A", "Step A", "Zero A"], "CSV")


def test_names_that_a_spreadsheet_would_run_are_copied_as_text_and_come_back(
    page: Page, studio: StudioProcess
) -> None:
    names = {"Lift A": "=1+1", "Step A": "-Step A", "Zero A": "'=Zero A"}
    content = json.dumps(studio.document(WALK)["segment_table"])
    for before, after in names.items():
        content = content.replace(f'"{before}"', f'"{after}"')
    gait = copy_of(studio, WALK, "Formulas", segment_table=json.loads(content))
    choose(page, "Formulas")
    cell(page, 3, 3).click()
    cell(page, 5, 3).click(modifiers=["Shift"])
    page.keyboard.press("Control+c")
    copied = page.evaluate("() => navigator.clipboard.readText()")
    assert copied == "'=1+1\n'-Step A\n''=Zero A"
    page.keyboard.press("Delete")
    wait_for(lambda: table(studio, gait)["feet"][2] == ["Push A", *["Wait A"] * 10], "the foot waits")
    for text in (copied, "\n".join(names.values())):
        put_on_clipboard(page, text)
        cell(page, 8, 3).click()
        page.keyboard.press("Control+v")
        wait_for(lambda: table(studio, gait)["feet"][2][7:10] == list(names.values()), "the paste")
        page.keyboard.press("Delete")
        wait_for(lambda: table(studio, gait)["feet"][2] == ["Push A", *["Wait A"] * 10], "the foot waits")


TABLE = """() => {
  const table = document.createElement("table");
  for (const texts of [["Gait", "Error"], ["=1+1", "-1.50"], ["Walk", "@SUM(A1)"]]) {
    const row = table.insertRow();
    for (const text of texts) row.insertCell().textContent = text;
  }
  document.body.append(table);
  getSelection().selectAllChildren(table);
}"""


def test_a_table_of_the_page_that_is_copied_begins_no_formula(page: Page) -> None:
    page.evaluate("() => document.activeElement.blur()")
    page.evaluate(TABLE)
    page.keyboard.press("Control+c")
    copied = page.evaluate("() => navigator.clipboard.readText()")
    assert [line.split("\t") for line in copied.strip().splitlines()] == [
        ["Gait", "Error"],
        ["'=1+1", "-1.50"],
        ["Walk", "'@SUM(A1)"],
    ]
    html = page.evaluate(
        "async () => (await (await navigator.clipboard.read())[0].getType('text/html')).text()"
    )
    assert "<td>'=1+1</td>" in html
    assert "<td>-1.50</td>" in html
    page.evaluate("() => document.body.lastElementChild.remove()")


def test_a_paste_that_does_not_fit_is_refused_with_the_place_and_the_table_stays(
    page: Page, studio: StudioProcess
) -> None:
    gait = copy_of(studio, WALK, "Refusals")
    before = table(studio, gait)
    choose(page, "Refusals")
    cell(page, 2, 2).click()
    put_on_clipboard(page, "Wait A\tHop A")
    page.keyboard.press("Control+v")
    expect(page.locator("#toasts")).to_contain_text("Foot 3, segment 2: there is no segment “Hop A”")
    put_on_clipboard(page, "Wait A\tStep A")
    page.keyboard.press("Control+v")
    expect(page.locator("#toasts")).to_contain_text("Foot 3, segment 2: “Step A” starts at Home-None")
    expect(note(page)).to_be_hidden()
    assert table(studio, gait) == before
    for text, place in (("Wait A\t\tWait A", "Foot 3"), ("\tWait A", "Foot 2")):
        put_on_clipboard(page, text)
        page.keyboard.press("Control+v")
        expect(page.locator("#toasts")).to_contain_text(f"{place}, segment 2: there is no segment “”")
    put_on_clipboard(page, "Wait A\tWait A\tWait A\tWait A\tWait A")
    page.keyboard.press("Control+v")
    expect(page.locator("#toasts")).to_contain_text(
        "Some of the copied segments did not fit and were not pasted: 2 columns after the last foot"
    )
    expect(page.locator("#toasts")).to_contain_text("already have this segment")


def test_segments_are_inserted_removed_and_filled_down(page: Page, studio: StudioProcess) -> None:
    gait = copy_of(studio, WALK, "Rows")
    before = table(studio, gait)
    choose(page, "Rows")
    cell(page, 4, 1).click()
    page.keyboard.press("Insert")
    wait_for(lambda: table(studio, gait)["feet"][2][4] == "Wait D", "every foot waits where it is")
    assert (table(studio, gait)["repeat_from"], table(studio, gait)["repeat_to"]) == (4, 11)
    expect(cell(page, 5, 1)).to_be_focused()
    page.keyboard.press("Control+Delete")
    wait_for(lambda: table(studio, gait) == before, "removed again")
    cell(page, 3, 1).click()
    page.get_by_role("button", name="Insert", exact=True).click()
    expect(page.locator("#toasts")).to_contain_text("Foot 3 is in the air at Home-None after segment 3")
    cell(page, 6, 3).click()
    cell(page, 9, 3).click(modifiers=["Shift"])
    page.keyboard.press("Control+d")
    expect(page.locator("#toasts")).to_contain_text("already have this segment")
    assert table(studio, gait) == before


def test_numbers_and_the_link_are_typed(page: Page, studio: StudioProcess) -> None:
    gait = copy_of(studio, WALK, "Numbers")
    choose(page, "Numbers")
    samples = page.get_by_role("spinbutton", name="Samples a segment")
    samples.fill("3")
    samples.press("Enter")
    wait_for(lambda: len(studio.document(gait)["timeline"]["feet"][0]) == 33, "the timeline follows")
    expect(undo_label(page)).to_have_text("samples a segment to 3")
    cell(page, "Link segment 1", 2).click()
    page.keyboard.type("lean a")
    page.keyboard.press("Enter")
    wait_for(lambda: table(studio, gait)["link"][1] == ["Lean A"], "the link is changed")
    expect(note(page)).to_contain_text("the segment ends at Lean-Base")
    note(page).get_by_role("button").click()
    wait_for(lambda: table(studio, gait)["link"][1] == ["Wait A"], "the link is mended")
    repeat = page.get_by_role("spinbutton", name="Repeat to segment")
    repeat.fill("99")
    repeat.press("Enter")
    expect(page.locator("#toasts")).to_contain_text(
        "“Repeat to segment” cannot be 99. The value must lie between 4 and 11"
    )
    assert table(studio, gait)["repeat_to"] == 10


def test_a_segment_before_the_links_first_is_the_links(page: Page, studio: StudioProcess) -> None:
    gait = copy_of(studio, WALK, "Longer link")
    before = table(studio, gait)
    choose(page, "Longer link")
    cell(page, "Link segment 1", 1).click()
    page.keyboard.press("Alt+Insert")
    wait_for(lambda: len(table(studio, gait)["link"][0]) == 2, "the link is longer")
    assert table(studio, gait)["feet"] == before["feet"]
    expect(undo_label(page)).to_have_text("insert before link segment 1")


@pytest.mark.heavy
def test_segments_and_positions_of_ones_own(page: Page, studio: StudioProcess) -> None:
    gait = copy_of(studio, WALK, "Words")
    choose(page, "Words")
    page.get_by_role("button", name="Vocabulary").click()
    words = page.get_by_role("region", name="Vocabulary")
    expect(words.get_by_label("Name of the height None")).to_be_in_viewport()
    words.get_by_role("button", name="Add a segment").click()
    expect(words.get_by_label("Name of the segment Segment 1")).to_be_focused()
    page.keyboard.type("Hover A")
    page.keyboard.press("Tab")
    expect(words.get_by_label("Start of Hover A")).to_be_focused()
    words.get_by_label("Start of Hover A").select_option("Home-None")
    words.get_by_label("End of Hover A").select_option("Home-None")
    words.get_by_label("Hover A is in the air").check()
    hover = {"start": "Home-None", "end": "Home-None", "swing": True}
    wait_for(lambda: table(studio, gait)["definitions"]["segments"].get("Hover A") == hover, "the segment")
    expect(undo_label(page)).to_have_text("hover A in the air")
    height = words.get_by_label("Stroke of each motor when the foot is in its middle position at Base, mm")
    height.fill("6")
    height.press("Enter")
    wait_for(lambda: table(studio, gait)["definitions"]["z"]["Base"] == 0.006, "the height")
    expect(page.locator("#toasts")).not_to_contain_text("object")
    place = words.get_by_label("Name of the place Step")
    place.fill("Reach")
    place.press("Enter")
    wait_for(
        lambda: table(studio, gait)["definitions"]["segments"]["Step A"]["end"] == "Reach-Base", "renamed"
    )
    gone = words.get_by_role("button", name="Delete the segment Lift A")
    expect(gone).to_have_attribute("aria-disabled", "true")
    expect(gone).to_have_attribute("title", re.compile("The table uses “Lift A” in 5 cells"))
    height.fill("99")
    height.press("Enter")
    expect(page.locator("#toasts")).to_contain_text(
        "“Base” cannot be 99 mm. The robot's motors reach 0.5 to 19.5 mm"
    )
    expect(height).to_have_value("6")
    words.get_by_role("button", name="Delete the segment Hover A").click()
    wait_for(lambda: "Hover A" not in table(studio, gait)["definitions"]["segments"], "deleted")


def test_words_that_changed_while_one_types_are_there_afterwards(page: Page, studio: StudioProcess) -> None:
    gait = copy_of(studio, WALK, "Two at it")
    choose(page, "Two at it")
    words = page.get_by_role("region", name="Vocabulary")
    if not words.is_visible():
        page.get_by_role("button", name="Vocabulary").click()
    words.get_by_label("Name of the place Step").fill("Stepp")
    changed = studio.document(gait)
    changed["segment_table"]["definitions"]["z"]["Base"] = 0.006
    assert studio.ask("PUT", f"/api/gaits/{gait}?label=Elsewhere", changed).status == 200
    expect(undo_label(page)).to_have_text("elsewhere")
    page.keyboard.press("Escape")
    page.keyboard.press("Tab")
    expect(
        words.get_by_label("Stroke of each motor when the foot is in its middle position at Base, mm")
    ).to_have_value("6")
    assert "Step" in table(studio, gait)["definitions"]["xy"]


@pytest.mark.heavy
def test_a_drawing_goes_into_the_table_or_the_page_says_why_not(page: Page, studio: StudioProcess) -> None:
    gait = copy_of(studio, WALK, "Drawing")
    choose(page, "Drawing")
    samples = page.get_by_role("grid", name="Footfall timeline")
    for sample in range(11, 21):
        samples.get_by_role("gridcell", name=f"foot 3, sample {sample}: swing", exact=True).wait_for()
    cell(page, 3, 3).click()
    cell(page, 4, 3).click(modifiers=["Shift"])
    samples.get_by_role("gridcell", name=re.compile("^foot 3, sample 11:")).focus()
    page.keyboard.press("Delete")
    wait_for(lambda: "Step A" not in table(studio, gait)["feet"][2], "the table follows")
    expect(cell(page, 3, 3)).to_have_text("Wait A")
    samples.get_by_role("gridcell", name="foot 2, sample 21: swing", exact=True).click()
    said = "Foot 2 would step from sample 22; segments change at samples 21 and 26."
    expect(page.locator("#segments")).to_contain_text(said)
    assert table(studio, gait) is None
    page.get_by_role("button", name=re.compile("^Undo")).click()
    expect(cell(page, 5, 2)).to_have_text("Lift A")


@pytest.mark.heavy
def test_a_table_is_made_of_a_drawing_with_room_for_steps(page: Page, studio: StudioProcess) -> None:
    gait = copy_of(studio, "walk", "Making")
    choose(page, "Making")
    make = page.get_by_role("button", name="Make a segment table")
    expect(make).to_have_attribute("aria-disabled", "true")
    expect(make).to_have_attribute("title", re.compile("such as 6"))
    page.get_by_role("button", name="Make a table with phases of 6 samples").click()
    expect(cell(page, 3, 3)).to_have_text("Lift A")
    wait_for(lambda: studio.document(gait)["options"]["phase_knots"] == 6, "the phases are longer")
    assert table(studio, gait)["samples_per_segment"] == 3
    page.get_by_role("button", name=re.compile("^Undo")).click()
    expect(make).to_be_visible()
    wait_for(lambda: studio.document(gait)["options"]["phase_knots"] == 5, "both are undone")
    order = {"order": [3, 2, 4, 1], "phase_knots": 6, "closing_knots": 6}
    assert studio.ask("POST", f"/api/gaits/{gait}/redraw", order).status == 200
    expect(make).not_to_have_attribute("aria-disabled", "true")
    drawn = studio.document(gait)["timeline"]["feet"]
    make.click()
    expect(cell(page, 3, 3)).to_have_text("Lift A")
    expect(undo_label(page)).to_have_text("make a segment table")
    assert studio.document(gait)["timeline"]["feet"] == drawn
