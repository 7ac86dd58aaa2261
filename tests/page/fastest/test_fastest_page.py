"""The dialogs *Rotate* and *Fastest gait*: prices, the search with its front, gaits made of choices."""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Locator, Page, expect

from tests.support.page.axe import findings
from tests.support.page.opened import opened_page
from tests.support.studio_process import StudioProcess

PACE = re.compile(r"[0-9]+\.[0-9]{2} mm/s")


@pytest.fixture
def page(browser: Browser, studio: StudioProcess) -> Iterator[Page]:
    with opened_page(browser, studio.url, 1280, 900) as opened:
        expect(opened.get_by_label("Gait name")).not_to_have_value("")
        yield opened


def open_dialog(page: Page) -> Locator:
    page.get_by_role("button", name="New", exact=True).click()
    page.get_by_role("menuitem", name="Fastest gait").click()
    dialog = page.get_by_role("dialog", name="Fastest gait")
    expect(dialog.get_by_role("radio", name=re.compile("1.5 s"))).to_be_checked()
    return dialog


def price(dialog: Locator, group: str, value: str) -> float:
    chip = dialog.get_by_role("group", name=group).locator("label", has_text=value).locator("b")
    expect(chip).to_have_text(PACE)
    return float((chip.text_content() or "").split()[0])


@pytest.mark.heavy
def test_the_price_of_each_choice_is_there_before_it_is_made(page: Page) -> None:
    dialog = open_dialog(page)
    early, usual = price(dialog, "Stop bound", "1.0 s"), price(dialog, "Stop bound", "1.5 s")
    assert early < 0.75 * usual
    assert price(dialog, "Foot order", "Amble, at 45°") > usual
    assert price(dialog, "Stability margin", "10 mm") < usual
    assert findings(page) == []
    dialog.get_by_role("radio", name=re.compile("1.0 s")).press("Space")
    expect(dialog.get_by_text(re.compile("C-Gait, along x: 1[.]8[0-9] mm/s in mid-walk"))).to_be_visible()
    # The focus stays on what was chosen, though every price is new.
    expect(dialog.get_by_role("radio", name=re.compile("1.0 s"))).to_be_focused()


@pytest.mark.heavy
def test_a_gait_is_made_of_what_is_chosen_and_shown(page: Page) -> None:
    dialog = open_dialog(page)
    dialog.get_by_role("radio", name=re.compile("^Amble, at 45°")).press("Space")
    expect(dialog.get_by_label("Name of the new gait")).to_have_value("Amble, fastest")
    dialog.get_by_label("Cycles").fill("0")
    dialog.get_by_role("button", name="Create").click()
    expect(dialog.get_by_role("alert")).to_have_text(
        "Cycles is 0, but must be a whole number between 1 and 20."
    )
    dialog.get_by_label("Cycles").fill("2")
    dialog.get_by_role("button", name="Create").click()
    expect(page.get_by_label("Gait name")).to_have_value("Amble, fastest")
    expect(page.get_by_label("Foot order")).to_have_value("1 4 2 3")
    expect(page.get_by_role("spinbutton", name="Iterations")).to_have_value("2")


@pytest.mark.soak
def test_a_rotation_is_made_by_its_degrees_and_solved(page: Page) -> None:
    page.get_by_role("button", name="New", exact=True).click()
    page.get_by_role("menuitem", name="Rotate").click()
    dialog = page.get_by_role("dialog", name="Rotate on the spot")
    turn, cycles = dialog.get_by_label("Turn", exact=True), dialog.get_by_label("Cycles")
    expect(turn).to_have_value("45")
    turn.fill("0")
    expect(dialog.get_by_role("alert")).to_have_text(re.compile("^Turn is 0°"))
    turn.fill("-200")
    cycles.fill("2")
    expect(dialog.get_by_role("alert")).to_have_text(re.compile("^Each cycle would turn 100.0°"))
    assert findings(page) == []
    turn.fill("-40")
    expect(dialog.get_by_role("status")).to_have_text(re.compile("turns 20.0° to the right"))
    dialog.get_by_role("button", name="Create").click()
    expect(page.get_by_label("Gait name")).to_have_value("Rotate 40° right")
    expect(page.get_by_label("Foot order")).to_have_value("1 2 3 4")
    expect(page.get_by_role("spinbutton", name="Iterations")).to_have_value("2")
    line = page.get_by_role("list", name="Gaits").get_by_role("button", name=re.compile("^Rotate 40°"))
    expect(line).to_contain_text("°/s", timeout=120_000)


@pytest.mark.heavy
def test_a_search_shows_its_table_is_cancelled_and_found_again_in_jobs(page: Page) -> None:
    dialog = open_dialog(page)
    dialog.get_by_role("button", name="Search all foot orders").click()
    expect(dialog.get_by_role("button", name="Search all foot orders")).to_have_attribute(
        "aria-disabled", "true"
    )
    table = dialog.get_by_role("table", name="Gaits that were tried")
    expect(table.get_by_text(PACE).first).to_be_visible(timeout=60_000)
    dialog.get_by_role("button", name="Cancel search").click()
    expect(dialog.get_by_text("The last search: Cancelled.")).to_be_visible(timeout=30_000)
    # The button that went had the focus; another one has it now.
    expect(dialog.get_by_role("button", name="Search all foot orders")).to_be_focused()
    page.keyboard.press("Escape")
    expect(dialog).to_be_hidden()
    page.get_by_role("button", name=re.compile("^Jobs")).first.click()
    page.get_by_role("button", name=re.compile("^Fastest gait, ")).first.click()
    expect(dialog.get_by_role("table", name="Gaits that were tried").get_by_text(PACE).first).to_be_visible()
    dialog.get_by_role("button", name=re.compile("^Choose ")).first.click()
    expect(dialog.get_by_role("group", name="Foot order").locator(":checked")).to_have_count(1)


@pytest.mark.heavy
def test_a_robot_with_other_legs_has_orders_of_its_own(page: Page) -> None:
    dialog = open_dialog(page)
    robot = dialog.get_by_label("Robot of the fastest gait")
    six = robot.locator("option", has_text="six").or_(robot.locator("option", has_text="Hexapod")).first
    robot.select_option(value=six.get_attribute("value"))
    expect(dialog.get_by_text("computed with the firmware timing of the DeltaWalker")).to_be_visible()
    orders = dialog.get_by_role("group", name="Foot order").locator("label")
    expect(orders.first).to_have_attribute("title", re.compile("^Feet 1-[2-6]-[2-6]-[2-6]-[2-6]-[2-6]"))
    expect(orders.filter(has_text="Ripple").first).to_be_visible()
    # Its own margin.
    margins = dialog.get_by_role("group", name="Stability margin")
    expect(margins.get_by_role("radio", name=re.compile("^3 mm"))).to_be_checked()


@pytest.mark.heavy
@pytest.mark.parametrize(("width", "height"), [(1280, 720), (820, 1180)])
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_the_dialog_is_whole_and_accessible(page: Page, width: int, height: int, scheme: str) -> None:
    page.set_viewport_size({"width": width, "height": height})
    page.emulate_media(color_scheme=scheme)  # type: ignore[arg-type]
    dialog = open_dialog(page)
    assert price(dialog, "Stop bound", "1.5 s") > 3.0
    assert findings(page) == []
    box = dialog.bounding_box()
    assert box is not None
    assert box["x"] >= 0
    assert box["x"] + box["width"] <= width
    assert dialog.evaluate("(element) => element.scrollWidth <= element.clientWidth")
