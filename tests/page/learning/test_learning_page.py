"""Learning from trials on the page: a course is cancelled, a result kept as a set, offered, deleted."""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Route, expect

from app.store.database import Database
from core.vision.track_csv import format_track_csv
from tests.support.page.drawers import open_drawer
from tests.support.page.opened import look, opened_page
from tests.support.studio_process import StudioProcess, running_studio
from tests.support.trials.synthetic_walks import keep_course
from tests.support.trials.tracks import stepping_track

pytestmark = pytest.mark.heavy

GAITS = ("walk-manual-0", "walk-manual-1", "walk-manual-2")


@pytest.fixture(scope="module")
def studio(tmp_path_factory: pytest.TempPathFactory) -> Iterator[StudioProcess]:
    """A studio that has learned once and has trials of three gaits."""
    data = tmp_path_factory.mktemp("data")
    database = Database(data / "studio.sqlite3")
    keep_course(database, "3 trials of 3 gaits")
    database.close()
    with running_studio(data) as running:
        track = format_track_csv(stepping_track((0.0085, 0.0085), 1))
        for gait in (*GAITS, ""):
            body = {"name": f"trial of {gait or 'nothing'}", "csv": track, "expected_cm": 1.0, "gait": gait}
            assert running.ask("POST", "/api/trials", body).status == 201
        yield running


def test_a_course_runs_in_the_background_and_can_be_cancelled(
    browser: Browser, studio: StudioProcess
) -> None:
    with opened_page(browser, studio.url, 1280, 720) as page:
        open_drawer(page, "Trials")
        panel = page.get_by_role("region", name="Trials")
        panel.get_by_role("button", name="Learn from trials").click()
        expect(panel.get_by_role("checkbox", name="trial of nothing")).to_be_disabled()
        panel.get_by_role("checkbox", name=GAITS[2]).uncheck()
        learn = panel.get_by_role("button", name="Learn", exact=True)
        expect(learn).to_have_attribute("aria-disabled", "true")
        why = re.compile("^You ticked trials of 2 gaits. Learning needs at least 3 gaits")
        expect(learn).to_have_attribute("title", why)
        expect(panel.get_by_role("status", name="What Learn needs")).to_have_text(why)
        expect(panel.get_by_text("The studio does not know which waypoints were sent")).to_be_visible()
        panel.get_by_role("checkbox", name=GAITS[2]).check()
        expect(panel.get_by_role("status", name="What Learn needs")).to_be_hidden()
        learn.click()
        expect(panel.get_by_role("status", name="Learning")).to_have_text(
            re.compile(r"^\d+ of \d+ simulations")
        )
        expect(panel).to_contain_text("Learning from 3 trials of 3 gaits")
        look(page, "learning-on")
        panel.get_by_role("button", name="Cancel learning").click()
        expect(panel.get_by_role("list", name="Learning jobs")).to_contain_text("cancelled")
        expect(learn).to_be_visible()


def test_a_course_is_asked_for_again_only_where_the_studio_does_not_answer(
    browser: Browser, studio: StudioProcess
) -> None:
    on = {"id": "made", "state": "running", "done": 1, "total": 9, "source": "", "by": "", "made": 0.0}
    asked: list[str] = []

    def answer(route: Route) -> None:
        asked.append(route.request.url)
        if len(asked) == 1:
            route.abort()
        else:
            route.fulfill(status=500, json={"error": "The disk is full.", "where": None})

    with opened_page(browser, studio.url, 1024, 768) as page:
        page.route("**/api/learning", lambda route: route.fulfill(json={"courses": [on]}))
        page.route("**/api/learning/made", answer)
        open_drawer(page, "Trials")
        panel = page.get_by_role("region", name="Trials")
        panel.get_by_role("button", name="Learn from trials").click()
        progress = panel.get_by_role("status", name="Learning")
        expect(progress).to_have_text("The studio does not answer. Check that the studio is still running.")
        expect(progress).to_have_text("The disk is full.")
        assert len(asked) == 2


def test_what_was_learned_is_kept_chosen_in_simulate_deleted_and_brought_back(
    browser: Browser, studio: StudioProcess
) -> None:
    with opened_page(browser, studio.url, 1024, 768) as page:
        open_drawer(page, "Trials")
        panel = page.get_by_role("region", name="Trials")
        panel.get_by_role("button", name="Learn from trials").click()
        panel.get_by_role("button", name="3 trials of 3 gaits").click()
        drag = panel.get_by_role("table", name="Parameters").get_by_role("row", name="Cable drag")
        expect(drag).to_contain_text(" to ")
        speed = panel.get_by_role("table", name="Parameters").get_by_role("row", name="Motor speed")
        expect(speed).to_contain_text("not identifiable")
        ways = panel.get_by_role("table", name="Error of the predicted distance and angle")
        expect(ways.get_by_role("row", name="Physics, gait left out")).to_be_visible()
        cut = "1 of 3 gaits had strokes outside the motors’ range. "
        cut += "Learning limited these strokes to the range. The largest change is 4.2 mm (Walk, 3 cm)."
        expect(panel.get_by_text(cut)).to_be_visible()
        panel.get_by_label("Name of the set").fill("Lab floor")
        look(page, "learning-result")
        panel.get_by_role("button", name="Keep as a set").click()
        sets = panel.get_by_role("list", name="Sets of physics parameters")
        expect(sets).to_contain_text("Lab floor, version 1")
        offered = page.get_by_label("Physics parameters", exact=True).locator(
            "option", has_text="Lab floor, version 1"
        )
        expect(offered).to_have_count(1)
        sets.get_by_role("button", name="Delete Lab floor, version 1").click()
        expect(sets).to_have_count(0)
        expect(offered).to_have_count(0)
        page.get_by_role("button", name="Undo", exact=True).last.click()
        expect(sets).to_contain_text("Lab floor, version 1")
        expect(offered).to_have_count(1)
        page.get_by_role("tab", name="Simulate").click()
        expect(page.get_by_label("Physics parameters", exact=True)).to_have_value("scales")
