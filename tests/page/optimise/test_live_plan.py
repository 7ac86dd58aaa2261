"""The live plan on the page: it follows a drag and explains what is infeasible; the goal is dragged in 3D."""

from __future__ import annotations

import re
from collections.abc import Iterator
from math import hypot

import pytest
from playwright.sync_api import Browser, Locator, Page, expect

from tests.support.page.opened import choose, opened_page
from tests.support.studio_process import StudioProcess, wait_for


@pytest.fixture
def page(browser: Browser, studio: StudioProcess, request: pytest.FixtureRequest) -> Iterator[Page]:
    has_scene = "scene" in request.keywords
    with opened_page(browser, studio.url, 1280, 800, has_scene=has_scene) as opened:
        yield opened


def live_line(page: Page) -> Locator:
    return page.get_by_role("status", name="Verdict")


def margin_curve(page: Page) -> str:
    drawn: str = page.locator('.strip[data-strip="margin"] canvas').evaluate("(canvas) => canvas.toDataURL()")
    return drawn


def middle(place: Locator) -> tuple[float, float]:
    box = place.bounding_box()
    assert box is not None
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def cell(page: Page, foot: int, sample: int) -> Locator:
    return page.get_by_role("gridcell", name=re.compile(f"^foot {foot}, sample {sample}: "))


def use_seconds(page: Page) -> str:
    """The duration that the undo entry names."""
    found = re.search(r"([0-9.]+) s", page.locator("#undo-label").inner_text())
    assert found is not None
    return f"/ {found.group(1)} s"


@pytest.mark.soak
def test_the_fastest_timing_stands_beside_the_drawn_one_and_can_be_used(page: Page) -> None:
    choose(page, "C-Gait 10 mm")
    page.get_by_role("button", name="Fastest timing").click()
    box = page.get_by_role("region", name="Fastest timing")
    use = box.get_by_role("button", name=re.compile(r"^Use [0-9.]+ s"))
    use.wait_for()
    label = box.get_by_role("img").get_attribute("aria-label") or ""
    drawn, fastest = (float(number) for number in re.findall(r"[0-9]+\.[0-9]", label))
    assert fastest < drawn == 17.6
    use.click()
    expect(live_line(page)).to_contain_text("Plan optimised, margin")
    expect(page.locator("#clock")).to_contain_text(use_seconds(page))
    expect(box).to_be_hidden()
    page.get_by_role("button", name="Undo").click()
    expect(page.locator("#clock")).to_contain_text("/ 17.6 s")


def test_the_plan_follows_a_drag_on_the_timeline_before_it_ends(page: Page, studio: StudioProcess) -> None:
    choose(page, "Walk 10 mm")
    before, asked = margin_curve(page), studio.document("walk")
    page.mouse.move(*middle(cell(page, 3, 11)))
    page.mouse.down()
    page.mouse.move(*middle(cell(page, 3, 12)))
    wait_for(lambda: margin_curve(page) not in ("", before), "the margin follows the drag")
    expect(page.get_by_role("status", name="Verdict")).to_contain_text("Edit under way")
    assert studio.document("walk") == asked
    page.keyboard.press("Escape")
    page.mouse.up()
    wait_for(lambda: margin_curve(page) == before, "the plan is the old one again")
    assert studio.document("walk") == asked


@pytest.mark.heavy
def test_a_typed_number_is_answered_while_it_is_typed_and_is_one_edit(
    page: Page, studio: StudioProcess
) -> None:
    choose(page, "Amble 10 mm")
    before = margin_curve(page)
    step = page.get_by_role("spinbutton", name="Step", exact=True)
    step.fill("12")
    wait_for(lambda: margin_curve(page) not in ("", before), "the margin follows the number")
    assert studio.document("amble")["step"][0] == pytest.approx(0.00707, abs=1e-5)
    step.press("Enter")
    expect(page.get_by_role("button", name=re.compile("^Undo"))).to_contain_text("step to 12 mm")
    wait_for(lambda: studio.document("amble")["step"][0] > 0.0084, "the edit has arrived")
    page.get_by_role("button", name=re.compile("^Undo")).click()
    expect(step).to_have_value("10")


def test_a_number_out_of_range_is_refused_with_a_sentence_and_nothing_changes(
    page: Page, studio: StudioProcess
) -> None:
    choose(page, "Amble 10 mm")
    before = studio.document("amble")
    step = page.get_by_role("spinbutton", name="Step", exact=True)
    step.fill("-5")
    step.press("Enter")
    refusal = page.get_by_role("alert").filter(has_text="Step is -5 mm; it must lie between 0 and 60 mm.")
    expect(refusal).to_be_visible()
    step.blur()
    expect(step).to_have_value("-5")
    step.press("Escape")
    expect(step).to_have_value("10")
    assert studio.document("amble") == before


@pytest.mark.heavy
def test_an_infeasible_step_is_explained_where_it_happens_and_a_remedy_cures_it(page: Page) -> None:
    choose(page, "S-Gait 10 mm")
    step = page.get_by_role("spinbutton", name="Step", exact=True)
    step.fill("28")
    step.press("Enter")
    expect(live_line(page)).to_contain_text("no motion")
    why = page.get_by_role("region", name="Why the gait is infeasible")
    expect(why).to_contain_text(re.compile("proven|diagnosed"))
    expect(why.get_by_role("list", name="What is missing").get_by_role("listitem").first).to_contain_text(
        "mm"
    )
    marked = page.locator(".cell[data-lack=bad]")
    expect(marked.first).to_have_attribute("title", re.compile(" short "))
    why.get_by_role("button", name=re.compile("^Go to")).first.click()
    expect(page.locator("#clock")).not_to_contain_text(re.compile(r"^0\.0 "))
    remedy = why.get_by_role("group", name="What would help").get_by_role("listitem").first
    remedy.hover()  # under the pointer no row changes its place
    label = remedy.locator("b").inner_text()
    remedy.get_by_role("button").click()
    expect(live_line(page)).to_contain_text("Plan margin")
    expect(why).to_be_hidden()
    expect(page.locator(".cell[data-lack]")).to_have_count(0)
    expect(page.get_by_role("button", name=re.compile("^Undo"))).to_contain_text(label, ignore_case=True)


@pytest.mark.heavy
def test_pointing_at_a_way_out_shows_where_it_leads(page: Page, studio: StudioProcess) -> None:
    choose(page, "S-Gait 10 mm")
    before = studio.document("s-gait")
    ways = ask_too_much(page)
    way = ways.get_by_role("listitem").first
    expect(way).to_contain_text("6.0 mm")
    way.hover()
    expect(live_line(page)).to_contain_text("Plan margin")
    expect(page.get_by_role("status", name="Verdict")).to_contain_text("Preview")
    page.mouse.move(700, 300)
    expect(live_line(page)).to_contain_text("no motion")
    way.get_by_role("button").focus()
    expect(live_line(page)).to_contain_text("Plan margin")
    page.keyboard.press("Escape")
    expect(live_line(page)).to_contain_text("no motion")
    page.get_by_role("button", name=re.compile("^Undo")).click()
    wait_for(lambda: studio.document("s-gait")["step"] == before["step"], "nothing but the step was edited")


@pytest.mark.heavy
def test_a_drawing_that_ends_in_the_air_is_offered_ways_out(page: Page, studio: StudioProcess) -> None:
    choose(page, "Amble 10 mm")
    grid = page.get_by_role("grid", name="Footfall timeline")
    grid.get_by_role("gridcell", name="foot 2, sample 45: stance", exact=True).click()
    ways = page.get_by_role("group", name="What would help")
    ways.get_by_role("button").first.click()
    expect(live_line(page)).to_contain_text("Plan margin")
    assert all(row.endswith("1") for row in studio.document("amble")["timeline"]["feet"])


def ask_too_much(page: Page) -> Locator:
    """A step that is infeasible; gives back the group of ways out."""
    step = page.get_by_role("spinbutton", name="Step", exact=True)
    step.fill("28")
    step.press("Enter")
    expect(live_line(page)).to_contain_text("no motion")
    return page.get_by_role("group", name="What would help")


@pytest.mark.heavy
def test_a_way_out_keeps_what_was_edited_since_although_the_plan_is_the_same(
    page: Page, studio: StudioProcess
) -> None:
    choose(page, "C-Gait 10 mm")
    ways = ask_too_much(page)
    expect(ways.get_by_role("button").first).to_be_visible()
    page.get_by_text(re.compile("^More")).click()
    speed = page.get_by_role("spinbutton", name="Motor speed", exact=True)
    speed.fill("60")
    speed.press("Enter")
    wait_for(lambda: studio.document("c-gait")["options"]["motor_speed"] == 0.06, "the speed has arrived")
    ways.get_by_role("button", name=re.compile("^Use this: Step")).click()
    expect(live_line(page)).to_contain_text("Plan margin")
    wait_for(lambda: hypot(*studio.document("c-gait")["step"][:2]) < 0.0275, "the remedy has arrived")
    assert studio.document("c-gait")["options"]["motor_speed"] == 0.06


@pytest.mark.heavy
def test_a_number_says_how_far_it_can_go_while_it_is_dragged(page: Page, studio: StudioProcess) -> None:
    choose(page, "S-Gait 10 mm")
    before = studio.document("s-gait")["step"]
    name = page.locator("#optimise .field", has=page.get_by_role("spinbutton", name="Step", exact=True))
    place = middle(name.locator(".name"))
    page.mouse.move(*place)
    page.mouse.down()
    page.mouse.move(place[0] + 12, place[1])
    hint = name.get_by_role("status")
    expect(hint).to_have_text(re.compile(r"^Possible up to [0-9.]+ mm$"))
    largest = float(hint.inner_text().split()[3])
    page.mouse.move(place[0] + 40, place[1])
    expect(hint).to_be_visible()
    page.keyboard.press("Escape")
    page.mouse.up()
    expect(hint).to_be_hidden()
    assert studio.document("s-gait")["step"] == before
    step = page.get_by_role("spinbutton", name="Step", exact=True)
    step.fill(str(largest))
    step.press("Enter")
    expect(live_line(page)).to_contain_text("Plan margin")
    expect(page.get_by_role("region", name="Why the gait is infeasible")).to_be_hidden()


@pytest.mark.heavy
def test_a_margin_below_the_robots_own_is_amber_until_physics_has_spoken(page: Page) -> None:
    choose(page, "Walk 10 mm")
    design = page.get_by_role("tab", name=re.compile("^Design: plan found"))
    expect(design).to_be_visible()
    margin = page.get_by_role("spinbutton", name="Stability margin")
    margin.fill("4")
    margin.press("Enter")
    expect(page.get_by_role("tab", name="Design: small stability margin, not simulated yet")).to_be_visible()
    page.get_by_role("button", name="Simulate", exact=True).first.click()
    expect(design).to_be_visible(timeout=30_000)


@pytest.mark.heavy
def test_each_way_out_says_what_physics_makes_of_it(page: Page) -> None:
    choose(page, "S-Gait 10 mm")
    ways = ask_too_much(page)
    expect(ways.get_by_role("listitem").first).to_contain_text(
        "The robot walks in the simulation.", timeout=120_000
    )
    page.get_by_role("button", name=re.compile("^Undo")).click()
    expect(ways).to_be_hidden()


@pytest.mark.heavy
def test_a_gait_that_tips_in_physics_is_offered_what_helps(page: Page) -> None:
    choose(page, "Walk 10 mm")
    margin = page.get_by_role("spinbutton", name="Stability margin")
    margin.fill("0")
    margin.press("Enter")
    expect(live_line(page)).to_contain_text("Plan margin")
    page.get_by_role("button", name="Simulate", exact=True).first.click()
    page.get_by_role("tab", name=re.compile("^Design")).click()
    first = page.get_by_role("group", name="What would help").get_by_role("listitem").first
    expect(first).to_contain_text("The robot walks in the simulation.", timeout=60_000)
    first.get_by_role("button").click()
    expect(page.get_by_role("group", name="What would help")).to_be_hidden()


@pytest.mark.heavy
@pytest.mark.scene
def test_what_cannot_be_reached_is_marked_in_3d_at_its_time(page: Page) -> None:
    choose(page, "C-Gait 10 mm")
    step = page.get_by_role("spinbutton", name="Step", exact=True)
    step.fill("28")
    step.press("Enter")
    reach = page.get_by_role("button", name=re.compile("^Go to Reach, foot")).first
    reach.click()
    wait_for(lambda: trouble_extent(page) > 0.005, "the outline of the reach is drawn")
    page.get_by_role("button", name=re.compile("^Undo")).click()
    wait_for(lambda: trouble_extent(page) == 0.0, "the outline is gone")


def trouble_extent(page: Page) -> float:
    """How wide the marks of what is missing are drawn, m."""
    extent: float = page.evaluate(
        """() => {
          const inside = document.querySelector("#viser").contentWindow.__viserMutable;
          let wide = 0;
          inside?.nodeRefFromName["/overlay/trouble"]?.traverse((part) => {
            const at = part.geometry?.attributes?.instanceStart;
            if (!at) return;
            const xs = Array.from({ length: at.count }, (_, index) => at.getX(index));
            wide = Math.max(wide, Math.max(...xs) - Math.min(...xs));
          });
          return wide;
        }"""
    )
    return extent


@pytest.mark.heavy
@pytest.mark.scene
def test_dragging_the_goal_in_3d_changes_the_step_as_one_edit(page: Page, studio: StudioProcess) -> None:
    choose(page, "Walk 10 mm")
    goal = page.get_by_role("slider", name="Goal", exact=True)
    expect(goal).to_have_attribute("aria-valuetext", re.compile("step 10.0 mm"))
    box = goal.bounding_box()
    assert box is not None
    page.mouse.move(box["x"], box["y"])
    page.mouse.down()
    page.mouse.move(box["x"] + 12, box["y"])
    page.mouse.move(box["x"] + 24, box["y"] - 4)
    expect(goal).not_to_have_attribute("aria-valuetext", re.compile("step 10.0 mm"))
    assert studio.document("walk")["step"][0] == pytest.approx(0.00707, abs=1e-5)
    page.mouse.up()
    wait_for(lambda: studio.document("walk")["step"][0] > 0.009, "the edit has arrived")
    dragged = studio.document("walk")["step"]
    assert [value * 2000 for value in dragged[:2]] == pytest.approx([round(v * 2000) for v in dragged[:2]])
    assert dragged[0] != pytest.approx(dragged[1])
    page.get_by_role("button", name=re.compile("^Undo")).click()
    expect(goal).to_have_attribute("aria-valuetext", re.compile("step 10.0 mm"))


@pytest.mark.heavy
@pytest.mark.scene
def test_arrow_keys_move_the_goal_by_half_a_millimetre_and_turn_it(page: Page, studio: StudioProcess) -> None:
    choose(page, "Walk 10 mm")
    before = studio.document("walk")["step"]
    goal = page.get_by_role("slider", name="Goal", exact=True)
    expect(goal).to_have_attribute("aria-valuetext", re.compile("step"))
    goal.press("ArrowRight")
    wait_for(lambda: studio.document("walk")["step"] != before, "the edit has arrived")
    assert studio.document("walk")["step"] == pytest.approx([before[0] + 0.0005, before[1], 0.0])
    page.get_by_role("slider", name="Goal turn").press("ArrowRight")
    wait_for(lambda: studio.document("walk")["step"][2] > 0, "the turn has arrived")
    assert studio.document("walk")["step"][2] == pytest.approx(0.0174533, abs=1e-6)
    expect(page.get_by_role("spinbutton", name="Turn")).to_have_value("1")


@pytest.mark.heavy
def test_iterations_are_looked_at_and_left_again(page: Page) -> None:
    choose(page, "Amble 10 mm")
    page.get_by_role("button", name="Optimise", exact=True).click()
    slider = page.get_by_role("slider", name="Iteration")
    slider.wait_for()
    # The job's end arrives before the plan's, and a new plan leaves the iteration that is looked at.
    expect(live_line(page)).to_contain_text("Plan optimised, margin")
    slider.press("Home")
    note = page.get_by_role("status", name="Plan")
    expect(live_line(page)).to_contain_text("optimiser iteration")
    expect(note).to_contain_text("Iteration 0 of")
    page.get_by_role("button", name="Back to the plan").click()
    expect(note).to_contain_text("Optimised")
    expect(live_line(page)).to_contain_text("Plan optimised, margin")
