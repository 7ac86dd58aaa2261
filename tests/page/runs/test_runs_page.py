"""Runs on the page: found, filtered, laid over the plan, noted, compared, deleted and brought back."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Browser, Locator, Page, expect

from app.store.database import Database
from tests.support.page.drawers import open_drawer
from tests.support.page.late_answers import LateAnswers
from tests.support.page.opened import opened_page
from tests.support.ran_robot import keep_run
from tests.support.studio_process import StudioProcess, running_studio, wait_for

pytestmark = pytest.mark.heavy

GAIT = "walk-manual-0"


@pytest.fixture(scope="module")
def studio(tmp_path_factory: pytest.TempPathFactory) -> Iterator[StudioProcess]:
    """A studio whose robot ran three times, and before that once until it was stopped."""
    folder: Path = tmp_path_factory.mktemp("data")
    database = Database(folder / "studio.sqlite3")
    keep_run(database, "Eve", GAIT, day=-1, share=0.4)
    for day, by in enumerate(("Ada", "Bob", "Ada")):
        keep_run(database, by, GAIT, day)
    database.close()
    with running_studio(folder) as running:
        yield running


@pytest.fixture
def page(browser: Browser, studio: StudioProcess) -> Iterator[Page]:
    with opened_page(browser, studio.url, 1280, 800) as opened:
        expect(opened.get_by_label("Gait name")).not_to_have_value("")
        yield opened


def listed(page: Page) -> Locator:
    return page.get_by_role("list", name="Runs", exact=True).get_by_role("listitem")


def panel(page: Page) -> Locator:
    return page.get_by_role("region", name="Runs", exact=True)


def test_a_run_is_found_by_who_sent_it(page: Page) -> None:
    open_drawer(page, "Runs")
    expect(listed(page)).to_have_count(4)
    expect(listed(page).first).to_contain_text(re.compile(r"error 0\.\d\d mm"))
    page.get_by_label("Operator of the runs").select_option("Bob")
    expect(listed(page)).to_have_count(1)
    page.get_by_label("Runs until").fill("2020-01-01")
    expect(panel(page)).to_contain_text("No run matches the filters.")
    page.keyboard.press("Escape")
    page.get_by_role("tab", name="Design").click()
    expect(panel(page)).to_be_hidden()


def test_a_run_lies_over_the_plan_with_its_errors_and_its_note(page: Page, studio: StudioProcess) -> None:
    open_drawer(page, "Runs")
    listed(page).nth(1).get_by_role("button").click()
    expect(page.get_by_label("Gait name")).to_have_value("Manual walk, v0")
    expect(page.get_by_role("note", name="Lines of the plots")).to_have_text("plannedmeasured")
    expect(panel(page)).to_contain_text("Bob")
    feet = panel(page).get_by_role("table", name="Feet, mm").get_by_role("row")
    expect(feet).to_have_count(5)
    expect(panel(page).get_by_role("table", name="Motors, mm").get_by_role("row")).to_have_count(13)

    run = studio.ask("GET", "/api/runs?operator=Bob").content["runs"][0]["id"]
    for form in ("CSV", "MCAP"):
        link = panel(page).get_by_role("link", name=form, exact=True)
        expect(link).to_have_attribute("href", f"/api/runs/{run}/run.{form.lower()}")
    note = panel(page).get_by_label("Note")
    note.fill("On foam.")
    note.press("Tab")
    expect(page.locator("#announcer")).to_have_text("Note kept.")
    assert studio.ask("GET", f"/api/runs/{run}").content["note"] == "On foam."

    panel(page).get_by_label("Compare with").select_option(index=1)
    times = panel(page).get_by_role("table", name="Times, s")
    expect(times.get_by_role("row", name=re.compile("duration"))).to_contain_text("0.0")  # the same run twice
    compare_with_a_stopped_run(page)
    found = Axe().run(page, context={"include": [["#drawer-runs"]]}).response["violations"]
    assert [one["id"] for one in found if one["impact"] in ("serious", "critical")] == []
    panel(page).get_by_role("button", name="Close runs").click()
    expect(page.get_by_role("note", name="Lines of the plots")).to_be_hidden()


def compare_with_a_stopped_run(page: Page) -> None:
    """Both are in one plot, up to the waypoint at which the shorter one ended."""
    choice = panel(page).get_by_label("Compare with")
    label = choice.locator("option").filter(has_text="stopped").inner_text()
    choice.select_option(label=label)
    words = panel(page).get_by_role("status", name="Comparison")
    expect(words).to_have_text(
        re.compile(
            r"^The comparison covers the \d+ waypoints that both runs reached\. "
            r"The shorter run ended at waypoint \d+\.$"
        )
    )
    times = panel(page).get_by_role("table", name="Times, s")
    expect(times.get_by_role("row", name=re.compile("^duration"))).to_have_text(
        re.compile(r"(\d+\.\d)\s*\1\s*0\.0")
    )
    plot = panel(page).get_by_role("img", name=re.compile("^Time, s, at each waypoint: this run ends at"))
    expect(plot.locator("polyline")).to_have_count(2)
    expect(panel(page).get_by_role("note", name="Lines of the comparison")).to_have_text(
        "this runthe other run"
    )
    panel(page).get_by_label("Plot of both runs").select_option(label="Stroke of foot 2, motor 1, mm")
    plot = panel(page).get_by_role("img", name=re.compile("^Stroke of foot 2, motor 1, mm, at each waypoint"))
    plot.hover()
    expect(panel(page)).to_contain_text(re.compile(r"waypoint \d+: this \d+\.\d\d, other \d+\.\d\d mm"))


def test_the_run_that_was_opened_last_stays_and_a_closed_panel_lays_nothing_over_the_plan(page: Page) -> None:
    open_drawer(page, "Runs")
    rows = listed(page)
    first = rows.nth(0).locator("button").get_attribute("data-run")
    late = LateAnswers(page, "GET", f"/api/runs/{first}$")
    rows.nth(0).get_by_role("button").click()
    wait_for(lambda: late.count == 1, "the first run is on its way")
    rows.nth(1).get_by_role("button").click()
    expect(page.get_by_role("note", name="Lines of the plots")).to_be_visible()
    with page.expect_event("requestfinished", lambda request: request.url.endswith(f"/api/runs/{first}")):
        late.let_go()
    page.evaluate("() => new Promise(requestAnimationFrame)")
    expect(panel(page)).to_contain_text("Bob")
    late = LateAnswers(page, "GET", f"/api/runs/{first}/strokes")
    panel(page).get_by_role("button", name="All runs").click()
    rows.nth(0).get_by_role("button").click()
    wait_for(lambda: late.count == 1, "its strokes are on their way")
    panel(page).get_by_role("button", name="Close runs").click()
    late.let_go()
    page.evaluate("() => new Promise(requestAnimationFrame)")
    expect(page.get_by_role("note", name="Lines of the plots")).to_be_hidden()


def test_a_deleted_run_comes_back(page: Page) -> None:
    open_drawer(page, "Runs")
    listed(page).first.get_by_role("button").click()
    panel(page).get_by_role("button", name="Delete").click()
    expect(listed(page)).to_have_count(3)
    page.locator(".toast").get_by_role("button", name="Undo").click()
    expect(panel(page).get_by_role("button", name="Delete")).to_be_visible()
    panel(page).get_by_role("button", name="All runs").click()
    expect(listed(page)).to_have_count(4)


TRACE = """async () => {
  const { mountTrace } = await import("/static/runs/runs.js");
  const { createStore } = await import("/static/state/store.js");
  const store = createStore();
  mountTrace(store);
  const tell = async (robot, reached, plan_time, phase = "streaming", id = "r", hash = "h") => {
    const run = { id, gait: "walk", phase, reached, plan_time, waypoints_hash: "h" };
    const view = { plan: { waypoints_hash: hash } };
    store.set({ robot: { link: "ready", robot, run, strokes_mm: [reached] }, view });
    await Promise.resolve();
    await Promise.resolve();
    return store.state.trace && { ...store.state.trace };
  };
  const seen = [await tell("moving", 0, 0)];
  for (const [reached, time] of [[1, 0], [1, 0], [2, 0.4], [3, 0]]) {
    seen.push(await tell("moving", reached, time));
  }
  seen.push(await tell("done", 4, 0.4, "ended"));
  seen.push(await tell("moving", 0, 0, "start pose", "another"));
  seen.push(await tell("moving", 1, 0, "streaming", "another"));
  seen.push(await tell("stopped", 1, 0, "ended", "another"));
  seen.push(await tell("stopped", 1, 0, "ended", "another", "edited"));
  return seen;
}"""


def test_strokes_grow_with_each_waypoint_and_stay_until_an_edit_or_another_run(page: Page) -> None:
    first, *grown, done, another, begun, stopped, edited = page.evaluate(TRACE)
    assert [first, another, edited] == [None] * 3
    assert [trace["plan_times"] for trace in grown] == [[0], [0], [0, 0.4], [0, 0.4, 0]]
    assert grown[-1]["laps"] == [0, 0, 1]
    assert grown[-1]["measured_mm"] == [[1], [2], [3]]
    assert done["plan_times"] == [0, 0.4, 0, 0.4]  # the last arrival comes with the end
    assert begun["plan_times"] == stopped["plan_times"] == [0]
