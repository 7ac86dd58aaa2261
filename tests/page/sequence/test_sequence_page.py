"""The Sequence section: made, added to, repeated, moved by keys, buttons and drag, taken over, checked."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

import pytest
from playwright.sync_api import Browser, Locator, Page, expect

from tests.support.page.axe import findings
from tests.support.page.opened import opened_page
from tests.support.studio_process import StudioProcess, wait_for

SHARES_STUDIO = True


@pytest.fixture(scope="module")
def page(browser: Browser, studio: StudioProcess) -> Iterator[Page]:
    with opened_page(browser, studio.url, 1280, 800) as opened:
        expect(opened.get_by_label("Gait name")).not_to_have_value("")
        yield opened


@pytest.fixture
def tour(page: Page, studio: StudioProcess, request: pytest.FixtureRequest) -> str:
    """A shown sequence of walk 3×, turn 45°, S-gait 2×; its id."""
    name = re.sub(r"\W+", " ", request.node.name)[:40].strip()
    parts = [{"gait": "walk", "times": 3}, {"gait": "rotate", "times": 3}, {"gait": "s-gait", "times": 2}]
    made = studio.ask("POST", "/api/sequences", {"name": name, "parts": parts}).content
    page.get_by_role("list", name="Gaits").get_by_role("button", name=re.compile(f"^{name}")).click()
    expect(rows(page)).to_have_count(3)
    expect(page.get_by_label("Gait name")).to_have_value(name)
    expect(rows(page).nth(2)).to_contain_text("20.0 mm")
    return str(made["id"])


def rows(page: Page) -> Locator:
    return page.get_by_role("grid", name="Parts of the sequence").get_by_role("row")


def part(page: Page, index: int) -> Locator:
    return page.get_by_role("gridcell", name=re.compile(f"^Part {index} of "))


def sources(studio: StudioProcess, gait: str) -> list[str]:
    document: dict[str, Any] = studio.ask("GET", f"/api/gaits/{gait}").content
    return [one["source"] for one in document["sequence"]]


def becomes(studio: StudioProcess, gait: str, wanted: list[str]) -> None:
    wait_for(lambda: sources(studio, gait) == wanted, f"{gait} has the parts {wanted}")


def undo(page: Page) -> Locator:
    return page.get_by_role("button", name=re.compile("^Undo"))


@pytest.mark.heavy
def test_times_out_of_range_stay_with_the_reason(page: Page, studio: StudioProcess, tour: str) -> None:
    times = page.get_by_label("Times of part 1")
    for typed, sentence in (
        ("99", "Times is 99, but must be a whole number between 1 and 20."),
        ("2.5", "Times is 2.5, but must be a whole number between 1 and 20."),
    ):
        times.fill(typed)
        times.press("Enter")
        expect(rows(page).first.get_by_role("alert")).to_have_text(sentence)
        expect(times).to_have_value(typed)
    times.press("Escape")
    expect(times).to_have_value("3")
    expect(rows(page).first.get_by_role("alert")).to_be_hidden()
    assert studio.ask("GET", f"/api/gaits/{tour}").content["sequence"][0]["times"] == 3


@pytest.mark.heavy
def test_a_sequence_is_made_from_the_shown_gait_and_grows(page: Page, studio: StudioProcess) -> None:
    page.get_by_role("list", name="Gaits").get_by_role("button", name=re.compile("^Rotate 15°")).click()
    expect(page.get_by_label("Gait name")).to_have_value("Rotate 15°, as in the thesis")
    page.get_by_role("button", name="New", exact=True).click()
    page.get_by_role("menuitem", name="New sequence").click()
    expect(rows(page)).to_have_count(1)
    page.get_by_label("Times of part 1").fill("3")
    page.get_by_label("Times of part 1").press("Enter")
    expect(undo(page)).to_contain_text("run Rotate 15°, as in the thesis 3×")
    page.get_by_label("Gait to add").select_option("walk")
    place = page.get_by_role("button", name="Add", exact=True).bounding_box()
    page.get_by_role("button", name="Add", exact=True).click()
    expect(rows(page)).to_have_count(2)
    whole = page.get_by_label("The whole sequence")
    expect(whole).to_contain_text(re.compile("Turn45°"))
    expect(whole).to_contain_text("10.0 mm")
    expect(page.locator("#parts .stretch")).to_have_text(["Rotate 15°, as in the thesis 3×", "Walk 10 mm"])
    assert page.get_by_role("button", name="Add", exact=True).bounding_box() == place
    assert sources(studio, "sequence") == ["rotate", "walk"]


@pytest.mark.heavy
def test_parts_move_by_keys_and_buttons_and_each_move_is_one_undo_step(
    page: Page, studio: StudioProcess, tour: str
) -> None:
    part(page, 1).focus()
    page.keyboard.press("Alt+ArrowDown")
    becomes(studio, tour, ["rotate", "walk", "s-gait"])
    expect(part(page, 2)).to_be_focused()
    expect(undo(page)).to_contain_text("move walk 10 mm to place 2", ignore_case=True)
    rows(page).nth(2).get_by_role("button", name="Move up").click()
    becomes(studio, tour, ["rotate", "s-gait", "walk"])
    undo(page).click()
    becomes(studio, tour, ["rotate", "walk", "s-gait"])
    undo(page).click()
    becomes(studio, tour, ["walk", "rotate", "s-gait"])
    expect(rows(page).first).to_contain_text("Walk 10 mm")


def drag_down(page: Page, index: int) -> None:
    """Takes the first part and moves it to the lower edge of another; it is not let go."""
    part(page, 1).hover(position={"x": 30, "y": 8})
    page.mouse.down()
    end = rows(page).nth(index).bounding_box()
    assert end is not None
    page.mouse.move(end["x"] + 30, end["y"] + end["height"] - 4, steps=5)


def test_a_part_is_dragged_behind_the_last_one(page: Page, studio: StudioProcess, tour: str) -> None:
    drag_down(page, 2)
    expect(rows(page).nth(2)).to_have_attribute("data-after", "")
    page.mouse.up()
    becomes(studio, tour, ["rotate", "s-gait", "walk"])


def test_a_drag_ends_with_escape_and_changes_nothing(page: Page, studio: StudioProcess, tour: str) -> None:
    drag_down(page, 1)
    expect(rows(page).first).to_have_attribute("data-dragged", "")
    page.keyboard.press("Escape")
    page.mouse.up()
    expect(page.locator("[data-dragged]")).to_have_count(0)
    assert sources(studio, tour) == ["walk", "rotate", "s-gait"]


def test_delete_takes_a_part_out_and_the_last_one_stays(page: Page, studio: StudioProcess, tour: str) -> None:
    part(page, 2).focus()
    page.keyboard.press("Delete")
    becomes(studio, tour, ["walk", "s-gait"])
    expect(rows(page)).to_have_count(2)
    rows(page).nth(0).get_by_role("button", name="Take out").click()
    becomes(studio, tour, ["s-gait"])
    last = rows(page).nth(0).get_by_role("button", name="Take out")
    expect(last).to_have_attribute("aria-disabled", "true")
    expect(last).to_have_attribute("title", re.compile("at least one part"))


@pytest.mark.heavy
def test_a_press_meets_its_button_while_another_plan_comes(
    page: Page, studio: StudioProcess, tour: str
) -> None:
    document = studio.ask("GET", f"/api/gaits/{tour}").content
    document["sequence"][0]["gait"]["name"] = "A walk whose name is so long that it takes a second line"
    rows(page).nth(1).get_by_role("button", name="Take out").hover(position={"x": 12, "y": 2})
    page.mouse.down()
    assert studio.ask("PUT", f"/api/gaits/{tour}?label=Longer%20name", document).status == 200
    page.wait_for_timeout(300)
    page.mouse.up()
    becomes(studio, tour, ["walk", "s-gait"])
    expect(part(page, 1)).to_contain_text("second line")


def test_enter_shows_where_a_part_begins(page: Page, tour: str) -> None:
    expect(page.locator("#parts .stretch")).to_have_count(3)
    part(page, 2).focus()
    page.keyboard.press("Enter")
    expect(page.get_by_label("Time", exact=True)).to_contain_text("49.6")


def test_a_changed_source_is_said_and_taken_over(page: Page, studio: StudioProcess, tour: str) -> None:
    walk = studio.ask("GET", "/api/gaits/walk").content
    studio.ask("PUT", "/api/gaits/walk?label=Step", {**walk, "step": [0.004, 0.004, 0.0]})
    expect(rows(page).first).to_contain_text("source changed")
    rows(page).first.get_by_role("button", name="update").click()
    expect(rows(page).first).to_contain_text("live")
    expect(rows(page).first).to_contain_text("17.0 mm")
    studio.ask("POST", "/api/gaits/walk/undo")


def test_nothing_is_painted_on_a_sequence(page: Page, studio: StudioProcess, tour: str) -> None:
    before = studio.ask("GET", f"/api/gaits/{tour}").content
    page.get_by_role("gridcell", name=re.compile("^foot 2, sample 2: ")).click()
    expect(page.get_by_text("You cannot draw in the timeline of a sequence").first).to_be_visible()
    expect(page.get_by_role("grid", name="Footfall timeline")).to_have_attribute("aria-readonly", "true")
    assert studio.ask("GET", f"/api/gaits/{tour}").content == before


@pytest.mark.heavy
def test_what_is_asked_between_parts_is_one_edit(page: Page, studio: StudioProcess, tour: str) -> None:
    page.locator("#sequence").get_by_text("Between parts").click()
    speed = page.get_by_role("spinbutton", name="Body speed between parts")
    speed.fill("8")
    speed.press("Enter")
    expect(undo(page)).to_contain_text("body speed between parts to 8 mm/s", ignore_case=True)
    assert studio.ask("GET", f"/api/gaits/{tour}").content["options"]["body_speed"] == 0.008
    assert findings(page) == []


def test_one_check_is_for_the_whole_sequence(page: Page, tour: str) -> None:
    page.get_by_role("tab", name="Check & approve").click()
    page.get_by_role("button", name="Check", exact=True).click()
    expect(page.get_by_role("status", name="Verdict")).to_contain_text("Checked passed")


def test_a_part_without_a_motion_is_named_on_the_page(page: Page, studio: StudioProcess) -> None:
    walk = studio.ask("GET", "/api/gaits/walk").content
    far = studio.ask("POST", "/api/gaits", {**walk, "name": "Far walk", "step": [0.04, 0.04, 0.0]}).content[
        "id"
    ]
    parts = [{"gait": "rotate"}, {"gait": far}]
    studio.ask("POST", "/api/sequences", {"name": "Too far", "parts": parts})
    page.get_by_role("list", name="Gaits").get_by_role("button", name=re.compile("^Too far")).click()
    expect(rows(page).nth(1)).to_contain_text("no motion")
    expect(page.locator("#sequence").get_by_role("alert")).to_contain_text(
        "Part 2, “Far walk”, has no motion"
    )
    expect(page.locator('#parts [data-source="draft"]')).to_have_text(["Far walk"])
    page.get_by_role("tab", name="Check & approve").click()
    check = page.get_by_role("button", name="Check", exact=True)
    expect(check).to_have_attribute("aria-disabled", "true")
    expect(check).to_have_attribute("title", re.compile("Part 2"))


def trouble(page: Page) -> Locator:
    return page.locator("#sequence").get_by_role("alert").filter(has_text=re.compile("Part|sequence"))


@pytest.mark.heavy
def test_a_part_with_another_sample_time_is_resampled_in_one_click(
    page: Page, studio: StudioProcess, tour: str
) -> None:
    walk = studio.ask("GET", "/api/gaits/walk").content
    walk["timeline"]["sample_time"] = 0.5
    slow = studio.ask("POST", "/api/gaits", {**walk, "name": "Slow walk"}).content["id"]
    page.get_by_label("Gait to add").select_option(slow)
    page.get_by_role("button", name="Add", exact=True).click()
    expect(trouble(page)).to_contain_text("a sequence has one sample time")
    assert sources(studio, tour) == ["walk", "rotate", "s-gait"]
    page.get_by_role("button", name="Resample", exact=True).click()
    becomes(studio, tour, ["walk", "rotate", "s-gait", slow])
    expect(rows(page)).to_have_count(4)
    expect(page.get_by_text("a sample every 0.4 s instead of 0.5 s").first).to_be_visible()
    expect(trouble(page)).to_be_hidden()
    expect(rows(page).nth(3)).to_contain_text("live")
    undo(page).click()
    becomes(studio, tour, ["walk", "rotate", "s-gait"])


def test_gaits_that_cannot_be_parts_are_greyed_with_the_reason(page: Page, tour: str) -> None:
    greyed = page.get_by_label("Gait to add").locator("option:disabled")
    expect(greyed.filter(has_text="(made for the robot's clock)").first).to_be_attached()
    expect(greyed.filter(has_text="(made for the robot ").first).to_be_attached()
    expect(page.get_by_label("Gait to add").locator("option:checked")).to_be_enabled()


@pytest.mark.heavy
def test_repetitions_start_from_rest_and_follow_each_other_again(
    page: Page, studio: StudioProcess, tour: str
) -> None:
    document = studio.ask("GET", f"/api/gaits/{tour}").content
    document["sequence"][0]["restarts"] = True
    studio.ask("PUT", f"/api/gaits/{tour}?label=From+rest", document)
    expect(rows(page).first).to_contain_text("repetitions from rest")
    rows(page).first.get_by_role("button", name="without a pause").click()
    expect(undo(page)).to_contain_text("run Walk 10 mm without a pause")
    expect(rows(page).first).not_to_contain_text("repetitions from rest")
    assert "restarts" not in studio.ask("GET", f"/api/gaits/{tour}").content["sequence"][0]
    assert findings(page) == []


@pytest.mark.heavy
def test_other_gaits_have_their_segment_table_again(page: Page, tour: str) -> None:
    expect(page.get_by_role("tab", name="Sequence")).to_be_visible()
    page.get_by_role("list", name="Gaits").get_by_role("button", name=re.compile("^Amble 10 mm(?!,)")).click()
    expect(page.get_by_role("tab", name="Segments")).to_be_visible()
    expect(page.locator("#sequence")).to_be_hidden()
    expect(page.locator("#parts")).to_be_hidden()
