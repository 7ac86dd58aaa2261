"""The still pictures: what each of them shows, and how the page gets there."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from playwright.sync_api import Locator, expect

from tests.pictures.sitting import READY, SETTLE_MS, SIZE, Sitting, wait_until_robot
from tests.support.page.robot_panel import name
from tests.support.studio_process import Answer

WALK = "Walk 10 mm"
MANUAL = "Manual walk, v0"


@dataclass(frozen=True)
class Still:
    """A still picture.

    Args:
        take: brings the page there and keeps it at a path.
        has_scene: whether the 3D scene is seen.
    """

    take: Callable[[Sitting, Path], None]
    has_scene: bool = True


def studio(at: Sitting, path: Path) -> None:
    """The whole page with Fast C-Gait, a foot in the air."""
    at.hide_plot("Foot heights")
    at.lower_the_timeline(44)
    at.closer(2)
    at.to_sample(2)
    at.keep(path)


def timeline(at: Sitting, path: Path) -> None:
    """Two rows selected, and what shifting them by a sample would do."""
    at.hide_plot("Foot heights")
    at.lower_the_timeline(44)
    at.choose(WALK)
    cells = at.page.get_by_role("grid", name="Footfall timeline")
    first, last = (
        cells.get_by_role("gridcell", name=re.compile(f"^foot {foot}, sample {sample}:"))
        for foot, sample in ((2, 14), (3, 22))
    )
    first.hover()
    at.page.keyboard.down("Control")
    at.page.mouse.down()
    last.hover()
    at.page.mouse.up()
    at.page.keyboard.up("Control")
    at.page.get_by_role("button", name="Edit", exact=True).click()
    at.page.get_by_role("menuitem", name=re.compile("^Shift phase")).click()
    expect(at.page.get_by_role("dialog", name="Shift phase")).to_be_visible()
    at.keep(path)


def segments(at: Sitting, path: Path) -> None:
    """A change that does not fit yet, and what mends it."""
    at.choose(MANUAL)
    at.page.get_by_role("tab", name="Segments").click()
    grid = at.page.get_by_role("grid", name="Segment table")
    row = grid.get_by_role("row", name="Segment 5", exact=True)
    row.get_by_role("gridcell").nth(2).click()
    at.page.keyboard.press("Delete")
    expect(at.page.get_by_role("status", name="Segment table note")).to_contain_text("starts at")
    at.page.set_viewport_size({**SIZE, "height": 960})  # room for the whole table
    at.keep(path, at.page.get_by_role("region", name="Timeline and plots"))


def sequence(at: Sitting, path: Path) -> None:
    """Three parts one after the other."""
    parts = [{"gait": "walk", "times": 3}, {"gait": "rotate", "times": 3}, {"gait": "s-gait", "times": 2}]
    title = "Walk, turn by 45°, S-Gait"
    made = at.studio.ask("POST", "/api/sequences", {"name": title, "parts": parts})
    at.choose(title)
    expect(at.page.get_by_role("grid", name="Parts of the sequence").get_by_role("row")).to_have_count(3)
    at.closer(2)
    at.to_sample(124)
    at.keep(path)
    forget(at, made)


def simulation(at: Sitting, path: Path) -> None:
    """A trot that tips, beside its plan."""
    at.choose("Trot")
    at.step("Simulate")
    at.page.get_by_role("button", name="Simulate", exact=True).click()
    panel = at.page.get_by_role("tabpanel", name="Simulate")
    row = panel.get_by_role("row", name=re.compile("^Largest tilt"))
    row.get_by_role("button").click()
    at.closer(3)
    at.keep(path)


def versions(at: Sitting, path: Path) -> None:
    """What is different since the first version."""
    document = {**at.studio.document("amble"), "name": "Amble to the door"}
    made = at.studio.ask("POST", "/api/gaits", document)
    at.choose(document["name"])
    place = f"/api/gaits/{made.content['id']}"
    document["name"] = "Amble, faster"
    document["step"] = [1.2 * value for value in document["step"]]
    document["options"]["margin"] = 0.005
    assert at.studio.ask("PUT", f"{place}?label=Faster", document).status == 200
    at.studio.ask("POST", f"{place}/versions", {"name": "Before the demo"})
    at.page.get_by_role("button", name="Versions").click()
    listed = at.page.get_by_role("listbox", name="Versions")
    expect(listed.get_by_role("option")).to_have_count(2)
    listed.press("End")
    at.keep(path, at.page.get_by_role("dialog"))
    forget(at, made)


def new_gait(at: Sitting, path: Path) -> None:
    """The dialog for a new gait of a robot with six legs."""
    at.page.get_by_role("button", name="New", exact=True).click()
    at.page.get_by_role("menuitem", name="New gait…").click()
    asked = at.page.get_by_role("dialog", name="New gait")
    asked.get_by_label("Robot of the new gait").select_option("hexapod")
    at.keep(path, at.page.get_by_role("dialog"))


def five_motors(at: Sitting, path: Path) -> None:
    """A walk made by hand that five motors cannot carry out."""
    document = {**at.studio.document("walk-manual-0"), "name": "Manual walk, 5 motors"}
    document["robot"] = "deltawalker5"
    made = at.studio.ask("POST", "/api/gaits", document)
    at.choose(document["name"])
    at.step("Check & approve")
    at.page.get_by_role("button", name="Check", exact=True).click()
    at.page.get_by_role("button", name="go to").first.click()
    at.hide_plot("Strokes")
    at.lower_the_timeline(52)
    at.closer(2)
    at.keep(path)
    forget(at, made)


def jog(at: Sitting, path: Path) -> None:
    """A foot that is to be lifted after the body went away from it."""
    at.choose(WALK)
    name(at.page, "Ada")
    at.page.get_by_role("button", name="Connect", exact=True).click()
    press(at.page.get_by_role("button", name="Arm", exact=True))
    wait_until_robot(at.studio, "armed")
    at.page.get_by_text("Jog: move a motor").click()
    group = at.page.get_by_role("group", name="Jog", exact=True)
    press(group.get_by_role("button", name="Body", exact=True))
    for axis, times in (("height plus", 4), ("x minus", 3), ("y plus", 3)):
        for _ in range(times):
            press(group.get_by_role("button", name=f"Body, {axis}"))
    press(group.get_by_role("button", name="Foot", exact=True))
    for _ in range(2):
        press(group.get_by_role("button", name="Foot 1, z plus"))
    expect(group.get_by_role("button", name="Move", exact=True)).not_to_have_attribute(
        "aria-disabled", "true"
    )
    group.evaluate("(group) => group.scrollIntoView({ block: 'end' })")
    at.hide_plot("Foot heights")
    at.lower_the_timeline(44)
    at.closer(4)
    at.keep(path)


def patterns(at: Sitting, path: Path) -> None:
    """A transition between two gaits, in which a cell is kept."""
    transition(at)
    at.page.get_by_label("Shortest that works").uncheck()
    grid = at.page.get_by_role("grid", name="Pattern", exact=True)
    solved(at)
    grid.get_by_role("gridcell", name=re.compile("^foot 4, sample 10:")).click(modifiers=["Shift"])
    solved(at)
    at.keep(path)


def patterns_conflict(at: Sitting, path: Path) -> None:
    """A transition that is too short for four feet to swing."""
    transition(at)
    for gait in "AB":
        at.page.get_by_role("slider", name=f"Gait {gait}: boundary sample").press("Home")
    solved(at)
    at.fill(at.page.get_by_label("Length", exact=True), "6")
    solved(at, "Infeasible")
    at.keep(path)


def patterns_limbs(at: Sitting, path: Path) -> None:
    """Four limbs of six that walk."""
    at.choose("Hexapod tripod")
    at.drawn()
    at.page.wait_for_function(READY)
    at.page.get_by_role("tab", name="Pattern search").click()
    at.page.get_by_role("button", name="Some limbs").click()
    at.page.get_by_label("Limb 3", exact=True).select_option(label="held up")
    at.page.get_by_label("Limb 6", exact=True).select_option(label="broken")
    solved(at)
    at.page.get_by_role("button", name="Walk it").click()
    expect(at.page.get_by_role("button", name="Stop walking")).to_be_visible()
    at.page.get_by_role("button", name="Pause", exact=True).click()
    at.keep(path)


def transition(at: Sitting) -> None:
    """Opens the search for a transition from Walk to a wave."""
    at.choose(WALK)
    at.page.get_by_role("tab", name="Pattern search").click()
    at.page.get_by_label("Gait B", exact=True).select_option("quadruped-wave-1")
    solved(at)


def solved(at: Sitting, word: str = "Optimal") -> None:
    """Waits for the answer of a search."""
    at.page.wait_for_timeout(SETTLE_MS)
    expect(at.page.locator(".pattern-grid[data-stale]")).to_have_count(0)
    expect(at.page.get_by_role("status", name="Pattern found")).to_contain_text(word)


def forget(at: Sitting, made: Answer) -> None:
    """Deletes a gait that was made for a picture, so that no other shows it."""
    at.studio.ask("DELETE", f"/api/gaits/{made.content['id']}")


def press(button: Locator) -> None:
    """Presses a button as soon as it may be."""
    expect(button).not_to_have_attribute("aria-disabled", "true")
    button.click()


STILLS: dict[str, Still] = {
    "studio.png": Still(studio),
    "timeline.png": Still(timeline),
    "segments.png": Still(segments, has_scene=False),
    "sequence.png": Still(sequence),
    "simulation.png": Still(simulation),
    "versions.png": Still(versions, has_scene=False),
    "new-gait.png": Still(new_gait, has_scene=False),
    "five-motors.png": Still(five_motors),
    "patterns.png": Still(patterns),
    "patterns-conflict.png": Still(patterns_conflict),
    "patterns-limbs.png": Still(patterns_limbs),
    "jog.png": Still(jog),
}
"""By the name of the file in docs; last what leaves the robot connected."""
