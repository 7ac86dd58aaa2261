"""The one-file page in a browser that has no network: it plays, scrubs and turns."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page, expect

from app.export.formats import ExportFormat, export
from app.export.source import exportable_plan
from app.plans.make_plan import make_plan
from core.library.library import library
from solver_jobs import solve_live
from tests.support.studio_process import wait_for


@pytest.fixture(scope="module")
def file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    gait = library()["walk"].gait
    source = exportable_plan("walk", gait, make_plan(gait, None, solve_live))
    path = tmp_path_factory.mktemp("share") / "walk.html"
    path.write_bytes(export(source, ExportFormat.HTML).content)
    return path


@pytest.fixture
def page(browser: Browser, file: Path) -> Iterator[Page]:
    context = browser.new_context(
        viewport={"width": 1280, "height": 900}, offline=True, reduced_motion="reduce"
    )
    opened = context.new_page()
    errors: list[str] = []
    asked: list[str] = []
    opened.on("console", lambda message: errors.append(message.text) if message.type == "error" else None)
    opened.on("pageerror", lambda error: errors.append(str(error)))
    opened.on("request", lambda request: asked.append(request.url))
    opened.goto(file.as_uri())
    expect(opened.locator("#clock")).not_to_be_empty()
    yield opened
    assert errors == []
    assert asked == [file.as_uri()]
    context.close()


def shown_colours(page: Page) -> int:
    count: int = page.evaluate(
        """() => {
          const stage = document.getElementById("stage");
          const { data } = stage.getContext("2d").getImageData(0, 0, stage.width, stage.height);
          return new Set(new Uint32Array(data.buffer)).size;
        }"""
    )
    return count


def picture(page: Page) -> str:
    url: str = page.evaluate("() => document.getElementById('stage').toDataURL()")
    return url


def test_it_opens_still_where_motion_is_not_wanted_and_shows_the_robot(page: Page) -> None:
    expect(page.get_by_role("heading", name="Walk 10 mm")).to_be_visible()
    expect(page.get_by_role("button", name="Play")).to_be_visible()
    expect(page.locator("#clock")).to_have_text("0.00 / 17.6 s")
    expect(page.locator("#margin")).to_contain_text("Stability margin")
    assert shown_colours(page) > 200


def test_play_moves_the_robot_and_pause_stops_it(page: Page) -> None:
    page.get_by_label("Speed").select_option("10")
    page.get_by_role("button", name="Play").click()
    wait_for(lambda: float(page.get_by_label("Time").input_value()) > 2, "playing has passed 2 s")
    page.get_by_role("button", name="Pause").click()
    expect(page.get_by_role("button", name="Play")).to_be_visible()
    stopped = page.locator("#clock").inner_text()
    page.evaluate("() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")
    assert page.locator("#clock").inner_text() == stopped


def test_keys_step_by_knots_and_the_margin_follows(page: Page) -> None:
    page.keyboard.press("ArrowRight")
    expect(page.locator("#clock")).to_contain_text("0.40 /")
    page.keyboard.press("Shift+ArrowRight")
    expect(page.locator("#clock")).to_contain_text("4.40 /")
    page.keyboard.press("ArrowLeft")
    expect(page.locator("#clock")).to_contain_text("4.00 /")
    page.keyboard.press("End")
    expect(page.locator("#clock")).to_contain_text("17.60 /")
    page.keyboard.press("ArrowRight")
    expect(page.locator("#clock")).to_contain_text("17.60 /")
    page.keyboard.press("Home")
    expect(page.locator("#clock")).to_contain_text("0.00 /")


def test_a_click_on_the_diagram_goes_to_that_sample(page: Page) -> None:
    area = page.locator("#diagram svg").bounding_box()
    assert area is not None
    sample = 12
    x = area["x"] + area["width"] * (104 + 940 * (sample + 0.5) / 45) / 1120
    page.mouse.click(x, area["y"] + area["height"] / 2)
    wait_for(lambda: float(page.get_by_label("Time").input_value()) > 0, "the sample is shown")
    assert float(page.get_by_label("Time").input_value()) == pytest.approx(sample * 0.4, abs=0.05)


def test_dragging_turns_the_view_and_the_button_brings_it_back(page: Page) -> None:
    before = picture(page)
    page.mouse.move(500, 300)
    page.mouse.down()
    page.mouse.move(620, 260)
    page.mouse.up()
    wait_for(lambda: picture(page) != before, "another picture")
    page.get_by_role("button", name="Reset view").click()
    wait_for(lambda: picture(page) == before, "the first picture again")


def test_the_same_moment_is_the_same_picture_however_often_it_is_painted(page: Page) -> None:
    resized = """() => new Promise((done) => {
      const stage = document.getElementById("stage");
      stage.width += 1; // another size begins with a new pen, and is set right by the next painting
      document.getElementById("home").click();
      requestAnimationFrame(() => done(stage.toDataURL()));
    })"""
    first = page.evaluate(resized)
    page.get_by_role("button", name="Reset view").click()
    page.evaluate("() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")
    assert picture(page) == first


def test_the_body_can_be_taken_away_to_see_what_is_below(page: Page) -> None:
    before = picture(page)
    body = page.get_by_role("button", name="Body")
    body.click()
    expect(body).to_have_attribute("aria-pressed", "false")
    wait_for(lambda: picture(page) != before, "another picture")
    body.click()
    wait_for(lambda: picture(page) == before, "the first picture again")
