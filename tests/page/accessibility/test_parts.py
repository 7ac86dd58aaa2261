"""The page as assistive tools find it, judged by axe-core: no serious finding in any of its parts."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Browser, Page, expect

from tests.support.page.opened import opened_page
from tests.support.studio_process import StudioProcess

pytestmark = pytest.mark.heavy

TABS = ("Design", "Simulate", "Check & approve", "Run", "Segments", "Pattern search")
SERIOUS = ("serious", "critical")
OWN = {"exclude": [["#viser"]]}
"""The scene's frame is Viser's own page."""


@pytest.fixture
def page(browser: Browser, studio: StudioProcess, request: pytest.FixtureRequest) -> Iterator[Page]:
    has_scene = "scene" in request.keywords
    with opened_page(browser, studio.url, 1280, 800, has_scene=has_scene) as opened:
        expect(opened.get_by_role("grid", name="Footfall timeline").get_by_role("row")).to_have_count(4)
        yield opened


def serious_findings(page: Page, context: dict[str, list[list[str]]] = OWN) -> list[str]:
    """A line for each serious or critical finding: rule, help and the first elements."""
    found = Axe().run(page, context=context, options={"resultTypes": ["violations"]}).response["violations"]
    return [
        f"{rule['id']}: {rule['help']} at {[node['target'] for node in rule['nodes'][:3]]}"
        for rule in found
        if rule["impact"] in SERIOUS
    ]


@pytest.mark.scene
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_no_part_of_the_page_has_a_serious_finding(page: Page, scheme: str) -> None:
    page.emulate_media(color_scheme="dark" if scheme == "dark" else "light")
    for tab in TABS:
        page.get_by_role("tab", name=tab).click()
        assert serious_findings(page) == [], f"{tab}, {scheme}"


def test_the_keys_and_the_operators_dialog_have_no_serious_finding(page: Page) -> None:
    page.get_by_role("button", name="Keyboard", exact=True).click()
    expect(page.get_by_role("dialog")).to_be_visible()
    assert serious_findings(page) == []


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_the_timelines_menu_and_its_selection_have_no_serious_finding(page: Page, scheme: str) -> None:
    page.emulate_media(color_scheme="dark" if scheme == "dark" else "light")
    page.keyboard.press("Control+a")
    page.keyboard.press("+")
    page.get_by_role("button", name="Edit", exact=True).click()
    expect(page.get_by_role("menu", name="Edit the timeline")).to_be_visible()
    assert serious_findings(page) == []
    page.get_by_role("menuitem", name="Stretch…").click()
    expect(page.get_by_role("dialog", name="Stretch")).to_be_visible()
    assert serious_findings(page) == []


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_the_dialog_for_a_new_gait_has_no_serious_finding(page: Page, scheme: str) -> None:
    page.emulate_media(color_scheme="dark" if scheme == "dark" else "light")
    page.get_by_role("button", name="New", exact=True).click()
    expect(page.get_by_role("menuitem", name="New gait…")).to_be_visible()
    assert serious_findings(page) == []
    page.get_by_role("menuitem", name="New gait…").click()
    page.get_by_label("Order of the feet").fill("1 1 1")
    page.get_by_role("button", name="Create").click()
    expect(page.get_by_label("Order of the feet")).to_have_attribute("aria-invalid", "true")
    assert serious_findings(page) == []


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_the_comparison_with_a_faster_gait_has_no_serious_finding(page: Page, scheme: str) -> None:
    page.emulate_media(color_scheme="dark" if scheme == "dark" else "light")
    page.get_by_role("button", name="Faster on the robot").click()
    dialog = page.get_by_role("dialog", name="Faster on the robot")
    expect(dialog.get_by_role("status")).to_contain_text("Looking for the fastest motion")
    assert serious_findings(page) == []
    dialog.get_by_role("button", name="Cancel").click()


def test_a_finding_would_be_found(page: Page) -> None:
    page.evaluate(
        """() => {
          for (const name of ["aria-label", "title"]) document.getElementById("play").removeAttribute(name);
        }"""
    )
    assert any(line.startswith("button-name") for line in serious_findings(page))
