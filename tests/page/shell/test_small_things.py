"""What a first visit to the page stumbled over: numbers, refusals, swings under the finger, iterations."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import partial

import pytest
from playwright.sync_api import Browser, Locator, Page, expect

from tests.support.page.opened import choose, opened_page
from tests.support.studio_process import StudioProcess, wait_for

pytestmark = pytest.mark.heavy

ROOM_FOR_PLACEHOLDER = """field => {
  const style = getComputedStyle(field);
  const pen = document.createElement("canvas").getContext("2d");
  pen.font = style.font;
  const room = field.clientWidth - parseFloat(style.paddingLeft) - parseFloat(style.paddingRight);
  return pen.measureText(field.placeholder).width <= room;
}"""
"""Whether a field is wide enough for what stands in it while it is empty."""


@pytest.fixture
def page(browser: Browser, studio: StudioProcess, request: pytest.FixtureRequest) -> Iterator[Page]:
    has_scene = "scene" in request.keywords
    with opened_page(browser, studio.url, 1024, 768, has_scene=has_scene) as opened:
        yield opened


def number(page: Page, name: str) -> Locator:
    return page.get_by_role("spinbutton", name=name, exact=True)


def undo(page: Page) -> Locator:
    return page.get_by_role("button", name=re.compile("^Undo"))


def drag(page: Page, foot: int, start: int, end: int) -> None:
    """Drags from the middle of one sample's cell to the middle of another's, samples counted from 1."""
    places = []
    for sample in (start, end):
        box = page.get_by_role("gridcell", name=re.compile(f"^foot {foot}, sample {sample}: ")).bounding_box()
        assert box is not None
        places.append((box["x"] + box["width"] / 2, box["y"] + box["height"] / 2))
    page.mouse.move(*places[0])
    page.mouse.down()
    page.mouse.move(*places[1], steps=4)
    page.mouse.up()


def swings(studio: StudioProcess, gait: str, foot: int) -> list[tuple[int, int]]:
    row = studio.document(gait)["timeline"]["feet"][foot - 1]
    return [(match.start() + 1, match.end()) for match in re.finditer("0+", row)]


def has_swings(studio: StudioProcess, wanted: list[tuple[int, int]]) -> bool:
    """Whether foot 3 of the walk swings at these samples and no others."""
    return swings(studio, "walk", 3) == wanted


def test_the_reason_covers_no_field_and_is_not_cut(page: Page) -> None:
    choose(page, "S-Gait 10 mm")
    number(page, "Step").fill("28")
    number(page, "Step").press("Enter")
    why = page.get_by_role("region", name="Why the gait is infeasible")
    expect(why).to_be_visible()
    box = why.locator(".advice").bounding_box()
    assert box is not None
    for field in page.locator("#optimise .fields input:visible, #optimise .fields select:visible").all():
        place = field.bounding_box()
        assert place is not None
        assert place["y"] + place["height"] <= box["y"] or place["y"] >= box["y"] + box["height"]
    assert why.locator(".first").evaluate("text => text.scrollHeight <= text.clientHeight")
    assert "mm" not in page.get_by_role("status", name="Verdict").inner_text()
    undo(page).click()
    expect(why).to_be_hidden()


def test_an_end_of_a_swing_its_middle_and_alt_each_do_their_own(page: Page, studio: StudioProcess) -> None:
    choose(page, "Walk 10 mm")
    assert swings(studio, "walk", 3) == [(6, 10)]
    drag(page, 3, 10, 12)
    expect(undo(page)).to_have_attribute("title", re.compile("Foot 3: swing at samples 6–12 "))
    wait_for(lambda: swings(studio, "walk", 3) == [(6, 12)], "the end has moved")
    drag(page, 3, 8, 7)
    expect(undo(page)).to_have_attribute("title", re.compile("Foot 3: swing moved by −1 sample "))
    wait_for(lambda: swings(studio, "walk", 3) == [(5, 11)], "the swing has moved")
    page.keyboard.down("Alt")
    drag(page, 3, 10, 11)
    page.keyboard.up("Alt")
    wait_for(lambda: swings(studio, "walk", 3) == [(5, 9)], "it is painted over")
    page.keyboard.down("b")
    drag(page, 3, 8, 9)
    page.keyboard.up("b")
    wait_for(lambda: swings(studio, "walk", 3) == [(5, 7)], "it is painted over again")
    for left in ([(5, 9)], [(5, 11)], [(6, 12)], [(6, 10)]):
        undo(page).click()
        wait_for(partial(has_swings, studio, left), "one gesture is one edit")


def test_a_swing_stops_at_a_locked_sample_and_says_why(page: Page, studio: StudioProcess) -> None:
    content = studio.document("amble")
    row = content["timeline"]["feet"][2]
    first = row.index("0") + 1
    last = row.rindex("0") + 1
    locked = [[*("0" * len(row))] for _ in content["timeline"]["feet"]]
    locked[2][last + 1] = "1"
    content["timeline"]["locked"] = ["".join(one) for one in locked]
    view = studio.ask("GET", "/api/gaits/amble/view").content
    path = f"/api/gaits/amble?label=Lock%20a%20sample&revision={view['revision']}"
    assert studio.ask("PUT", path, content).status == 200
    choose(page, "Amble 10 mm")
    drag(page, 3, last, last + 4)
    expect(page.locator("#toasts")).to_contain_text(f"Foot 3, sample {last + 2} is locked.")
    wait_for(lambda: swings(studio, "amble", 3) == [(first, last + 1)], "it stops before the locked sample")


def test_phases_of_a_timeline_drawn_by_hand_are_empty_until_one_is_typed(
    page: Page, studio: StudioProcess
) -> None:
    choose(page, "C-Gait 10 mm")
    phases = number(page, "Phase length")
    expect(phases).to_have_value("5")
    drawn = studio.document("c-gait")["timeline"]["feet"]
    foot = studio.document("c-gait")["order"][0]
    drag(page, foot, 6, 7)
    expect(phases).to_have_value("")
    expect(phases).to_have_attribute("placeholder", "as drawn")
    assert phases.evaluate(ROOM_FOR_PLACEHOLDER)
    expect(number(page, "Final stance")).to_have_value("")
    phases.fill("5")
    phases.press("Enter")
    wait_for(lambda: studio.document("c-gait")["timeline"]["feet"] == drawn, "it is drawn anew")
    expect(phases).to_have_value("5")
    expect(number(page, "Final stance")).to_have_value("5")


def test_the_direction_and_more_iterations_are_still_a_drawing(page: Page) -> None:
    choose(page, "Walk 10 mm")
    page.get_by_text(re.compile("^More")).click()
    page.get_by_role("combobox", name="Direction").select_option("2")
    number(page, "Iterations").fill("2")
    number(page, "Iterations").press("Enter")
    expect(page.locator("#undo-label")).to_have_text("iterations to 2")
    expect(page.get_by_role("grid", name="Footfall timeline")).to_have_attribute("aria-colcount", "85")
    expect(number(page, "Phase length")).to_have_value("5")
    undo(page).click()
    undo(page).click()


def test_what_was_refused_stays_with_the_reason_until_it_is_repaired_or_escape(page: Page) -> None:
    choose(page, "S-Gait 10 mm")
    step = number(page, "Step")
    refusal = page.locator("#optimise").get_by_role("alert").filter(has_text=re.compile("^Step "))
    step.fill("-5")
    step.press("Enter")
    expect(refusal).to_contain_text("must lie between 0 and 60 mm")
    step.fill("10")
    expect(refusal).to_be_hidden()
    step.press("Control+a")
    step.press_sequentially("e")
    step.press("Enter")
    expect(refusal).to_contain_text("Step needs a number between 0 and 60 mm")
    number(page, "Stability margin").fill("2")
    number(page, "Stability margin").press("Enter")
    expect(undo(page)).to_contain_text("margin to 2 mm")
    expect(refusal).to_be_visible()
    expect(step).to_have_attribute("aria-invalid", "true")
    step.press("Escape")
    expect(refusal).to_be_hidden()
    expect(step).to_have_value("10")
    undo(page).click()


@pytest.mark.parametrize(
    ("name", "typed", "sentence"),
    [
        (
            "Phase length",
            "2.5",
            "Phase length is 2.5 samples, but must be a whole number between 2 and 50 samples.",
        ),
        ("Final stance", "", "Final stance needs a whole number between 0 and 100 samples."),
        ("Clearance", "99", "Clearance is 99 mm; it must lie between 0 and 15 mm."),
    ],
)
def test_no_number_is_rounded_or_put_back_in_silence(
    page: Page, studio: StudioProcess, name: str, typed: str, sentence: str
) -> None:
    choose(page, "S-Gait 10 mm")
    before = studio.document("s-gait")
    field = number(page, name)
    kept = field.input_value()
    field.fill(typed)
    field.press("Enter")
    expect(page.get_by_role("alert").filter(has_text=sentence)).to_be_visible()
    field.blur()
    expect(field).to_have_value(typed)
    assert studio.document("s-gait") == before
    field.press("Escape")
    expect(field).to_have_value(kept)


def test_a_wrong_foot_order_stays_until_it_is_right(page: Page) -> None:
    choose(page, "S-Gait 10 mm")
    order = page.get_by_role("textbox", name="Foot order")
    kept = order.input_value()
    order.fill("1 1 2 3")
    order.blur()
    refusal = page.get_by_role("alert").filter(has_text="must contain each of the 4 feet exactly once")
    expect(refusal).to_be_visible()
    expect(order).to_have_value("1 1 2 3")
    choose(page, "Amble 10 mm")
    expect(refusal).to_be_hidden()
    choose(page, "S-Gait 10 mm")
    expect(order).to_have_value(kept)


@pytest.mark.parametrize(
    ("typed", "sentence"),
    [
        ("", "A gait needs a name."),
        ("Amble 10 mm", "Another gait is called “Amble 10 mm”. Write another name, such as “Amble 10 mm 2”"),
    ],
)
def test_a_name_that_is_empty_or_taken_is_refused_and_stays(page: Page, typed: str, sentence: str) -> None:
    choose(page, "S-Gait 10 mm")
    name = page.get_by_label("Gait name")
    name.fill(typed)
    name.press("Enter")
    expect(page.get_by_role("alert").filter(has_text=sentence)).to_be_visible()
    expect(name).to_have_value(typed)
    name.press("Escape")
    expect(name).to_have_value("S-Gait 10 mm")
    expect(page.get_by_role("alert").filter(has_text=sentence)).to_be_hidden()


def test_a_decimal_comma_is_a_point(page: Page) -> None:
    choose(page, "S-Gait 10 mm")
    margin = number(page, "Stability margin")
    margin.press("Control+a")
    margin.press_sequentially("1,5")
    expect(margin).to_have_value("1.5")
    margin.press("Enter")
    expect(undo(page)).to_contain_text("margin to 1.5 mm")
    undo(page).click()


def test_the_last_edit_is_named_in_the_free_room_of_the_top_bar(page: Page) -> None:
    choose(page, "S-Gait 10 mm")
    number(page, "Step").fill("12")
    number(page, "Step").press("Enter")
    text = page.locator("#undo .history-text")
    expect(text).to_have_text("step to 12 mm")
    page.set_viewport_size({"width": 1280, "height": 720})
    assert text.evaluate("text => text.scrollWidth <= text.clientWidth")
    page.set_viewport_size({"width": 1024, "height": 768})
    page.locator("#saved-state").evaluate("state => { state.textContent = '· drawing not accepted'; }")
    parts = [page.locator(f"#{name}").bounding_box() for name in ("versions", "undo", "save", "link", "stop")]
    edges = [edge for box in parts if box is not None for edge in (box["x"], box["x"] + box["width"])]
    assert len(edges) == 10
    assert edges == sorted(edges)
    assert edges[-1] <= 1024
    undo(page).click()


def test_undo_in_a_number_is_the_pages_and_the_focused_number_follows(
    page: Page, studio: StudioProcess
) -> None:
    choose(page, "S-Gait 10 mm")
    step = number(page, "Step")
    step.fill("12")
    step.press("Enter")
    wait_for(lambda: abs(studio.document("s-gait")["step"][0] - 0.012) < 1e-9, "the edit has arrived")
    step.press("Control+z")
    expect(step).to_be_focused()
    expect(step).to_have_value("10")
    wait_for(lambda: abs(studio.document("s-gait")["step"][0] - 0.010) < 1e-9, "the undo has arrived")
    step.fill("17")
    step.press("Control+z")
    expect(step).to_have_value("10")


@pytest.mark.scene
def test_the_turn_grows_to_the_right_and_the_greyed_button_says_why(page: Page) -> None:
    choose(page, "Walk 10 mm")
    turn = page.get_by_role("slider", name="Goal turn")
    expect(turn).to_have_attribute("aria-valuetext", "turn 0.0°")
    turn.press("ArrowRight")
    turn.press("ArrowUp")
    expect(turn).to_have_attribute("aria-valuetext", "turn 2.0°")
    note = page.locator("#optimise p").filter(has_text="only for gaits that do not turn")
    expect(note).to_be_visible()
    undo(page).click()
    undo(page).click()
    expect(note).to_be_hidden()


def test_the_legend_is_of_the_iteration_looked_at_and_escape_leaves(page: Page) -> None:
    choose(page, "S-Gait 10 mm")
    page.get_by_role("button", name="Optimise", exact=True).click()
    slider = page.get_by_role("slider", name="Iteration")
    slider.wait_for()
    note = page.get_by_role("status", name="Plan")
    expect(note).to_contain_text("Optimised in")
    legend = page.locator(".curve-key")
    last = legend.text_content() or ""
    assert "violation" in last
    slider.press("Home")
    verdict = page.get_by_role("status", name="Verdict")
    expect(verdict).to_contain_text("optimiser iteration")
    expect(legend).not_to_have_text(last)
    word = verdict.get_by_role("button").first
    assert word.evaluate("text => text.scrollWidth <= text.clientWidth")
    expect(page.get_by_role("button", name="Back to the plan")).to_be_in_viewport(ratio=0.9)
    page.keyboard.press("Escape")
    expect(verdict).not_to_contain_text("optimiser iteration")


def test_a_focused_number_follows_another_tab_but_not_while_it_is_typed(
    page: Page, studio: StudioProcess
) -> None:
    choose(page, "Rotate 15°, as in the thesis")
    margin = number(page, "Stability margin")
    margin.focus()
    change_elsewhere(studio, 0.002)
    expect(margin).to_have_value("2")
    margin.press("Control+a")
    margin.press_sequentially("99")
    change_elsewhere(studio, 0.001)
    expect(page.get_by_role("button", name=re.compile("^Undo"))).to_have_attribute(
        "title", re.compile("Margin to 1 mm")
    )
    expect(margin).to_have_value("99")
    margin.press("Escape")
    expect(margin).to_have_value("1")


def change_elsewhere(studio: StudioProcess, margin: float) -> None:
    """Another margin for the gait that turns, as another tab would send it."""
    content = studio.document("rotate")
    content["options"]["margin"] = margin
    revision = studio.ask("GET", "/api/gaits/rotate/view").content["revision"]
    path = f"/api/gaits/rotate?label=Margin%20to%20{margin * 1000:.0f}%20mm&revision={revision}"
    assert studio.ask("PUT", path, content).status == 200
