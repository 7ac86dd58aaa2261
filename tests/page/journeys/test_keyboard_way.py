"""The whole path by keyboard alone: no click, no pointer, and no focus that a script has put anywhere."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.support.page.keyboard import focused, tab_to
from tests.support.page.opened import opened_page
from tests.support.studio_process import StudioProcess, wait_for

pytestmark = pytest.mark.heavy
SPEED = 5.0
"""Seconds of the emulated robot in a second."""
HELD_MS = 1300
NEAR = 8
"""Tab stops between two acts that follow each other."""


@pytest.fixture
def page(browser: Browser, studio: StudioProcess) -> Iterator[Page]:
    with opened_page(browser, studio.url, 1440, 900, gait=None) as opened:
        expect(opened.get_by_role("button", name="Simulate", exact=True)).to_be_visible()
        yield opened


def press(page: Page, *keys: str) -> None:
    for key in keys:
        page.keyboard.press(key)


def choose_a_gait(page: Page) -> None:
    tab_to(page, "Find a gait")
    page.keyboard.type("Walk 10")
    press(page, "Tab")
    for _ in range(NEAR):
        if focused(page).startswith("Walk 10 mm"):
            break
        press(page, "ArrowDown")
    press(page, "Enter")
    expect(page.get_by_label("Gait name")).to_have_value("Walk 10 mm")
    expect(page.get_by_role("status", name="Verdict")).to_contain_text("Plan margin")
    press(page, "Shift+Tab", "Escape")


def edit_and_take_it_back(page: Page) -> None:
    grid = page.get_by_role("grid", name="Footfall timeline")
    tab_to(page, "foot 1, sample 1:")
    press(page, "ArrowDown", "ArrowDown", *["ArrowRight"] * 10, "Space")
    expect(grid.get_by_role("gridcell", name="foot 3, sample 11: swing", exact=True)).to_be_visible()
    assert focused(page) == "foot 3, sample 11: swing"
    press(page, "Control+z")
    expect(grid.get_by_role("gridcell", name="foot 3, sample 11: stance", exact=True)).to_be_visible()
    expect(page.get_by_role("status", name="Verdict")).to_contain_text("Plan margin")


def do_the_next_act(page: Page, name: str) -> None:
    """The button of the next act is one key before the top bar."""
    expect(page.get_by_role("button", name=name, exact=True)).not_to_have_attribute("aria-disabled", "true")
    for _ in range(NEAR):
        if focused(page) == name:
            break
        press(page, "Shift+F6" if "Steps" not in focused(page) else "Tab")
    else:
        raise AssertionError(f"{name} is not reached; the focus is at {focused(page)}")
    press(page, "Enter")


def simulate_check_and_approve(page: Page) -> None:
    do_the_next_act(page, "Simulate")
    expect(page.get_by_role("status", name="Verdict")).to_contain_text("Simulated walks")
    do_the_next_act(page, "Check")
    expect(page.get_by_role("status", name="Verdict")).to_contain_text("Checked passed")
    do_the_next_act(page, "Approve")
    expect(page.get_by_role("dialog")).to_be_visible()
    page.keyboard.type("Ada")
    press(page, "Enter")
    expect(page.get_by_role("tab", name="Run", selected=True)).to_be_visible()


def connect_arm_and_hold(page: Page, studio: StudioProcess) -> None:
    status = page.get_by_role("status", name="Robot")
    do_the_next_act(page, "Connect")
    expect(status).to_contain_text("disarmed")
    tab_to(page, "Arm", most=NEAR)
    press(page, "Enter")
    expect(status).to_contain_text("armed")
    send = page.get_by_role("button", name="Send to robot", exact=True)
    expect(send).not_to_have_attribute("aria-disabled", "true")
    tab_to(page, "Send to robot", most=NEAR)
    page.keyboard.down("Enter")
    expect(send).to_have_attribute("data-holding", "")
    assert studio.robot()["run"] is None, "nothing is sent before the key was held for a second"
    page.wait_for_timeout(HELD_MS)
    page.keyboard.up("Enter")
    wait_for(lambda: (studio.robot()["run"] or {}).get("reached", 0) > 0, "the robot walks")


def test_the_whole_path_by_keyboard_alone(page: Page, studio: StudioProcess) -> None:
    choose_a_gait(page)
    edit_and_take_it_back(page)
    simulate_check_and_approve(page)
    connect_arm_and_hold(page, studio)
    press(page, "Escape")
    wait_for(lambda: studio.robot()["robot"] == "stopped", "it stands still")
    do_the_next_act(page, "Clear")
    expect(page.get_by_role("status", name="Robot")).to_contain_text("disarmed")
    tab_to(page, "Arm", most=NEAR)
    press(page, "Enter")
    expect(page.get_by_role("status", name="Robot")).to_contain_text("armed")
    count_down_with_a_short_press_and_stop_by_the_button(page, studio)


def count_down_with_a_short_press_and_stop_by_the_button(page: Page, studio: StudioProcess) -> None:
    expect(page.get_by_role("button", name="Send to robot", exact=True)).not_to_have_attribute(
        "aria-disabled", "true"
    )
    tab_to(page, "Send to robot", most=NEAR)
    press(page, "Enter")
    expect(page.get_by_role("group", name="Countdown")).to_be_visible()
    assert focused(page) == "Cancel"
    press(page, "Escape")
    expect(page.get_by_role("group", name="Countdown")).to_be_hidden()
    tab_to(page, "Send to robot", back=True, most=NEAR)
    press(page, "Enter")
    wait_for(lambda: studio.robot()["robot"] == "moving", "the countdown ends with a run")
    press(page, "Shift+F6")
    tab_to(page, "Stop", back=True, most=60)
    press(page, "Enter")
    wait_for(lambda: studio.robot()["robot"] == "stopped", "it stands still")
