"""The 3D preview on the page: what is shown, ghosts, the view, and pages on different robots."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest
from playwright.sync_api import Browser, Page, expect

from core.robot.model import load_robot
from tests.support.page.opened import opened_page, scene_browser
from tests.support.studio_process import StudioProcess

pytestmark = [pytest.mark.heavy, pytest.mark.alone]

INSIDE = "document.querySelector('#viser').contentWindow?.__viserMutable"


@pytest.fixture
def page(browser: Browser, studio: StudioProcess) -> Iterator[Page]:
    with opened_page(browser, studio.url, 1280, 800, has_scene=True) as opened:
        wait_for_scene(opened)
        yield opened


def wait_for_scene(page: Page) -> None:
    page.wait_for_function(f"() => {INSIDE}?.nodeRefFromName['/overlay/com']?.visible === true")


def wait_until_visible(page: Page, node: str, visible: bool) -> None:
    script = f"(node) => ({INSIDE}?.nodeRefFromName[node]?.visible ?? false) === {str(visible).lower()}"
    page.wait_for_function(script, arg=node)


def choose(page: Page, menu: str, entry: str) -> None:
    page.get_by_role("button", name=menu, exact=True).click()
    page.get_by_role("menuitemcheckbox", name=entry).click()
    page.keyboard.press("Escape")


def move_higher(studio: StudioProcess, gait: str, height: float) -> None:
    document: dict[str, Any] = studio.ask("GET", f"/api/gaits/{gait}").content
    document["options"]["plane_height"] = height
    assert studio.ask("PUT", f"/api/gaits/{gait}?label=Higher", document).status == 200


def test_marks_are_shown_and_hidden_by_the_menu(page: Page) -> None:
    wait_until_visible(page, "/overlay/cop", True)
    for entry, node, shown in (
        ("Centre of pressure", "/overlay/cop_trace", False),
        ("Swings and footholds", "/overlay/swing3", False),
        ("Reach of the feet", "/robot/body/reach", True),
    ):
        choose(page, "Show", entry)
        wait_until_visible(page, node, shown)
    choose(page, "Show", "Goal")
    expect(page.get_by_role("slider", name="Goal", exact=True)).to_be_hidden()
    choose(page, "Show", "Robot")
    wait_until_visible(page, "/robot", False)
    page.reload()
    wait_for_scene(page)
    wait_until_visible(page, "/robot/body/reach", True)
    wait_until_visible(page, "/overlay/cop_trace", False)
    wait_until_visible(page, "/robot", True)


def test_a_ghost_says_why_there_is_none_and_stands_where_the_gait_was_before(
    page: Page, studio: StudioProcess
) -> None:
    page.get_by_role("button", name="Ghosts").click()
    before = page.get_by_role("menuitemcheckbox", name="Before the last edit")
    expect(before).to_have_attribute("title", "This gait has not been changed yet.")
    page.keyboard.press("Escape")
    move_higher(studio, "walk", 0.056)
    expect(page.locator("#undo-label")).to_contain_text("higher")
    choose(page, "Ghosts", "Before the last edit")
    wait_until_visible(page, "/ghost/before", True)
    page.wait_for_function(
        f"""() => {{
          const inside = {INSIDE};
          const height = inside.nodeRefFromName["/robot/body"].position.z;
          let ends = null;
          inside.nodeRefFromName["/ghost/before"].traverse((part) => {{
            ends ??= part.geometry?.attributes?.instanceStart?.data?.array ?? null;
          }});
          const tops = [...ends].filter((_, at) => at % 3 === 2);
          window.gap = [height, Math.max(...tops)];
          return Math.abs(height - 0.056) < 1e-4;
        }}"""
    )
    model = load_robot("deltawalker")
    height, top = page.evaluate("window.gap")
    assert top - height == pytest.approx(model.shape.upper_plate_height - 0.0025, abs=1e-4)
    assert studio.ask("POST", "/api/gaits/walk/undo").status == 200


def test_the_view_is_fitted_again_by_a_button(page: Page) -> None:
    place = f"{INSIDE}.camera.position.toArray()"
    page.get_by_role("button", name="Fit the view").click()
    page.wait_for_function(f"() => {INSIDE}.messageQueue.length === 0")
    fitted = page.evaluate(place)
    page.frame_locator("#viser").locator("canvas[data-engine]").hover()
    page.mouse.wheel(0, 600)
    page.wait_for_function(
        f"(fitted) => Math.hypot(...{place}.map((at, i) => at - fitted[i])) > 0.02", arg=fitted
    )
    page.get_by_role("button", name="Fit the view").click()
    page.wait_for_function(
        f"(fitted) => Math.hypot(...{place}.map((at, i) => at - fitted[i])) < 0.02", arg=fitted
    )


def test_two_pages_on_different_robots_each_see_their_own(
    page: Page, browser: Browser, studio: StudioProcess
) -> None:
    assert studio.ask("POST", "/api/gaits/drawn", {"name": "Six", "robot": "hexapod"}).status == 201
    with opened_page(browser, studio.url, 1024, 768, has_scene=True) as other:
        wait_for_scene(other)
        other.get_by_role("list", name="Gaits").get_by_role("button", name="Six").click()
        wait_until_visible(other, "/overlay/swing6", True)
        wait_for_scene(other)
        assert page.evaluate(f"{INSIDE}.nodeRefFromName['/robot/leg6_foot'] === undefined")
        assert page.evaluate(f"{INSIDE}.nodeRefFromName['/robot/leg4_foot'] !== undefined")
        other.get_by_role("list", name="Gaits").get_by_role("button", name="Amble 10 mm").first.click()
        other.wait_for_function(
            f"""() => {INSIDE}?.nodeRefFromName['/robot/leg4_foot']
            && !{INSIDE}.nodeRefFromName['/robot/leg6_foot']"""
        )


def test_with_a_gpu_the_robot_throws_a_shadow(browser: Browser, studio: StudioProcess) -> None:
    page = scene_browser(browser).new_page(viewport={"width": 1024, "height": 640})
    # Only what the page takes from it is tried here: this machine may have no GPU.
    page.add_init_script(
        "Object.defineProperty(window, 'footfallSoftwareDrawing', { get: () => false, set: () => {} })"
    )
    page.goto(studio.url)
    wait_until_visible(page, "/floor/shadow", True)
    page.wait_for_function(
        f"""() => {{
          let casts = 0;
          {INSIDE}.nodeRefFromName["/robot"].traverse((part) => {{ casts += part.castShadow ? 1 : 0; }});
          return casts > 30;
        }}"""
    )
    page.close()
