"""Choosing cells of the timeline, with every tool and by keyboard alone."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, expect

from tests.support.page.timeline_page import FOUR, TimelinePage, opened_timeline, painted, rectangle
from tests.support.studio_process import StudioProcess, wait_for

SHARES_STUDIO = True


@pytest.fixture(scope="module")
def timeline(browser: Browser, studio: StudioProcess) -> Iterator[TimelinePage]:
    with opened_timeline(browser, studio) as opened:
        yield opened


def is_selected(timeline: TimelinePage, start: tuple[int, int], end: tuple[int, int]) -> None:
    wait_for(lambda: timeline.selected() == rectangle(start, end), f"{start} to {end} are selected")


@pytest.mark.heavy
def test_shift_and_arrows_select_from_the_focused_cell_and_escape_drops_it(timeline: TimelinePage) -> None:
    timeline.open("Keys select")
    timeline.cell(2, 9).focus()
    timeline.press("Shift+ArrowRight", "Shift+ArrowRight", "Shift+ArrowDown")
    is_selected(timeline, (2, 9), (3, 11))
    expect(timeline.cell(2, 9)).to_be_focused()
    frame = timeline.page.locator(".selection-box").bounding_box()
    corner = timeline.cell(2, 9).bounding_box()
    assert frame is not None
    assert corner is not None
    assert abs(frame["x"] - corner["x"]) < 2
    assert abs(frame["y"] - corner["y"]) < 2
    timeline.press("Shift+End")
    is_selected(timeline, (2, 9), (3, 24))
    timeline.press("Shift+Home", "Shift+ArrowUp", "Shift+ArrowUp")
    is_selected(timeline, (1, 1), (2, 9))
    timeline.press("Escape")
    wait_for(lambda: timeline.selected() == [], "nothing is selected")
    timeline.press("Shift+Space")
    is_selected(timeline, (2, 1), (2, 24))
    timeline.press("ArrowLeft")
    wait_for(lambda: timeline.selected() == [], "an arrow moves on without a selection")
    expect(timeline.cell(2, 8)).to_be_focused()
    timeline.press("Control+a")
    is_selected(timeline, (1, 1), (4, 24))
    expect(timeline.grid).to_have_attribute("aria-multiselectable", "true")


def test_control_and_arrows_go_to_the_next_border_of_a_swing(timeline: TimelinePage) -> None:
    timeline.open("Borders")
    timeline.cell(1, 1).focus()
    timeline.press("Control+ArrowRight")
    expect(timeline.cell(1, 5)).to_be_focused()
    timeline.press("Control+Shift+ArrowRight")
    is_selected(timeline, (1, 5), (1, 9))
    timeline.press("End", "PageDown")
    expect(timeline.cell(4, 24)).to_be_focused()


def test_shift_click_extends_and_a_row_is_chosen_by_its_label(timeline: TimelinePage) -> None:
    gait = timeline.open("Clicks select")
    timeline.cell(2, 3).focus()
    timeline.cell(3, 6).click(modifiers=["Shift"])
    is_selected(timeline, (2, 3), (3, 6))
    timeline.cell(1, 4).click(modifiers=["Shift"])
    is_selected(timeline, (1, 3), (2, 4))
    timeline.page.get_by_role("rowheader", name="Foot 3").click()
    is_selected(timeline, (3, 1), (3, 24))
    timeline.page.get_by_role("rowheader", name="Foot 4").click(modifiers=["Shift"])
    is_selected(timeline, (3, 1), (4, 24))
    assert timeline.feet(gait) == FOUR


def test_the_select_tool_takes_a_rectangle_and_a_whole_swing(timeline: TimelinePage) -> None:
    gait = timeline.open("Select tool")
    timeline.tool("Select")
    timeline.drag((4, 9), (2, 5))
    is_selected(timeline, (2, 5), (4, 9))
    timeline.cell(2, 20).click()
    is_selected(timeline, (2, 20), (2, 20))
    timeline.cell(3, 14).dblclick()
    is_selected(timeline, (3, 13), (3, 16))
    assert timeline.feet(gait) == FOUR
    timeline.tool("Paint")


def test_what_is_selected_is_dragged_elsewhere_and_copied_with_alt(timeline: TimelinePage) -> None:
    gait = timeline.open("Carry")
    timeline.tool("Select")
    timeline.drag((1, 5), (1, 8))
    timeline.drag((1, 6), (1, 12))
    moved = painted(painted(FOUR, 1, 5, 8, "1"), 1, 11, 14, "0")
    timeline.becomes(gait, *moved)
    timeline.last_edit("Move foot 1, samples 5–8 by +6")
    is_selected(timeline, (1, 11), (1, 14))
    timeline.drag((1, 12), (1, 2), "Alt")
    timeline.becomes(gait, *painted(moved, 1, 1, 4, "0"))
    timeline.drag((1, 2), (1, 9), drop=False)
    timeline.press("Escape")
    timeline.page.mouse.up()
    timeline.becomes(gait, *painted(moved, 1, 1, 4, "0"))
    timeline.tool("Paint")


def test_a_plain_click_in_the_paint_tool_drops_the_selection_and_toggles(timeline: TimelinePage) -> None:
    gait = timeline.open("Paint after")
    timeline.select((1, 1), (2, 3))
    timeline.cell(4, 2).click()
    timeline.becomes(gait, *painted(FOUR, 4, 2, 2, "0"))
    assert timeline.selected() == []
