"""Trials on the page: added, beside their plan, iterations moved by hand, deleted and brought back."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Route, expect

from core.vision.track_csv import format_track_csv
from tests.support.page.drawers import open_drawer
from tests.support.page.opened import opened_page
from tests.support.studio_process import StudioProcess
from tests.support.trials.tracks import stepping_track

pytestmark = pytest.mark.heavy


@pytest.fixture
def track(tmp_path: Path) -> Path:
    path = tmp_path / "on glass.csv"
    path.write_text(format_track_csv(stepping_track((0.0085, 0.0085), 2)))
    return path


@pytest.mark.heavy
def test_an_empty_list_offers_an_example_that_is_marked_and_never_learned_from(
    browser: Browser, studio: StudioProcess
) -> None:
    with opened_page(browser, studio.url, 1280, 800) as page:
        open_drawer(page, "Trials")
        panel = page.get_by_role("region", name="Trials")
        panel.get_by_role("button", name="Look at an example").click()
        expect(panel.get_by_text("This trial was simulated.")).to_be_visible(timeout=60_000)
        expect(panel.get_by_role("img", name=re.compile("^Feet from above"))).to_be_visible()
        panel.get_by_role("button", name="All trials").click()
        row = panel.get_by_role("list", name="Trials", exact=True).get_by_role("listitem")
        expect(row).to_contain_text("Example, made by simulation")
        expect(panel.get_by_role("table", name="Gaits compared")).to_have_count(0)
        panel.get_by_role("button", name="Learn from trials").click()
        expect(panel.get_by_role("checkbox", name=re.compile("^Example"))).to_be_disabled()
        expect(panel.get_by_text("Learning uses only trials of a real robot").first).to_be_visible()
        needs = panel.get_by_role("status", name="What Learn needs")
        expect(needs).to_contain_text("There is no trial to learn from yet. Learning needs at least 3 gaits")
        panel.get_by_role("button", name="All trials").click()
        row.get_by_role("button").click()
        panel.get_by_role("button", name="Delete", exact=True).click()
        expect(panel.get_by_role("button", name="Look at an example")).to_be_visible()


def test_a_track_is_added_compared_moved_deleted_and_brought_back(
    browser: Browser, studio: StudioProcess, track: Path
) -> None:
    with opened_page(browser, studio.url, 1280, 800) as page:
        expect(page.get_by_label("Gait name")).not_to_have_value("")  # the distance is that of the shown gait
        open_drawer(page, "Trials")
        panel = page.get_by_role("region", name="Trials")
        expect(panel.get_by_text("No trial yet.")).to_be_visible()
        panel.get_by_role("button", name="Add trials…").click()
        panel.get_by_label("Track files").set_input_files(track)
        clock = track.with_name("times.txt")
        clock.write_text("".join(f"{frame / 12}\n" for frame in range(track.read_text().count("\n") - 1)))
        panel.get_by_label("Frame times").set_input_files(clock)
        expect(panel.get_by_label("Wanted distance, cm")).to_have_value("1")
        panel.get_by_label("Iterations").fill("3")
        expect(panel.get_by_label("Wanted distance, cm")).to_have_value("3")
        panel.get_by_label("Wanted distance, cm").fill("2")
        panel.get_by_label("Iterations").fill("2")
        panel.get_by_role("button", name="Add trials", exact=True).click()
        end = panel.get_by_role("slider", name="End of iteration 1")
        expect(panel.get_by_text("12.0 a second")).to_be_visible()
        published = panel.get_by_role("table", name="Movement as published")
        expect(published.get_by_role("row", name="mean 2.40 45.0 20")).to_be_visible()
        expect(published.get_by_role("row", name="planned 2.0")).to_be_visible()
        net = panel.get_by_role("table", name="Net movement", exact=True)
        figures = net.get_by_role("row", name="mean").get_by_role("cell").all_text_contents()
        beside = panel.get_by_role("table", name="Net movement: planned, simulated, tracked")
        tracked = beside.get_by_role("row", name="tracked").get_by_role("cell")
        expect(tracked).to_have_text([re.compile(r"^\d"), *figures, "–"])
        before = int(end.get_attribute("aria-valuenow") or 0)
        end.press("ArrowLeft")
        expect(panel.get_by_role("button", name="Find them again")).to_be_visible()
        expect(end).to_have_attribute("aria-valuenow", str(before - 1))
        expect(end).to_be_focused()
        panel.get_by_role("button", name="Delete").click()
        expect(panel.get_by_text("No trial yet.")).to_be_visible()
        page.get_by_role("button", name="Undo", exact=True).last.click()
        expect(end).to_have_attribute("aria-valuenow", str(before - 1))
        panel.get_by_role("button", name="All trials").click()
        row = panel.get_by_role("table", name="Gaits compared").get_by_role("row", name="Walk 10 mm, 1.0 cm")
        expect(row.get_by_role("cell")).to_have_text([*figures, re.compile(r"^\d")])
        lines = panel.get_by_role("list", name="Trials", exact=True)
        expect(lines).to_contain_text(f"{figures[0]} of 2.00 cm")


def test_the_whole_line_of_an_iterations_end_is_dragged_and_lies_where_the_hand_leaves_it(
    browser: Browser, studio: StudioProcess
) -> None:
    csv = format_track_csv(stepping_track((0.0085, 0.0085), 2))
    body = {"name": "dragged", "csv": csv, "expected_cm": 2.0, "iterations": 2}
    trial = studio.ask("POST", "/api/trials", body).content
    with opened_page(browser, studio.url, 1280, 800) as page:
        open_drawer(page, "Trials")
        panel = page.get_by_role("region", name="Trials")
        panel.get_by_role("button", name=re.compile("^dragged")).click()
        expect(panel.get_by_role("status", name="Physics")).to_contain_text("is not known of this trial")
        end = panel.get_by_role("slider", name="End of iteration 1")
        end.scroll_into_view_if_needed()
        before = int(end.get_attribute("aria-valuenow") or 0)
        box = panel.locator("svg.feet-ways .reach").bounding_box()
        frame = panel.locator("svg.feet-ways .grid").bounding_box()
        assert box is not None
        assert frame is not None
        x, y = box["x"] + box["width"] / 2 + 4, box["y"] + box["height"] * 0.75
        page.mouse.move(x, y)
        page.mouse.down()
        page.mouse.move(x + 30, y, steps=3)
        page.mouse.up()
        expect(panel.get_by_role("button", name="Find them again")).to_be_visible()
        moved = int(end.get_attribute("aria-valuenow") or 0) - before
        assert abs(moved - 30 / frame["width"] * (trial["frames"] - 1)) <= 1.5


def test_where_pictures_come_unevenly_the_ends_of_iterations_stand_at_their_times(
    browser: Browser, studio: StudioProcess
) -> None:
    csv = format_track_csv(stepping_track((0.0085, 0.0085), 2))
    body = {"name": "uneven", "csv": csv, "expected_cm": 2.0, "iterations": 2}
    trial = studio.ask("POST", "/api/trials", body).content

    def slower_and_slower(route: Route) -> None:
        content = route.fetch().json()
        content["track"]["shares"] = [share**2 for share in content["track"]["shares"]]
        route.fulfill(json=content)

    with opened_page(browser, studio.url, 1280, 800) as page:
        page.route("**/paths", slower_and_slower)
        open_drawer(page, "Trials")
        panel = page.get_by_role("region", name="Trials")
        panel.get_by_role("button", name=re.compile("^uneven")).click()
        expect(panel.get_by_role("status", name="Physics")).to_contain_text("is not known of this trial")
        end = panel.get_by_role("slider", name="End of iteration 1")
        share = int(end.get_attribute("aria-valuenow") or 0) / (trial["frames"] - 1)
        told = float((end.get_attribute("aria-valuetext") or "").removesuffix(" s"))
        assert told == pytest.approx(share**2 * trial["seconds"], abs=0.11)
        frame, reach = (panel.locator(f"svg.feet-ways .{part}").bounding_box() for part in ("grid", "reach"))
        assert frame is not None
        assert reach is not None
        place = (reach["x"] + reach["width"] / 2 - frame["x"]) / frame["width"]
        assert place == pytest.approx(share**2, abs=0.01)


def test_a_trial_that_is_changed_elsewhere_is_followed_and_what_was_typed_stays(
    browser: Browser, studio: StudioProcess
) -> None:
    csv = format_track_csv(stepping_track((0.0085, 0.0085), 1))
    trial = studio.ask("POST", "/api/trials", {"name": "shared", "csv": csv, "expected_cm": 1.0}).content
    at = f"/api/trials/{trial['id']}"
    with opened_page(browser, studio.url, 1280, 800) as page:
        open_drawer(page, "Trials")
        panel = page.get_by_role("region", name="Trials")
        panel.get_by_role("button", name=re.compile("^shared")).click()
        note = panel.get_by_label("Note", exact=True)
        studio.ask("PUT", at, {"revision": 1, "note": "old tape"})
        expect(note).to_have_value("old tape")
        note.fill("my tape")
        studio.ask("PUT", at, {"revision": 2, "note": "their tape"})
        two = panel.get_by_role("group", name="Two notes")
        expect(two).to_contain_text("The saved note is “their tape”.")
        expect(note).to_have_value("my tape")
        two.get_by_role("button", name="Save what I typed").click()
        expect(two).to_be_hidden()
        studio.ask("DELETE", at)
        expect(panel.get_by_text("This trial is deleted.")).to_be_visible()
        note.fill("too late")
        note.blur()
        expect(page.get_by_role("alert").filter(has_text="Bring it back first")).to_be_visible()
        expect(note).to_have_value("too late")
        panel.get_by_role("button", name="Bring it back").click()
        expect(panel.get_by_text("This trial is deleted.")).to_be_hidden()
        two.get_by_role("button", name="Save what I typed").click()
        expect(two).to_be_hidden()
        panel.get_by_role("button", name="All trials").click()
        row = panel.get_by_role("button", name=re.compile("^shared"))
        expect(row).to_contain_text("too late")
        studio.ask("DELETE", at)
        expect(row).to_have_count(0)
