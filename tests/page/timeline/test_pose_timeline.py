"""A gait for the robot's clock on the page: uneven samples, its own fields, solved again after an edit."""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.support.page.opened import opened_page
from tests.support.studio_process import StudioProcess

pytestmark = pytest.mark.heavy


@pytest.fixture
def page(browser: Browser, studio: StudioProcess, request: pytest.FixtureRequest) -> Iterator[Page]:
    has_scene = "scene" in request.keywords
    with opened_page(browser, studio.url, 1440, 900, gait=None, has_scene=has_scene) as opened:
        expect(opened.get_by_label("Gait name")).to_have_value("Fast C-Gait")
        yield opened


@pytest.mark.soak
def test_samples_are_as_wide_as_they_last_and_an_edit_is_solved_after_it(page: Page) -> None:
    cells = (
        page.get_by_role("grid", name="Footfall timeline").get_by_role("row").first.get_by_role("gridcell")
    )
    expect(cells).to_have_count(27)
    widths = {round(cells.nth(index).bounding_box()["width"]) for index in range(1, 20)}  # type: ignore[index]
    assert len(widths) > 1
    answer = page.get_by_role("status", name="Verdict")
    expect(answer).to_contain_text("Plan margin")
    expect(answer).to_contain_text("mm/s")
    expect(page.get_by_label("Phase length", exact=True)).to_be_hidden()
    expect(page.get_by_label("Step length")).to_have_value("true")
    step = page.get_by_label("Step", exact=True)
    step.fill("20")
    step.press("Enter")
    expect(answer).to_contain_text("adapted, not solved")
    expect(page.get_by_role("region", name="Search")).to_contain_text("Looking for the fastest motion")
    expect(page.get_by_label("Step length")).to_have_value("false")
    expect(answer).to_contain_text("Plan margin", timeout=120_000)
    page.get_by_role("button", name="Undo").click()
    expect(page.get_by_label("Step length")).to_have_value("true")
    expect(answer).to_contain_text("Plan margin")


def test_a_search_is_cancelled_and_begun_again_and_the_timeline_is_not_drawn_on(page: Page) -> None:
    page.locator("#optimise summary").filter(has_text="More").first.click()
    cycles = page.get_by_label("Iterations", exact=True)
    cycles.fill("5")
    cycles.press("Enter")
    search = page.get_by_role("region", name="Search")
    search.get_by_role("button", name="Cancel").click()
    expect(search).to_contain_text("The search was cancelled.")
    answer = page.get_by_role("status", name="Verdict")
    expect(answer).to_contain_text("adapted")
    search.get_by_role("button", name="Search again").click()
    expect(search).to_contain_text("Looking for the fastest motion")
    page.get_by_role("button", name="Undo").click()
    expect(search).to_be_hidden()
    expect(answer).to_contain_text("Plan margin")
    expect(page.get_by_role("button", name="Paint", exact=True)).to_have_attribute("aria-disabled", "true")
    grid = page.get_by_role("grid", name="Footfall timeline")
    grid.get_by_role("gridcell", name="foot 1, sample 3: swing", exact=True).click()
    toasts = page.locator("#toasts")
    expect(toasts).to_contain_text("because the studio computes it from the poses of the gait")
    expect(page.get_by_role("button", name="Undo")).to_have_attribute("aria-disabled", "true")


@pytest.mark.scene
def test_a_pose_that_is_dragged_is_pinned_and_let_go(page: Page) -> None:
    answer = page.get_by_role("status", name="Verdict")
    expect(answer).to_contain_text("Plan margin")
    pose = page.get_by_role("slider", name="Pose", exact=True)
    expect(page.locator("#pose")).to_have_attribute("data-off", "")  # the standard stance stays as it is
    for _ in range(12):
        page.get_by_role("button", name="Next sample").click()
    expect(pose).to_have_attribute("aria-valuetext", re.compile("pose 13: "))
    place = pose.bounding_box()
    assert place is not None
    page.mouse.move(place["x"], place["y"])
    page.mouse.down()
    page.mouse.move(place["x"] + 3, place["y"] + 4, steps=3)
    expect(answer).to_contain_text("adapted, not solved")
    page.mouse.up()
    pinned = page.get_by_role("list", name="Pinned poses")
    expect(pinned.get_by_role("listitem")).to_have_count(1)
    expect(pose).to_have_attribute("aria-valuetext", re.compile("pose 13, pinned: "))
    expect(answer).to_contain_text("Plan margin", timeout=120_000)
    expect(page.get_by_role("button", name="Undo")).to_contain_text("pin pose 13")
    pose.focus()
    page.keyboard.press("ArrowUp")
    expect(answer).to_contain_text("adapted, not solved")
    pinned.get_by_role("button", name="Unpin pose 13").click()
    expect(pinned.get_by_role("listitem")).to_have_count(0)
    for _ in range(3):
        page.get_by_role("button", name="Undo").click()
    expect(answer).to_contain_text("Plan margin")
    expect(page.get_by_role("button", name="Undo")).to_have_attribute("aria-disabled", "true")


@pytest.mark.scene
def test_a_pose_that_is_dragged_too_far_is_drawn_nearer_and_a_click_moves_nothing(page: Page) -> None:
    answer = page.get_by_role("status", name="Verdict")
    expect(answer).to_contain_text("Plan margin")
    pose = page.get_by_role("slider", name="Pose", exact=True)
    undo = page.get_by_role("button", name="Undo")
    for _ in range(12):
        page.get_by_role("button", name="Next sample").click()
    expect(pose).to_have_attribute("aria-valuetext", re.compile("pose 13: "))
    place = pose.bounding_box()
    assert place is not None
    page.mouse.move(place["x"], place["y"])
    page.mouse.down()
    page.mouse.move(place["x"] + 1, place["y"])
    page.mouse.up()
    expect(undo).to_have_attribute("aria-disabled", "true")
    page.mouse.down()
    page.mouse.move(place["x"] + 180, place["y"] - 30, steps=4)
    expect(page.get_by_role("status", name="Plan")).to_contain_text("it is drawn nearer")
    expect(page.locator("#pose")).not_to_have_attribute("data-off", "")
    page.keyboard.press("Escape")
    page.mouse.up()
    expect(answer).to_contain_text("Plan margin")
    expect(undo).to_have_attribute("aria-disabled", "true")
