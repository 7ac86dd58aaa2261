"""Videos on the page: a setup made on a picture, a video tracked into a trial, places and colours taken."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from playwright.sync_api import Browser, Locator, Page, expect

from app.vision.video_io import jpeg
from tests.app.routes.test_videos_http import SETUP
from tests.app.vision.test_lens import CORNERS, seen_from
from tests.support.page.axe import findings
from tests.support.page.drawers import open_drawer
from tests.support.page.late_answers import LateRequests
from tests.support.page.opened import opened_page
from tests.support.studio_process import StudioProcess, wait_for
from tests.support.trials import rendered
from tests.support.trials.tracks import RATE, stepping_track

pytestmark = pytest.mark.heavy

EVERY = 4
"""Every so many frames of the track are rendered."""

SQUARE = ((-5, -5), (5, -5), (5, 5), (-5, 5))
"""Places that the page asks for one after the other, cm."""


@pytest.fixture(scope="module")
def video(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A walk of 0.85 cm along x and y, seen through a lens."""
    path = tmp_path_factory.mktemp("video") / "on glass.avi"
    rendered.write_video(path, stepping_track((0.0085, 0.0085), 1).feet[::EVERY], RATE / EVERY)
    return path


@pytest.fixture
def page(browser: Browser, studio: StudioProcess) -> Iterator[Page]:
    with opened_page(browser, studio.url, 1280, 720) as opened:
        yield opened


def panel(page: Page) -> Locator:
    return page.get_by_role("region", name="Trials")


def pixel_of(place_cm: tuple[float, float]) -> tuple[float, float]:
    """Where a place is in the rendered picture: through the lens, as OpenCV counts pixels."""
    per_cm = rendered.PIXELS_PER_METRE / 100
    straight = (rendered.ORIGIN[0] + place_cm[0] * per_cm, rendered.ORIGIN[1] - place_cm[1] * per_cm)
    maps = rendered.distorting_maps()
    off = (maps[0] - straight[0]) ** 2 + (maps[1] - straight[1]) ** 2
    row, column = divmod(int(off.argmin()), rendered.SIZE[0])
    return float(column), float(row)


def click_pixel(page: Page, pixel: tuple[float, float]) -> None:
    """Clicks into the fitted picture, which is another element for each frame."""
    frame = page.locator(".video-frame").bounding_box()
    assert frame is not None
    size = np.array([frame["width"], frame["height"]])
    scale = (size / rendered.SIZE).min()
    corner = [frame["x"], frame["y"]] + (size - np.array(rendered.SIZE) * scale) / 2
    x, y = corner + (np.array(pixel) + 0.5) * scale
    page.mouse.click(float(x), float(y))


def send_video(page: Page, video: Path) -> None:
    open_drawer(page, "Trials")
    panel(page).get_by_role("button", name="From a video…").click()
    panel(page).get_by_label("Video file").set_input_files(video)
    expect(panel(page).get_by_role("button", name="New setup…")).to_be_visible()


def test_a_video_becomes_a_trial_through_a_setup_that_is_made_on_its_picture(page: Page, video: Path) -> None:
    send_video(page, video)
    track = panel(page).get_by_role("button", name="Track the feet")
    expect(track).to_have_attribute("aria-disabled", "true")
    panel(page).get_by_role("button", name="New setup…").click()
    state = panel(page).get_by_role("status", name="Setup state")
    panel(page).get_by_role("tab", name="Place").click()
    expect(page.locator(".video-image")).to_have_js_property("naturalWidth", rendered.SIZE[0])
    for count, corner in enumerate(SQUARE, start=1):
        click_pixel(page, pixel_of(corner))
        expect(page.locator(".video-point")).to_have_count(count)
    expect(state).to_contain_text("Complete. Saved, version")
    expect(page.locator(".camera-axis")).to_have_count(2)
    before = page.locator(".video-point").nth(1).get_attribute("data-x")
    page.locator(".video-point").nth(1).press("ArrowRight")
    expect(page.locator(".video-point").nth(1)).to_have_attribute("data-x", str(int(before or 0) + 1))

    panel(page).get_by_role("tab", name="Feet").click()
    feet = panel(page).get_by_role("list", name="Feet in this picture").get_by_role("listitem")
    expect(feet).to_contain_text(["Foot 1, green", "Foot 2, red", "Foot 3, orange", "Foot 4, blue"])
    expect(feet.filter(has_text="cm")).to_have_count(4)
    panel(page).get_by_role("slider", name="Foot 1, hue to").press("Shift+ArrowLeft")
    panel(page).get_by_role("button", name="Foot 2, red").click()
    panel(page).get_by_role("button", name="Pick colour").click()
    click_pixel(page, pixel_of((0, 4)))
    expect(panel(page).get_by_role("list", name="Spots of this colour")).to_contain_text("chosen as the foot")
    assert findings(page) == []

    panel(page).get_by_role("button", name="Done").click()
    panel(page).get_by_label("Wanted distance, cm").fill("1.2")
    track.click()
    published = panel(page).get_by_role("table", name="Movement as published")
    expect(published.get_by_role("row", name="planned 1.0")).to_be_visible()
    mean = published.get_by_role("row", name="mean").get_by_role("cell")
    assert float(mean.nth(0).inner_text()) == pytest.approx(1.2, abs=0.08)
    assert float(mean.nth(1).inner_text()) == pytest.approx(45.0, abs=3.0)


def test_a_tracking_that_nobody_follows_offers_its_trial_and_its_video_leads_there(
    page: Page, studio: StudioProcess, video: Path
) -> None:
    setup = studio.ask("POST", "/api/setups", SETUP).content["id"]
    kept = studio.ask("POST", "/api/videos?name=aside.avi", video.read_bytes() + b"\0").content["id"]
    order = {"setup": setup, "name": "tracked aside", "expected_cm": 1.0}
    studio.ask("POST", f"/api/videos/{kept}/track", order)
    open_drawer(page, "Jobs")
    expect(page.get_by_role("button", name="Tracking aside.avi")).to_be_visible()
    page.get_by_role("button", name="Open the trial").click()
    published = panel(page).get_by_role("table", name="Movement as published")
    expect(published).to_be_visible()
    expect(panel(page)).to_contain_text("tracked aside")
    panel(page).get_by_role("button", name="All trials").click()
    panel(page).get_by_role("button", name="From a video…").click()
    row = panel(page).get_by_role("list", name="Videos").get_by_role("listitem").filter(has_text="aside.avi")
    expect(row).to_contain_text("has a trial")
    row.get_by_role("button", name="Open its trial").click()
    expect(published).to_be_visible()


def test_a_video_that_is_sent_twice_is_said_to_be_there(page: Page, video: Path) -> None:
    send_video(page, video)
    panel(page).get_by_role("button", name="All videos").click()
    panel(page).get_by_label("Video file").set_input_files(video)
    expect(page.get_by_role("status").filter(has_text="The studio already has “")).to_be_visible()


def test_a_file_on_its_way_goes_on_where_its_panel_is_left_until_it_is_cancelled(
    page: Page, video: Path
) -> None:
    page.route("**/api/videos?name=*", lambda route: None)
    open_drawer(page, "Trials")
    panel(page).get_by_role("button", name="From a video…").click()
    panel(page).get_by_label("Video file").set_input_files(video)
    expect(panel(page).get_by_role("button", name="Cancel upload")).to_be_visible()
    page.keyboard.press("Escape")
    expect(panel(page)).to_be_hidden()
    open_drawer(page, "Trials")
    panel(page).get_by_role("button", name="From a video…").click()
    panel(page).get_by_role("button", name="Cancel upload").click()
    expect(panel(page).get_by_label("Video file")).to_be_enabled()
    expect(panel(page).get_by_role("button", name="Cancel upload")).to_be_hidden()


def test_videos_that_come_late_take_no_later_form_away(page: Page) -> None:
    open_drawer(page, "Trials")
    late = LateRequests(page, "GET", "/api/videos$")
    panel(page).get_by_role("button", name="From a video…").click()
    wait_for(lambda: late.count > 0, "the list of videos is asked for")
    panel(page).get_by_role("button", name="Add trials…").click()
    with page.expect_response("**/api/videos") as answer:
        late.let_go()
    answer.value.finished()
    page.evaluate("new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn)))")
    expect(panel(page).get_by_label("Track files")).to_be_visible()
    expect(panel(page).get_by_label("Video file")).to_have_count(0)


def test_a_setup_that_was_changed_elsewhere_is_shown_as_it_is_now(
    page: Page, studio: StudioProcess, video: Path
) -> None:
    send_video(page, video)
    panel(page).get_by_role("button", name="New setup…").click()
    name = panel(page).get_by_label("Setup name")
    expect(name).not_to_have_value("")
    view = next(
        one
        for one in studio.ask("GET", "/api/setups").content["setups"]
        if one["setup"]["name"] == name.input_value()
    )
    setup = {**view["setup"], "name": "from another service"}
    assert studio.ask("PUT", f"/api/setups/{view['id']}", {"revision": 1, "setup": setup}).status == 200
    name.fill("mine")
    name.press("Tab")
    expect(page.get_by_role("alert").filter(has_text="on another page")).to_be_visible()
    expect(name).to_have_value("from another service")
    name.fill("mine")
    name.press("Tab")
    expect(panel(page).get_by_role("status", name="Setup state")).to_contain_text("Saved, version 3.")


TURNS = ((0.0, 0.0, 0.0), (0.4, 0.0, 0.1), (-0.35, 0.2, 0.0), (0.1, -0.45, 0.2))
"""Slopes of the board before the camera, rad."""


def board_pictures(folder: Path) -> list[Path]:
    """Pictures of the board through the lens, and one that shows none."""
    pictures = [seen_from(np.array(turn), np.array([0.3 * at, 0.0, 13.0])) for at, turn in enumerate(TURNS)]
    pictures.append(np.full_like(pictures[0], 128))
    paths = [folder / f"board {number}.jpg" for number in range(len(pictures))]
    for path, picture in zip(paths, pictures, strict=True):
        path.write_bytes(jpeg(picture))
    return paths


def test_a_lens_is_found_from_pictures_of_a_board_and_straightens_what_is_shown(
    page: Page, video: Path, tmp_path: Path
) -> None:
    send_video(page, video)
    panel(page).get_by_role("button", name="New setup…").click()
    for side, corners in zip(("one", "other"), CORNERS, strict=True):
        expect(panel(page).get_by_label(f"Inner corners, {side} side")).to_have_value(str(corners))
    straighten = panel(page).get_by_role("button", name="Straighten the picture")
    expect(straighten).to_have_attribute("aria-disabled", "true")
    panel(page).get_by_label("Pictures of the checkerboard", exact=True).set_input_files(
        board_pictures(tmp_path)
    )
    boards = (
        panel(page).get_by_role("list", name="Pictures searched for the checkerboard").get_by_role("listitem")
    )
    expect(boards).to_have_count(len(TURNS) + 1)
    expect(boards.filter(has_text=re.compile(r"0\.\d\d px"))).to_have_count(len(TURNS))
    expect(boards.last).to_contain_text("not found")
    expect(panel(page).get_by_text(f"computed from {len(TURNS)} pictures")).to_be_visible()
    shown = page.locator(".video-image").get_attribute("src")
    straighten.click()
    expect(page.locator(".video-image")).not_to_have_attribute("src", shown or "")
    panel(page).get_by_role("button", name="Remove the lens correction").click()
    expect(panel(page).get_by_text("There is no lens correction.")).to_be_visible()
    expect(straighten).to_have_attribute("aria-disabled", "true")


def test_a_file_that_is_no_video_is_refused_with_a_sentence(page: Page, tmp_path: Path) -> None:
    path = tmp_path / "notes.mp4"
    path.write_text("no video")
    open_drawer(page, "Trials")
    panel(page).get_by_role("button", name="From a video…").click()
    panel(page).get_by_label("Video file").set_input_files(path)
    expect(page.get_by_role("alert").filter(has_text="notes.mp4")).to_be_visible()
    expect(panel(page).get_by_label("Video file")).to_be_enabled()
