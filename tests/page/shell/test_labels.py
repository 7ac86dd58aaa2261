"""No text of the page is cut or lies on another one, in any state and size; a failure leaves a picture."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page, ViewportSize, expect

from app.emulator.emulated_robot import EmulatedRobot
from tests.support.page.drawers import open_drawer
from tests.support.page.labels import Scheme, label_problems, require_whole_labels
from tests.support.page.opened import leave_scene_out
from tests.support.patience import patient_robot
from tests.support.soak import is_soak
from tests.support.studio_process import StudioProcess, running_studio, wait_for

pytestmark = pytest.mark.heavy
SPEED = 5.0
SIZES = {"desk": ((1280, 720), (1440, 900), (1920, 1080)), "tablet": ((820, 1180),), "zoomed": ((640, 360),)}
"""Widths and heights in CSS px of each kind of screen; the last one is 1280 × 720 at 200 %."""


@pytest.fixture
def robot() -> Iterator[EmulatedRobot]:
    with patient_robot(SPEED) as emulated:
        yield emulated


@pytest.fixture
def studio(tmp_path: Path, robot: EmulatedRobot) -> Iterator[StudioProcess]:
    with running_studio(tmp_path, "--robot", robot.device) as running:
        yield running


@pytest.fixture(
    params=["desk", *(pytest.param(kind, marks=pytest.mark.soak) for kind in ("tablet", "zoomed"))]
)
def screen(request: pytest.FixtureRequest) -> str:
    return str(request.param)


@pytest.fixture
def page(browser: Browser, studio: StudioProcess, screen: str) -> Iterator[Page]:
    width, height = SIZES[screen][0]
    scale = 2.0 if screen == "zoomed" else 1.0
    context = browser.new_context(
        viewport={"width": width, "height": height}, device_scale_factor=scale, reduced_motion="reduce"
    )
    opened = context.new_page()
    leave_scene_out(opened)
    opened.goto(studio.url)
    expect(opened.get_by_role("status", name="Verdict")).to_contain_text("margin")
    expect(opened.get_by_role("button", name="Simulate", exact=True)).to_be_visible()
    yield opened
    context.close()


def press(page: Page, name: str) -> None:
    button = page.get_by_role("button", name=name, exact=True)
    expect(button).not_to_have_attribute("aria-disabled", "true")
    button.click()


def choose(page: Page, name: str) -> None:
    """Shows a gait of the list, and closes a drawer that lay over the stage."""
    if page.get_by_role("list", name="Gaits").is_hidden():
        open_drawer(page, "Gaits")
    page.get_by_label("Find a gait").fill(name)
    page.get_by_role("list", name="Gaits").get_by_role("button", name=name).first.click()
    expect(page.get_by_label("Gait name")).to_have_value(name)
    if page.get_by_label("Find a gait").is_visible():
        page.get_by_label("Find a gait").fill("")


def test_no_label_is_cut_and_no_two_texts_overlap(
    page: Page, studio: StudioProcess, screen: str, tmp_path: Path
) -> None:
    usual, *others = [ViewportSize(width=width, height=height) for width, height in SIZES[screen]]
    # Places do not depend on the colours: in a soak both are looked at, in one size.
    schemes: tuple[Scheme, ...] = ("light", "dark") if screen == "desk" and is_soak() else ("light",)

    def look(state: str) -> None:
        require_whole_labels(page, state, tmp_path, schemes)
        for size in others:
            page.set_viewport_size(size)
            require_whole_labels(page, f"{state} {size['width']}x{size['height']}", tmp_path, ("light",))
        if others:
            page.set_viewport_size(usual)

    look("design")
    for name in ("Jobs", "Runs", "Trials", "Papers", "Gaits"):
        open_drawer(page, name)
        look(f"drawer {name}")
    page.get_by_role("button", name="Close gaits").click()
    for view in ("Segments", "Pattern search", "Cells"):
        page.get_by_role("tab", name=view).click()
        look(f"view {view}")
    for step in ("Simulate", "Check & approve", "Run", "Design"):
        page.get_by_role("tab", name=step).click()
        look(f"step {step}")
    press(page, "Simulate")
    expect(page.get_by_role("status", name="Verdict")).to_contain_text("Simulated walks")
    look("simulated")
    press(page, "Check")
    expect(page.get_by_role("status", name="Verdict")).to_contain_text("Checked passed")
    look("checked")
    press(page, "Approve")
    page.get_by_role("textbox", name="Your name").fill("Ada")
    look("asked for a name")
    press(page, "Continue")
    expect(page.get_by_role("tab", name="Run", selected=True)).to_be_visible()
    look("approved")
    strip = page.get_by_role("status", name="Verdict").bounding_box()
    assert strip is not None
    assert strip["height"] <= 44, "the verdict strip is one row"
    press(page, "Connect")
    expect(page.get_by_role("status", name="Robot")).to_contain_text("disarmed")
    look("connected")
    press(page, "Arm")
    expect(page.get_by_role("status", name="Robot")).to_contain_text("armed")
    look("armed")
    page.get_by_role("button", name="Send to robot").click()
    wait_for(lambda: (studio.robot()["run"] or {}).get("reached", 0) > 2, "the robot walks", 60)
    look("moving")
    press(page, "Pause robot")
    expect(page.get_by_role("button", name="Resume robot")).to_be_visible()
    look("pausing")
    page.get_by_role("button", name="Stop", exact=True).click()
    wait_for(lambda: studio.robot()["robot"] == "stopped", "it stands still")
    expect(page.get_by_role("button", name="Clear", exact=True)).to_be_visible()
    look("stopped")
    open_drawer(page, "Runs").locator(".run-row").first.click()
    expect(page.get_by_role("button", name="All runs")).to_be_visible()
    look("a run")
    page.get_by_role("button", name="Close runs").click()
    choose(page, "Walk 10 mm")
    page.get_by_role("tab", name="Design").click()
    look("a drawn gait")
    length = page.get_by_role("spinbutton", name="Step", exact=True)
    length.fill("30")
    length.press("Enter")
    expect(page.get_by_role("status", name="Verdict")).to_contain_text("no motion")
    look("no motion")
    page.get_by_role("button", name="Undo").click()
    choose(page, "Manual walk, v0")
    page.get_by_role("tab", name="Segments").click()
    look("segment table")


@pytest.mark.parametrize("screen", ["desk"])
def test_a_cut_and_an_overlap_would_be_found(page: Page) -> None:
    page.evaluate("document.querySelector('#save').style.cssText = 'width: 20px; overflow: hidden'")
    page.evaluate("document.querySelector('#tab-check').style.marginLeft = '-180px'")
    problems = label_problems(page)
    assert any(line.startswith("cut: Save") for line in problems)
    assert any(line.startswith("overlap: ") for line in problems)
