"""Drive by keys and the motor test on the page: what moves the robot, what ends it, what is never sent."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Locator, Page, Request, expect

from tests.support.page.axe import findings
from tests.support.page.opened import look, opened_page
from tests.support.page.robot_panel import name
from tests.support.studio_process import StudioProcess, wait_for

pytestmark = pytest.mark.heavy

SPEED = 2.0
LONG = 60.0


class Driver:
    """A tab with the region of the keys, and the steps that it sent."""

    def __init__(self, page: Page, person: str) -> None:
        name(page, person)
        self.page = page
        self.group = page.get_by_role("group", name="Drive by keys")
        self.group.locator("summary").click()
        self.sent: list[str] = []
        page.on("request", self._note)

    def _note(self, request: Request) -> None:
        body = json.loads(request.post_data or "{}") if request.method == "POST" else {}
        if request.url.endswith("/api/robot/jog") and not body.get("preview"):
            self.sent.append(json.dumps(body["steps"][0]))
        elif request.url.endswith("/api/robot/jog/end"):
            self.sent.append("end")

    @property
    def region(self) -> Locator:
        return self.page.get_by_role("application", name="Keys that drive the robot")

    def says(self, words: str) -> None:
        expect(self.group.get_by_role("status")).to_contain_text(re.compile(words))

    def enter(self) -> None:
        self.region.click()
        self.says("Keys act")

    def arm(self) -> None:
        self.page.get_by_role("button", name="Connect", exact=True).click()
        arm = self.page.get_by_role("button", name="Arm", exact=True)
        expect(arm).not_to_have_attribute("aria-disabled", "true", timeout=LONG * 1000)
        arm.click()

    def hold(self, code: str, repeats: int) -> None:
        """Holds a key down: the browser repeats it, and it is still down afterwards."""
        for _ in range(repeats):
            self.page.keyboard.down(code)
            self.page.wait_for_timeout(50)

    def hold_until_sent(self, code: str, count: int = 1) -> None:
        before = len(self.sent)
        for _ in range(400):
            self.hold(code, 1)
            if len(self.sent) >= before + count:
                return
        raise AssertionError(f"{self.sent}: less than {count} steps were sent")


@pytest.fixture
def ada(browser: Browser, studio: StudioProcess) -> Iterator[Driver]:
    with opened_page(browser, studio.url, 1280, 900) as page:
        yield Driver(page, "Ada")
    # A robot that is disconnected while it moves is stopped, and stays so when it is connected again.
    wait_for(lambda: studio.robot()["robot"] not in ("moving", "stopping"), "the robot stands", LONG)
    holder = studio.robot()["lease"]["page"]
    who = {"X-Footfall-Page": holder} if holder else None
    if studio.robot()["allowed"]["clear"] is None:
        wait_for(lambda: studio.ask("POST", "/api/robot/clear", None, who).status == 200, "cleared", LONG)
        wait_for(lambda: studio.robot()["robot"] == "disarmed", "the stop is cleared", LONG)
    studio.ask("POST", "/api/robot/disconnect", None, who)
    wait_for(lambda: studio.robot()["link"] == "disconnected", "the line is closed", LONG)


def rests(studio: StudioProcess, state: str = "armed") -> None:
    wait_for(lambda: studio.robot()["robot"] == state, f"the robot is {state}", LONG)


def test_keys_move_the_robot_step_by_step_only_in_the_region_and_leave_the_page_alone(
    ada: Driver, studio: StudioProcess
) -> None:
    page = ada.page
    ada.region.click()
    ada.says("Connect the robot first")
    ada.arm()
    ada.hold("KeyW", 3)
    page.keyboard.up("KeyW")
    ada.region.focus()  # as by Tab: it is not entered by that
    ada.hold("KeyW", 3)
    page.keyboard.up("KeyW")
    assert ada.sent == []
    page.keyboard.press("Enter")
    ada.says("Keys act")
    look(page, "drive-by-keys")
    assert findings(page, {"include": [["#robot"]]}) == []

    before = studio.robot()["strokes_mm"]
    ada.hold_until_sent("KeyW", 2)
    page.keyboard.up("KeyW")
    assert set(ada.sent[:2]) == {
        json.dumps({"part": "motor", "foot": 1, "motor": 2, "axis": None, "by_mm": 3})
    }
    rests(studio)
    moved = [now - then for now, then in zip(studio.robot()["strokes_mm"], before, strict=True)]
    assert moved[1] > 3.5
    assert max(abs(one) for index, one in enumerate(moved) if index != 1) < 0.5

    # Of these, none acts on the page: playback, playhead, zoom, folds, list of keys, save, undo.
    playhead = page.evaluate("document.querySelector('#sections').scrollTop")
    for key in ("Space", "Home", "End", "?", "[", "l", "k", "f", "Control+s", "Control+z", "F6"):
        page.keyboard.press(key)
    expect(page.get_by_role("dialog")).to_have_count(0)
    expect(page.get_by_role("button", name="Play", exact=True)).to_be_visible()
    assert page.evaluate("document.querySelector('#sections').scrollTop") == playhead
    expect(ada.region).to_be_focused()
    rests(studio)

    page.keyboard.press("KeyS")
    page.keyboard.press("Escape")
    expect(ada.region).not_to_be_focused()
    ada.says("Click here")
    sent = len(ada.sent)
    ada.hold("ArrowUp", 3)
    assert len(ada.sent) == sent
    ada.enter()
    page.keyboard.press("Tab")
    expect(ada.region).not_to_be_focused()
    rests(studio)


def test_a_refused_step_says_why_once_and_nothing_is_sent(ada: Driver, studio: StudioProcess) -> None:
    ada.arm()
    rests(studio)
    ada.enter()
    previews: list[str] = []
    ada.page.on("request", lambda request: previews.append(request.url))
    for _ in range(100):  # until the robot stands still, a key does nothing
        ada.hold("Digit1", 1)
        if any(url.endswith("/jog") for url in previews):
            break
    ada.hold("Digit1", 10)
    ada.says("its range is 0.5 to 19.5 mm")
    ada.page.keyboard.up("Digit1")
    assert sum(url.endswith("/jog") for url in previews) == 1
    assert ada.sent == []


@pytest.mark.parametrize("way", ["release", "blur", "window", "hidden", "socket"])
def test_whatever_ends_the_hold_ends_the_driving(ada: Driver, studio: StudioProcess, way: str) -> None:
    page = ada.page
    page.get_by_role("combobox", name="Step of a key").select_option("5")
    ada.arm()
    rests(studio)
    ada.enter()
    before = studio.robot()["strokes_mm"][5]
    ada.hold_until_sent("KeyY")
    if way == "release":
        page.keyboard.up("KeyY")
    elif way == "blur":
        ada.region.blur()
    elif way == "window":
        page.evaluate("window.dispatchEvent(new Event('blur'))")
    elif way == "hidden":
        page.evaluate(
            "Object.defineProperty(document, 'hidden', { get: () => true });"
            "document.dispatchEvent(new Event('visibilitychange'))"
        )
    else:
        page.close()
    rests(studio)
    if way != "socket":
        ada.hold("KeyY", 20) if way != "release" else page.wait_for_timeout(1000)
        steps = [one for one in ada.sent if one != "end"]
        assert len(steps) == 1
        assert ada.sent[-1] == "end"
        ada.says("Click here" if way != "release" else "Keys act")
    # 5 mm are two messages: the second was not sent.
    assert studio.robot()["strokes_mm"][5] - before < 4.0


def test_escape_in_a_step_stops_the_robot(ada: Driver, studio: StudioProcess) -> None:
    ada.arm()
    rests(studio)
    ada.enter()
    ada.hold_until_sent("KeyY")
    expect(ada.group.get_by_role("status")).to_contain_text("Moving motor 3 of foot 2")
    ada.page.keyboard.press("Escape")
    rests(studio, "stopped")
    ada.says("Clear the stop first|Arm the robot first|Click here|Driving by keys has ended")
    sent = len(ada.sent)
    ada.hold("KeyY", 10)
    assert [one for one in ada.sent[sent:] if one != "end"] == []


def test_keys_held_in_a_second_tab_get_a_sentence_and_send_nothing(
    ada: Driver, browser: Browser, studio: StudioProcess
) -> None:
    with opened_page(browser, studio.url, 1280, 900) as page:
        grace = Driver(page, "Grace")
        ada.arm()
        rests(studio)
        grace.region.click()
        grace.says("Ada is in control. Ask Ada for control")
        grace.hold("KeyW", 5)
        assert grace.sent == []

        ada.enter()
        page.get_by_role("button", name="Ask for control").click()
        ada.hold_until_sent("KeyW")
        ada.page.get_by_role("button", name="Give control to Grace").press("Enter")
        ada.says("Grace is in control")
        sent = len(ada.sent)
        ada.hold("KeyW", 5)
        assert ada.sent[sent:] in ([], ["end"])


def test_the_motor_test_fills_its_table_and_can_be_ended_early(ada: Driver, studio: StudioProcess) -> None:
    page = ada.page
    group = page.get_by_role("group", name="Motor test")
    group.locator("summary").click()
    start = group.get_by_role("button", name="Test all motors")
    expect(start).to_have_attribute("aria-disabled", "true")
    expect(group).to_contain_text("Connect the robot first.")
    ada.arm()
    rests(studio)
    start.click()
    table = group.get_by_role("table", name="Motors")
    expect(table.locator("tbody tr")).to_have_count(12)
    expect(table.locator("tr").nth(1)).to_contain_text("good", timeout=LONG * 1000)
    expect(table.locator("[data-now]")).to_contain_text("moves now")
    look(page, "motor-test")
    group.get_by_role("button", name="End after this motor").click()
    expect(group.get_by_role("status")).to_contain_text(
        "The motor test was ended early.", timeout=LONG * 1000
    )
    rests(studio)
    assert findings(page, {"include": [["#robot"]]}) == []
    page.reload()
    page.get_by_role("tab", name="Run").click()
    group.locator("summary").click()
    expect(group.get_by_role("status")).to_contain_text("The motor test was ended early.")
    expect(table.locator("tr").nth(1)).to_contain_text("good")
