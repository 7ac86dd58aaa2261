"""The strip plots under the timeline: which are shown, what they say, and how finely they are drawn."""

from __future__ import annotations

import csv
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import pytest
from playwright.sync_api import Browser, Locator, Page, expect

from tests.support.page.opened import opened_page
from tests.support.studio_process import StudioProcess, wait_for

SHARES_STUDIO = True

LONGEST_DRAWING_MS = 50.0
FOUR_FEET = {"foot-1", "foot-2", "foot-3", "foot-4"}

DRAW = """async ([legs, samples]) => {
  const { createStore } = await import("/static/state/store.js");
  const { mountPlots } = await import("/static/plots/plots.js");
  const store = createStore();
  document.querySelector("#plots").replaceChildren();
  mountPlots(store);
  const list = (count, of) => Array.from({ length: count }, (_, at) => of(at));
  const wave = (index, at) => 10 + 8 * Math.sin(index / 9 + at);
  const rows = (count, of) => list(samples, (index) => list(count, (at) => of(index, at)));
  const plan = (shift) => ({
    hash: String(shift), note: "", times: list(samples, (index) => 0.4 * index),
    margin: list(samples, (index) => wave(index, 0) / 1000),
    feet: rows(legs, (index, at) => [0, 0, wave(index, at + shift) / 1000]),
    strokes_mm: rows(3 * legs, wave), stroke_limits_mm: [0.5, 19.5],
    foot_speeds_mm_s: rows(legs, wave), motor_speeds_mm_s: rows(3 * legs, wave),
    motor_speed_limit_mm_s: 15,
  });
  const timeline = { sample_time: 0.4, feet: list(legs, () => "1".repeat(samples)) };
  const gait = { timeline, options: { foot_speed: 0.015 } };
  const frame = () => new Promise((done) => requestAnimationFrame(done));
  for (let frames = 0; frames < 3; frames += 1) await frame(); // until every strip knows its size
  const times = [];
  for (let round = 0; round < 7; round += 1) {
    const begun = performance.now();
    store.set({ view: { id: "x", plan: plan(round), document: gait } });
    await null;
    document.querySelector("#plots").getBoundingClientRect();
    times.push(performance.now() - begun);
  }
  return times.sort((a, b) => a - b);
}"""
PAINTED = """(strip) => {
  const canvas = strip.querySelector("canvas");
  if (!canvas || canvas.width * canvas.height === 0) return {};
  const style = getComputedStyle(document.documentElement);
  const names = ["--good", "--bad", ...Array.from({ length: 12 }, (_, foot) => `--foot-${foot + 1}`)];
  const parts = (hex) => [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16));
  const colours = names.map((name) => parts(style.getPropertyValue(name).trim()));
  const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
  const rows = {};
  for (let at = 0; at < data.length; at += 4) {
    if (data[at + 3] < 200) continue;
    const isNear = (part, axis) => Math.abs(part - data[at + axis]) <= 4;
    const near = colours.findIndex((colour) => colour.every(isNear));
    const row = Math.floor(at / 4 / canvas.width) / canvas.height;
    if (near >= 0) (rows[names[near].slice(2)] ??= new Set()).add(row);
  }
  return Object.fromEntries(Object.entries(rows).map(([name, found]) => [name, [...found]]));
}"""
"""Rows of the canvas, 0 at the top to 1, in which each colour is painted."""
BANDS = """(strip) => {
  const canvas = strip.querySelector("canvas");
  if (!canvas || canvas.width * canvas.height === 0) return 0;
  const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, 1);
  return data.filter((_, at) => at % 4 === 3).filter((alpha) => alpha > 20 && alpha < 80).length;
}"""
"""Columns whose topmost pixel is tinted."""
FOOT_SPEED_LIMIT = """async ([document, parts]) => {
  const { STRIPS } = await import("/static/plots/strips.js");
  const { of } = STRIPS.find(({ key }) => key === "foot_speeds");
  return of({ foot_speeds_mm_s: [[1]], parts }, document).high;
}"""


@pytest.fixture
def page(browser: Browser, studio: StudioProcess) -> Iterator[Page]:
    with opened_page(browser, studio.url, 1280, 720) as opened:
        wait_for(lambda: "good" in painted(opened, "margin"), "the margin is drawn")
        yield opened


def strip(page: Page, key: str) -> Locator:
    return page.locator(f'.strip[data-strip="{key}"]')


def painted(page: Page, key: str) -> dict[str, list[float]]:
    """Rows of a strip, 0 at the top to 1, in which each colour of the theme is painted."""
    rows: dict[str, list[float]] = strip(page, key).evaluate(PAINTED)
    return rows


def feet_painted(page: Page, key: str) -> set[str]:
    return {name for name in painted(page, key) if name.startswith("foot-")}


def show(page: Page, *names: str) -> None:
    page.get_by_role("button", name="Plots").click()
    for name in names:
        page.get_by_role("menuitemcheckbox", name=name).click()
    page.keyboard.press("Escape")


@pytest.mark.heavy
def test_three_strips_are_shown_at_first_and_a_choice_outlasts_a_reload(page: Page) -> None:
    expect(page.locator(".strip:visible")).to_have_count(3)
    show(page, "Motor speeds", "Strokes")
    wait_for(lambda: feet_painted(page, "motor_speeds") == FOUR_FEET, "four feet are drawn")
    expect(strip(page, "strokes")).to_be_hidden()
    page.reload()
    wait_for(lambda: feet_painted(page, "motor_speeds") == FOUR_FEET, "four feet are drawn")
    expect(strip(page, "strokes")).to_be_hidden()


def test_the_menu_is_used_by_keyboard_alone(page: Page) -> None:
    button = page.get_by_role("button", name="Plots")
    button.focus()
    page.keyboard.press("ArrowDown")
    page.keyboard.press("End")
    expect(page.get_by_role("menuitemcheckbox", name="Motor speeds")).to_be_focused()
    page.keyboard.press("ArrowUp")
    page.keyboard.press(" ")
    expect(strip(page, "foot_speeds")).to_be_visible()
    page.keyboard.press("Escape")
    expect(page.get_by_role("menu", name="Plots")).to_be_hidden()
    expect(button).to_be_focused()


def test_every_strip_says_its_range_and_its_limits(page: Page) -> None:
    show(page, "Foot speeds", "Motor speeds")
    words = re.compile(r"^Foot speeds: 0\.0 to [1-9][0-9.]* mm/s, limit 15\.0")
    expect(strip(page, "foot_speeds")).to_have_attribute("aria-label", words)
    both = re.compile(r"^Strokes: [0-9.]+ to [0-9.]+ mm, limits 0\.5 and 19\.5")
    expect(strip(page, "strokes")).to_have_attribute("aria-label", both)


def test_the_limit_of_the_foot_speeds_is_the_own_one_of_a_computed_motion(page: Page) -> None:
    slow, fast, own = ({"options": {"foot_speed": speed}} for speed in (0.01, 0.03, 0.04))
    by_hand = {**slow, "segment_table": {}}
    stay, between = {"is_transition": False}, {"is_transition": True}

    def limit(document: dict[str, Any], *parts: dict[str, bool]) -> float | None:
        found: float | None = page.evaluate(FOOT_SPEED_LIMIT, [document, parts])
        return found

    def sequence(*gaits: dict[str, Any]) -> dict[str, Any]:
        return {**own, "sequence": [{"gait": gait} for gait in gaits]}

    assert limit(fast) == 30.0
    assert [limit({**fast, word: {}}) for word in ("segment_table", "recorded", "poses")] == [None] * 3
    assert limit(sequence(slow, fast), stay, stay) == 30.0
    assert limit(sequence(slow, fast), stay, between, stay) == 40.0
    assert limit(sequence(slow, by_hand), stay, between, stay) is None


def test_the_pointer_reads_the_values_of_all_feet_and_both_times(page: Page) -> None:
    strip(page, "heights").scroll_into_view_if_needed()
    box = strip(page, "heights").bounding_box()
    assert box is not None
    # Foot 3 is at its highest at 2.8 s; a sample's column is 1/45 of the strip.
    page.mouse.move(box["x"] + box["width"] * 7.5 / 45, box["y"] + 3)
    card = page.locator(".plot-card")
    expect(card).to_contain_text(re.compile(r"2\.80 s plan\s*[0-9.]+ s on the robot"))
    rows = card.locator("tbody tr")
    expect(rows).to_have_count(4)
    expect(rows.nth(2)).to_have_text(re.compile(r"^ ?3 \w+3\.0[0-9.]{9,}$"))
    expect(rows.nth(2)).to_have_attribute("data-near", "")
    expect(rows.nth(0)).to_contain_text("down")
    expect(card).to_contain_text(re.compile(r"Margin[0-9.]+ mm"))
    page.mouse.move(box["x"] + box["width"] / 2, 20)
    expect(card).to_be_hidden()


@pytest.mark.heavy
def test_what_passes_a_limit_is_drawn_in_the_bad_colour(page: Page, studio: StudioProcess) -> None:
    assert "bad" not in painted(page, "strokes")
    document: dict[str, Any] = studio.ask("GET", "/api/gaits/walk").content
    answer = studio.ask("PUT", "/api/gaits/walk?label=Too%20far", {**document, "step": [0.04, 0.04, 0.0]})
    assert answer.status == 200
    wait_for(lambda: "bad" in painted(page, "strokes"), "a stroke passes its limit")
    assert studio.ask("POST", "/api/gaits/walk/undo").status == 200
    wait_for(lambda: "bad" not in painted(page, "strokes"), "every stroke keeps its limits")


def test_a_plot_is_at_least_72_pixels_high_with_ticks_and_named_limits(page: Page) -> None:
    for key in ("margin", "strokes", "heights"):
        box = strip(page, key).bounding_box()
        assert box is not None
        assert box["height"] >= 72
    expect(page.locator(".plot-ticks").first.locator("span")).not_to_have_count(0)
    expect(strip(page, "strokes")).to_contain_text(re.compile(r"limit 19\.5 ?↑.*limit 0\.5"))
    expect(strip(page, "margin")).to_contain_text("asked 6")


@pytest.mark.heavy
def test_a_plot_is_saved_as_picture_and_as_values_in_one_click(page: Page, tmp_path: Path) -> None:
    saved = {}
    for form in ("SVG", "PNG", "CSV"):
        with page.expect_download() as download:
            page.get_by_role("button", name=f"Save Strokes as {form}").click()
        saved[form] = tmp_path / download.value.suggested_filename
        download.value.save_as(saved[form])
    assert saved["SVG"].name == "Walk 10 mm strokes.svg"
    drawing = ElementTree.parse(saved["SVG"]).getroot()
    assert len(drawing.findall(".//{*}path")) == 12
    words = {text.text for text in drawing.findall(".//{*}text")}
    assert {"Strokes, mm", "Walk 10 mm", "limit 19.5", "plan, s"} <= words
    assert saved["PNG"].read_bytes()[:8] == b"\x89PNG\r\n\x1a\n"
    rows = list(csv.reader(saved["CSV"].read_text().splitlines()))
    assert rows[0][:4] == ["curve", "plan_s", "robot_s", "foot 1 motor 1, mm"]
    assert {row[0] for row in rows[1:]} == {"planned"}
    assert len(rows) == 46
    assert all(0.5 <= float(value) <= 19.5 for row in rows[1:] for value in row[3:])


@pytest.mark.heavy
def test_twelve_feet_of_240_samples_are_drawn_at_once(page: Page) -> None:
    show(page, "Foot speeds", "Motor speeds")
    times = page.evaluate(DRAW, [12, 240])
    assert len(feet_painted(page, "foot_speeds")) == 12
    # The quickest of seven: other programs on the machine can only add to it.
    assert times[0] < LONGEST_DRAWING_MS


@pytest.mark.heavy
def test_where_a_stroke_is_not_known_the_strip_is_marked(page: Page, studio: StudioProcess) -> None:
    document: dict[str, Any] = studio.ask("GET", "/api/gaits/walk").content
    far = {**document, "step": [0.12, 0.0, 0.0]}
    assert studio.ask("PUT", "/api/gaits/walk?label=Far%20too%20far", far).status == 200
    wait_for(lambda: strip(page, "strokes").evaluate(BANDS) > 0, "what is not known is marked")
    assert studio.ask("POST", "/api/gaits/walk/undo").status == 200
    wait_for(lambda: strip(page, "strokes").evaluate(BANDS) == 0, "all is known again")


def test_a_grid_has_at_most_a_hundred_lines_a_side(page: Page) -> None:
    said = page.evaluate(
        """async () => {
            const { ground, gridPlaces } = await import("/static/trials/trial_plot.js");
            const drawn = ({ lines, step }) => [lines.length, step];
            const far = (end) => drawn(ground([{ x: [-1.5, end], y: [0, 2] }]));
            return [far(3), far(5000), gridPlaces(-1.5, 2, 1), gridPlaces(-15, 25, 10)];
        }"""
    )
    assert said == [[8, 1], [52, 100], [-1, 0, 1, 2], [-10, 0, 10, 20]]
