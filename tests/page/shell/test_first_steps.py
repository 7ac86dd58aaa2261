"""The card First steps: four acts that tick themselves, for a data folder in which nothing was made yet."""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Browser, Locator, Page, expect

from tests.support.page.opened import opened_page
from tests.support.studio_process import StudioProcess


@pytest.fixture
def page(browser: Browser, studio: StudioProcess) -> Iterator[Page]:
    """A new user's page; its first gait is one for the robot's clock."""
    with opened_page(browser, studio.url, 1280, 800, gait=None) as opened:
        expect(opened.get_by_role("status", name="Verdict")).to_contain_text("margin")
        yield opened


def card(page: Page) -> Locator:
    return page.get_by_role("region", name="First steps")


def act(page: Page, title: str) -> Locator:
    return card(page).get_by_role("listitem").filter(has_text=title)


def count(page: Page) -> Locator:
    return card(page).get_by_role("status")


def open_by_help(page: Page) -> None:
    """Opens the card also where the data folder has an edit by now."""
    expect(page.get_by_role("button", name="Simulate", exact=True)).to_be_visible()
    page.keyboard.press("?")
    page.get_by_role("dialog").get_by_role("button", name="First steps").click()


def set_step(page: Page, length: str) -> None:
    step = page.get_by_role("spinbutton", name="Step", exact=True)
    step.fill(length)
    step.press("Enter")


@pytest.mark.heavy
def test_acts_tick_themselves_are_remembered_and_the_card_comes_back_from_help(page: Page) -> None:
    expect(count(page)).to_have_text("0 of 4 done")
    assert page.evaluate("document.activeElement === document.body"), "it takes no focus"
    card(page).get_by_role("button", name="Show me where: Play the walk").click()
    play = page.get_by_role("button", name="Play", exact=True)
    expect(play).to_be_focused()
    expect(play).to_have_attribute("data-shown-place", "")
    play.press("Enter")
    expect(act(page, "Play the walk")).to_have_attribute("data-done", "")
    expect(act(page, "Drag the step").get_by_role("paragraph")).to_be_visible()
    expect(count(page)).to_have_text("1 of 4 done")

    name = page.locator("#design .name").get_by_text("Step", exact=True)
    box = name.bounding_box()
    assert box is not None
    page.mouse.move(box["x"] + 4, box["y"] + box["height"] / 2)
    page.mouse.down()
    page.mouse.move(box["x"] - 20, box["y"] + box["height"] / 2, steps=4)
    page.mouse.up()
    expect(act(page, "Drag the step")).to_have_attribute("data-done", "")
    page.reload()
    expect(count(page)).to_have_text("2 of 4 done")

    card(page).get_by_role("button", name="Close first steps").press("Enter")
    expect(card(page)).to_be_hidden()
    expect(page.get_by_role("button", name="Keyboard", exact=True)).to_be_focused()
    page.reload()
    expect(page.get_by_role("status", name="Verdict")).to_contain_text("margin")
    expect(card(page)).to_be_hidden()
    open_by_help(page)
    expect(count(page)).to_have_text("2 of 4 done")


@pytest.mark.heavy
def test_a_remedy_is_found_by_way_of_a_drawn_gait(page: Page) -> None:
    open_by_help(page)
    remedy = act(page, "Make the step too long")
    remedy.get_by_role("button", name=re.compile("^Make the step too long")).click()
    expect(remedy).to_contain_text("under Examples, choose Walk 10 mm")
    where = card(page).get_by_role("button", name=re.compile("^Show me where: Make the step"))
    where.click()
    walk = page.get_by_role("list", name="Gaits").get_by_role("button", name=re.compile("^Walk 10 mm(?!,)"))
    expect(walk).to_be_focused()
    walk.press("Enter")
    expect(page.get_by_label("Gait name")).to_have_value("Walk 10 mm")
    expect(remedy).to_contain_text("Set Step to 30 mm")
    where.click()
    expect(page.get_by_role("spinbutton", name="Step", exact=True)).to_be_focused()
    set_step(page, "30")
    use = page.get_by_role("button", name=re.compile("^Use this"))
    expect(use.first).to_be_visible()
    use.first.click()
    expect(remedy).to_have_attribute("data-done", "")


@pytest.mark.heavy
def test_where_to_send_is_the_button_at_the_foot_of_the_step_that_is_open(page: Page) -> None:
    open_by_help(page)
    act(page, "Send the gait").get_by_role("button", name=re.compile("^Send the gait")).click()
    card(page).get_by_role("button", name=re.compile("^Show me where: Send")).click()
    expect(page.get_by_role("button", name="Simulate", exact=True)).to_be_focused()
    for scheme in ("light", "dark"):
        page.emulate_media(color_scheme="dark" if scheme == "dark" else "light")
        found = Axe().run(page, context={"include": [["#first-steps"]]}).response["violations"]
        assert found == [], scheme
