"""Two people on two tabs: each sees the other's edits, loses none of their own, and undoes only those."""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, BrowserContext, Locator, Page, expect

from tests.support.chromium import LONG_MS
from tests.support.page.drawers import gait_act
from tests.support.page.opened import leave_scene_out
from tests.support.studio_process import StudioProcess, wait_for

pytestmark = pytest.mark.heavy

SHARES_STUDIO = True


@pytest.fixture
def gait(studio: StudioProcess) -> str:
    made: str = studio.ask("POST", "/api/gaits?copy_of=walk&name=Shared").content["id"]
    return made


@pytest.fixture
def context(browser: Browser) -> Iterator[BrowserContext]:
    opened = browser.new_context(viewport={"width": 1100, "height": 740})
    opened.set_default_timeout(LONG_MS)
    leave_scene_out(opened)
    yield opened
    opened.close()


def tab(context: BrowserContext, studio: StudioProcess, gait: str, operator: str = "") -> Page:
    page = context.new_page()
    page.add_init_script(f"localStorage.setItem('footfall.gait', '{gait}')")
    if operator:
        page.add_init_script(f"localStorage.setItem('footfall.operator', '{operator}')")
    page.goto(studio.url)
    expect(page.get_by_label("Gait name")).to_have_value("Shared")
    return page


def paint(page: Page, foot: int, sample: int) -> None:
    cell = shown(page, foot, sample)
    cell.focus()
    cell.press("Space")


def shown(page: Page, foot: int, sample: int) -> Locator:
    return page.get_by_role("gridcell", name=re.compile(f"^foot {foot}, sample {sample}:"))


def is_(page: Page, foot: int, sample: int, state: str) -> None:
    expect(shown(page, foot, sample)).to_have_accessible_name(
        re.compile(f"^foot {foot}, sample {sample}: {state}")
    )


def undo(page: Page) -> Locator:
    return page.locator("#undo")


def says(button: Locator, words: str) -> None:
    expect(button).to_have_attribute("title", re.compile(words))


def test_each_tab_undoes_its_own_edit_and_keeps_the_others(
    context: BrowserContext, studio: StudioProcess, gait: str
) -> None:
    ada, bob = tab(context, studio, gait), tab(context, studio, gait)
    paint(ada, 2, 30)
    is_(bob, 2, 30, "swing")
    paint(bob, 4, 12)
    is_(ada, 4, 12, "swing")
    says(undo(ada), "Foot 2, sample 30")
    says(undo(bob), "Foot 4, sample 12")
    undo(ada).click()
    is_(bob, 2, 30, "stance")
    is_(bob, 4, 12, "swing")
    says(undo(ada), "Nothing to undo")
    says(ada.locator("#redo"), "Foot 2, sample 30")
    ada.locator("#redo").click()
    is_(bob, 2, 30, "swing")

    # A reload is the same tab; a tab that is closed leaves its edits to who is still there.
    ada.reload()
    says(undo(ada), "Foot 2, sample 30")
    bob.close()
    says(undo(ada), "Foot 2, sample 30")
    undo(ada).click()
    says(undo(ada), "Foot 4, sample 12")
    undo(ada).click()
    is_(ada, 4, 12, "stance")


def test_edits_at_the_same_moment_are_both_there(
    context: BrowserContext, studio: StudioProcess, gait: str
) -> None:
    ada, bob = tab(context, studio, gait), tab(context, studio, gait)
    for sample in range(30, 34):
        paint(ada, 2, sample)
        paint(bob, 3, sample)

    def both() -> bool:
        feet = studio.ask("GET", f"/api/gaits/{gait}").content["timeline"]["feet"]
        return bool(feet[1][29:33] == "0000" and feet[2][29:33] == "0000")

    wait_for(both, "both people's cells are swing")
    for _ in range(4):
        says(undo(bob), "Foot 3")
        before = undo(bob).get_attribute("title")
        undo(bob).click()
        expect(undo(bob)).not_to_have_attribute("title", before or "")

    def bobs_are_taken_back() -> bool:
        feet = studio.ask("GET", f"/api/gaits/{gait}").content["timeline"]["feet"]
        assert feet[1][29:33] == "0000"
        return bool(feet[2][29:33] == "1111")

    wait_for(bobs_are_taken_back, "Bob's cells stand again, Ada's swing")


def test_undo_says_who_changed_the_same_and_leaves_it(
    browser: Browser, studio: StudioProcess, gait: str
) -> None:
    contexts = [browser.new_context(viewport={"width": 1100, "height": 740}) for _ in "ab"]
    for one in contexts:
        leave_scene_out(one)
    ada, grace = (tab(one, studio, gait, name) for one, name in zip(contexts, ("Ada", "Grace"), strict=True))
    margin = [page.get_by_role("spinbutton", name="Stability margin", exact=True) for page in (ada, grace)]
    margin[0].fill("1")
    margin[0].press("Enter")
    expect(margin[1]).to_have_value("1")
    margin[1].fill("2")
    margin[1].press("Enter")
    expect(margin[0]).to_have_value("2")
    undo(ada).click()
    alert = ada.get_by_role("alert").filter(has_text="Grace changed the stability margin since")
    expect(alert).to_be_visible()
    expect(margin[0]).to_have_value("2")
    for one in contexts:
        one.close()


def test_a_tab_that_the_browser_copied_is_another_author(
    context: BrowserContext, studio: StudioProcess, gait: str
) -> None:
    ada = tab(context, studio, gait)
    own = ada.evaluate("sessionStorage.getItem('footfall.page')")
    copy = context.new_page()
    copy.add_init_script(f"if (!sessionStorage.length) sessionStorage.setItem('footfall.page', '{own}')")
    copy.goto(studio.url)
    expect(copy.get_by_label("Gait name")).to_have_value("Shared")
    copy.wait_for_function("own => sessionStorage.getItem('footfall.page') !== own", arg=own)
    assert ada.evaluate("sessionStorage.getItem('footfall.page')") == own
    paint(copy, 2, 31)
    is_(ada, 2, 31, "swing")
    says(undo(copy), "Foot 2, sample 31")
    says(undo(ada), "Nothing to undo")


def test_a_gait_that_was_deleted_in_another_tab_is_missed_and_can_be_brought_back(
    context: BrowserContext, studio: StudioProcess, gait: str
) -> None:
    here, there = tab(context, studio, gait), tab(context, studio, gait)
    paint(here, 1, 12)
    is_(there, 1, 12, "swing")
    gait_act(there, "Delete")
    expect(there.locator("#toasts")).to_contain_text("“Shared” is deleted.")
    said = here.locator("#toasts")
    expect(said).to_contain_text("“Shared” was deleted in another tab.")
    expect(here.get_by_label("Gait name")).not_to_have_value("Shared")
    said.get_by_role("button", name="Bring it back").click()
    expect(here.get_by_label("Gait name")).to_have_value("Shared")
    is_(here, 1, 12, "swing")
    expect(there.locator("#toasts")).not_to_contain_text("in another tab")
