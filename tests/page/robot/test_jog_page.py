"""The jog in the Robot panel: a target is looked at first, then the robot goes there."""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.support.page.axe import findings
from tests.support.page.opened import look, opened_page
from tests.support.page.robot_panel import name
from tests.support.studio_process import StudioProcess, wait_for

pytestmark = pytest.mark.heavy

SPEED = 20.0

SCROLL_BACK = "() => { document.getElementById('sections').scrollTop -= 120; }"
"""Scrolls the panel to where Move is low in it, and the summary of the run can be seen above the jog."""

NOTE_PLACE = """button => button.addEventListener(
    "click", () => { window.pressedAt = button.getBoundingClientRect().top; }, { capture: true })"""
"""Notes where the button stands when it is pressed."""

UNDER_THE_FINGER = """button => {
    const { top, height } = button.getBoundingClientRect();
    return Math.abs(top - window.pressedAt) < height / 2;
}"""


@pytest.fixture
def page(browser: Browser, studio: StudioProcess) -> Iterator[Page]:
    with opened_page(browser, studio.url, 1280, 900) as opened:
        name(opened, "Ada")
        opened.get_by_text("Jog: move a motor").click()
        yield opened


def test_the_body_is_raised_by_a_target_that_is_seen_first(page: Page, studio: StudioProcess) -> None:
    jog = page.get_by_role("group", name="Jog", exact=True)
    move = jog.get_by_role("button", name="Move", exact=True)
    expect(move).to_have_attribute("title", "Connect the robot first.")
    page.get_by_role("button", name="Connect", exact=True).click()
    arm = page.get_by_role("button", name="Arm", exact=True)
    expect(arm).not_to_have_attribute("aria-disabled", "true")
    arm.click()
    expect(move).to_have_attribute("title", re.compile("Choose a step"))

    jog.get_by_role("button", name="Body", exact=True).click()
    lower = jog.get_by_role("button", name="Body, height minus")
    expect(lower).to_have_attribute("title", re.compile("Choose a shorter step"))
    jog.get_by_role("spinbutton", name="Jog step").fill("0.4")
    jog.get_by_role("spinbutton", name="Jog step").press("Enter")
    higher = jog.get_by_role("button", name="Body, height plus")
    higher.focus()
    page.keyboard.press("Enter")
    expect(jog.get_by_role("status", name="Jog findings")).to_contain_text("No motor would move")
    expect(move).to_have_attribute("aria-disabled", "true")
    assert findings(page, {"include": [["#robot"]]}) == []
    jog.get_by_role("spinbutton", name="Jog step").fill("3")
    jog.get_by_role("spinbutton", name="Jog step").press("Enter")
    higher.click()
    higher.click()
    expect(jog.get_by_text(re.compile(r"3 moves, about .* Stop acts within"))).to_be_visible()
    before = studio.robot()["strokes_mm"]
    assert max(before) < 1.0
    look(page, "jog")

    expect(move).not_to_have_attribute("aria-disabled", "true")
    move.focus()
    page.evaluate(SCROLL_BACK)
    move.evaluate(NOTE_PLACE)
    move.click()
    wait_for(lambda: min(studio.robot()["strokes_mm"]) > 6.0, "the body is raised", 60.0)
    expect(jog.get_by_text("The jog starts at the present strokes of the motors.")).to_be_visible()
    wait_for(lambda: studio.robot()["robot"] == "armed", "the jog is done", 60.0)
    expect(page.get_by_role("status", name="Robot")).to_contain_text("armed")
    wait_for(lambda: move.evaluate(UNDER_THE_FINGER), "the button stays under the finger", 5.0)
    expect(page.get_by_role("button", name="Send to robot")).to_be_visible()


def test_letters_and_the_target_alone_move_nothing(page: Page, studio: StudioProcess) -> None:
    jog = page.get_by_role("group", name="Jog", exact=True)
    wait_for(
        lambda: studio.robot()["link"] == "disconnected" or studio.robot()["robot"] == "armed", "it rests"
    )
    stands = studio.robot()["strokes_mm"]
    jog.get_by_role("button", name="Motor", exact=True).click()
    plus = jog.get_by_role("button", name="Motor 2 of foot 1 plus")
    expect(plus).not_to_have_attribute("aria-disabled", "true")
    plus.click()
    expect(jog.get_by_role("img", name=re.compile("Motor 2 of foot 1"))).to_be_visible()
    page.keyboard.press("m")
    page.keyboard.press("ArrowRight")
    jog.get_by_role("button", name="Target to present pose").click()
    assert studio.robot()["jog"] is None
    if stands is not None:
        assert studio.robot()["strokes_mm"] == pytest.approx(stands, abs=0.1)


def test_a_pose_is_taken_into_the_segment_table_and_undone(page: Page, studio: StudioProcess) -> None:
    jog = page.get_by_role("group", name="Jog", exact=True)
    take = jog.get_by_role("button", name="Take this pose as a waypoint")
    expect(take).to_have_attribute("title", re.compile("has no segment table"))
    page.get_by_text("By hand (9)").click()
    page.get_by_text("Manual walk, v0", exact=True).click()
    expect(take).not_to_have_attribute("aria-disabled", "true")

    def segments() -> int:
        view = studio.ask("GET", "/api/gaits/walk-manual-0/view").content
        return len(view["document"]["segment_table"]["feet"][0])

    before = segments()
    jog.get_by_role("button", name="Body", exact=True).click()
    higher = jog.get_by_role("button", name="Body, height plus")
    expect(higher).not_to_have_attribute("aria-disabled", "true")
    higher.click()
    take.click()
    expect(
        page.get_by_text(f"“Pose 1” was added to the segment table as segment {before + 1}.")
    ).to_be_visible()
    wait_for(lambda: segments() == before + 1, "the table is longer", 60.0)
    page.keyboard.press("Control+z")
    wait_for(lambda: segments() == before, "the pose is undone", 60.0)
