"""Axe finds nothing on the way to the robot: simulated, checked, approved, and in each state of the robot."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Page, expect

from app.emulator.emulated_robot import EmulatedRobot
from app.emulator.faults import Fault, FaultRequest
from tests.support.page.axe import require_no_finding
from tests.support.page.drawers import open_drawer
from tests.support.page.keyboard import tab_stops
from tests.support.page.opened import opened_page
from tests.support.page.robot_panel import name
from tests.support.studio_process import StudioProcess, wait_for

pytestmark = pytest.mark.heavy
SPEED = 5.0
"""Seconds of the emulated robot in a second."""
SLOW = 0.3
"""The same while the page is looked at in mid-run."""


@pytest.fixture(scope="module")
def page(browser: Browser, studio: StudioProcess) -> Iterator[Page]:
    with opened_page(browser, studio.url, 1280, 800) as opened:
        expect(opened.get_by_role("status", name="Verdict")).to_contain_text("Plan margin")
        yield opened


def press(page: Page, name: str) -> None:
    button = page.get_by_role("button", name=name, exact=True)
    expect(button).not_to_have_attribute("aria-disabled", "true")
    button.click()


def unfold(page: Page) -> None:
    page.evaluate("document.querySelectorAll('details').forEach((one) => { one.open = true; })")


def is_walking(studio: StudioProcess) -> bool:
    """Whether the robot moves and has reached a waypoint of this run."""
    view = studio.robot()
    return bool(view["robot"] == "moving" and view["run"]["reached"] > 0)


def walks(studio: StudioProcess) -> None:
    """Waits until the robot walks."""
    wait_for(lambda: is_walking(studio), "the robot walks")


def test_simulated_checked_and_approved(page: Page) -> None:
    press(page, "Simulate")
    expect(page.get_by_role("status", name="Verdict")).to_contain_text("Simulated walks")
    require_no_finding(page, "simulated")
    press(page, "Check")
    expect(page.get_by_role("status", name="Verdict")).to_contain_text("Checked passed")
    unfold(page)
    require_no_finding(page, "checked")
    press(page, "Approve")
    page.get_by_role("textbox", name="Your name").fill("Ada")
    require_no_finding(page, "asked for a name")
    press(page, "Continue")
    expect(page.get_by_role("tab", name="Run", selected=True)).to_be_visible()
    page.get_by_role("tab", name="Check & approve").click()
    require_no_finding(page, "approved")
    page.get_by_role("tab", name="Run").click()


def test_looked_on_asked_for_and_taken_over(page: Page, browser: Browser, studio: StudioProcess) -> None:
    held = page.get_by_role("group", name="Who is in control")
    with opened_page(browser, studio.url, 1280, 800) as grace:
        name(grace, "Grace")
        press(grace, "Connect")
        expect(held).to_contain_text("Grace is in control.")
        require_no_finding(page, "looked on")
        press(page, "Ask for control")
        expect(grace.get_by_role("group", name="Who is in control")).to_contain_text("Ada asks for control.")
        require_no_finding(grace, "asked")
    expect(held).to_contain_text("Grace left without releasing control.")
    press(page, "Take over")
    expect(page.get_by_role("group", name="Take over")).to_be_visible()
    require_no_finding(page, "before taking over")
    press(page, "Take control")
    expect(held).to_contain_text("You are in control.")


def test_connected_armed_running_and_stopped(page: Page, studio: StudioProcess, robot: EmulatedRobot) -> None:
    status = page.get_by_role("status", name="Robot")
    expect(status).to_contain_text("disarmed")
    unfold(page)
    require_no_finding(page, "connected")
    press(page, "Arm")
    expect(status).to_contain_text("armed")
    require_no_finding(page, "armed")
    press(page, "Send to robot")
    expect(page.get_by_role("group", name="Countdown")).to_be_visible()
    robot.change_speed(SLOW)
    walks(studio)
    require_no_finding(page, "moving")
    press(page, "Pause robot")
    require_no_finding(page, "pausing")
    robot.change_speed(SPEED)
    page.get_by_role("button", name="Stop", exact=True).click()
    expect(page.get_by_role("button", name="Clear", exact=True)).to_be_visible()
    require_no_finding(page, "stopped")
    press(page, "Clear")
    expect(status).to_contain_text("disarmed")


def test_a_fault_in_mid_run(page: Page, studio: StudioProcess, robot: EmulatedRobot) -> None:
    press(page, "Arm")
    expect(page.get_by_role("status", name="Robot")).to_contain_text("armed")
    press(page, "Send to robot")
    walks(studio)
    robot.inject(FaultRequest(Fault.UNPLUG))
    expect(page.get_by_role("status", name="Robot")).to_contain_text("hung up")
    require_no_finding(page, "fault")


def test_jobs_and_runs_one_opened_and_two_compared(page: Page) -> None:
    open_drawer(page, "Jobs")
    require_no_finding(page, "jobs")
    runs = open_drawer(page, "Runs")
    expect(runs.locator(".run-row")).to_have_count(2)
    require_no_finding(page, "runs")
    assert tab_stops(page, "ul[aria-label=Runs]") == 1
    runs.locator(".run-row").first.click()
    expect(page.get_by_role("button", name="All runs")).to_be_visible()
    unfold(page)
    require_no_finding(page, "a run")
    runs.get_by_label("Compare with").select_option(index=1)
    expect(runs.get_by_role("status", name="Comparison")).to_contain_text("both runs reached")
    require_no_finding(page, "two runs")
