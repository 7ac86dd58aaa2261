"""While a gait has no motion plots and robot show, in grey, the last plan of the same gait that worked."""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.support.page.opened import choose, opened_page
from tests.support.studio_process import StudioProcess, wait_for

SHARES_STUDIO = True

GREYS = """() => {
  let [grey, coloured] = [0, 0];
  const robot = document.querySelector("#viser").contentWindow.__viserMutable?.nodeRefFromName["/robot"];
  robot?.traverse(({ isMesh, material }) => {
    if (!isMesh || material.type !== "MeshStandardMaterial") return;
    const { r, g, b } = material.color;
    if (Math.max(r, g, b) - Math.min(r, g, b) < 0.001) grey += 1;
    else coloured += 1;
  });
  return [grey, coloured];
}"""


@pytest.fixture
def page(browser: Browser, studio: StudioProcess, request: pytest.FixtureRequest) -> Iterator[Page]:
    has_scene = "scene" in request.keywords
    with opened_page(browser, studio.url, 1280, 800, has_scene=has_scene) as opened:
        yield opened


@pytest.mark.heavy
def test_plots_keep_the_last_plan_that_worked_without_figures(page: Page) -> None:
    choose(page, "Amble 10 mm")
    page.get_by_role("gridcell", name="foot 2, sample 45: stance", exact=True).click()
    margin = page.locator('.strip[data-strip="margin"]')
    key = page.get_by_role("note", name="Lines of the plots")
    expect(key).to_contain_text("grey: last valid plan")
    expect(margin).to_have_attribute("aria-label", re.compile("^Grey: the last valid plan"))
    expect(page.locator(".plot-label .value").first).to_have_text("–")
    expect(page.get_by_role("status", name="Verdict")).to_contain_text("no motion")
    page.get_by_role("group", name="What would help").get_by_role("listitem").first.hover()
    expect(key).to_be_hidden()
    expect(page.locator(".plot-label .value").first).to_contain_text("mm")
    page.mouse.move(600, 300)
    expect(key).to_contain_text("grey: last valid plan")
    page.get_by_role("button", name=re.compile("^Undo")).click()
    expect(key).to_be_hidden()
    expect(page.locator(".plot-label .value").first).to_contain_text("mm")


@pytest.mark.heavy
@pytest.mark.scene
def test_the_robot_is_grey_and_the_stage_says_so(page: Page) -> None:
    choose(page, "S-Gait 10 mm")
    badge = page.get_by_role("status", name="Shown in 3D")
    expect(badge).to_have_text("Plan")
    wait_for(lambda: page.evaluate(GREYS)[1] > 0, "the robot has its colours")
    page.get_by_role("gridcell", name="foot 2, sample 45: stance", exact=True).click()
    expect(badge).to_have_text("No motionGrey: the last valid plan.")
    wait_for(lambda: page.evaluate(GREYS)[1] == 0 < page.evaluate(GREYS)[0], "the robot is grey")
    page.get_by_role("button", name=re.compile("^Undo")).click()
    expect(badge).to_have_text("Plan")
    wait_for(lambda: page.evaluate(GREYS)[1] > 0, "the robot has its colours again")
