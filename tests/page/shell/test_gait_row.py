"""A gait that was just made is seen in a long list; the dialog for it judges while one types."""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.support.page.drawers import gait_act
from tests.support.page.opened import opened_page
from tests.support.studio_process import StudioProcess

pytestmark = pytest.mark.heavy


@pytest.fixture
def page(browser: Browser, studio: StudioProcess) -> Iterator[Page]:
    with opened_page(browser, studio.url, 1024, 768) as opened:
        expect(opened.get_by_label("Gait name")).not_to_have_value("")
        yield opened


def test_a_copy_at_the_end_of_a_long_list_is_scrolled_into_view(page: Page, studio: StudioProcess) -> None:
    walk = studio.ask("GET", "/api/gaits/walk").content
    for number in range(24):
        assert studio.ask("POST", "/api/gaits", walk | {"name": f"Saved {number:02}"}).status == 201
    # A row that moves while others are still being added is missed by a click.
    expect(page.get_by_role("list", name="Gaits").get_by_role("button", name="Saved 23")).to_be_attached()
    page.get_by_role("list", name="Gaits").get_by_role("button", name="Saved 00").click()
    expect(page.get_by_label("Gait name")).to_have_value("Saved 00")
    page.get_by_label("Gait name").fill("Zebra")
    page.get_by_label("Gait name").press("Enter")
    gait_act(page, "Duplicate")
    expect(page.get_by_label("Gait name")).to_have_value("Zebra copy")
    copy = page.get_by_role("list", name="Gaits").get_by_role("button", name="Zebra copy")
    expect(copy).to_have_attribute("aria-current", "true")
    expect(copy).to_be_in_viewport(ratio=0.95)


def test_a_double_click_leads_to_the_name_and_letters_are_its(page: Page, studio: StudioProcess) -> None:
    page.get_by_role("list", name="Gaits").get_by_role("button", name="C-Gait 10 mm").first.dblclick()
    name = page.get_by_label("Gait name")
    expect(name).to_be_focused()
    expect(name).to_have_value("C-Gait 10 mm")
    page.wait_for_function("() => getSelection().toString() === 'C-Gait 10 mm'")
    page.keyboard.type("Kink")
    page.keyboard.press("Enter")
    expect(page.get_by_role("list", name="Gaits").get_by_role("button", name="Kink")).to_be_visible()
    assert "1" not in "".join(studio.ask("GET", "/api/gaits/c-gait").content["timeline"]["locked"])


def test_a_gait_that_cannot_walk_says_so_in_the_list(page: Page) -> None:
    stuck = page.get_by_role("list", name="Gaits").get_by_role("button", name="Hexapod, front pair up")
    expect(stuck).to_contain_text("infeasible")
    expect(stuck).to_have_attribute("title", re.compile("No motion of this gait keeps every limit"))
    walks = page.get_by_role("list", name="Gaits").get_by_role("button", name="Hexapod tripod")
    expect(walks).not_to_contain_text("infeasible")


def test_a_foot_order_is_judged_while_it_is_typed(page: Page) -> None:
    page.get_by_role("button", name="New", exact=True).click()
    page.get_by_role("menuitem", name="New gait…").click()
    order = page.get_by_label("Order of the feet")
    order.fill("3 2 4")
    refusal = (
        page.get_by_role("dialog").get_by_role("alert").filter(has_text="Enter each of the feet 1 to 4 once")
    )
    expect(refusal).to_be_visible()
    expect(order).to_have_attribute("aria-invalid", "true")
    order.fill("3 2 4 1")
    expect(refusal).to_be_hidden()
    page.get_by_role("dialog").get_by_label("Phase length").fill("2.5")
    expect(
        page.get_by_role("dialog").get_by_role("alert").filter(has_text="whole number of samples")
    ).to_be_visible()
    page.keyboard.press("Escape")
