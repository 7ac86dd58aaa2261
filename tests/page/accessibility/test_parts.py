"""The page as assistive tools find it: axe finds nothing on any panel, menu or dialog."""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.support.page.axe import findings, require_no_finding
from tests.support.page.drawers import open_drawer
from tests.support.page.opened import opened_page
from tests.support.studio_process import StudioProcess

pytestmark = pytest.mark.heavy

STEPS = ("Simulate", "Check & approve", "Run", "Design")


@pytest.fixture
def page(browser: Browser, studio: StudioProcess, request: pytest.FixtureRequest) -> Iterator[Page]:
    has_scene = "scene" in request.keywords
    with opened_page(browser, studio.url, 1280, 800, has_scene=has_scene) as opened:
        expect(opened.get_by_role("grid", name="Footfall timeline").get_by_role("row")).to_have_count(4)
        expect(opened.get_by_role("button", name="Simulate", exact=True)).to_be_visible()
        yield opened


def unfold(page: Page) -> None:
    """Opens all folded groups."""
    page.evaluate("document.querySelectorAll('details').forEach((one) => { one.open = true; })")


def choose(page: Page, name: str) -> None:
    find = page.get_by_label("Find a gait")
    find.fill(name)
    page.get_by_role("list", name="Gaits").get_by_role("button", name=name).first.click()
    expect(page.get_by_label("Gait name")).to_have_value(name)
    find.fill("")


@pytest.mark.scene
def test_the_first_page_with_its_scene(page: Page) -> None:
    require_no_finding(page, "first page")


def test_steps_and_views(page: Page) -> None:
    for step in STEPS:
        page.get_by_role("tab", name=step).click()
        unfold(page)
        require_no_finding(page, step)
    for view in ("Segments", "Pattern search"):
        page.get_by_role("tab", name=view).click()
        require_no_finding(page, view)
    expect(page.get_by_role("button", name="Make gait")).not_to_have_attribute("aria-disabled", "true")
    require_no_finding(page, "pattern found")


def test_the_segment_table_and_the_choice_of_a_segment(page: Page) -> None:
    choose(page, "Manual walk, v0")
    page.get_by_role("tab", name="Segments").click()
    grid = page.get_by_role("grid", name="Segment table")
    page.get_by_role("button", name="Vocabulary").click()
    require_no_finding(page, "segment table")
    grid.get_by_role("gridcell").first.click()
    page.keyboard.press("Enter")
    expect(page.get_by_role("listbox", name="Segments")).to_be_visible()
    require_no_finding(page, "choice of a segment")


def test_drawers_and_their_menus(page: Page, studio: StudioProcess) -> None:
    for name in ("Jobs", "Runs", "Trials", "Papers", "Gaits"):
        open_drawer(page, name)
        require_no_finding(page, name)
    page.get_by_role("list", name="Gaits").get_by_role("button", name="Examples").click()
    require_no_finding(page, "examples unfolded")
    for name in ("New", "Gait", "Edit", "Show"):
        page.get_by_role("button", name=name, exact=True).click()
        expect(page.get_by_role("menu")).to_be_visible()
        require_no_finding(page, f"menu {name}")
        page.keyboard.press("Escape")
    page.get_by_label("Find a gait").fill("no such gait")
    require_no_finding(page, "nothing found")


def test_dialogs(page: Page) -> None:
    page.keyboard.press("?")
    expect(page.get_by_role("dialog", name="Keyboard")).to_be_visible()
    require_no_finding(page, "keys")
    page.keyboard.press("Escape")
    page.locator("#operator").click()
    expect(page.get_by_role("textbox", name="Your name")).to_be_visible()
    require_no_finding(page, "operator")
    page.keyboard.press("Escape")
    page.get_by_role("button", name="Versions").click()
    expect(page.get_by_role("listbox", name="Versions")).to_be_visible()
    require_no_finding(page, "versions")
    page.keyboard.press("Escape")
    page.keyboard.press("Control+a")
    page.keyboard.press("+")
    page.get_by_role("button", name="Edit", exact=True).click()
    page.get_by_role("menuitem", name="Stretch…").click()
    expect(page.get_by_role("dialog", name="Stretch")).to_be_visible()
    require_no_finding(page, "stretch a selection")


def test_dialogs_for_new_gaits(page: Page) -> None:
    new = page.get_by_role("button", name="New", exact=True)
    new.click()
    page.get_by_role("menuitem", name="New gait…").click()
    page.get_by_label("Order of the feet").fill("1 1 1")
    page.get_by_role("button", name="Create").click()
    expect(page.get_by_label("Order of the feet")).to_have_attribute("aria-invalid", "true")
    require_no_finding(page, "new gait, refused")
    page.keyboard.press("Escape")
    new.click()
    page.get_by_role("menuitem", name="Fastest gait…").click()
    dialog = page.get_by_role("dialog", name=re.compile("Fastest gait"))
    expect(dialog).to_be_visible()
    require_no_finding(page, "fastest gait")
    page.keyboard.press("Escape")
    page.get_by_role("button", name="Faster on the robot").click()
    dialog = page.get_by_role("dialog", name="Faster on the robot")
    expect(dialog.get_by_role("status")).to_contain_text("Looking for the fastest motion")
    require_no_finding(page, "faster on the robot")
    dialog.get_by_role("button", name="Cancel").click()


def test_no_motion_with_its_remedies(page: Page) -> None:
    step = page.get_by_role("spinbutton", name="Step", exact=True)
    step.fill("30")
    step.press("Enter")
    expect(page.get_by_role("status", name="Verdict")).to_contain_text("no motion")
    expect(page.locator(".remedy").first).to_be_visible()
    for name in STEPS:
        page.get_by_role("tab", name=name).click()
        require_no_finding(page, f"no motion, {name}")


def test_a_sequence_and_a_gait_for_the_robots_clock(page: Page, studio: StudioProcess) -> None:
    parts = [{"gait": "walk", "times": 1}, {"gait": "walk", "times": 2}]
    assert studio.ask("POST", "/api/sequences", {"name": "Two walks", "parts": parts}).status == 201
    choose(page, "Two walks")
    expect(page.get_by_role("grid", name="Parts of the sequence")).to_be_visible()
    unfold(page)
    require_no_finding(page, "sequence")
    choose(page, "Fast walk")
    unfold(page)
    require_no_finding(page, "gait for the robot's clock")


def test_trials_an_example_videos_cameras_and_learning(page: Page) -> None:
    trials = open_drawer(page, "Trials")
    trials.get_by_role("button", name="Look at an example").click()
    expect(trials.get_by_role("img", name=re.compile("^Feet from above"))).to_be_visible()
    unfold(page)
    require_no_finding(page, "a trial")
    for way, shown in (
        ("Add trials…", trials.get_by_label("Track files")),
        ("From a video…", trials.get_by_label("Video file")),
        ("Learn from trials", trials.get_by_role("status", name="What Learn needs")),
        ("Cameras", trials.get_by_role("button", name="All trials")),
    ):
        trials.get_by_role("button", name="All trials").click()
        trials.get_by_role("button", name=way).click()
        expect(shown).to_be_visible()
        unfold(page)
        require_no_finding(page, way)


def test_a_finding_would_be_found(page: Page) -> None:
    page.evaluate(
        """() => {
          for (const name of ["aria-label", "title"]) document.getElementById("play").removeAttribute(name);
        }"""
    )
    assert any("button-name" in line for line in findings(page))
