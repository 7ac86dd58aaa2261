"""The pattern search on the page: transitions, conflicts that are relaxed, some limbs that walk, drawings."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import partial

import pytest
from playwright.sync_api import Browser, Locator, Page, Request, expect

from tests.support.page.axe import findings
from tests.support.page.drawers import gait_act
from tests.support.page.late_answers import LateEvents
from tests.support.page.opened import opened_page
from tests.support.studio_process import StudioProcess, wait_for

pytestmark = pytest.mark.heavy

SEARCH = {"include": [[".pattern-panel"], [".pattern-view"], [".right .tabs"]]}
"""What belongs to the search; the scene is left out."""


@pytest.fixture(scope="module")
def page(browser: Browser, studio: StudioProcess) -> Iterator[Page]:
    """A page without its 3D scene, with the pattern search open."""
    with opened_page(browser, f"{studio.url}static/icon.svg", 1280, 800) as opened:
        opened.goto(studio.url)
        expect(opened.get_by_label("Gait name")).not_to_have_value("")
        yield opened


@pytest.fixture
def search(fresh: Page) -> Page:
    """The search with Walk and both cursors at the first sample."""
    to_the_start(fresh)
    return fresh


def to_the_start(page: Page) -> None:
    for gait in "AB":
        expect(cursor(page, gait)).not_to_have_attribute("aria-valuenow", "1")
        cursor(page, gait).press("Home")
        expect(cursor(page, gait)).to_have_attribute("aria-valuenow", "1")


@pytest.fixture
def fresh(page: Page) -> Page:
    """The search as a browser shows it for the first time, beginning with Walk."""
    page.evaluate(
        "localStorage.removeItem('footfall.patterns'), sessionStorage.removeItem('footfall.patterns.open')"
    )
    page.reload()
    choose_gait(page, "Walk 10 mm")
    page.get_by_role("tab", name="Pattern search").click()
    expect(page.get_by_role("tabpanel", name="Pattern search")).to_be_visible()
    return page


def choose_gait(page: Page, name: str) -> None:
    exact = page.locator(".name", has_text=re.compile(f"^{re.escape(name)}$"))
    # The search finds it in a folded group too.
    find = page.get_by_role("searchbox", name="Find a gait")
    find.fill(name)
    page.get_by_role("list", name="Gaits").get_by_role("button").filter(has=exact).click()
    find.fill("")
    expect(page.get_by_label("Gait name")).to_have_value(name)


def cursor(page: Page, gait: str) -> Locator:
    return page.get_by_role("slider", name=f"Gait {gait}: boundary sample")


def grid(page: Page) -> Locator:
    return page.get_by_role("grid", name="Pattern", exact=True)


def cell(page: Page, foot: int, sample: int) -> Locator:
    return grid(page).get_by_role("gridcell", name=re.compile(f"^foot {foot}, sample {sample}:"))


def rows(page: Page) -> list[str]:
    found: list[str] = page.evaluate(
        """() => [...document.querySelectorAll(".pattern-grid [role=row]")].map((row) =>
             [...row.querySelectorAll(".cell")]
               .map(({ dataset }) => ({ swing: "0", stance: "1" })[dataset.state] ?? ".").join(""))"""
    )
    return found


def status(page: Page) -> Locator:
    return page.get_by_role("status", name="Pattern found")


def solved(page: Page, word: str | re.Pattern[str] = "Optimal") -> None:
    """Waits until the newest question is answered."""
    expect(page.locator(".pattern-grid[data-stale]")).to_have_count(0)
    expect(status(page)).to_contain_text(word)
    if word != "Infeasible":  # the first pattern of a search is in the grid before the search has ended
        walk = page.locator(".pattern-acts button").first
        expect(walk).not_to_have_attribute("aria-disabled", "true")
    wait_for(
        lambda: rows(page) != [] and (word == "Infeasible" or "." not in "".join(rows(page))), "its cells", 60
    )


def press(page: Page, *keys: str) -> None:
    for key in keys:
        page.keyboard.press(key)


def test_cursors_first_stand_in_mid_gait_and_each_order_is_shown_once(fresh: Page) -> None:
    solved(fresh)
    for gait in "AB":
        words = re.compile("sample 18 of 45.*feet [1-4], [1-4], [1-4] stand, foot [1-4] swings")
        expect(cursor(fresh, gait)).to_have_attribute("aria-valuetext", words)
    assert {row[0] for row in rows(fresh)} == {"0", "1"}
    best = fresh.get_by_role("listbox", name="Best patterns").get_by_role("option")
    expect(best).to_have_count(5)
    orders = set()
    for index in range(5):
        best.nth(index).click()
        expect(best.nth(index)).to_have_attribute("aria-selected", "true")
        columns = list(zip(*rows(fresh), strict=True))
        orders.add(tuple(c for c, before in zip(columns, [None, *columns], strict=False) if c != before))
    assert len(orders) == 5
    fresh.get_by_label("Gait B", exact=True).select_option("textbook-trot")
    expect(cursor(fresh, "B")).to_have_attribute("aria-valuenow", "1")


def test_a_transition_follows_its_cursors_and_becomes_a_gait(search: Page, studio: StudioProcess) -> None:
    solved(search)
    expect(search.get_by_label("Gait A", exact=True)).to_have_value("walk")
    expect(search.get_by_label("Gait B", exact=True)).to_have_value("amble")
    cursor(search, "A").focus()
    press(search, *["ArrowRight"] * 6)
    expect(cursor(search, "A")).to_have_attribute(
        "aria-valuetext", re.compile("sample 7 of 45.*foot 3 swings")
    )
    wait_for(lambda: [row[0] for row in rows(search)] == ["1", "1", "0", "1"], "it begins as the gait does")
    solved(search)
    assert all(set(row) <= {"0", "1"} for row in rows(search))
    expect(cell(search, 3, 1)).to_have_accessible_name("foot 3, sample 1: swing, given by a gait")
    make = search.get_by_role("button", name="Make gait")
    expect(make).not_to_have_attribute("aria-disabled", "true")
    make.click()
    expect(search.get_by_label("Gait name")).to_have_value("Walk 10 mm to Amble 10 mm")
    made = studio.ask("GET", "/api/gaits/walk-10-mm-to-amble-10-mm").content
    wait_for(lambda: [row[6:26] for row in made["timeline"]["feet"]] == rows(search), "it is the shown one")
    gait_act(search, "Delete")
    expect(search.locator("#toasts")).to_contain_text("is deleted")


def test_cursors_stay_while_a_new_gait_is_not_yet_in_the_list(
    browser: Browser, studio: StudioProcess
) -> None:
    with opened_page(browser, f"{studio.url}static/icon.svg", 1280, 800) as other:
        late = LateEvents(other, "gaits")
        other.goto(studio.url)
        choose_gait(other, "Walk 10 mm")
        other.get_by_role("tab", name="Pattern search").click()
        to_the_start(other)
        solved(other)
        cursor(other, "A").focus()
        press(other, *["ArrowRight"] * 6)
        solved(other)
        shown = rows(other)
        other.get_by_role("button", name="Make gait").click()
        expect(other.get_by_label("Gait name")).to_have_value("Walk 10 mm to Amble 10 mm")
        search_again(other)
        expect(cursor(other, "A")).to_have_attribute("aria-valuenow", "7")
        assert late.count > 0, "the list was held back"
        late.let_go()
        expect(other.get_by_role("list", name="Gaits")).to_contain_text("Walk 10 mm to Amble 10 mm")
        expect(cursor(other, "A")).to_have_attribute("aria-valuenow", "7")
        assert rows(other) == shown
        gait_act(other, "Delete")
        expect(other.locator("#toasts")).to_contain_text("is deleted")


def test_what_is_drawn_stays_and_is_freed_again(search: Page) -> None:
    solved(search)
    sample = next(s for s in range(4, 16) if rows(search)[1][s] == "1")
    cell(search, 2, sample + 1).click()
    expect(cell(search, 2, sample + 1)).to_have_accessible_name(f"foot 2, sample {sample + 1}: swing, drawn")
    solved(search)
    assert rows(search)[1][sample] == "0"
    press(search, "ArrowRight", "k")
    expect(cell(search, 2, sample + 2)).to_have_accessible_name(re.compile("drawn$"))
    press(search, "k", "ArrowLeft", " ")
    expect(search.locator('.pattern-grid [data-fixed="drawn"]')).to_have_count(0)
    cell(search, 1, 1).click()
    expect(search.locator("#toasts")).to_contain_text("move the cursor of gait A or B")


def test_a_conflict_is_explained_and_a_button_relaxes_it(search: Page) -> None:
    solved(search)
    search.get_by_label("Swings that the feet can do").uncheck()
    solved(search)
    search.get_by_label("Length", exact=True).fill("6")
    solved(search, "Infeasible")
    why = search.get_by_role("alert").filter(has_text="No pattern keeps all rules and fixed cells")
    expect(why).to_contain_text("only two feet are down")
    expect(search.get_by_role("button", name="Make gait")).to_have_attribute("aria-disabled", "true")
    assert findings(search, SEARCH) == []
    why.get_by_role("button", name="2 feet down instead of 3").click()
    solved(search)
    expect(why).to_be_hidden()
    expect(search.get_by_label("Feet down, at least, feet")).to_have_value("2")
    search.get_by_role("button", name="Use the thesis's numbers").first.click()
    expect(search.get_by_label("Feet down, at least, feet")).to_have_value("3")


def test_a_length_too_short_for_what_a_cursor_cuts_is_mended_by_a_button(search: Page) -> None:
    solved(search)
    for sample in range(2, 7):
        cursor(search, "A").press("ArrowRight")
        expect(cursor(search, "A")).to_have_attribute("aria-valuenow", str(sample))
    search.get_by_label("Length", exact=True).fill("3")
    solved(search, "Infeasible")
    why = search.get_by_role("alert").filter(has_text="3 samples are too few to finish the swings")
    why.get_by_role("button", name=re.compile("samples instead of 3")).click()
    solved(search)
    expect(why).to_be_hidden()


def test_the_best_patterns_are_looked_through_by_keys(search: Page) -> None:
    solved(search)
    best = search.get_by_role("listbox", name="Best patterns")
    expect(best.get_by_role("option")).to_have_count(5)
    pictures = best.locator("svg").evaluate_all("(pictures) => pictures.map(({ innerHTML }) => innerHTML)")
    assert len(set(pictures)) == 5
    first = rows(search)
    best.focus()
    press(search, "ArrowDown")
    expect(best.get_by_role("option").nth(1)).to_have_attribute("aria-selected", "true")
    wait_for(lambda: rows(search) != first, "another pattern is shown")
    press(search, "Home")
    wait_for(lambda: rows(search) == first, "the best one is shown again")


def test_what_walks_has_a_playhead_and_the_chosen_pattern_outlasts_its_gait(search: Page) -> None:
    solved(search)
    best = search.get_by_role("listbox", name="Best patterns")
    expect(best.get_by_role("option")).to_have_count(5)
    best.focus()
    press(search, "ArrowDown", "ArrowDown")
    chosen = rows(search)
    search.get_by_role("button", name="Walk it").click()
    sought = search.locator(".pattern-sought .pattern-playhead")
    expect(sought).to_be_visible()
    expect(search.locator(".pattern-playhead:not(.pattern-sought *)")).to_be_visible()
    search.get_by_role("button", name="Stop walking").click()
    expect(search.locator(".pattern-playhead")).to_be_hidden()
    search.get_by_role("button", name="Make gait").click()
    expect(search.get_by_label("Gait name")).to_have_value("Walk 10 mm to Amble 10 mm")
    search_again(search)
    expect(best.get_by_role("option").nth(2)).to_have_attribute("aria-selected", "true")
    assert rows(search) == chosen
    gait_act(search, "Delete")
    expect(search.locator("#toasts")).to_contain_text("is deleted")


def test_a_gait_for_some_limbs_walks_and_is_made(search: Page, studio: StudioProcess) -> None:
    choose_gait(search, "Hexapod tripod")
    gait_act(search, "Gait for some limbs…")
    search.get_by_label("Limb 3", exact=True).select_option("held")
    search.get_by_label("Limb 6", exact=True).select_option("broken")
    search.get_by_role("switch", name="Balance margin: on").check()
    wait_for(lambda: rows(search)[2] == "0" * 20 and "." not in "".join(rows(search)), "limb 3 is up", 60)
    solved(search)
    search.get_by_role("button", name="Walk it").click()
    expect(search.get_by_role("button", name="Stop walking")).to_be_visible()
    expect(search.get_by_role("button", name="Pause")).to_be_visible()
    expect(search.get_by_role("status", name="Verdict")).to_contain_text("margin")
    search.get_by_role("button", name="Stop walking").click()
    second = search.get_by_role("listbox", name="Best patterns").get_by_role("option").nth(1)
    second.click()
    chosen = rows(search)
    search.get_by_role("button", name="Make gait").click()
    expect(search.get_by_label("Gait name")).to_have_value("4 limbs of 6")
    search_again(search)
    expect(second).to_have_attribute("aria-selected", "true")
    assert rows(search) == chosen
    made = studio.ask("GET", "/api/gaits/4-limbs-of-6").content
    assert made["held"] == {"start": [3, 6], "end": [3, 6]}
    expect(search.get_by_role("status", name="Verdict")).to_contain_text("Plan margin")


def test_a_drawing_is_completed_by_one_edit(search: Page, studio: StudioProcess) -> None:
    document = studio.ask("GET", "/api/gaits/walk").content
    feet = ["1" * 24, "1" * 24, "1" * 24, "1" * 6 + "0" * 4 + "1" * 14]
    half = {**document, "name": "Half drawn", "timeline": {"sample_time": 0.4, "feet": feet}}
    assert studio.ask("POST", "/api/gaits", half).status == 201
    choose_gait(search, "Half drawn")
    search.get_by_role("button", name="Complete", exact=True).click()
    search.get_by_label("Keep the painted swings").check()
    wait_for(lambda: len(rows(search)) == 4 and len(rows(search)[0]) == 24, "the drawing's grid")
    solved(search)
    done = rows(search)
    assert done[3][6:10] == "0000"
    search.get_by_role("button", name="Complete the drawing").click()
    undo = search.get_by_role("button", name=re.compile("^Undo"))
    expect(undo).to_have_attribute("title", re.compile("Undo: Complete the drawing"))
    assert studio.ask("GET", "/api/gaits/half-drawn").content["timeline"]["feet"] == done
    search_again(search)
    nothing = re.compile("^This pattern is the same as the drawing")
    complete = search.get_by_role("button", name="Complete the drawing")
    expect(complete).to_have_attribute("title", nothing)
    undo.click()
    wait_for(lambda: studio.ask("GET", "/api/gaits/half-drawn").content["timeline"]["feet"] == feet, "undone")


def search_again(page: Page) -> None:
    """What was made is shown in its cells; opens the search once more."""
    expect(page.get_by_role("tab", name="Cells")).to_have_attribute("aria-selected", "true")
    page.get_by_role("tab", name="Pattern search").click()


def is_request(asked: str, request: Request) -> bool:
    method, _, path = asked.partition(" ")
    return request.method == method and request.url.endswith(path)


def test_a_long_search_shows_bound_and_gap_and_can_be_ended(search: Page) -> None:
    solved(search)
    feet = rows(search)
    best = {
        "feet": feet,
        "sample_changes": 5,
        "limb_changes": 8,
        "redrawn": 0,
        "score": 5008,
        "body_xy": None,
    }
    progress = {"seconds": 2.5, "objective": 5008, "bound": 4006, "pattern": best}
    running = {"id": 10**15, "state": "running", "progress": progress}
    search.route("**/api/patterns", lambda route: route.fulfill(status=202, json=running))
    search.route("**/api/patterns/1**", lambda route: route.fulfill(json=running))
    search.get_by_label("Length", exact=True).fill("21")
    shown = search.get_by_role("status", name="Search", exact=True)
    expect(shown).to_contain_text(
        "best so far: 5 moments of change · 8 foot changes · score 5008, lower bound 4006 · gap 20 %"
    )
    expect(search.get_by_role("button", name="Make gait")).to_have_attribute("aria-disabled", "true")
    assert findings(search, SEARCH) == []
    for button, asked in (
        ("Use this now", f"POST /api/patterns/{10**15}/use"),
        ("Cancel the search", f"DELETE /api/patterns/{10**15}"),
    ):
        with search.expect_request(partial(is_request, asked)):
            shown.get_by_role("button", name=button).click()
    search.unroute("**/api/patterns")
    search.unroute("**/api/patterns/1**")


def test_a_reload_keeps_gaits_cursors_and_rules(search: Page) -> None:
    solved(search)
    search.get_by_label("Gait B", exact=True).select_option("quadruped-wave-1")
    expect(cursor(search, "B")).to_have_attribute("aria-valuemax", "42")
    cursor(search, "B").focus()
    press(search, "End", "ArrowLeft")
    expect(cursor(search, "B")).to_have_attribute("aria-valuenow", "41")
    text = cursor(search, "B").get_attribute("aria-valuetext")
    search.get_by_role("switch", name="Workloads differ by: on").uncheck()
    search.get_by_label("Length", exact=True).fill("24")
    solved(search)
    search.reload()
    expect(search.get_by_role("tab", name="Pattern search")).to_have_attribute("aria-selected", "true")
    expect(cursor(search, "B")).to_have_attribute("aria-valuetext", text or "")
    expect(search.get_by_label("Gait B", exact=True)).to_have_value("quadruped-wave-1")
    expect(search.get_by_role("switch", name="Workloads differ by: on")).not_to_be_checked()
    expect(search.get_by_label("Length", exact=True)).to_have_value("24")
    solved(search)


@pytest.mark.parametrize("scheme", [pytest.param("light", marks=pytest.mark.soak), "dark"])
def test_no_kind_of_pattern_has_a_serious_finding(search: Page, scheme: str) -> None:
    search.emulate_media(color_scheme="dark" if scheme == "dark" else "light")
    for kind in ("Transition", "Some limbs", "Complete"):
        search.get_by_role("button", name=kind, exact=True).click()
        # On a busy machine the time limit may come before the proof.
        solved(search, re.compile("^(Optimal|Feasible)"))
        assert findings(search, SEARCH) == [], f"{kind}, {scheme}"
    search.get_by_role("tab", name="Design").click()
    expect(search.get_by_role("grid", name="Footfall timeline")).to_be_visible()
    expect(search.get_by_role("tabpanel", name="Pattern search")).to_be_hidden()
