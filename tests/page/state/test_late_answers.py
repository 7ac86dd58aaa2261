"""Answers and events that come after somebody went on: they change nothing but what they are of."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any
from urllib.parse import quote

import pytest
from playwright.sync_api import Browser, Dialog, Locator, Page, Route, expect

from tests.support.page.drawers import gait_act
from tests.support.page.late_answers import LateAnswers, LateEvents, LateRequests
from tests.support.page.opened import opened_page
from tests.support.studio_process import StudioProcess, wait_for

pytestmark = pytest.mark.heavy

SHARES_STUDIO = True


@pytest.fixture(scope="module")
def page(browser: Browser, studio: StudioProcess) -> Iterator[Page]:
    with opened_page(browser, studio.url, 1280, 800) as opened:
        yield opened


def made(studio: StudioProcess, name: str) -> str:
    """A gait that was edited once; gives its id."""
    gait: str = studio.ask("POST", f"/api/gaits?copy_of=walk&name={quote(name)}").content["id"]
    change(studio, gait, margin=0.004)
    return gait


def change(studio: StudioProcess, gait: str, **options: Any) -> None:
    changed = studio.document(gait)
    changed["options"] |= options
    assert studio.ask("PUT", f"/api/gaits/{gait}?label=Elsewhere", changed).status == 200


def row(page: Page, name: str) -> Locator:
    return page.get_by_role("list", name="Gaits").get_by_role("button", name=re.compile(f"^{name}(?! copy)"))


def choose(page: Page, name: str) -> None:
    row(page, name).click()
    expect(page.get_by_label("Gait name")).to_have_value(name)


def fill(page: Page, name: str, value: str) -> None:
    field = page.get_by_role("spinbutton", name=name, exact=True)
    field.fill(value)
    field.press("Enter")


@pytest.mark.parametrize("changed", ["here alone", "elsewhere too"])
def test_edits_reach_the_gait_that_they_are_of_though_another_is_shown_by_then(
    page: Page, studio: StudioProcess, changed: str
) -> None:
    left, shown = made(studio, f"Left {changed}"), made(studio, f"Shown {changed}")
    before = studio.document(shown)
    choose(page, f"Left {changed}")
    late = LateRequests(page, "PUT", f"/api/gaits/{left}")
    fill(page, "Stability margin", "1")
    fill(page, "Clearance", "4")
    wait_for(lambda: late.count == 1, "the first edit is on its way")
    choose(page, f"Shown {changed}")
    if changed == "elsewhere too":
        change(studio, left, stop_bound=1.5)
    late.let_go()

    def arrived() -> bool:
        options = studio.document(left)["options"]
        return bool(options["margin"] == 0.001 and options["clearance"] == 0.004)

    wait_for(arrived, "both edits are in the gait that was left")
    assert studio.document(left)["options"]["stop_bound"] == (1.5 if changed == "elsewhere too" else 1.0)
    assert studio.document(shown) == before
    expect(page.get_by_label("Gait name")).to_have_value(f"Shown {changed}")
    expect(page.locator("#saved-state")).to_have_text("Not saved to a file")


def test_undo_and_save_are_of_the_gait_that_was_shown_when_they_were_pressed(
    page: Page, studio: StudioProcess
) -> None:
    left, shown = made(studio, "Undone"), made(studio, "Not undone")
    before = [studio.document(gait) for gait in (left, shown)]
    choose(page, "Undone")
    late = LateRequests(page, "PUT", f"/api/gaits/{left}")
    fill(page, "Clearance", "4")
    wait_for(lambda: late.count == 1, "the edit is on its way")
    page.keyboard.press("Control+z")
    page.keyboard.press("Control+s")
    choose(page, "Not undone")
    late.let_go()
    wait_for(lambda: not view(studio, left)["edited"], "undone, and saved")
    assert [studio.document(gait) for gait in (left, shown)] == before
    assert view(studio, shown)["edited"]


def test_the_page_asks_before_it_is_left_with_edits_that_the_studio_lacks(
    page: Page, studio: StudioProcess
) -> None:
    gait = made(studio, "Hasty")
    choose(page, "Hasty")
    kept: list[str] = []

    def stay(dialog: Dialog) -> None:
        kept.append(dialog.type)
        dialog.dismiss()

    page.on("dialog", stay)
    late = LateRequests(page, "PUT", f"/api/gaits/{gait}")
    fill(page, "Clearance", "4")
    fill(page, "Stability margin", "1")
    wait_for(lambda: late.count == 1, "the first edit is on its way")
    page.evaluate("() => { setTimeout(() => location.reload()); }")
    wait_for(lambda: late.count == 1 and kept == ["beforeunload"], "the page has asked")
    late.let_go()
    expect(page.locator("#saved-state")).to_have_text("Not saved to a file")
    assert studio.document(gait)["options"]["margin"] == 0.001
    page.reload()
    expect(page.get_by_label("Gait name")).to_have_value("Hasty")
    assert kept == ["beforeunload"]
    page.remove_listener("dialog", stay)


def view(studio: StudioProcess, gait: str) -> dict[str, Any]:
    content: dict[str, Any] = studio.ask("GET", f"/api/gaits/{gait}/view").content
    return content


def test_an_old_summary_does_not_take_the_place_of_the_new_ones(page: Page, studio: StudioProcess) -> None:
    gait = made(studio, "Summed up")
    page.get_by_role("tab", name="Run").click()
    late = LateAnswers(page, "GET", f"/api/gaits/{gait}/run")
    choose(page, "Summed up")
    wait_for(lambda: late.count == 1, "the first summary is on its way")
    change(studio, gait, clearance=0.004)
    now = view(studio, gait)["plan"]["waypoints_hash"]
    shown = page.locator("#robot dd.mono")
    expect(shown).to_have_attribute("title", now)
    with page.expect_event("requestfinished", lambda request: f"/{gait}/run" in request.url):
        late.let_go()
    page.evaluate("() => new Promise(requestAnimationFrame)")
    expect(shown).to_have_attribute("title", now)


def test_old_approvals_do_not_take_the_place_of_new_ones(page: Page, studio: StudioProcess) -> None:
    gait = made(studio, "Approved")
    assert studio.ask("POST", f"/api/gaits/{gait}/check").status == 200
    page.get_by_role("tab", name="Check & approve").click()
    late = LateAnswers(page, "GET", f"/api/gaits/{gait}/approvals$")
    choose(page, "Approved")
    wait_for(lambda: late.count == 1, "the list without an approval is on its way")
    words = {"by": "Ada", "accept_warnings": True}
    assert studio.ask("POST", f"/api/gaits/{gait}/approve", words).status == 200
    approvals = page.get_by_role("list", name="Approvals").get_by_role("listitem")
    expect(approvals).to_have_count(1)
    with page.expect_event("requestfinished", lambda request: request.url.endswith("/approvals")):
        late.let_go()
    page.evaluate("() => new Promise(requestAnimationFrame)")
    expect(approvals).to_have_count(1)


def test_a_gait_that_is_not_listed_yet_is_copied_and_deleted(browser: Browser, studio: StudioProcess) -> None:
    made(studio, "Fresh")
    with opened_page(browser, f"{studio.url}static/icon.svg", 1280, 800) as page:
        late = LateEvents(page, "gaits")
        page.goto(studio.url)
        choose(page, "Fresh")
        name = page.get_by_label("Gait name")
        gait_act(page, "Duplicate")
        expect(name).to_have_value("Fresh copy")
        gait_act(page, "Duplicate")
        expect(name).to_have_value("Fresh copy copy")
        assert late.count > 0, "the list was held back"
        gait_act(page, "Delete")
        expect(page.locator("#toasts")).to_contain_text("“Fresh copy copy” is deleted")
        expect(name).not_to_have_value("Fresh copy copy")
        late.let_go()
        expect(row(page, "Fresh copy")).to_be_visible()
        expect(row(page, "Fresh copy copy")).to_have_count(0)


def test_a_gait_that_is_not_listed_yet_stays_when_the_line_opens_anew(
    browser: Browser, studio: StudioProcess
) -> None:
    with opened_page(browser, f"{studio.url}static/icon.svg", 1280, 800) as page:
        page.goto(studio.url)
        expect(page.get_by_label("Gait name")).not_to_have_value("")
        kept = page.evaluate(
            """async () => {
                const [{ createStore }, { selectAfterHello }] = await Promise.all(
                    ["state/store", "shell/gait_list"].map((name) => import(`/static/${name}.js`)));
                const gaits = [{ id: "walk" }];
                const [fresh, gone] = [{ id: "amble" }, null].map((view) =>
                    createStore({ gaits, selected: "amble", view }));
                for (const store of [fresh, gone]) selectAfterHello(store);
                return [fresh, gone].map(({ state }) => state.selected);
            }"""
        )
        assert kept[0] == "amble"
        assert kept[1] != "amble"


def test_edits_wait_while_the_studio_does_not_answer_and_undo_takes_back_the_last(
    page: Page, studio: StudioProcess
) -> None:
    gait = made(studio, "Waiting")
    choose(page, "Waiting")
    page.get_by_role("tab", name="Design").click()
    to_studio = re.compile(f"/api/gaits/{gait}")
    page.route(to_studio, lambda route: route.abort())
    fill(page, "Stability margin", "1")
    kept = page.get_by_text("Your edits stay on this page and are sent when the studio answers.")
    expect(kept).to_be_visible()
    fill(page, "Clearance", "4")
    fill(page, "Clearance", "5")
    page.get_by_role("button", name="Undo", exact=True).first.click()
    expect(page.get_by_role("spinbutton", name="Clearance", exact=True)).to_have_value("4")
    expect(page.locator("#saved-state")).to_have_text("Sending")
    assert studio.document(gait)["options"]["margin"] == 0.004
    page.unroute(to_studio)
    expect(page.locator("#saved-state")).to_have_text("Not saved to a file")
    options = studio.document(gait)["options"]
    assert (options["margin"], options["clearance"]) == (0.001, 0.004)


def parts(page: Page) -> Locator:
    return page.get_by_role("grid", name="Parts of the sequence").get_by_role("row")


def sequence(page: Page, studio: StudioProcess, name: str) -> str:
    """A shown sequence of three gaits; gives its id."""
    chained = [{"gait": source, "times": 1} for source in ("walk", "rotate", "s-gait")]
    gait: str = studio.ask("POST", "/api/sequences", {"name": name, "parts": chained}).content["id"]
    choose(page, name)
    expect(parts(page)).to_have_count(3)
    return gait


def sources(studio: StudioProcess, gait: str) -> list[str]:
    return [part["source"] for part in studio.document(gait)["sequence"]]


def test_an_edit_whose_answer_comes_after_its_event_is_shown_once(page: Page, studio: StudioProcess) -> None:
    gait = sequence(page, studio, "Taken apart")
    late = LateAnswers(page, "PUT", f"/api/gaits/{gait}")
    parts(page).nth(1).get_by_role("button", name="Take out").click()
    wait_for(lambda: late.count == 1, "the studio has the edit")
    expect(page.locator("#saved-state")).to_have_text("Not saved to a file")
    expect(parts(page)).to_have_count(2)
    parts(page).nth(0).get_by_role("button", name="Take out").click()
    expect(parts(page)).to_have_count(1)
    late.let_go()
    wait_for(lambda: sources(studio, gait) == ["s-gait"], "both parts are out")
    expect(parts(page)).to_have_count(1)


@pytest.mark.parametrize("heard", ["by its event", "not at all"])
def test_an_edit_whose_answer_is_lost_is_made_once(
    browser: Browser, studio: StudioProcess, heard: str
) -> None:
    lost: list[str] = []

    def lose(route: Route) -> None:
        if route.request.method != "PUT" or lost:
            route.fallback()
            return
        lost.append(route.request.url)
        route.fetch()
        route.abort()

    with opened_page(browser, "about:blank", 1280, 800) as other:
        if heard == "not at all":
            LateEvents(other, "gait")
        other.goto(studio.url)
        gait = sequence(other, studio, f"Heard of {heard}")
        other.route(re.compile(f"/api/gaits/{gait}"), lose)
        parts(other).nth(0).get_by_role("button", name="Take out").click()
        parts(other).nth(1).get_by_role("button", name="Take out").click()
        expect(other.locator("#saved-state")).to_have_text("Not saved to a file")
        expect(parts(other)).to_have_count(1)
    assert lost
    assert sources(studio, gait) == ["rotate"]


def test_a_copy_has_what_was_done_before(page: Page, studio: StudioProcess) -> None:
    gait = made(studio, "To be renamed")
    choose(page, "To be renamed")
    late = LateRequests(page, "PUT", f"/api/gaits/{gait}")
    page.get_by_label("Gait name").fill("Renamed")
    page.get_by_label("Gait name").press("Enter")
    gait_act(page, "Duplicate")
    wait_for(lambda: late.count == 1, "the name is on its way")
    late.let_go()
    expect(page.get_by_label("Gait name")).to_have_value("Renamed copy")
