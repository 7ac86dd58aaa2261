"""The segment table on the page: typed like a spreadsheet, one selection with the timeline, nothing lost."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any, Literal

import pytest
from playwright.sync_api import Browser, Locator, Page, expect

from tests.page.opened import opened_page
from tests.page.test_accessibility import serious_findings
from tests.studio_process import StudioProcess, wait_for

LONG_MS = 20_000
WALK, WALK_NAME = "walk-manual-0", "Manual walk, v0"


@pytest.fixture(scope="module")
def page(browser: Browser, studio: StudioProcess) -> Iterator[Page]:
    """One page for all: each test has a gait of its own."""
    with opened_page(browser, studio.url, 1280, 800, has_scene=False) as opened:
        opened.set_default_timeout(LONG_MS)
        expect.set_options(timeout=LONG_MS)
        opened.context.grant_permissions(["clipboard-read", "clipboard-write"])
        yield opened
        expect.set_options(timeout=5000)


def copy_of(studio: StudioProcess, gait: str, name: str, **changes: Any) -> str:
    """A saved gait of its own for a test, then edited in some fields; gives its id."""
    answer = studio.ask("POST", "/api/gaits", {**document(studio, gait), "name": name})
    assert answer.status == 201
    gait_id: str = answer.content["id"]
    if changes:
        edited = {**document(studio, gait_id), **changes}
        assert studio.ask("PUT", f"/api/gaits/{gait_id}?label=Prepare", edited).status == 200
    return gait_id


def choose(page: Page, name: str) -> None:
    page.get_by_role("list", name="Gaits").get_by_role(
        "button", name=re.compile(f"^{re.escape(name)}")
    ).click()
    expect(page.get_by_label("Gait name")).to_have_value(name)
    page.get_by_role("tab", name="Segments").click()


def document(studio: StudioProcess, gait: str) -> dict[str, Any]:
    content: dict[str, Any] = studio.ask("GET", f"/api/gaits/{gait}").content
    return content


def table(studio: StudioProcess, gait: str) -> dict[str, Any]:
    content: dict[str, Any] = document(studio, gait)["segment_table"]
    return content


def grid(page: Page) -> Locator:
    return page.get_by_role("grid", name="Segment table")


def cell(page: Page, segment: int | str, foot: int) -> Locator:
    """The cell of a segment, counted from 1, or of "Link segment 1"."""
    name = f"Segment {segment}" if isinstance(segment, int) else segment
    return grid(page).get_by_role("row", name=name, exact=True).get_by_role("gridcell").nth(foot - 1)


def note(page: Page) -> Locator:
    return page.get_by_role("status", name="Segment table note")


def undo_label(page: Page) -> Locator:
    return page.locator("#undo-label")


def selected_samples(page: Page) -> list[str]:
    cells = page.get_by_role("grid", name="Footfall timeline").locator('[aria-selected="true"]').all()
    return [re.sub(":.*", "", one.get_attribute("aria-label") or "") for one in cells]


def put_on_clipboard(page: Page, text: str) -> None:
    page.evaluate("text => navigator.clipboard.writeText(text)", text)


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
    expect(cell(page, 5, 1)).to_have_attribute("title", re.compile("the foot is at Home-None then"))
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
    expect(saved).to_have_text("· table does not fit")
    page.reload()
    choose(page, "Reload")
    expect(cell(page, 4, 1)).to_have_text("Lift A")
    expect(cell(page, 5, 1)).to_have_attribute("aria-invalid", "true")
    expect(saved).to_have_text("· table does not fit")
    expect(undo_label(page)).to_have_text("foot 1, segment 4 to Lift A")
    changed = document(studio, gait)
    changed["segment_table"]["definitions"]["z"]["Base"] = 0.006
    assert studio.ask("PUT", f"/api/gaits/{gait}?label=Elsewhere", changed).status == 200
    expect(cell(page, 4, 1)).to_have_text("Wait A")
    expect(page.locator("#toasts")).to_contain_text("“Reload” that did not fit yet are dropped")
    expect(note(page)).to_be_hidden()


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
    gap = "([sheet, note]) => note.getBoundingClientRect().top - sheet.getBoundingClientRect().bottom"
    wait_for(lambda: page.evaluate(gap, [sheet, beside]) >= 0, "the note stands below the table")
    page.keyboard.press("Control+z")
    expect(note(page)).to_be_hidden()


def test_a_manual_plan_that_cannot_be_carried_out_is_not_green(page: Page) -> None:
    said = page.evaluate(
        """async () => {
            const { planState } = await import("/static/answer.js");
            const plan = { source: "manual", live: null, times: [0, 1], refusal: null, balance: 0.01 };
            const unreachable = { ...plan, refusal: { sentence: "Too far." } };
            return [plan, { ...plan, balance: -0.004 }, unreachable].map(planState);
        }"""
    )
    assert said == [
        ["By hand", "good"],
        ["By hand, off balance", "caution"],
        ["By hand, out of reach", "bad"],
    ]


def test_copies_go_to_other_cells_and_come_from_a_spreadsheet(page: Page, studio: StudioProcess) -> None:
    gait = copy_of(studio, WALK, "Clipboard")
    choose(page, "Clipboard")
    cell(page, 3, 3).click()
    cell(page, 5, 3).click(modifiers=["Shift"])
    page.keyboard.press("Control+c")
    assert page.evaluate("() => navigator.clipboard.readText()") == "Lift A\nStep A\nZero A"
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
    put_on_clipboard(page, "Wait A\tWait A\tWait A\tWait A\tWait A")
    page.keyboard.press("Control+v")
    expect(page.locator("#toasts")).to_contain_text("2 columns behind the last foot did not fit")
    expect(page.locator("#toasts")).to_contain_text("The same stands here already")


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
    expect(page.locator("#toasts")).to_contain_text("foot 3 is in mid-air at Home-None after segment 3")
    cell(page, 6, 3).click()
    cell(page, 9, 3).click(modifiers=["Shift"])
    page.keyboard.press("Control+d")
    expect(page.locator("#toasts")).to_contain_text("stands here already")
    assert table(studio, gait) == before


def test_numbers_and_the_link_are_typed(page: Page, studio: StudioProcess) -> None:
    gait = copy_of(studio, WALK, "Numbers")
    choose(page, "Numbers")
    samples = page.get_by_role("spinbutton", name="Samples a segment")
    samples.fill("3")
    samples.press("Enter")
    wait_for(lambda: len(document(studio, gait)["timeline"]["feet"][0]) == 33, "the timeline follows")
    expect(undo_label(page)).to_have_text("samples a segment to 3")
    cell(page, "Link segment 1", 2).click()
    page.keyboard.type("lean a")
    page.keyboard.press("Enter")
    wait_for(lambda: table(studio, gait)["link"][1] == ["Lean A"], "the link is changed")
    expect(note(page)).to_contain_text("Foot 2, link segment 1: leads to Lean-Base")
    note(page).get_by_role("button").click()
    wait_for(lambda: table(studio, gait)["link"][1] == ["Wait A"], "the link is mended")
    repeat = page.get_by_role("spinbutton", name="Repeat to segment")
    repeat.fill("99")
    repeat.press("Enter")
    expect(page.locator("#toasts")).to_contain_text("Repeat to segment is 99; it must lie between 4 and 11")
    assert table(studio, gait)["repeat_to"] == 10


def test_segments_and_positions_of_ones_own(page: Page, studio: StudioProcess) -> None:
    gait = copy_of(studio, WALK, "Words")
    choose(page, "Words")
    page.get_by_role("button", name="Vocabulary").click()
    words = page.get_by_role("region", name="Vocabulary")
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
    height = words.get_by_label("Motor stroke of a centred foot at Base, mm")
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
    expect(gone).to_have_attribute("title", re.compile("stands in 5 cells of the table"))
    height.fill("99")
    height.press("Enter")
    expect(page.locator("#toasts")).to_contain_text(
        "Base cannot be 99 mm: the robot's motors reach 0.5 to 19.5 mm"
    )
    expect(height).to_have_value("6")
    words.get_by_role("button", name="Delete the segment Hover A").click()
    wait_for(lambda: "Hover A" not in table(studio, gait)["definitions"]["segments"], "deleted")


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


def test_a_table_is_made_of_a_drawing_with_room_for_steps(page: Page, studio: StudioProcess) -> None:
    gait = copy_of(studio, "walk", "Making")
    choose(page, "Making")
    make = page.get_by_role("button", name="Make a segment table")
    expect(make).to_have_attribute("aria-disabled", "true")
    expect(make).to_have_attribute("title", re.compile("such as 6"))
    page.get_by_role("button", name="Make one with phases of 6").click()
    expect(cell(page, 3, 3)).to_have_text("Lift A")
    wait_for(lambda: document(studio, gait)["options"]["phase_knots"] == 6, "the phases are longer")
    assert table(studio, gait)["samples_per_segment"] == 3
    page.get_by_role("button", name=re.compile("^Undo")).click()
    expect(make).to_be_visible()
    wait_for(lambda: document(studio, gait)["options"]["phase_knots"] == 5, "both are undone")
    order = {"order": [3, 2, 4, 1], "phase_knots": 6, "closing_knots": 6}
    assert studio.ask("POST", f"/api/gaits/{gait}/redraw", order).status == 200
    expect(make).not_to_have_attribute("aria-disabled", "true")
    drawn = document(studio, gait)["timeline"]["feet"]
    make.click()
    expect(cell(page, 3, 3)).to_have_text("Lift A")
    expect(undo_label(page)).to_have_text("make a segment table")
    assert document(studio, gait)["timeline"]["feet"] == drawn


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
    assert serious_findings(page) == []
    page.keyboard.press("Enter")
    expect(note(page).get_by_role("button")).to_have_count(3)
    assert serious_findings(page) == []
    page.keyboard.press("Control+z")
    expect(note(page)).to_be_hidden()
    page.get_by_role("button", name="Vocabulary").click()
