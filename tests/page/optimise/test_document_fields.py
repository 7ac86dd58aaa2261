"""Orientation and sample time of a gait: changed in fields, undone by name, and not there in a sequence."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Locator, Page, expect

from app.documents.gait_json import gait_content
from core.gait.gait import Orientation
from core.gait.poses import Poses
from core.library.new_gait import drawn_gait
from core.pose_gaits.gait_poses import new_pose_gait
from core.robot.model import load_robot
from tests.support.page.opened import choose, opened_page
from tests.support.studio_process import StudioProcess, wait_for

pytestmark = pytest.mark.heavy


@pytest.fixture
def page(browser: Browser, studio: StudioProcess) -> Iterator[Page]:
    with opened_page(browser, studio.url, 1024, 768) as opened:
        yield opened


def more(page: Page, gait: str) -> None:
    choose(page, gait)
    unfold(page)


def unfold(page: Page) -> None:
    page.locator("#optimise summary").filter(has_text="More").first.click()


def orientation(page: Page) -> Locator:
    return page.get_by_role("combobox", name="Orientation", exact=True)


def sample_time(page: Page) -> Locator:
    return page.get_by_role("spinbutton", name="Sample time", exact=True)


def first_foot(page: Page) -> Locator:
    return page.get_by_role("grid", name="Footfall timeline").get_by_role("rowheader").first


def test_another_orientation_renames_the_feet_and_leaves_the_step(page: Page, studio: StudioProcess) -> None:
    more(page, "Walk 10 mm")
    step = studio.document("walk")["step"]
    expect(first_foot(page)).to_contain_text("FR")
    orientation(page).select_option("FBS")
    expect(first_foot(page)).not_to_contain_text("FR")
    assert studio.document("walk")["orientation"] == "FBS"
    assert studio.document("walk")["step"] == step
    expect(page.locator("#undo-label")).to_have_text("orientation to FBS")
    page.locator("#undo").click()
    expect(orientation(page)).to_have_value("FB")
    expect(first_foot(page)).to_contain_text("FR")


def test_another_sample_time_keeps_the_drawing_and_changes_how_long_it_takes(
    page: Page, studio: StudioProcess
) -> None:
    more(page, "C-Gait 10 mm")
    drawn = studio.document("c-gait")["timeline"]
    sample_time(page).fill("9")
    sample_time(page).press("Enter")
    alert = page.locator("#optimise").get_by_role("alert")
    expect(alert.filter(has_text="Sample time is 9 s; it must lie between 0.05 and 5 s.")).to_be_visible()
    assert studio.document("c-gait")["timeline"] == drawn
    sample_time(page).fill("0.5")
    sample_time(page).press("Enter")
    timed = {**drawn, "sample_time": 0.5}
    wait_for(lambda: studio.document("c-gait")["timeline"] == timed, "only the sample time is another")
    expect(page.get_by_label("Time", exact=True)).to_contain_text("22.0 s")
    expect(page.locator("#undo-label")).to_have_text("sample time to 0.5 s")
    page.locator("#undo").click()
    expect(sample_time(page)).to_have_value("0.4")


def test_swings_may_overlap_where_a_gait_for_the_robot_has_more_than_four_legs(
    page: Page, studio: StudioProcess
) -> None:
    overlap = page.get_by_role("combobox", name="Overlap", exact=True)
    choose(page, "Fast C-Gait")
    unfold(page)
    expect(page.get_by_role("spinbutton", name="Slip", exact=True)).to_be_visible()
    expect(overlap).to_be_hidden()
    model = load_robot("hexapod")
    drawn = drawn_gait(model, "Six feet", Orientation.FBS, (1, 4, 2, 5, 3, 6), 0.02)
    asked = gait_content(new_pose_gait("Six feet", drawn, Poses(free_step=False), model))
    made = studio.ask("POST", "/api/gaits", asked).content["id"]
    page.get_by_role("list", name="Gaits").get_by_role("button", name="Six feet").click()
    expect(page.get_by_label("Gait name")).to_have_value("Six feet")
    expect(overlap).to_have_value("false")
    overlap.select_option("overlapping")
    wait_for(lambda: studio.document(made)["poses"].get("overlap"), "swings overlap")
    expect(page.locator("#undo-label")).to_have_text("overlap to overlapping")
    expect(page.locator("#optimise summary").first).to_have_text("More: overlapping swings")
    page.locator("#undo").click()
    expect(overlap).to_have_value("false")
    expect(page.locator("#optimise summary").first).to_have_text("More")
    studio.ask("DELETE", f"/api/gaits/{made}")  # which ends its search


def test_a_sequence_has_notes_of_its_own_and_all_else_from_its_parts(
    page: Page, studio: StudioProcess
) -> None:
    asked = {"name": "Chain", "parts": [{"gait": "walk", "times": 1}]}
    made = studio.ask("POST", "/api/sequences", asked).content["id"]
    page.get_by_role("list", name="Gaits").get_by_role("button", name="Chain").click()
    expect(page.get_by_label("Gait name")).to_have_value("Chain")
    unfold(page)
    expect(orientation(page)).to_be_hidden()
    expect(sample_time(page)).to_be_hidden()
    notes = page.get_by_role("textbox", name="Notes", exact=True)
    notes.fill("Round the table")
    notes.press("Tab")
    wait_for(lambda: studio.document(made)["notes"] == "Round the table", "the notes are kept")
