"""Cameras on the page: recording with the run up to its trial, the picture beside the scene, unplugging."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Locator, Page, expect

from app.emulator.emulated_robot import EmulatedRobot
from tests.app.routes.test_cameras_http import walked
from tests.app.routes.test_videos_http import SETUP, TRACK
from tests.support.page.axe import findings
from tests.support.page.drawers import open_drawer
from tests.support.page.opened import look, opened_page
from tests.support.studio_process import StudioProcess, running_studio
from tests.support.trials.rendered import SIZE, write_video
from tests.support.trials.tracks import RATE

pytestmark = [pytest.mark.heavy, pytest.mark.alone]

SPEED = 3.0
"""Of the robot: its walk lasts long enough for a track, and no longer."""
EVERY = 4
"""Every so many frames of the track are filmed, so fast that the film lasts about as long as the run."""


LEFT = """(width) => {
  const element = document.querySelector(".camera-float");
  const isThere = element && Math.abs(element.offsetWidth - width) < 2;
  return isThere && element.style.transform.startsWith("translate(16px") && element.style.transform;
}"""
"""Where the picture is once it is so wide and has been moved."""


@pytest.fixture(scope="module")
def film(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("video") / "walk.avi"
    write_video(path, TRACK.feet[::EVERY], RATE / EVERY * SPEED)
    return path


@pytest.fixture(scope="module")
def studio(
    tmp_path_factory: pytest.TempPathFactory, robot: EmulatedRobot, film: Path
) -> Iterator[StudioProcess]:
    words = ("--robot", robot.device, "--camera", f"Glass={film}", "--camera", f"Side={film}")
    with running_studio(tmp_path_factory.mktemp("data"), *words) as running:
        assert running.ask("POST", "/api/setups", SETUP).status == 201
        yield running


@pytest.fixture
def page(browser: Browser, studio: StudioProcess) -> Iterator[Page]:
    with opened_page(browser, studio.url, 1280, 720) as opened:
        yield opened


def panel(page: Page) -> Locator:
    return page.get_by_role("region", name="Trials")


def camera(page: Page, name: str) -> Locator:
    return panel(page).get_by_role("list", name="Cameras").get_by_role("listitem", name=name, exact=True)


def open_cameras(page: Page) -> None:
    open_drawer(page, "Trials")
    panel(page).get_by_role("button", name="Cameras").click()


def test_a_run_is_recorded_and_its_note_leads_to_the_trial_with_its_figures(
    page: Page, studio: StudioProcess
) -> None:
    open_cameras(page)
    page.get_by_label("Glass, seen").select_option("under the platform")
    page.get_by_label("Glass, setup").select_option("under the glass")
    records = page.get_by_role("switch", name="Glass, record each run")
    records.click()
    expect(records).to_be_checked()
    camera(page, "Glass").get_by_role("button", name="Look").click()
    feet = panel(page).get_by_role("list", name="Feet in this picture").get_by_role("listitem")
    expect(feet.filter(has_text="cm")).to_have_count(4)
    assert findings(page) == []

    run = walked(studio)
    expect(panel(page)).to_be_hidden()
    page.get_by_role("button", name="Trial of this run").click()
    published = panel(page).get_by_role("table", name="Movement as published")
    expect(published.get_by_role("row", name="planned 1.0")).to_be_visible()
    mean = published.get_by_role("row", name="mean").get_by_role("cell").first
    assert 0.2 < float(mean.inner_text()) < 2.0
    expect(panel(page)).to_contain_text("tracked with the camera setup “under the glass”, version 1")

    open_drawer(page, "Runs").locator(f"[data-run='{run}']").click()
    recorded = page.get_by_role("group", name="Recordings of this run")
    recorded.get_by_role("button", name="Recording of glass").click()
    expect(panel(page).get_by_role("button", name="Open its trial")).to_be_visible()


def test_a_camera_stands_beside_the_scene_and_says_that_it_was_unplugged(page: Page, film: Path) -> None:
    open_cameras(page)
    camera(page, "Side").get_by_role("button", name="Beside the scene").click()
    beside = page.get_by_role("region", name="Camera Side")
    expect(beside.locator("img")).to_have_js_property("naturalWidth", min(480, SIZE[0]))
    away = film.with_suffix(".away")
    film.rename(away)
    try:
        expect(beside).to_contain_text("unplugged")
        expect(beside.get_by_role("status")).to_contain_text(re.compile(r"\w+\."))
    finally:
        away.rename(film)
    expect(beside.locator("img")).to_be_visible()
    expect(beside.locator("p")).to_be_empty()
    beside.get_by_role("button", name="Close the camera's picture").click()
    expect(beside).to_have_count(0)


def test_the_picture_beside_the_scene_is_small_and_comes_back_where_and_as_large_as_it_was_left(
    page: Page,
) -> None:
    open_cameras(page)
    float_button = camera(page, "Side").get_by_role("button", name="Beside the scene")
    float_button.click()
    beside = page.get_by_role("region", name="Camera Side")
    expect(beside.locator("img")).to_have_js_property("naturalWidth", min(480, SIZE[0]))
    first, scene = beside.bounding_box(), page.locator("section.stage").bounding_box()
    assert first is not None
    assert scene is not None
    assert first["width"] <= 0.2 * scene["width"] + 1
    title = beside.get_by_role("group")
    look(page, "camera-beside")
    for key in ("ArrowRight", "ArrowUp", "+"):
        title.press(key)
    left = page.wait_for_function(LEFT, arg=first["width"] + 16).json_value()
    float_button.click()
    expect(beside).to_have_count(0)
    float_button.click()
    assert page.wait_for_function(LEFT, arg=first["width"] + 16).json_value() == left


def test_an_unplugged_camera_that_is_looked_at_is_grey_and_says_why_until_it_is_back(
    page: Page, film: Path
) -> None:
    open_cameras(page)
    page.get_by_label("Side, seen").select_option("from the side")
    camera(page, "Side").get_by_role("button", name="Look").click()
    stage = page.get_by_role("region", name="Picture", exact=True)
    live = panel(page).get_by_text("This is the live picture of the camera.")
    expect(live).to_be_visible()
    expect(stage.locator("img")).to_have_js_property("naturalWidth", SIZE[0])
    away = film.with_suffix(".away")
    film.rename(away)
    try:
        expect(panel(page).get_by_text("Plug it in again.")).to_be_visible()
        expect(live).to_have_count(0)
        expect(stage.locator("img")).to_have_css("filter", "grayscale(1)")
        look(page, "camera-gone")
    finally:
        away.rename(film)
    expect(live).to_be_visible()
    expect(stage.locator("img")).to_have_css("filter", "none")


def test_a_camera_without_a_setup_does_not_record_for_tracking_and_says_why(page: Page) -> None:
    open_cameras(page)
    page.get_by_label("Side, seen").select_option("under the platform")
    records = page.get_by_role("switch", name="Side, record each run")
    records.click()
    expect(page.get_by_role("alert").filter(has_text="setup")).to_be_visible()
    expect(records).not_to_be_checked()
