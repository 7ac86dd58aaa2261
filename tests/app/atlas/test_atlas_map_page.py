"""The map of an atlas in a browser that has no network: axes, front, keys, filters, and the chosen gait."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page, expect

from app.atlas.atlas_file import AtlasFile
from app.atlas.front import atlas_front
from app.atlas.map_page import map_page
from core.atlas.row import RowStatus
from tests.app.atlas.map_atlas import invented_atlas
from tests.support.page.axe import require_no_finding

SIZES = ((1440, 900), (820, 1180), (390, 844))
AXES = (
    ("least_margin", "speed"),
    ("margin", "speed"),
    ("stop_seconds", "speed"),
    ("seconds", "stroke_use"),
    ("turn_rate", "least_margin"),
    ("step_x", "height"),
)
LEAST_TARGET = 44
LEFT, RIGHT, TOP, BOTTOM = 58, 18, 14, 44
"""Around the plot, px, as in app/atlas/page/plot.js."""


@pytest.fixture(scope="module")
def atlas(tmp_path_factory: pytest.TempPathFactory) -> Iterator[AtlasFile]:
    made = invented_atlas(tmp_path_factory.mktemp("map") / "some.sqlite")
    yield made
    made.close()


@pytest.fixture(scope="module")
def file(atlas: AtlasFile) -> Path:
    path = atlas.path.with_name("some.html")
    path.write_text(map_page(atlas))
    return path


@pytest.fixture
def page(browser: Browser, file: Path) -> Iterator[Page]:
    context = browser.new_context(viewport={"width": 1440, "height": 900}, offline=True)
    opened = context.new_page()
    errors: list[str] = []
    asked: list[str] = []
    opened.on("console", lambda message: errors.append(message.text) if message.type == "error" else None)
    opened.on("pageerror", lambda error: errors.append(str(error)))
    opened.on("request", lambda request: asked.append(request.url))
    opened.goto(file.as_uri())
    yield opened
    assert errors == []
    assert asked == [file.as_uri()]
    context.close()


def front(page: Page) -> list[int]:
    """Numbers of the gaits in the table."""
    return [int(text) for text in page.locator("#front tbody button").all_inner_texts()]


def chosen(page: Page) -> str:
    return page.locator("#gait-title").inner_text()


def test_its_front_is_that_of_the_command_line_for_any_axes(page: Page, atlas: AtlasFile) -> None:
    for x, y in AXES:
        page.get_by_label("Horizontal axis").select_option(x)
        page.get_by_label("Vertical axis").select_option(y)
        rows = [row for row, _ in atlas_front(atlas, x, y)]
        listed = [row.number for row in sorted(rows, key=lambda row: (-row.speed, row.number))]
        assert front(page) == listed, (x, y)
        assert page.locator("#front-count").inner_text().startswith(f"{len(rows)} gait")


def test_arrow_keys_walk_the_front(page: Page) -> None:
    listed = front(page)
    assert len(listed) > 3
    page.get_by_role("application", name="Map of 200 gaits").focus()
    page.keyboard.press("ArrowDown")  # the uppermost of the front is the fastest
    assert chosen(page) == f"Gait {listed[0]}"
    expect(page.locator("#card")).to_contain_text("On the front")
    page.keyboard.press("ArrowRight")
    assert chosen(page) == f"Gait {listed[1]}"
    page.keyboard.press("End")
    assert chosen(page) == f"Gait {listed[-1]}"
    expect(page.get_by_role("status")).to_contain_text(f"Gait {listed[-1]}: Foot order")
    page.keyboard.press("Escape")
    expect(page.locator("#gait-title")).to_have_text("No gait chosen")
    expect(page.locator("#card")).to_be_hidden()


def test_the_table_is_one_stop_of_tab_with_arrow_keys(page: Page) -> None:
    listed = front(page)
    assert page.locator("#front tbody button[tabindex='0']").count() == 1
    page.get_by_role("button", name=str(listed[0]), exact=True).focus()
    page.keyboard.press("ArrowDown")
    assert chosen(page) == f"Gait {listed[1]}"
    second = page.get_by_role("button", name=str(listed[1]), exact=True)
    expect(second).to_be_focused()
    expect(second).to_have_attribute("aria-pressed", "true")


def test_a_chosen_gait_shows_its_figures_and_the_command_that_opens_it(page: Page, atlas: AtlasFile) -> None:
    number = front(page)[0]
    row, parameters = atlas.entry(number)
    page.get_by_role("row", name=f"{number} {parameters['order'].replace(',', '-')}").click()
    details = page.get_by_role("region", name=f"Gait {number}")
    expect(details.locator("#figures")).to_contain_text(f"{row.speed * 1000:.2f} mm/s")
    expect(details.locator("#parameters")).to_contain_text(f"{parameters['height'] * 1000:.1f} mm")
    expect(details.locator("code")).to_have_text(f"footfall atlas open {atlas.path} {number} -o gait.json")
    page.context.grant_permissions(["clipboard-read", "clipboard-write"])
    details.get_by_role("button", name="Copy").click()
    expect(details.get_by_role("button")).to_have_text("Copied")
    copied = page.evaluate("navigator.clipboard.readText()")
    assert copied == f"footfall atlas open {atlas.path} {number} -o gait.json"


def place(page: Page, atlas: AtlasFile, number: int) -> tuple[float, float]:
    """Where a gait's dot is on the screen, px: margin across, speed upwards, and 4 % of room at each end."""
    box = page.locator("#map").bounding_box()
    assert box is not None
    rows = list(atlas.rows(RowStatus.SOLVED))

    def share(name: str) -> float:
        known = [float(getattr(row, name)) for row in rows]
        room = 0.04 * (max(known) - min(known))
        low = min(known) - room
        return (float(getattr(atlas.entry(number)[0], name)) - low) / (max(known) + room - low)

    across, up = share("least_margin"), share("speed")
    width, height = box["width"] - LEFT - RIGHT, box["height"] - TOP - BOTTOM
    return box["x"] + LEFT + across * width, box["y"] + TOP + (1 - up) * height


def test_pointing_shows_a_gait_and_a_click_keeps_it(page: Page, atlas: AtlasFile) -> None:
    fastest = front(page)[0]
    page.mouse.move(*place(page, atlas, fastest))
    expect(page.locator("#card")).to_contain_text(f"Gait {fastest}")
    assert chosen(page) == "No gait chosen"
    page.mouse.down()
    page.mouse.up()
    assert chosen(page) == f"Gait {fastest}"
    page.mouse.move(10, 10)
    expect(page.locator("#card")).to_be_hidden()
    assert chosen(page) == f"Gait {fastest}"


def test_filters_narrow_the_map_and_its_front(page: Page, atlas: AtlasFile) -> None:
    page.get_by_label("Speed, mm/s, to").fill("2")
    page.get_by_role("combobox", name="Foot order", exact=True).select_option("1-3-2-4")
    kept = [
        row.number
        for row, parameters in atlas.entries(RowStatus.SOLVED)
        if row.speed <= 0.002 and parameters["order"] == "1,3,2,4"
    ]
    expect(page.locator("#shown")).to_have_text(f"{len(kept)} of 200 solved shown")
    assert set(front(page)) <= set(kept)
    page.get_by_label("Speed, mm/s, from").fill("9")
    expect(page.locator("#empty")).to_be_visible()
    page.get_by_role("button", name="Show all gaits").click()
    expect(page.locator("#shown")).to_have_text("200 of 200 solved shown")
    expect(page.locator("#empty")).to_be_hidden()


def test_colours_follow_a_choice_or_a_range(page: Page) -> None:
    expect(page.get_by_role("list", name="Colours").get_by_role("listitem")).to_have_count(6)
    page.get_by_label("Colour by").select_option("height")
    expect(page.get_by_role("list", name="Colours").get_by_role("listitem")).to_have_count(1)


@pytest.mark.heavy
@pytest.mark.parametrize("size", SIZES)
def test_axe_finds_nothing_and_nothing_lies_beside_the_screen(page: Page, size: tuple[int, int]) -> None:
    page.set_viewport_size({"width": size[0], "height": size[1]})
    page.locator("#front tbody tr").nth(1).click()
    page.locator("details").evaluate("(filters) => { filters.open = true; }")
    require_no_finding(page, f"map at {size[0]} px")
    assert page.evaluate("document.documentElement.scrollWidth") == size[0]
    if size[0] < SIZES[0][0]:
        boxes = page.locator("button, select, input, summary, header a").evaluate_all(
            "(all) => all.map((one) => [one.id || one.textContent, one.getBoundingClientRect().height])"
        )
        assert [name for name, height in boxes if height < LEAST_TARGET] == []


def test_an_atlas_without_a_solved_gait_says_so(browser: Browser, tmp_path: Path) -> None:
    atlas = invented_atlas(tmp_path / "none.sqlite", solved=0, failed=0)
    (tmp_path / "none.html").write_text(map_page(atlas))
    context = browser.new_context(offline=True)
    opened = context.new_page()
    opened.goto((tmp_path / "none.html").as_uri())
    expect(opened.get_by_text("No gait of this atlas is solved")).to_be_visible()
    expect(opened.get_by_role("heading", name="Why gaits are infeasible")).to_be_visible()
    require_no_finding(opened, "an empty atlas")
    context.close()
