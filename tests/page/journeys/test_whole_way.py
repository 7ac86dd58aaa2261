"""One person's whole way on the page: from opening it to measured strokes of the emulated robot."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page, expect

from app.bridge.delivery import ARRIVAL_MM
from app.emulator.emulated_robot import EmulatedRobot
from tests.support.page.opened import look, opened_page
from tests.support.patience import patient_robot
from tests.support.studio_process import StudioProcess, running_studio, wait_for

SPEED = 40.0
"""Seconds of the emulated robot in a second."""
WALKING = 5.0
"""The same from the beginning of a run on: slow enough to look on."""
SLOW = 0.5
"""The same while the page is loaded anew, which a busy machine takes its time for."""


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
    with opened_page(browser, studio.url, 1280, 720, has_scene=True) as opened:
        yield opened


def see_the_sample_gait_walk(page: Page) -> None:
    expect(page.get_by_role("list", name="Gaits").get_by_text("Walk 10 mm", exact=True)).to_be_visible()
    expect(page.get_by_role("region", name="3D preview")).to_be_visible()
    frame = page.frame_locator("iframe").locator("canvas").first
    frame.wait_for()
    standing = page.get_by_role("region", name="3D preview").screenshot()
    expect(page.locator("#clock")).to_contain_text("17.6 s")
    page.get_by_role("button", name="Play", exact=True).click()
    expect(page.locator("#clock")).not_to_contain_text(re.compile(r"^0\.[0-9] "))
    page.get_by_role("button", name="Pause", exact=True).click()
    preview = page.get_by_role("region", name="3D preview")
    wait_for(lambda: preview.screenshot() != standing, "the preview shows another picture", 60)


def change_a_footfall_and_take_it_back(page: Page) -> None:
    grid = page.get_by_role("grid", name="Footfall timeline")
    grid.get_by_role("gridcell", name="foot 3, sample 11: stance", exact=True).click()
    expect(grid.get_by_role("gridcell", name="foot 3, sample 11: swing", exact=True)).to_be_visible()
    page.get_by_role("button", name=re.compile("^Undo")).click()
    expect(grid.get_by_role("gridcell", name="foot 3, sample 11: stance", exact=True)).to_be_visible()
    grid.get_by_role("gridcell", name="foot 3, sample 11: stance", exact=True).click()
    expect(grid.get_by_role("gridcell", name="foot 3, sample 11: swing", exact=True)).to_be_visible()


def optimise_check_and_approve(page: Page) -> None:
    page.get_by_role("tab", name="Design").click()
    page.get_by_role("button", name="Optimise", exact=True).click()
    page.get_by_role("button", name="Jobs", exact=True).click()
    jobs = page.get_by_role("list", name="Jobs")
    expect(jobs.get_by_text(re.compile("done", re.I)).first).to_be_visible()
    look(page, "optimised")
    page.get_by_role("tab", name="Check & approve").click()
    page.get_by_role("button", name="Check", exact=True).click()
    approve = page.get_by_role("button", name="Approve", exact=True)
    expect(approve).to_be_enabled()
    look(page, "checked")
    approve.click()
    page.get_by_role("textbox", name="Your name").fill("Ada")
    page.keyboard.press("Enter")
    expect(page.get_by_role("tab", name="Run", selected=True)).to_be_visible()
    expect(page.get_by_role("status", name="Verdict")).to_contain_text("Approved by Ada")


def say_who_you_are(page: Page, name: str) -> None:
    page.get_by_role("button", name=re.compile("Operator")).click()
    page.get_by_role("textbox", name="Your name").fill(name)
    page.keyboard.press("Enter")


def go_the_robots_way(page: Page, robot: EmulatedRobot) -> None:
    page.get_by_role("tab", name="Run").click()
    expect(page.get_by_text(re.compile("about 8 s")).first).to_be_visible()
    look(page, "before-connecting")
    page.get_by_role("button", name="Connect", exact=True).click()
    status = page.get_by_role("status", name="Robot")
    expect(status).to_contain_text("disarmed")
    page.get_by_role("button", name="Arm", exact=True).click()
    expect(status).to_contain_text("armed")
    look(page, "armed")
    robot.change_speed(WALKING)
    page.get_by_role("button", name="Send to robot").click()
    expect(status).to_contain_text("moving")


def test_from_opening_the_page_to_the_robots_measured_strokes(
    page: Page, studio: StudioProcess, robot: EmulatedRobot
) -> None:
    look(page, "opened")
    see_the_sample_gait_walk(page)
    change_a_footfall_and_take_it_back(page)
    optimise_check_and_approve(page)
    go_the_robots_way(page, robot)
    wait_for(lambda: (studio.robot()["run"] or {}).get("reached", 0) > 5, "some waypoints are reached")
    robot.change_speed(SLOW)
    page.reload()
    status = page.get_by_role("status", name="Robot")
    expect(status).to_contain_text("moving")
    robot.change_speed(SPEED)
    page.get_by_role("tab", name="Run").click()
    look(page, "running")
    expect(status).to_contain_text("done")
    look(page, "done")
    plan = studio.ask("GET", "/api/gaits/walk/view").content["plan"]
    messages = [m for m in robot.firmware.messages if m.strokes_mm is not None]
    parsed = [[round(h, 4) for h in m.strokes_mm or ()] for m in messages]
    assert parsed[-plan["waypoint_count"] :] == plan["waypoint_strokes_mm"]
    start_moves = parsed[: -plan["waypoint_count"]]
    assert len(start_moves) <= 3
    assert len(messages) == len(robot.firmware.messages)
    reached = robot.firmware.completions[-plan["waypoint_count"] :]
    assert all(done.worst_mm <= ARRIVAL_MM for done in reached)
    shown = [float(text) for text in page.locator(".strokes .bar span").all_inner_texts()]
    assert len(shown) == 12
    assert max(abs(a - b) for a, b in zip(shown, plan["waypoint_strokes_mm"][-1], strict=True)) <= 1.1


def edit_while_the_robot_moves(page: Page) -> None:
    later = page.get_by_role("status", name="Later edit")
    expect(later).to_be_hidden()
    page.get_by_role("tab", name="Design").click()
    step = page.get_by_role("spinbutton", name="Step", exact=True)
    step.fill("9")
    step.press("Enter")
    page.get_by_role("tab", name="Run").click()
    expect(later).to_have_text(
        "The run continues with the approved version of the gait. The page shows a newer version."
    )
    look(page, "edited while it runs")


@pytest.mark.heavy
def test_stop_on_the_page_latches_until_it_is_cleared(
    page: Page, studio: StudioProcess, robot: EmulatedRobot
) -> None:
    job = studio.ask("POST", "/api/jobs", {"kind": "optimise", "gait": "walk"}).content["id"]
    wait_for(lambda: studio.ask("GET", f"/api/jobs/{job}").content["state"] == "done", "the job is done")
    studio.ask("POST", "/api/gaits/walk/check")
    studio.ask("POST", "/api/gaits/walk/approve", {"by": "Ada", "accept_warnings": True})
    say_who_you_are(page, "Ada")
    go_the_robots_way(page, robot)
    wait_for(lambda: (studio.robot()["run"] or {}).get("reached", 0) > 2, "some waypoints are reached")
    robot.change_speed(SLOW)
    edit_while_the_robot_moves(page)
    page.get_by_role("button", name="Stop", exact=True).click()
    robot.change_speed(SPEED)  # not before: a quick run may have ended by then
    status = page.get_by_role("status", name="Robot")
    wait_for(lambda: studio.robot()["robot"] == "stopped", "the robot stands still")
    expect(status).to_contain_text(re.compile("stopped at .* by Ada", re.I))
    look(page, "stopped")
    taken = len(robot.firmware.messages)
    page.get_by_role("button", name="Clear", exact=True).click()
    expect(status).to_contain_text("disarmed")
    page.get_by_role("button", name="Arm", exact=True).click()
    expect(status).to_contain_text("armed")
    cleared = [m.payload for m in robot.firmware.messages[taken:]]
    assert len(cleared) == 2
    assert cleared[1] == "s,0"
