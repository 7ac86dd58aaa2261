"""Operations on the selection: each is one named edit, shows its preview, and lets locked cells be."""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, expect

from tests.support.page.timeline_page import FOUR, TimelinePage, opened_timeline, painted
from tests.support.studio_process import StudioProcess, wait_for

SHARES_STUDIO = True

ZEROS = "0" * 24


@pytest.fixture(scope="module")
def timeline(browser: Browser, studio: StudioProcess) -> Iterator[TimelinePage]:
    with opened_timeline(browser, studio) as opened:
        yield opened


def spliced(first: int, last: int, *inside: str) -> tuple[str, ...]:
    """The four rows with samples (counted from 1) replaced by other text."""
    return tuple(row[: first - 1] + text + row[last:] for row, text in zip(FOUR, inside, strict=True))


@pytest.mark.heavy
def test_a_number_is_asked_for_shown_on_the_timeline_and_is_one_named_edit(timeline: TimelinePage) -> None:
    gait = timeline.open("Amount")
    after = painted(FOUR, 1, 5, 10, "0")
    timeline.select((1, 5), (1, 8))
    timeline.item("Stretch").click()
    asked = timeline.page.get_by_role("dialog", name="Stretch")
    asked.get_by_label("New length").fill("6")
    wait_for(lambda: timeline.shown() == after, "the timeline shows the preview")
    assert timeline.feet(gait) == FOUR
    asked.get_by_role("button", name="Apply").click()
    timeline.becomes(gait, *after)
    timeline.last_edit("Stretch foot 1, samples 5–8 to 6 samples")
    assert len(timeline.selected()) == 6
    timeline.undo().click()
    timeline.becomes(gait, *FOUR)


def test_any_whole_length_is_taken_and_a_wrong_factor_has_a_sentence(timeline: TimelinePage) -> None:
    nine = tuple(row[:9] for row in FOUR)
    gait = timeline.open("Any length", nine)
    timeline.press("Escape", "Control+a")
    timeline.item("Stretch").click()
    asked = timeline.page.get_by_role("dialog", name="Stretch")
    factor = asked.get_by_label("Factor")
    factor.fill("0")
    expect(asked.get_by_role("status")).to_have_text("“Factor” needs a number above 0.")
    asked.get_by_label("New length").fill("10")
    expect(factor).to_have_value("1.11")
    asked.get_by_role("button", name="Apply").click()
    wait_for(lambda: len(timeline.feet(gait)[0]) == 10, "the gait has 10 samples")


def test_pointing_at_a_line_shows_its_preview_and_escape_drops_it(timeline: TimelinePage) -> None:
    gait = timeline.open("Preview")
    timeline.select((1, 1), (1, 10))
    line = timeline.item("Reverse in time")
    line.hover()
    reversed_rows = (FOUR[0][:10][::-1] + FOUR[0][10:], *FOUR[1:])
    wait_for(lambda: timeline.shown() == reversed_rows, "the preview is shown")
    changed = timeline.page.locator(".cell[data-preview]")
    expect(changed).to_have_count(
        0 if reversed_rows == FOUR else sum(a != b for a, b in zip(FOUR[0], reversed_rows[0], strict=True))
    )
    timeline.press("Escape")
    expect(line).to_be_hidden()
    timeline.becomes(gait, *FOUR)
    assert len(timeline.selected()) == 10


def test_the_menu_is_used_with_the_keyboard_alone(timeline: TimelinePage) -> None:
    gait = timeline.open("Keyboard menu")
    timeline.cell(1, 5).focus()
    timeline.press("Shift+ArrowRight")
    button = timeline.page.get_by_role("button", name="Edit", exact=True)
    button.focus()
    timeline.press("Enter", "ArrowDown", "ArrowDown", "ArrowDown", "ArrowDown", "Enter")
    timeline.becomes(gait, *painted(FOUR, 1, 5, 6, "1"))
    expect(button).to_be_focused()
    timeline.press("Enter", "ArrowUp", "Home", "End", "Escape")
    expect(timeline.page.get_by_role("menu", name="Edit the timeline")).to_be_hidden()
    expect(button).to_be_focused()


def test_samples_come_and_go_at_the_focused_cell(timeline: TimelinePage) -> None:
    gait = timeline.open("Columns")
    timeline.cell(2, 6).focus()
    timeline.item("Insert samples").click()
    asked = timeline.page.get_by_role("dialog", name="Insert samples")
    expect(asked).to_contain_text("Works on all feet, sample 6.")
    asked.get_by_role("spinbutton").press("Enter")
    timeline.becomes(gait, *spliced(6, 5, "0", "1", "1", "1"))
    timeline.press("Escape")
    timeline.cell(2, 6).focus()
    timeline.item("Remove samples").click()
    timeline.becomes(gait, *FOUR)
    timeline.last_edit("Remove sample 6")


def test_without_a_selection_the_whole_timeline_is_meant(timeline: TimelinePage) -> None:
    gait = timeline.open("Whole")
    timeline.item("Mirror").click()
    timeline.becomes(gait, FOUR[1], FOUR[0], FOUR[3], FOUR[2])
    timeline.last_edit("Mirror the whole timeline")
    timeline.item("Rotate by 90°").click()
    timeline.becomes(gait, FOUR[2], FOUR[1], FOUR[0], FOUR[3])
    timeline.last_edit("Direction to 2")
    assert timeline.document(gait)["direction"] == 2


@pytest.mark.heavy
def test_the_menu_keeps_its_place_under_the_pointer(timeline: TimelinePage) -> None:
    timeline.open("Menu")
    first = timeline.item("Copy")
    place = first.bounding_box()
    for item in timeline.page.get_by_role("menu", name="Edit the timeline").get_by_role("menuitem").all():
        item.hover()
        assert first.bounding_box() == place, item.inner_text()
    timeline.press("Escape")


def test_repeating_the_whole_is_more_iterations(timeline: TimelinePage) -> None:
    drawn = tuple("1" * (5 + 10 * foot) + "0" * 5 + "1" * (35 - 10 * foot) for foot in range(4))
    gait = timeline.open("Iterations", drawn)
    timeline.item("Repeat").click()
    asked = timeline.page.get_by_role("dialog", name="Repeat")
    expect(asked.get_by_role("status")).to_contain_text(
        "2 iterations. The length of the timeline changes from 45 to 85 samples (33.6 s)"
    )
    asked.get_by_role("spinbutton").press("Enter")
    wait_for(lambda: len(timeline.feet(gait)[0]) == 85, "it is run through twice")
    assert timeline.document(gait)["iterations"] == 2
    timeline.last_edit("Iterations to 2")
    expect(timeline.grid).to_have_attribute("aria-colcount", "85")


def test_a_stretch_takes_a_factor_and_keeps_every_swing(timeline: TimelinePage) -> None:
    gait = timeline.open("Factor")
    timeline.item("Stretch…").click()
    asked = timeline.page.get_by_role("dialog", name="Stretch")
    asked.get_by_label("Factor").fill("1.5")
    expect(asked.get_by_label("New length")).to_have_value("36")
    asked.get_by_label("New length").fill("3")
    expect(asked.get_by_role("status")).to_contain_text("would disappear")
    expect(asked.get_by_role("button", name="Apply")).to_have_attribute("aria-disabled", "true")
    asked.get_by_label("New length").fill("0")
    expect(asked.get_by_role("status")).to_contain_text("must lie between 1 and 2000 samples")
    asked.get_by_role("button", name="Cancel").click()
    timeline.becomes(gait, *FOUR)


def test_what_a_locked_cell_forbids_says_which_and_does_nothing(timeline: TimelinePage) -> None:
    locked = [ZEROS[:5] + "1" + ZEROS[6:], ZEROS, ZEROS, ZEROS]
    gait = timeline.open("Held", timeline={"sample_time": 0.4, "feet": list(FOUR), "locked": locked})
    timeline.select((1, 5), (1, 8))
    line = timeline.item("To stance")
    line.hover()
    expect(line).to_have_attribute("aria-disabled", "true")
    expect(line).to_have_attribute(
        "aria-description", re.compile("would change foot 1, sample 6, which is locked")
    )
    timeline.press("Escape", "Delete")
    timeline.said("This operation would change foot 1, sample 6, which is locked. Unlock this cell first.")
    line = timeline.item("Remove samples")
    expect(line).to_have_attribute(
        "aria-description", re.compile("Foot 1, sample 6 is locked. Unlock all cells")
    )
    timeline.press("Escape")
    assert timeline.feet(gait) == FOUR


@pytest.mark.heavy
def test_cells_are_copied_as_text_and_pasted_where_they_fit(timeline: TimelinePage) -> None:
    page = timeline.page
    page.context.grant_permissions(["clipboard-read", "clipboard-write"])
    gait = timeline.open("Clipboard")
    timeline.select((1, 7), (2, 10))
    timeline.press("Control+c")
    wait_for(
        lambda: page.evaluate("() => navigator.clipboard.readText()") == "0011\n1100",
        "it is on the clipboard",
    )
    timeline.press("Escape")
    timeline.cell(3, 1).focus()
    timeline.press("Control+v")
    pasted = painted(painted(FOUR, 3, 1, 2, "0"), 4, 3, 4, "0")
    timeline.becomes(gait, *pasted)
    timeline.last_edit("Paste at foot 3, sample 1")
    timeline.press("Escape")
    timeline.cell(4, 23).focus()
    timeline.press("Control+v")
    timeline.becomes(gait, *painted(pasted, 4, 23, 24, "0"))
    timeline.said(
        "Some of the copied cells did not fit and were not pasted: "
        "2 samples after the end and 1 row below the last foot."
    )
    timeline.undo().click()
    page.evaluate("() => navigator.clipboard.writeText('stance, swing')")
    timeline.press("Control+v")
    timeline.said("The clipboard has no timeline cells. Line 1 may contain only 1 (stance) and 0 (swing).")
    timeline.becomes(gait, *pasted)


def test_a_copy_that_ends_with_the_timeline_is_cut_and_says_so(timeline: TimelinePage) -> None:
    gait = timeline.open("Clipped")
    timeline.select((4, 17), (4, 21))
    timeline.press("Control+d")
    timeline.becomes(gait, *painted(FOUR, 4, 22, 24, "0"))
    timeline.said("The last 2 samples of the result do not fit into the timeline and are cut off.")
    timeline.press("Control+d")
    timeline.said("so a copy does not fit")


@pytest.mark.heavy
def test_cut_duplicate_and_delete_have_their_keys(timeline: TimelinePage) -> None:
    gait = timeline.open("Cut keys")
    timeline.select((1, 5), (1, 8))
    timeline.press("Control+x")
    timeline.becomes(gait, *painted(FOUR, 1, 5, 8, "1"))
    timeline.last_edit("Cut foot 1, samples 5–8")
    timeline.press("Control+v", "Control+d")
    timeline.becomes(gait, *painted(FOUR, 1, 9, 12, "0"))
    timeline.press("Backspace")
    timeline.becomes(gait, *FOUR)
    timeline.press("Escape")
    timeline.cell(2, 9).focus()
    timeline.press("Delete")
    timeline.becomes(gait, *painted(FOUR, 2, 9, 9, "1"))
    timeline.page.get_by_role("slider", name="Playhead").focus()
    timeline.press("Delete")
    timeline.said("No cells are selected")
    timeline.press("Control+z", "Control+Shift+z", "Control+z", "Control+y")
    timeline.becomes(gait, *painted(FOUR, 2, 9, 9, "1"))
