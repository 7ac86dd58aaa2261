"""Locks, zoom, loop and the keys of the timeline."""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, expect

from tests.support.page.timeline_page import FOUR, TimelinePage, opened_timeline, painted
from tests.support.studio_process import StudioProcess, wait_for

SHARES_STUDIO = True

NONE = "0" * 24


@pytest.fixture(scope="module")
def timeline(browser: Browser, studio: StudioProcess) -> Iterator[TimelinePage]:
    with opened_timeline(browser, studio) as opened:
        yield opened


def has_locks(timeline: TimelinePage, gait: str, *rows: str) -> None:
    wait_for(lambda: tuple(timeline.document(gait)["timeline"]["locked"]) == rows, f"the locks are {rows}")


def shown_columns(timeline: TimelinePage) -> float:
    """How many of 24 samples the window shows."""
    width: float = timeline.page.evaluate(
        """() => (24 * document.querySelector(".cells-window").clientWidth)
          / document.querySelector(".cells").getBoundingClientRect().width"""
    )
    return width


def place(timeline: TimelinePage, selector: str) -> tuple[float, float]:
    """Left and right edge of something on the screen."""
    box = timeline.page.locator(selector).first.bounding_box()
    assert box is not None
    return box["x"], box["x"] + box["width"]


@pytest.mark.heavy
def test_a_drag_with_shift_locks_a_rectangle_and_from_a_locked_cell_unlocks(timeline: TimelinePage) -> None:
    gait = timeline.open("Shift locks")
    timeline.drag((1, 2), (2, 4), "Shift")
    three = "0111" + NONE[4:]
    has_locks(timeline, gait, three, three, NONE, NONE)
    timeline.last_edit("Lock feet 1–2, samples 2–4")
    expect(timeline.cell(1, 3)).to_have_attribute("aria-label", "foot 1, sample 3: stance, locked")
    timeline.cell(1, 3).click()
    timeline.said("Foot 1, sample 3 is locked.")
    assert timeline.feet(gait) == FOUR
    timeline.drag((2, 4), (2, 2), "Shift")
    has_locks(timeline, gait, three, NONE, NONE, NONE)
    timeline.last_edit("Unlock foot 2, samples 2–4")
    timeline.tool("Lock")
    timeline.drag((1, 2), (1, 4))
    has_locks(timeline, gait, NONE, NONE, NONE, NONE)
    timeline.cell(4, 24).click()
    has_locks(timeline, gait, NONE, NONE, NONE, NONE[:-1] + "1")
    timeline.press("b")
    expect(timeline.page.get_by_role("button", name="Paint", exact=True)).to_have_attribute(
        "aria-pressed", "true"
    )
    timeline.cell(1, 2).click()
    timeline.becomes(gait, *painted(FOUR, 1, 2, 2, "0"))


@pytest.mark.heavy
def test_k_locks_the_focused_cell_or_the_selection_and_paint_passes_it_over(timeline: TimelinePage) -> None:
    gait = timeline.open("K locks")
    timeline.cell(3, 3).focus()
    timeline.press("k")
    has_locks(timeline, gait, NONE, NONE, "001" + NONE[3:], NONE)
    timeline.drag((3, 2), (3, 4))
    timeline.becomes(gait, *painted(painted(FOUR, 3, 2, 2, "0"), 3, 4, 4, "0"))
    timeline.press("Control+a", "k")
    has_locks(timeline, gait, *["1" * 24] * 4)
    timeline.press("k")
    has_locks(timeline, gait, *[NONE] * 4)


def test_the_wheel_zooms_about_the_pointer_and_f_shows_all(timeline: TimelinePage) -> None:
    timeline.open("Wheel")
    wait_for(lambda: abs(shown_columns(timeline) - 24) < 0.2, "all of it is shown")
    timeline.page.mouse.move(*timeline.middle(2, 17))
    before = timeline.middle(2, 17)[0]
    timeline.page.keyboard.down("Control")
    timeline.page.mouse.wheel(0, -200)
    timeline.page.keyboard.up("Control")
    wait_for(lambda: shown_columns(timeline) < 16, "it is closer")
    assert abs(timeline.middle(2, 17)[0] - before) < 30
    left = place(timeline, "#timeline .cells")[0]
    timeline.page.mouse.wheel(200, 0)
    wait_for(lambda: place(timeline, "#timeline .cells")[0] < left, "it scrolls along")
    bar = timeline.page.get_by_role("scrollbar", name="Shown part of the timeline")
    expect(bar).to_be_visible()
    timeline.press("f")
    wait_for(lambda: abs(shown_columns(timeline) - 24) < 0.2, "all of it is shown again")
    expect(bar).to_be_hidden()


def test_plus_and_minus_zoom_and_ruler_playhead_and_focus_stay_together(timeline: TimelinePage) -> None:
    timeline.open("Keys zoom")
    timeline.press("Home", "+", "+", "+")
    wait_for(lambda: abs(shown_columns(timeline) - 8) < 0.2, "it is as close as it goes")
    ruler = timeline.page.get_by_role("slider", name="Playhead")
    ruler.focus()
    timeline.press("End")
    wait_for(lambda: place(timeline, "#timeline .cells")[0] < 0, "the window follows the playhead")
    head = place(timeline, "#playhead")[0]
    assert abs(head - timeline.middle(1, 24)[0]) < 3
    timeline.cell(1, 22).focus()
    timeline.press("Home")
    expect(timeline.cell(1, 1)).to_be_focused()
    expect(timeline.cell(1, 1)).to_be_in_viewport()
    wait_for(
        lambda: abs(place(timeline, "#timeline .cells")[0] - place(timeline, ".cells-window")[0]) < 2, "home"
    )
    timeline.drag((2, 2), (2, 4))
    wait_for(lambda: timeline.shown() == painted(FOUR, 2, 2, 4, "0"), "a zoomed drag paints where it is seen")
    timeline.press("-", "-")
    wait_for(lambda: shown_columns(timeline) > 15, "it is further away")
    timeline.page.get_by_role("button", name="Fit", exact=True).click()
    wait_for(lambda: abs(shown_columns(timeline) - 24) < 0.2, "all of it is shown")


def test_two_fingers_zoom_and_paint_nothing(timeline: TimelinePage) -> None:
    gait = timeline.open("Pinch")
    session = timeline.page.context.new_cdp_session(timeline.page)
    (x, y), (other, _) = timeline.middle(2, 8), timeline.middle(2, 14)

    def touch(kind: str, *places: float) -> None:
        points = [{"x": at, "y": y, "id": index} for index, at in enumerate(places)]
        session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})

    touch("touchStart", x)
    touch("touchStart", x, other)
    for step in range(1, 6):
        touch("touchMove", x - 12 * step, other + 12 * step)
    touch("touchEnd")
    wait_for(lambda: shown_columns(timeline) < 20, "it is closer")
    assert timeline.feet(gait) == FOUR
    assert timeline.shown() == FOUR
    timeline.press("f")


def test_l_loops_the_selection_and_then_ends_it(timeline: TimelinePage) -> None:
    timeline.open("Loop")
    button = timeline.page.get_by_role("button", name="Loop", exact=True)
    timeline.select((1, 6), (2, 10))
    timeline.press("l")
    expect(button).to_have_attribute("aria-pressed", "true")
    mark = timeline.page.locator("#ruler .loop")
    expect(mark).to_have_attribute("title", re.compile("from 1.8 to 3.8 s"))
    edges = place(timeline, "#ruler .loop")
    assert abs(edges[0] - place(timeline, '.timeline-row[data-foot="1"] .cell:nth-child(6)')[0]) < 2
    timeline.press("l")
    expect(button).to_have_attribute("aria-pressed", "false")
    expect(mark).to_have_count(0)
    timeline.press("Escape", "l")
    expect(button).to_have_attribute("aria-pressed", "true")
    expect(mark).to_have_count(0)
    timeline.press("l")


def test_the_loop_button_does_what_l_does(timeline: TimelinePage) -> None:
    timeline.open("Loop by button")
    button = timeline.page.get_by_role("button", name="Loop", exact=True)
    timeline.select((1, 6), (2, 10))
    button.click()
    mark = timeline.page.locator("#ruler .loop")
    expect(mark).to_have_attribute("title", re.compile("from 1.8 to 3.8 s"))
    button.click()
    expect(button).to_have_attribute("aria-pressed", "false")


def test_space_plays_after_a_pointer_and_toggles_where_keys_led(timeline: TimelinePage) -> None:
    gait = timeline.open("Space")
    timeline.select((1, 6), (2, 10))
    timeline.press("Space")
    expect(timeline.page.get_by_role("button", name="Pause", exact=True)).to_be_visible()
    timeline.press("Space", "Enter")
    expect(timeline.page.get_by_role("button", name="Play", exact=True)).to_be_visible()
    timeline.press("Control+End")
    expect(timeline.cell(4, 24)).to_be_focused()
    timeline.press("Control+Home")
    expect(timeline.cell(1, 1)).to_be_focused()
    assert timeline.feet(gait) == FOUR
    timeline.press("Space")
    timeline.becomes(gait, "0" + FOUR[0][1:], *FOUR[1:])
    expect(timeline.page.get_by_role("button", name="Play", exact=True)).to_be_visible()


def test_space_plays_arrows_step_and_no_letter_asks_the_robot(timeline: TimelinePage) -> None:
    page = timeline.page
    timeline.open("Letters")
    sent: list[str] = []
    page.on("request", lambda request: sent.append(request.url))
    page.locator("#step-title").click()
    clock = page.locator("#clock b")
    timeline.press("Home", "ArrowRight")
    expect(clock).to_have_text("0.4")
    timeline.press("Shift+ArrowRight")
    expect(clock).to_have_text("4.4")
    timeline.press("Shift+ArrowLeft", "ArrowLeft", "End")
    expect(clock).to_have_text("9.2")
    timeline.press("Space")
    expect(page.get_by_role("button", name="Pause", exact=True)).to_be_visible()
    timeline.press("Space")
    expect(page.get_by_role("button", name="Play", exact=True)).to_be_visible()
    for letter in "acdefghijmnopqrstuvwxyz":
        timeline.press(letter)
    timeline.press("?")
    expect(page.get_by_role("dialog", name="Keyboard")).to_contain_text("Loop the selected samples")
    timeline.press("Escape")
    assert not [url for url in sent if "/api/robot/" in url]


def test_a_swing_of_a_cycle_goes_on_across_the_border(timeline: TimelinePage) -> None:
    rows = ("0" * 3 + "1" * 18 + "0" * 3, *FOUR[1:])
    timeline.open("Cycle", rows, options={"boundary": "periodic"})
    expect(timeline.cell(1, 24)).to_have_attribute("data-wraps", "out")
    expect(timeline.cell(1, 1)).to_have_attribute("data-wraps", "in")
    timeline.open("No cycle", rows)
    expect(timeline.cell(1, 24)).not_to_have_attribute("data-wraps", "out")


def test_control_s_saves(timeline: TimelinePage) -> None:
    gait = timeline.open("Saved by key")
    timeline.cell(1, 2).click()
    timeline.becomes(gait, *painted(FOUR, 1, 2, 2, "0"))
    timeline.press("Control+s")
    expect(timeline.page.get_by_role("button", name="Save", exact=True)).to_have_attribute(
        "aria-disabled", "true"
    )


def test_swings_carry_mark_and_duration_and_rows_their_duty(timeline: TimelinePage) -> None:
    timeline.open("Marks and durations")
    rows = timeline.page.locator(".timeline-row")
    expect(rows.first.locator(".swing-bar")).to_have_count(1)
    bars = rows.first.locator(".swing-bar").first.bounding_box()
    swing = timeline.cell(1, FOUR[0].index("0") + 1).bounding_box()
    assert bars is not None
    assert swing is not None
    assert abs(bars["x"] - swing["x"]) <= 1
    duty = round(100 * FOUR[0].count("1") / len(FOUR[0]))
    expect(rows.first.locator(".row-duty")).to_have_text(f"{duty} %")
    timeline.press("+")
    timeline.press("+")
    words = rows.first.locator(".swing-bar").first
    expect(words).to_have_text(re.compile(r"^[0-9.]+ s$"))
    timeline.press("f")
