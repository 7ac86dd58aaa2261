"""The versions panel: by keyboard, in words, and back again."""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Browser, Locator, Page, expect

from tests.support.page.opened import opened_page
from tests.support.studio_process import StudioProcess

pytestmark = pytest.mark.heavy


@pytest.fixture
def page(browser: Browser, studio: StudioProcess) -> Iterator[Page]:
    with opened_page(browser, studio.url, 1280, 800) as opened:
        expect(opened.get_by_label("Gait name")).to_have_value("Walk 10 mm")
        yield opened


def change(studio: StudioProcess, margin: float) -> None:
    document = studio.ask("GET", "/api/gaits/walk").content
    document["options"]["margin"] = margin
    assert studio.ask("PUT", "/api/gaits/walk?label=Margin", document).status == 200


def options(page: Page) -> Locator:
    return page.get_by_role("listbox", name="Versions").get_by_role("option")


def test_states_are_named_compared_and_restored_by_keyboard_alone(page: Page, studio: StudioProcess) -> None:
    change(studio, 0.002)
    expect(page.locator("#saved-state")).to_have_text("Not saved to a file")
    button = page.get_by_role("button", name="Versions")
    button.focus()
    expect(button).to_be_focused()  # a page that has just opened may still take the focus
    page.keyboard.press("Enter")
    expect(page.get_by_role("listbox", name="Versions")).to_be_visible(timeout=30_000)
    expect(options(page)).to_have_count(1)
    expect(page.get_by_role("listbox", name="Versions")).to_be_focused()
    difference = page.get_by_role("region", name="Difference")
    expect(difference).to_contain_text("since version 1")
    expect(difference).to_contain_text("Stability margin 6.0 mm → 2.0 mm")

    field = page.get_by_label("Name of this state")
    field.fill("Two millimetres")
    field.press("Enter")
    expect(options(page)).to_have_count(2)
    expect(options(page).first).to_have_accessible_name(re.compile("Version 2, Two millimetres, .*as now"))
    expect(page.get_by_role("button", name="Restore")).to_have_attribute("aria-disabled", "true")

    change(studio, 0.001)  # the panel follows what happens meanwhile
    expect(difference).to_contain_text("Stability margin 2.0 mm → 1.0 mm")
    versions = page.get_by_role("listbox", name="Versions")
    versions.focus()
    versions.press("End")
    expect(difference).to_contain_text("since version 1")
    page.get_by_label("Compared with").select_option(label="version 2, Two millimetres")
    expect(difference).to_contain_text("Changes from version 1 to version 2")
    restore = page.get_by_role("button", name="Restore")
    expect(restore).not_to_have_attribute("aria-disabled", "true")
    restore.press("Enter")
    expect(page.get_by_role("spinbutton", name="Stability margin", exact=True)).to_have_value("6")
    expect(page.locator("#undo")).to_have_attribute("title", re.compile("Restore version 1"))
    expect(options(page)).to_have_count(3)
    found = Axe().run(page, context={"include": [[".dialog"]]}).response["violations"]
    assert [one["id"] for one in found if one["impact"] in ("serious", "critical")] == []
    page.keyboard.press("Escape")
    expect(page.get_by_role("dialog")).to_have_count(0)
    expect(button).to_be_focused()
    page.keyboard.press("Control+z")
    expect(page.get_by_role("spinbutton", name="Stability margin", exact=True)).to_have_value("1")


def test_a_gait_without_versions_says_what_makes_them(page: Page) -> None:
    page.get_by_role("list", name="Gaits").get_by_role(
        "button", name=re.compile("^C-Gait 10 mm(?!,)")
    ).click()
    expect(page.get_by_label("Gait name")).to_have_value("C-Gait 10 mm")
    page.get_by_role("button", name="Versions").click()
    expect(page.get_by_role("region", name="Difference")).to_contain_text("There is no version yet")
    expect(page.get_by_role("button", name="Restore")).to_have_attribute("title", "There is no version yet.")
    page.keyboard.press("Escape")
    expect(page.get_by_role("dialog")).to_have_count(0)
