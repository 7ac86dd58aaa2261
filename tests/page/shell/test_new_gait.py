"""New gaits and robots on the page: the dialog, the choice of a robot, and what the list's tools do."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

import pytest
from playwright.sync_api import Browser, Locator, Page, expect

from tests.support.page.drawers import gait_act
from tests.support.page.opened import opened_page
from tests.support.studio_process import StudioProcess

SHARES_STUDIO = True


@pytest.fixture
def page(browser: Browser, studio: StudioProcess) -> Iterator[Page]:
    with opened_page(browser, studio.url, 1280, 720) as opened:
        expect(opened.get_by_label("Gait name")).not_to_have_value("")
        yield opened


def robot(page: Page) -> Locator:
    return page.get_by_role("combobox", name="Robot", exact=True)


def undo(page: Page) -> Locator:
    return page.get_by_role("button", name=re.compile("^Undo"))


def open_dialog(page: Page) -> Locator:
    page.get_by_role("button", name="New", exact=True).click()
    page.get_by_role("menuitem", name="New gait…").click()
    dialog = page.get_by_role("dialog", name="New gait")
    expect(dialog).to_be_visible()
    return dialog


def document(studio: StudioProcess, name: str) -> dict[str, Any]:
    gaits = studio.ask("GET", "/api/gaits").content["gaits"]
    found = next(gait["id"] for gait in gaits if gait["name"] == name)
    content: dict[str, Any] = studio.ask("GET", f"/api/gaits/{found}").content
    return content


@pytest.mark.heavy
def test_a_new_gait_is_made_by_keyboard_alone_for_a_robot_with_six_legs(
    page: Page, studio: StudioProcess
) -> None:
    new = page.get_by_role("button", name="New", exact=True)
    new.focus()
    page.keyboard.press("Enter")
    expect(page.get_by_role("menuitem", name="New gait…")).to_be_focused()
    page.keyboard.press("Enter")
    dialog = page.get_by_role("dialog", name="New gait")
    name = dialog.get_by_label("Name of the new gait")
    expect(name).to_be_focused()
    page.keyboard.type("Six in a wave")
    page.keyboard.press("Tab")
    page.keyboard.type("Hexa")
    expect(dialog.get_by_label("Robot of the new gait")).to_have_value("hexapod")
    expect(dialog.get_by_label("Order of the feet")).to_have_value("5 4 6 3 1 2")
    expect(dialog.get_by_role("status")).to_contain_text("One iteration has 65 samples and takes 25.6 s")
    page.keyboard.press("Tab")
    page.keyboard.type("Along x")
    expect(dialog.get_by_label("Order of the feet")).to_have_value("4 3 5 2 6 1")
    page.keyboard.press("Tab")
    page.keyboard.press("Tab")
    expect(dialog.get_by_label("Order of the feet")).to_be_focused()
    page.keyboard.press("Enter")
    expect(page.get_by_label("Gait name")).to_have_value("Six in a wave")
    expect(dialog).to_be_hidden()
    expect(page.get_by_role("status", name="Verdict")).to_contain_text("Plan margin")
    expect(robot(page)).to_have_value("hexapod")
    made = document(studio, "Six in a wave")
    assert (made["orientation"], made["step"], len(made["timeline"]["feet"])) == ("FBS", [0.01, 0.0, 0.0], 6)


@pytest.mark.heavy
def test_what_is_wrong_stands_at_its_field_and_nothing_is_made(page: Page, studio: StudioProcess) -> None:
    before = studio.ask("GET", "/api/gaits").content
    dialog = open_dialog(page)
    order, step = dialog.get_by_label("Order of the feet"), dialog.get_by_label("Step", exact=True)
    order.fill("1 2 3 3")
    step.fill("900")
    dialog.get_by_label("Name of the new gait").fill("  ")
    dialog.get_by_role("button", name="Create").click()
    expect(dialog.get_by_label("Name of the new gait")).to_be_focused()
    for field, word in (
        (order, "Enter each of the feet 1 to 4 once"),
        (step, "between 0 and 60 mm"),
        (dialog.get_by_label("Name of the new gait"), "Give the gait a name"),
    ):
        expect(field).to_have_attribute("aria-invalid", "true")
        said = field.get_attribute("aria-describedby")
        expect(dialog.locator(f"#{said}")).to_contain_text(word)
    order.fill("4 3 2 1")
    expect(order).not_to_have_attribute("aria-invalid", "true")
    expect(dialog.get_by_label("Pattern")).to_have_value("own")
    page.keyboard.press("Escape")
    expect(dialog).to_be_hidden()
    assert studio.ask("GET", "/api/gaits").content == before


def test_patterns_fill_in_the_order_and_an_order_finds_its_pattern(page: Page) -> None:
    dialog = open_dialog(page)
    order, pattern = dialog.get_by_label("Order of the feet"), dialog.get_by_label("Pattern")
    pattern.select_option("Amble")
    expect(order).to_have_value("3 1 4 2")
    order.fill("3 2 4 1")
    expect(pattern).to_have_value("Walk")
    dialog.get_by_label("Robot of the new gait").select_option("deltawalker5")
    expect(dialog.get_by_role("status")).to_contain_text("5 motors drive 12 strokes")
    dialog.get_by_role("button", name="Cancel").click()
    expect(dialog).to_be_hidden()


@pytest.mark.heavy
def test_a_robot_with_as_many_legs_is_an_edit_and_check_says_what_its_feet_do(page: Page) -> None:
    page.get_by_role("button", name="By hand").click()
    page.get_by_role("list", name="Gaits").get_by_role("button", name=re.compile("^Manual walk, v0")).click()
    expect(page.get_by_label("Gait name")).to_have_value("Manual walk, v0")
    robot(page).select_option(label="DeltaWalker, 5 motors")
    expect(undo(page)).to_have_attribute("title", re.compile("Robot to DeltaWalker, 5 motors"))
    note = page.get_by_role("status", name="Plan")
    expect(note).to_contain_text("The robot has 5, and misses strokes by up to 3.4 mm")
    page.get_by_role("tab", name="Check & approve").click()
    page.get_by_role("button", name="Check", exact=True).click()
    findings = page.get_by_role("list", name="Findings")
    expect(findings).to_contain_text("Foot 3 does not lift in its swing")
    expect(findings).to_contain_text("feet 1, 2, 3 and 4 do not lift")
    page.get_by_role("tab", name="Run").click()
    send = page.get_by_role("button", name="Send to robot")
    expect(send).to_have_attribute(
        "title", re.compile("this program can design for this robot but not drive it")
    )
    undo(page).click()
    page.get_by_role("tab", name="Design").click()
    expect(robot(page)).to_have_value("deltawalker")


@pytest.mark.heavy
def test_a_robot_with_other_legs_gets_a_gait_of_its_own(page: Page, studio: StudioProcess) -> None:
    page.get_by_role("list", name="Gaits").get_by_role("button", name=re.compile("^S-Gait 10 mm")).click()
    expect(page.get_by_label("Gait name")).to_have_value("S-Gait 10 mm")
    before = document(studio, "S-Gait 10 mm")
    robot(page).select_option("dodecapod")
    dialog = page.get_by_role("dialog", name="New gait")
    expect(dialog).to_contain_text(
        "“S-Gait 10 mm” is a gait for 4 legs, but Dodecapod, 36 motors has 12 legs"
    )
    expect(robot(page)).to_have_value("deltawalker")
    expect(dialog.get_by_label("Name of the new gait")).to_have_value("S-Gait 10 mm, Dodecapod")
    expect(dialog.get_by_label("Heading")).to_have_value("FBS")
    expect(dialog.get_by_label("Phase length", exact=True)).to_have_value("3")
    dialog.get_by_role("button", name="Create").click()
    expect(page.get_by_label("Gait name")).to_have_value("S-Gait 10 mm, Dodecapod")
    expect(page.get_by_role("status", name="Verdict")).to_contain_text("Plan margin")
    assert document(studio, "S-Gait 10 mm") == before
    expect(page.get_by_role("gridcell", name=re.compile("^foot 12, sample 1: "))).to_be_visible()


@pytest.mark.heavy
def test_one_menu_acts_on_the_shown_gait_and_fits_into_the_window(page: Page) -> None:
    dialog = open_dialog(page)
    dialog.get_by_label("Name of the new gait").fill("To be deleted")
    dialog.get_by_role("button", name="Create").click()
    expect(page.get_by_label("Gait name")).to_have_value("To be deleted")
    page.get_by_role("button", name="Gait", exact=True).click()
    entries = page.get_by_role("menu", name="Gait").get_by_role("menuitem")
    expect(entries.first).to_have_text("Duplicate")
    expect(entries.last).to_have_text("Delete")
    for entry in entries.all():
        expect(entry).to_be_in_viewport(ratio=1)
        assert entry.evaluate("item => item.scrollWidth <= item.clientWidth")
        assert entry.evaluate(
            """item => {
              const { x, y, width, height } = item.getBoundingClientRect();
              return document.elementFromPoint(x + width / 2, y + height / 2) === item;
            }"""
        ), "nothing lies over it"
    with page.expect_download() as download:
        page.get_by_role("group", name="Export as").get_by_role("menuitem", name="Gait (JSON)").click()
    assert download.value.suggested_filename.endswith(".json")
    gait_act(page, "Delete")
    expect(page.locator("#toasts")).to_contain_text("“To be deleted” is deleted.")
    page.get_by_role("button", name="Bring it back").click()
    expect(page.get_by_label("Gait name")).to_have_value("To be deleted")


def test_a_gait_of_the_program_says_why_it_cannot_be_deleted(page: Page) -> None:
    button = page.get_by_role("button", name="Gait", exact=True)
    button.press("ArrowDown")
    expect(page.get_by_role("menuitem", name="Duplicate")).to_be_focused()
    page.keyboard.press("End")
    delete = page.get_by_role("menuitem", name="Delete", exact=True)
    expect(delete).to_be_focused()
    expect(delete).to_have_attribute("aria-disabled", "true")
    expect(delete).to_have_attribute("title", re.compile("comes with the program"))
    page.keyboard.press("Escape")
    expect(button).to_be_focused()


@pytest.mark.heavy
def test_a_deleted_gait_is_brought_back_after_a_reload(page: Page, studio: StudioProcess) -> None:
    for gait in studio.ask("GET", "/api/gaits/deleted").content["gaits"]:
        studio.ask("POST", f"/api/gaits/{gait['id']}/restore")
    new = page.get_by_role("button", name="New", exact=True)
    entry = page.get_by_role("menuitem", name="Deleted gaits…")
    new.press("ArrowDown")
    expect(entry).to_have_attribute("title", "No gait is deleted, so there is no gait to bring back.")
    expect(entry).to_have_attribute("aria-disabled", "true")
    made = studio.ask("POST", "/api/gaits?copy_of=walk&name=Gone%20and%20back").content
    assert studio.ask("DELETE", f"/api/gaits/{made['id']}").status == 200
    listed = studio.ask("GET", "/api/gaits/deleted").content["gaits"]
    assert [(gait["id"], gait["name"]) for gait in listed] == [(made["id"], "Gone and back")]
    page.reload()
    new.press("ArrowDown")
    expect(entry).not_to_have_attribute("aria-disabled", "true")
    entry.press("Enter")
    dialog = page.get_by_role("dialog", name="Deleted gaits")
    back = dialog.get_by_role("button", name="Bring back Gone and back")
    expect(back).to_be_focused()
    back.press("Enter")
    expect(page.get_by_label("Gait name")).to_have_value("Gone and back")
    expect(dialog).to_have_count(0)
    assert studio.ask("GET", "/api/gaits/deleted").content == {"gaits": []}


@pytest.mark.heavy
def test_notices_of_a_gait_go_with_it_and_three_stand_at_once(page: Page) -> None:
    show = """async () => {
      const { toast } = await import("/static/lib/toasts.js");
      toast("It is deleted.", { action: { label: "Bring it back", act: () => {} } });
      for (const sentence of ["One.", "Two.", "Not pasted.", "Imported with remarks."]) toast(sentence);
    }"""
    page.evaluate(show)
    notices = page.locator("#toasts p")
    expect(notices).to_have_text(["It is deleted.", "Not pasted.", "Imported with remarks."])
    gaits = page.get_by_role("list", name="Gaits")
    gaits.locator("button.gait:not([aria-current])").first.click()
    expect(notices).to_have_text(["It is deleted."])
