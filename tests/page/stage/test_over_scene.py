"""What lies over the 3D scene: foot labels, arrow, scale, legend, view cube; and the camera's limits."""

from __future__ import annotations

import re
from collections.abc import Iterator
from math import hypot
from typing import Any

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Browser, Page, expect

from core.robot.model import load_robot
from tests.support.page.opened import choose, opened_page
from tests.support.studio_process import StudioProcess

pytestmark = [pytest.mark.heavy, pytest.mark.alone]

INSIDE = "document.querySelector('#viser').contentWindow?.__viserMutable"
FLOOR = -load_robot("deltawalker").sole_depth
BOXES = """(selector) => [...document.querySelectorAll(selector)].filter((it) => it.offsetWidth).map((it) => {
  const { x, y, width, height } = it.getBoundingClientRect();
  return { text: it.textContent, x: x + width / 2, y: y + height / 2, width, height };
})"""
"""Middles and sizes of what a selector finds, px of the window."""
FEET = f"""() => {{
  const {{ camera, nodeRefFromName: nodes, canvas }} = {INSIDE};
  const frame = document.querySelector("#viser").getBoundingClientRect();
  const feet = Array.from({{ length: 12 }}, (_, leg) => nodes[`/robot/leg${{leg + 1}}_foot`]).filter(Boolean);
  return feet.map((foot) => {{
    const at = foot.getWorldPosition(camera.position.clone()).project(camera);
    return [frame.x + (at.x + 1) / 2 * canvas.clientWidth, frame.y + (1 - at.y) / 2 * canvas.clientHeight];
  }});
}}"""
"""Where the client's own camera sees each foot, px of the window."""
PLACE = f"{INSIDE}.camera.position.toArray()"
CAMERA = f"() => {PLACE}"
"""The client's y points up."""


def wait_for_scene(page: Page) -> None:
    page.wait_for_function(f"() => {INSIDE}?.nodeRefFromName['/overlay/com']?.visible === true")
    page.wait_for_function("() => document.querySelector('.foot-label')?.offsetWidth > 0")


def settle(page: Page) -> None:
    """Waits until the client has handled its messages and the labels have followed."""
    page.wait_for_function(f"() => {INSIDE}.messageQueue.length === 0")
    page.evaluate("() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")


@pytest.fixture
def page(browser: Browser, studio: StudioProcess) -> Iterator[Page]:
    with opened_page(browser, studio.url, 1440, 900, has_scene=True) as opened:
        wait_for_scene(opened)
        settle(opened)
        yield opened


def play_until_lifted(page: Page) -> None:
    """Moves the playhead on to where a foot is in the air."""
    for _ in range(30):
        page.keyboard.press("ArrowRight")
        settle(page)
        if any("↑" in text for text in page.locator(".foot-label").all_inner_texts()):
            return
    raise AssertionError("no label says that its foot is lifted")


def boxes(page: Page, selector: str) -> list[dict[str, Any]]:
    found: list[dict[str, Any]] = page.evaluate(BOXES, selector)
    return found


def require_apart(found: list[dict[str, Any]]) -> None:
    for index, a in enumerate(found):
        for b in found[index + 1 :]:
            across = abs(a["x"] - b["x"]) - (a["width"] + b["width"]) / 2
            along = abs(a["y"] - b["y"]) - (a["height"] + b["height"]) / 2
            assert max(across, along) > -1, f"{a} lies over {b}"


def require_labels_beside_feet(page: Page) -> None:
    labels, feet = boxes(page, ".foot-label"), page.evaluate(FEET)
    assert len(labels) == len(feet)
    for label, (x, y) in zip(labels, feet, strict=True):
        assert hypot(label["x"] - x, label["y"] - y) < 110, f"{label} is far from its foot at {x}, {y}"
    require_apart([*labels, *boxes(page, ".walk-text"), *boxes(page, "#legend"), *boxes(page, "#view-cube")])


def test_each_foot_has_its_label_which_follows_it_and_says_that_it_is_lifted(page: Page) -> None:
    texts = page.locator(".foot-label")
    expect(texts).to_have_text(["1 FR", "2 FL", "3 BL", "4 BR"])
    require_labels_beside_feet(page)
    before = boxes(page, ".foot-label")
    play_until_lifted(page)
    expect(page.locator("#legend")).to_contain_text("in the air:")
    settle(page)
    require_labels_beside_feet(page)
    assert any(
        hypot(a["x"] - b["x"], a["y"] - b["y"]) > 3
        for a, b in zip(before, boxes(page, ".foot-label"), strict=True)
    )
    assert page.locator("#scene-labels").get_attribute("aria-hidden") == "true"
    assert page.locator("#scene-labels").evaluate("(one) => getComputedStyle(one).pointerEvents") == "none"


@pytest.mark.parametrize(("gait", "legs"), [("Hexapod tripod", 6), ("Dodecapod, nine limbs 1", 12)])
def test_many_feet_have_short_labels_that_lie_apart(page: Page, gait: str, legs: int) -> None:
    choose(page, gait)
    page.wait_for_function(f"() => {INSIDE}?.nodeRefFromName['/robot/leg{legs}_foot']")
    wait_for_scene(page)
    page.wait_for_function(f"() => document.querySelectorAll('.foot-label').length === {legs}")
    settle(page)
    assert [text.rstrip(" ↑") for text in page.locator(".foot-label").all_inner_texts()] == [
        str(foot + 1) for foot in range(legs)
    ]
    require_labels_beside_feet(page)


def test_the_arrow_says_the_step_of_the_present_edit(page: Page) -> None:
    words = page.locator(".walk-text")
    expect(words).to_have_text("Walks 10 mm a step")
    step = page.get_by_role("spinbutton", name="Step", exact=True)
    step.fill("12.5")
    step.press("Enter")
    expect(words).to_have_text("Walks 12.5 mm a step")
    turn = page.get_by_role("spinbutton", name="Turn", exact=True)
    turn.fill("-3")
    turn.press("Enter")
    expect(words).to_have_text("Walks 12.5 mm, turns 3° right a step")
    step.fill("30")
    step.press("Enter")
    expect(page.locator("#badge")).to_contain_text("No motion")
    expect(words).to_have_text("Goal: 30 mm, 3° right a step")
    expect(page.locator("#guides")).to_have_attribute("data-grey", "")
    expect(page.locator("#foot-labels")).to_have_attribute("data-grey", "")
    expect(page.locator("#legend")).not_to_contain_text("margin")
    for _ in range(3):
        page.get_by_role("button", name="Undo").click()
    expect(words).to_have_text("Walks 10 mm a step")
    expect(page.locator("#legend")).to_contain_text("margin")


def test_the_bar_on_the_floor_is_as_long_as_10_mm_are_there(page: Page) -> None:
    expect(page.locator(".scale-text")).to_have_text("10 mm")
    bar = page.locator(".scale-bar").evaluate(
        """(bar) => {
          const [x1, y1, x2, y2] = bar.getAttribute("d").match(/[\\d.]+/g).map(Number);
          const stage = document.querySelector(".stage").getBoundingClientRect();
          return [[stage.x + x1, stage.y + y1], [stage.x + x2, stage.y + y2]];
        }"""
    )
    places = page.evaluate(
        f"""([places, floor]) => {{
          const {{ camera, canvas }} = {INSIDE};
          const frame = document.querySelector("#viser").getBoundingClientRect();
          return places.map(([x, y]) => {{
            const [across, along] = [(x - frame.x) / canvas.clientWidth, (y - frame.y) / canvas.clientHeight];
            const eye = camera.position.clone();
            const way = eye.clone().set(2 * across - 1, 1 - 2 * along, 0.5).unproject(camera).sub(eye);
            return eye.clone().addScaledVector(way, (floor - eye.y) / way.y).toArray();
          }});
        }}""",
        [bar, FLOOR],
    )
    assert hypot(*(a - b for a, b in zip(*places, strict=True))) == pytest.approx(0.01, rel=0.02)


def test_the_legend_says_the_margin_at_the_playhead(page: Page) -> None:
    legend = page.locator("#legend")
    expect(legend).to_contain_text("area between standing feet")
    expect(legend).to_contain_text("centre of mass")
    margins = []
    for _ in range(30):
        margins.append(float(legend.locator(".legend-margin").inner_text().split()[1]))
        page.keyboard.press("ArrowRight")
        settle(page)
    assert max(margins) > 20
    verdict = re.search(r"margin ([\d.]+) mm", page.get_by_role("status", name="Verdict").inner_text())
    assert verdict is not None
    assert min(margins) == pytest.approx(float(verdict[1]), abs=0.11)


def test_the_camera_never_comes_below_the_floor(page: Page) -> None:
    box = page.locator("#viser").bounding_box()
    assert box is not None
    x, y = box["x"] + box["width"] * 0.2, box["y"] + box["height"] / 2
    for button in ("left", "right"):
        page.mouse.move(x, y)
        page.mouse.down(button="left" if button == "left" else "right")
        for part in range(8):
            page.mouse.move(x, y - 90 * part if button == "left" else y - 40 * part)
            settle(page)
            assert page.evaluate(CAMERA)[1] > FLOOR, button
        page.mouse.up(button="left" if button == "left" else "right")
        page.keyboard.press("Escape")
    target = page.evaluate(f"() => {INSIDE}.cameraControl.getTarget().toArray()")
    assert target[1] >= FLOOR - 1e-6


def test_the_view_is_fitted_again_when_the_stage_has_another_size(page: Page) -> None:
    def spread() -> tuple[float, float]:
        feet = page.evaluate(FEET)
        stage = page.locator(".stage").bounding_box()
        assert stage is not None
        for x, y in feet:
            assert stage["x"] < x < stage["x"] + stage["width"]
            assert stage["y"] < y < stage["y"] + stage["height"]
        return max(x for x, _ in feet) - min(x for x, _ in feet), stage["width"]

    moved = f"Math.hypot(...{PLACE}.map((at, axis) => at - before[axis]))"
    spread()
    before = page.evaluate(CAMERA)
    page.set_viewport_size({"width": 1440, "height": 1800})
    page.wait_for_function(f"(before) => {moved} > 0.02", arg=before)
    settle(page)
    across, wide = spread()
    assert 0.2 * wide < across < 0.9 * wide
    page.set_viewport_size({"width": 1440, "height": 900})
    page.wait_for_function(f"(before) => {moved} < 0.005", arg=before)


def test_the_cube_turns_the_view_by_pointer_and_by_keys(page: Page) -> None:
    cube = page.get_by_role("group", name="View from")
    cube.get_by_role("button", name="Top view").click()
    page.wait_for_function(f"() => {{ const [x, y, z] = {PLACE}; return y > 10 * Math.hypot(x, z); }}")
    settle(page)
    expect(page.locator(".scale-text")).to_be_visible()
    cube.get_by_role("button", name="Top view").focus()
    page.keyboard.press("ArrowRight")
    expect(cube.get_by_role("button", name="Front view")).to_be_focused()
    page.keyboard.press("Enter")
    # In front of a robot that looks along x = y: the client has x as -z, y as -x.
    page.wait_for_function(f"() => {{ const [x, y, z] = {PLACE}; return y < 0.2 && x < -0.1 && z < -0.1; }}")
    settle(page)
    face = cube.get_by_role("button", name="Front view").bounding_box()
    assert face is not None
    assert face["width"] > 40
    expect(page.locator(".scale-text")).to_be_hidden()
    cube.get_by_role("button", name="Perspective view").click()
    expect(page.locator(".scale-text")).to_be_visible()


def test_layers_are_shown_and_hidden_by_the_menu_and_kept(page: Page) -> None:
    def press(entry: str) -> None:
        page.get_by_role("button", name="Show", exact=True).click()
        page.get_by_role("menuitemcheckbox", name=entry, exact=True).click()
        page.keyboard.press("Escape")

    shadow = f"{INSIDE}.nodeRefFromName['/overlay/contact_shadow'].visible"
    page.wait_for_function(f"() => {shadow} === true")
    press("Labels")
    expect(page.locator("#foot-labels")).to_be_hidden()
    expect(page.locator(".legend-feet")).to_be_visible()
    press("Arrow and scale")
    expect(page.locator(".walk-text")).to_be_hidden()
    press("Contact shadows")
    page.wait_for_function(f"() => {shadow} === false")
    press("Support polygon")
    expect(page.locator(".legend-area")).to_be_hidden()
    page.reload()
    page.wait_for_function(f"() => {INSIDE}?.nodeRefFromName['/overlay/com']?.visible === true")
    expect(page.locator("#foot-labels")).to_be_hidden()
    for entry in ("Labels", "Arrow and scale", "Contact shadows", "Support polygon"):
        press(entry)
    expect(page.locator(".walk-text")).to_be_visible()


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_assistive_tools_find_nothing_wrong(page: Page, scheme: str) -> None:
    page.emulate_media(color_scheme="dark" if scheme == "dark" else "light")
    page.get_by_role("group", name="View from").get_by_role("button", name="Top view").focus()
    page.keyboard.press("ArrowLeft")
    page.keyboard.press("ArrowLeft")
    settle(page)
    found = Axe().run(page, context={"include": [[".stage"]], "exclude": [["#viser"]]}).response["violations"]
    assert [(rule["id"], [node["target"] for node in rule["nodes"]]) for rule in found] == []
