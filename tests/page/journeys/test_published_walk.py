"""From *Import* to the walking robot for a published recording that the motors cannot make as it stands."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Locator, Page, expect

from app.emulator.emulated_robot import EmulatedRobot
from tests.support.page.opened import opened_page
from tests.support.patience import patient_robot
from tests.support.reference import reference_path
from tests.support.studio_process import StudioProcess, running_studio

pytestmark = pytest.mark.heavy

MOST_CLICKS = 8
SPEED = 40.0
"""Seconds of the emulated robot in a second."""


@pytest.fixture
def robot() -> Iterator[EmulatedRobot]:
    with patient_robot(SPEED) as emulated:
        yield emulated


@pytest.fixture
def studio(tmp_path: Path, robot: EmulatedRobot) -> Iterator[StudioProcess]:
    with running_studio(tmp_path, "--robot", robot.device) as running:
        yield running


@pytest.fixture
def page(browser: Browser, studio: StudioProcess) -> Iterator[Page]:
    with opened_page(browser, studio.url, 1280, 800) as opened:
        yield opened


def test_a_published_walk_is_sent_within_eight_clicks_and_says_what_was_changed(
    page: Page, studio: StudioProcess
) -> None:
    file = reference_path("trajectories/direction1/walk_a.csv")
    clicked: list[str] = []

    def click(control: Locator) -> None:
        clicked.append(str(control))
        control.click()

    page.get_by_role("button", name="New", exact=True).click()
    with page.expect_file_chooser() as choosing:
        click(page.get_by_role("menuitem", name="Import…"))
    choosing.value.set_files(file)
    card = page.get_by_role("region", name="Why the gait is infeasible")
    first = card.get_by_role("listitem").first
    expect(first).to_contain_text("The robot walks in the simulation.")
    click(first.get_by_role("button", name="Use this: Keep within the motors' range"))
    expect(card).to_be_hidden()
    click(page.locator("#foot-design").get_by_role("button", name="Check", exact=True))
    click(page.get_by_role("checkbox", name=re.compile("^I have seen")))
    click(page.get_by_role("button", name="Approve", exact=True))
    page.get_by_role("textbox", name="Your name").fill("Ada")
    page.keyboard.press("Enter")
    click(page.get_by_role("button", name="Connect", exact=True))
    click(page.get_by_role("button", name="Arm", exact=True))
    click(page.get_by_role("button", name="Send to robot", exact=True))
    expect(page.get_by_role("status", name="Robot")).to_contain_text("The plan is done")
    assert len(clicked) <= MOST_CLICKS, clicked
    view = json.loads(studio.blob("/api/gaits/walk-a/view"))
    document = view["document"]
    assert document["recorded"]["text"] == file.read_text(), "the recording is unchanged"
    assert document["recorded"]["fit"]["within_stroke"] == "clip"
    assert "strokes clipped by up to 3.45 mm" in view["plan"]["note"]
