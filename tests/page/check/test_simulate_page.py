"""Simulate on the page: figures, the robot beside its plan, variations, and what an edit does to them."""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Browser, Locator, Page, expect

from tests.support.page.drawers import open_drawer
from tests.support.page.opened import opened_page
from tests.support.studio_process import StudioProcess

pytestmark = pytest.mark.heavy

GHOST = """() => {
  const scene = document.getElementById("viser").contentWindow.__viserMutable?.nodeRefFromName ?? {};
  const isDrawn = (name) => {
    let ends = null;
    scene[name]?.traverse(({ geometry }) => { ends ??= geometry?.attributes?.instanceStart?.data?.array; });
    return scene[name]?.visible && ends?.some((value) => value !== 0);
  };
  return isDrawn("/ghost/simulated") && isDrawn("/ghost/contact");
}"""
"""Whether the simulated robot and its contacts are drawn."""


@pytest.fixture
def page(browser: Browser, studio: StudioProcess) -> Iterator[Page]:
    with opened_page(browser, studio.url, 1280, 800, has_scene=True) as opened:
        opened.get_by_role("tab", name="Simulate").click()
        yield opened


def panel(page: Page) -> Locator:
    return page.get_by_role("tabpanel", name="Simulate")


def test_a_gait_is_simulated_shown_over_its_plan_and_stale_after_an_edit(page: Page) -> None:
    expect(panel(page)).to_contain_text("Not simulated yet.")
    page.get_by_role("button", name="Simulate", exact=True).click()
    open_drawer(page, "Jobs")
    jobs = page.get_by_role("list", name="Jobs", exact=True)
    expect(jobs.get_by_role("listitem")).to_contain_text("Walk 10 mm")
    expect(page.get_by_role("status", name="Verdict")).to_contain_text("Simulated walks")
    expect(page.get_by_role("tab", name="Simulate", selected=True)).to_be_visible()
    words = panel(page).get_by_role("status", name="Simulated")
    expect(words).to_contain_text("Robot on the scales, 0.570 kg")
    row = panel(page).get_by_role("row", name=re.compile("^Largest tilt"))
    expect(row).to_contain_text("°")
    row.get_by_role("button").click()
    time = re.search(r"([\d.]+) s$", row.inner_text())
    assert time is not None
    expect(page.get_by_label("Time", exact=True)).to_contain_text(time.group(1))

    expect(page.get_by_role("note", name="Lines of the plots")).to_have_text("plannedsimulated")
    page.wait_for_function(GHOST)
    found = Axe().run(page, context={"include": [["#simulate"]]}).response["violations"]
    assert [one["id"] for one in found if one["impact"] in ("serious", "critical")] == []

    page.get_by_role("gridcell", name="foot 3, sample 12: stance").click()
    expect(panel(page)).to_contain_text("The gait has changed")
    expect(page.get_by_role("note", name="Lines of the plots")).not_to_contain_text("simulated")
    expect(jobs).to_contain_text("older version of the gait")
    page.wait_for_function(f"() => !({GHOST})()")
    page.get_by_role("button", name="Undo").click()
    expect(page.get_by_role("note", name="Lines of the plots")).to_contain_text("simulated")


def test_a_simulation_is_cancelled_and_a_reload_brings_the_last_one_back(page: Page) -> None:
    expect(panel(page).get_by_role("status", name="Simulated")).to_be_visible()
    page.get_by_role("button", name="64 variations").click()
    panel(page).get_by_role("button", name="Cancel simulation").click()
    expect(panel(page).get_by_role("button", name="Cancel simulation")).to_be_hidden()
    open_drawer(page, "Jobs")
    expect(page.get_by_role("list", name="Jobs", exact=True)).to_contain_text("cancelled")
    expect(panel(page).get_by_role("list", name="Variations")).to_be_hidden()


MAP = """async () => {
  const { robustness } = await import("/static/check/simulate.js");
  const map = robustness();
  const figures = { walks: false, fell: false, max_tilt: 0.1, distance: 0.01, feet_error: 0.001 };
  const run = (name, more) => ({ ...figures, name, ended_early: "", ...more });
  const [walks, falls, ends] = [{ walks: true }, { fell: true }, { ended_early: "It fell." }];
  const runs = [run("a", walks), run("b", falls), run("c"), run("d", ends)];
  map.show({ count: runs.length, runs }, false);
  const cells = [...map.element.querySelectorAll("li")];
  return {
    words: map.element.querySelector("b").textContent,
    came: cells.map((cell) => cell.dataset.came),
    signs: cells.map((cell) => cell.textContent),
    titles: cells.map((cell) => cell.title),
  };
}"""


def test_the_map_tells_walking_tipping_and_falling_apart_without_colour(page: Page) -> None:
    shown = page.evaluate(MAP)
    assert shown["words"] == "1 of 4 walk (25 %)"
    assert shown["came"] == ["walks", "falls", "tips", "falls"]
    assert shown["signs"] == ["", "×", "!", "×"]
    assert shown["titles"][0].startswith("Variation 1: a. The robot walks. Tilt up to 5.7°")
    assert shown["titles"][3] == "Variation 4: d. The simulation ends early: It fell."
