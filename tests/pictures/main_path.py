"""The moving picture of README: from a gait that walks to a drawn one that the emulated robot follows."""

from __future__ import annotations

import re
from pathlib import Path

from playwright.sync_api import Locator, Page, expect

from tests.pictures.film import Film, middle_of
from tests.pictures.sitting import Sitting, wait_until_robot

FILM = "main_path.webp"
SPEED = 0.35
"""Seconds of the emulated robot in a second: slow enough for a frame at each waypoint."""
WALK = "Walk 10 mm"
REST = (1120.0, 640.0)
"""Where the pointer hides nothing while the robot walks, px."""
SLOWER = 0.1
"""How much longer each frame of the walking robot is shown, s."""


def main_path(at: Sitting, path: Path) -> None:
    """Films the main path and writes it."""
    film = Film(at)
    for scene in (look, choose, draw, mend, simulate, approve, send, walk):
        scene(film)
    film.write(path)


def look(film: Film) -> None:
    """Fast C-Gait plays."""
    at = film.at
    at.hide_plot("Foot heights")
    at.lower_the_timeline(44)
    at.closer(2)
    film.say("A gait for the robot's clock, played in 3D")
    film.frame()
    film.hold(0.6)
    film.glide(at.page.get_by_role("button", name="Play", exact=True))
    film.is_pressed = True
    film.frame()
    film.is_pressed = False
    film.play(on_ruler(at.page, 1), on_ruler(at.page, 10), 16)


def choose(film: Film) -> None:
    """The drawn walk is found in the list."""
    page = film.at.page
    film.say("Choose a walk to draw on")
    find = page.get_by_role("searchbox", name="Find a gait")
    film.click(find)
    find.fill("Walk 10")
    film.at.drawn()
    film.frame()
    exact = page.locator(".name", has_text=re.compile(f"^{re.escape(WALK)}$"))
    film.click(page.get_by_role("list", name="Gaits").get_by_role("button").filter(has=exact))
    expect(page.get_by_label("Gait name")).to_have_value(WALK)
    settled(film)
    film.hold(0.4)


def draw(film: Film) -> None:
    """A swing is moved, and the plan follows; then two feet are in the air together."""
    page = film.at.page
    film.say("Draw when a foot is in the air: the plan follows")
    film.glide(middle_of(cell(page, 3, 8)))
    film.drag(middle_of(cell(page, 3, 11)), 6)
    settled(film)
    film.hold(0.5)
    film.say("A drawing that cannot walk says where and why")
    film.glide(middle_of(cell(page, 2, 18)))
    film.drag(middle_of(cell(page, 2, 13)), 6)
    expect(page.get_by_role("button", name=re.compile("^Use this")).first).to_be_visible()
    settled(film)
    film.hold(0.8)


def mend(film: Film) -> None:
    """The first remedy is taken."""
    page = film.at.page
    film.say("What would help is solved and tried in physics: use it")
    expect(page.get_by_role("group", name="What would help")).to_contain_text("alks in the simulation")
    settled(film)
    use = page.get_by_role("button", name=re.compile("^Use this")).first
    film.glide(use)
    settled(film)
    film.hold(0.5)
    film.click(use)
    expect(page.get_by_role("status", name="Verdict")).to_contain_text("Plan margin")
    settled(film)
    film.hold(0.5)


def simulate(film: Film) -> None:
    """Physics runs what would be sent."""
    page = film.at.page
    film.say("Simulate exactly what would be sent")
    act(film, "Simulate")
    film.frame()
    expect(page.get_by_role("status", name="Verdict")).to_contain_text("Simulated walks")
    expect(page.get_by_role("tab", name="Check & approve", selected=True)).to_be_visible()
    settled(film)
    film.hold(0.6)


def approve(film: Film) -> None:
    """The rules are checked, and the waypoints approved by name."""
    page = film.at.page
    film.say("Check every rule, approve by name")
    act(film, "Check")
    button = page.get_by_role("button", name="Approve", exact=True)
    expect(button).not_to_have_attribute("aria-disabled", "true")
    settled(film)
    film.hold(0.6)
    act(film, "Approve")
    page.get_by_role("textbox", name="Your name").fill("Ada")
    settled(film)
    film.hold(0.3)
    act(film, "Continue")
    expect(page.get_by_role("tab", name="Run", selected=True)).to_be_visible()
    settled(film)


def send(film: Film) -> None:
    """The robot is connected, armed, and sent off."""
    page = film.at.page
    film.say("Connect, arm, hold to send (the robot is emulated)")
    act(film, "Connect")
    film.frame()
    expect(page.get_by_role("status", name="Robot")).to_contain_text("isarmed")
    settled(film)
    act(film, "Arm")
    wait_until_robot(film.at.studio, "armed")
    settled(film)
    hold = page.get_by_role("button", name="Send to robot")
    expect(hold).not_to_have_attribute("aria-disabled", "true")
    film.glide(hold)
    with film.pressed():
        while film.at.studio.robot()["run"] is None:
            page.wait_for_timeout(350)
            film.frame()


def walk(film: Film) -> None:
    """The robot walks; each frame is one of its waypoints."""
    page, studio = film.at.page, film.at.studio
    film.say("The robot follows: measured strokes over the plan")
    expect(page.locator(".strokes").first).to_be_visible()
    film.glide(REST)
    reached = -1
    while studio.robot()["robot"] != "done":
        now = (studio.robot()["run"] or {}).get("reached", 0)
        if now == reached:
            page.wait_for_timeout(50)
            continue
        reached = now
        settled(film)
        film.hold(SLOWER)
    settled(film)
    film.hold(2.0)


def act(film: Film, name: str) -> None:
    """Clicks a button as soon as it is offered."""
    button = film.at.page.get_by_role("button", name=name, exact=True)
    expect(button).not_to_have_attribute("aria-disabled", "true")
    film.click(button)


def settled(film: Film) -> None:
    """A frame of the page once it has been drawn."""
    film.at.drawn()
    film.frame()


def cell(page: Page, foot: int, sample: int) -> Locator:
    """A cell of the timeline, counted from 1."""
    return page.locator(f'.timeline-row[data-foot="{foot}"] .cell').nth(sample - 1)


def on_ruler(page: Page, sample: int) -> tuple[float, float]:
    """Where the ruler has a sample, counted from 1."""
    ruler = page.get_by_role("slider", name="Playhead").bounding_box()
    assert ruler is not None
    return middle_of(cell(page, 1, sample))[0], ruler["y"] + 6
