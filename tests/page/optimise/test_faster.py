"""*Faster on the robot* and *Draw it freely*: both sides, one Undo, and the reason where it cannot be."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Locator, Page, expect

from tests.support.page.labels import require_whole_labels
from tests.support.page.opened import choose, look, opened_page
from tests.support.studio_process import StudioProcess

pytestmark = pytest.mark.heavy

NUMBER = re.compile(r"^\d+\.\d+$")
LONG = 120_000


@pytest.fixture(scope="module")
def gait(studio: StudioProcess) -> str:
    """A C-gait with room for moves that are not divided, so that its search is short."""
    made: str = studio.ask("POST", "/api/gaits?copy_of=c-gait&name=Slow").content["id"]
    document = studio.document(made)
    options = {**document["options"], "stop_bound": 1.5}
    assert studio.ask("PUT", f"/api/gaits/{made}", {**document, "options": options}).status == 200
    return made


@pytest.fixture
def page(browser: Browser, studio: StudioProcess, gait: str) -> Iterator[Page]:
    with opened_page(browser, studio.url, 1280, 800) as opened:
        choose(opened, "Slow")
        yield opened


def button(page: Page, name: str) -> Locator:
    return page.locator("#optimise").get_by_role("button", name=name)


def compared(page: Page) -> Locator:
    """The dialog, once the search has ended."""
    button(page, "Faster on the robot").click()
    dialog = page.get_by_role("dialog", name="Faster on the robot")
    expect(dialog.get_by_role("button", name="Use this")).to_be_enabled(timeout=LONG)
    return dialog


def test_both_sides_are_compared_and_taken_over_in_one_undo_step(page: Page, tmp_path: Path) -> None:
    verdict, undo = page.get_by_role("status", name="Verdict"), page.get_by_role("button", name="Undo")
    expect(button(page, "Draw it freely")).to_be_hidden()
    dialog = compared(page)
    look(page, "faster")
    require_whole_labels(page, "faster", tmp_path)
    speeds = dialog.get_by_role("row", name="Speed")
    expect(speeds).to_have_count(2)
    for row in speeds.all():
        now, faster = (float(text) for text in row.get_by_role("cell").all_inner_texts())
        assert faster > now
    expect(dialog.get_by_role("status", name="Comparison")).to_contain_text("times as fast")
    dialog.get_by_role("button", name="Use this").click()
    expect(dialog).to_be_hidden()
    expect(page.get_by_label("Step length")).to_have_value("false")
    expect(verdict).to_contain_text("Plan margin")
    expect(page.get_by_role("region", name="Search")).to_be_hidden()
    expect(undo).to_have_attribute("title", re.compile("robot's clock"))
    undo.click()
    expect(page.get_by_label("Phase length", exact=True)).to_be_visible()
    expect(button(page, "Draw it freely")).to_be_hidden()


def test_it_becomes_a_new_gait_that_is_drawn_freely_again(page: Page) -> None:
    dialog = compared(page)
    dialog.get_by_role("button", name="Save as a new gait").click()
    expect(page.get_by_label("Gait name")).to_have_value("Slow, for the robot's clock")
    expect(page.get_by_role("status", name="Verdict")).to_contain_text("Plan margin")
    expect(button(page, "Faster on the robot")).to_be_hidden()
    button(page, "Draw it freely").click()
    expect(page.get_by_label("Phase length", exact=True)).to_have_value("5")
    expect(button(page, "Faster on the robot")).to_be_visible()
    page.get_by_role("button", name="Undo").click()
    expect(page.get_by_label("Step length")).to_have_value("false")


def test_two_quick_presses_open_one_dialog_and_cancel_ends_its_search(page: Page) -> None:
    begun: list[str] = []
    page.on("request", lambda request: begun.append(request.url) if request.url.endswith("/faster") else None)
    step = page.get_by_label("Step", exact=True)
    step.fill("9")
    step.press("Enter")
    expect(page.get_by_role("button", name="Undo")).not_to_have_attribute("aria-disabled", "true")
    faster = button(page, "Faster on the robot")
    expect(faster).not_to_have_attribute("aria-disabled", "true")
    faster.evaluate("(button) => { button.click(); button.click(); }")
    dialog = page.get_by_role("dialog", name="Faster on the robot")
    expect(dialog.get_by_role("status", name="Comparison")).to_contain_text("Looking for the fastest motion")
    expect(dialog.get_by_role("row", name="Least margin").get_by_role("cell").first).to_have_text(NUMBER)
    expect(dialog.get_by_role("button", name="Use this")).to_be_disabled()
    heads = dialog.locator("tbody > tr:first-child > th[scope=rowgroup]")
    expect(heads).to_have_text(["One iteration in mid-walk", re.compile("^Whole gait from rest to rest")])
    expect(dialog.locator("tbody")).to_have_count(2)
    assert len(begun) == 1
    with page.expect_event("requestfailed", lambda request: request.url.endswith("/faster")):
        dialog.get_by_role("button", name="Cancel").click()
    expect(dialog).to_be_hidden()
    expect(page.get_by_label("Phase length", exact=True)).to_be_visible()
    expect(page.locator("#toasts")).to_be_empty()
    faster.click()
    expect(dialog).to_be_visible()
    page.keyboard.press("Escape")
    expect(dialog).to_be_hidden()
    assert len(begun) == 2
    page.get_by_role("button", name="Undo").click()


def test_a_gait_that_cannot_be_converted_says_why(page: Page) -> None:
    page.evaluate("localStorage.setItem('footfall.gait', 'textbook-trot')")
    page.reload()
    faster = button(page, "Faster on the robot")
    expect(faster).to_have_attribute("title", re.compile("Feet 1 and 3 are in the air together"))
    faster.click(force=True)
    expect(page.locator("#toasts")).to_contain_text("lifts one foot after the other")
    expect(page.get_by_role("dialog")).to_be_hidden()
