"""Trials on the page beside plan and physics: the table of the three, tracks in 3D, bands over several."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, FilePayload, Locator, Page, expect

from core.vision.track_csv import format_track_csv
from tests.core.vision.test_image_header import picture
from tests.support.page.drawers import open_drawer
from tests.support.page.opened import opened_page
from tests.support.studio_process import StudioProcess
from tests.support.trials.tracks import stepping_track

pytestmark = pytest.mark.heavy

INSIDE = "document.querySelector('#viser').contentWindow?.__viserMutable"
ENDS = f"""(name) => {{
  let ends = null;
  {INSIDE}?.nodeRefFromName[name]?.traverse(({{ geometry }}) => {{
    ends ??= geometry?.attributes?.instanceStart?.data?.array;
  }});
  return ends && [...ends];
}}"""
"""The ends of a node's line pieces as they are drawn."""


def add_trial(studio: StudioProcess, name: str, step: float = 0.0085, **more: Any) -> str:
    track = format_track_csv(stepping_track((step, step), 1))
    body = {"name": name, "csv": track, "expected_cm": 1.0, "gait": "walk", **more}
    answer = studio.ask("POST", "/api/trials", body)
    assert answer.status == 201, answer.content
    return str(answer.content["id"])


def open_trials(page: Page) -> Locator:
    open_drawer(page, "Trials")
    return page.get_by_role("region", name="Trials")


def wait_until_shown(page: Page, node: str, shown: bool) -> None:
    script = f"(node) => ({INSIDE}?.nodeRefFromName[node]?.visible ?? false) === {str(shown).lower()}"
    page.wait_for_function(script, arg=node)


def test_physics_stands_beside_plan_and_track_once_it_is_there(
    browser: Browser, studio: StudioProcess
) -> None:
    add_trial(studio, "with plan")
    add_trial(studio, "without plan", gait="")
    with opened_page(browser, studio.url, 1280, 800) as page:
        panel = open_trials(page)
        panel.get_by_role("button", name=re.compile("^with plan")).click()
        expect(panel.get_by_role("table", name="Movement as published")).to_be_visible()
        table = panel.get_by_role("table", name="Planned, simulated, tracked")
        expect(table.get_by_role("row")).to_contain_text(["cm", "planned", "simulated", "tracked"])
        expect(table.get_by_role("row", name=re.compile(r"^tracked [\d.]+ 1.20 45.0 20 –"))).to_be_visible()
        simulated = table.get_by_role("row", name=re.compile(r"^simulated [\d.]+ (0\.9|1\.0)\d "))
        expect(simulated).to_be_visible()
        expect(panel.get_by_role("status", name="Physics")).to_contain_text("Robot on the scales")
        expect(panel.locator("svg.feet-ways polyline.way-simulated")).to_have_count(4)
        with page.expect_download() as download:
            panel.get_by_role("link", name="Report").click()
        assert "Tracked solid, simulated dashed, planned dotted." in Path(download.value.path()).read_text()
        panel.get_by_role("button", name="All trials").click()
        panel.get_by_role("button", name=re.compile("^without plan")).click()
        expect(panel.get_by_role("status", name="Physics")).to_contain_text("is not known of this trial")
        expect(table.get_by_role("row")).to_contain_text(["cm", "tracked"])


def test_tracks_lie_over_the_gait_in_3d_follow_the_playhead_and_go_with_the_panel(
    browser: Browser, studio: StudioProcess
) -> None:
    add_trial(studio, "in 3D")
    with opened_page(browser, studio.url, 1280, 800, has_scene=True) as page:
        page.wait_for_function(f"() => {INSIDE}?.nodeRefFromName['/tracks/marks'] !== undefined")
        panel = open_trials(page)
        panel.get_by_role("button", name=re.compile("^in 3D")).click()
        wait_until_shown(page, "/tracks/ways", True)
        page.wait_for_function(f"() => ({ENDS})('/tracks/marks')?.some((value) => value !== 0)")
        before = page.evaluate(ENDS, "/tracks/marks")
        page.keyboard.press("End")
        moved = f"(old) => ({ENDS})('/tracks/marks').some((value, at) => Math.abs(value - old[at]) > 0.005)"
        page.wait_for_function(moved, arg=before)
        page.get_by_role("button", name="Show", exact=True).click()
        page.keyboard.press("Escape")
        expect(page.get_by_role("menu", name="Show")).to_be_hidden()
        panel.get_by_label("Tracks in 3D").uncheck()
        wait_until_shown(page, "/tracks/ways", False)
        panel.get_by_label("Tracks in 3D").check()
        wait_until_shown(page, "/tracks/ways", True)
        panel.get_by_role("button", name="Close trials").click()
        wait_until_shown(page, "/tracks/ways", False)
        wait_until_shown(page, "/tracks/marks", False)


def test_trials_of_one_gait_lie_over_each_other_as_a_band(browser: Browser, studio: StudioProcess) -> None:
    gait = studio.ask("POST", "/api/gaits?copy_of=walk&name=Apart").content["id"]
    add_trial(studio, "short", 0.0080, gait=gait)
    add_trial(studio, "long", 0.0100, gait=gait, expected_cm=1.5)
    with opened_page(browser, studio.url, 1280, 800) as page:
        panel = open_trials(page)
        panel.get_by_role("button", name="Show band of Apart, 1.0 cm").click()
        above = panel.get_by_role("img", name=re.compile("^Trials from above: foot 1 ends ± 0.14 cm"))
        expect(above).to_be_visible()
        expect(above.locator("polyline.way-trial")).to_have_count(8)
        panel.get_by_role("checkbox", name="short").uncheck()
        above = panel.get_by_role("img", name=re.compile("^Trials from above: foot 1 ends ± 0.00 cm"))
        expect(above.locator("polyline.way-trial")).to_have_count(4)
        panel.get_by_role("checkbox", name="long").uncheck()
        expect(panel.get_by_text("Choose at least one trial.")).to_be_visible()


def test_photos_are_added_captioned_dropped_deleted_and_brought_back(
    browser: Browser, studio: StudioProcess
) -> None:
    add_trial(studio, "with photos", gait="")
    with opened_page(browser, studio.url, 1280, 800) as page:
        panel = open_trials(page)
        panel.get_by_role("button", name=re.compile("^with photos")).click()
        photos = panel.get_by_role("region", name="Photos of this trial")
        content = picture("PNG", (400, 300))
        file = FilePayload(name="tape.png", mimeType="image/png", buffer=content)
        photos.get_by_label("Add photos…", exact=True).and_(page.locator("input")).set_input_files(file)
        expect(photos.get_by_role("img", name="tape.png")).to_have_js_property("naturalWidth", 240)
        photos.get_by_label("Caption of photo 1").fill("new tape")
        photos.get_by_label("Caption of photo 1").press("Enter")
        expect(photos.get_by_role("img", name="new tape")).to_be_visible()
        photos.dispatch_event("drop", {"dataTransfer": dropped(page, "notes.txt")})
        expect(page.get_by_role("alert")).to_contain_text("notes.txt is no PNG or JPEG picture")
        photos.get_by_role("button", name="Delete photo 1").click()
        expect(photos.get_by_role("listitem")).to_have_count(0)
        page.get_by_role("button", name="Undo", exact=True).last.click()
        expect(photos.get_by_label("Caption of photo 1")).to_have_value("new tape")


def dropped(page: Page, name: str) -> Any:
    """What a hand drops that holds a file of words."""
    script = """(name) => {
      const held = new DataTransfer();
      held.items.add(new File(["words"], name));
      return held;
    }"""
    return page.evaluate_handle(script, name)
