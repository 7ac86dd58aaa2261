"""Two tabs and one robot: one holds it, the other looks on, asks for it, and can stop it."""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Page, expect

from app.emulator.emulated_robot import EmulatedRobot
from tests.support.page.opened import look, opened_page
from tests.support.page.robot_panel import name
from tests.support.studio_process import StudioProcess, wait_for

pytestmark = pytest.mark.heavy

SPEED = 20.0


@pytest.fixture
def ada(browser: Browser, studio: StudioProcess) -> Iterator[Page]:
    with opened_page(browser, studio.url, 1280, 720) as page:
        name(page, "Ada")
        yield page


@pytest.fixture
def grace(browser: Browser, studio: StudioProcess) -> Iterator[Page]:
    with opened_page(browser, studio.url, 1280, 720) as page:
        name(page, "Grace")
        yield page


def press(page: Page, button: str | re.Pattern[str]) -> None:
    found = page.get_by_role("button", name=button, exact=isinstance(button, str))
    expect(found).to_be_visible()
    found.press("Enter")


def says_who_holds(page: Page, words: str) -> None:
    held = page.get_by_role("group", name="Who is in control")
    expect(held).to_contain_text(words)


def is_state(page: Page, state: str) -> None:
    expect(page.get_by_role("status", name="Robot")).to_contain_text(re.compile(state))


def test_a_second_tab_looks_on_is_given_the_robot_and_the_first_can_still_stop(
    ada: Page, grace: Page
) -> None:
    says_who_holds(grace, "No one is in control.")
    press(ada, "Connect")
    is_state(ada, "disarmed")
    says_who_holds(ada, "You are in control.")
    says_who_holds(grace, "Ada is in control.")
    arm = grace.get_by_role("button", name="Arm", exact=True)
    expect(arm).to_have_attribute("aria-disabled", "true")
    expect(arm).to_have_attribute("title", re.compile("^Ada is in control. Ask Ada for control"))
    look(grace, "lease-looking-on")
    press(grace, "Ask for control")
    says_who_holds(ada, "Grace asks for control.")
    look(ada, "lease-asked")
    press(ada, "Give control to Grace")
    says_who_holds(grace, "You are in control.")
    press(grace, "Arm")
    is_state(ada, "\\barmed")
    grace.reload()
    grace.get_by_role("tab", name="Run").click()
    says_who_holds(grace, "You are in control.")
    press(ada, "Stop")
    is_state(grace, "stopp(ed|ing)")
    is_state(ada, "stopped")
    look(ada, "lease-stopped")
    press(grace, "Clear")
    is_state(grace, "disarmed")
    press(grace, "Disconnect")
    says_who_holds(ada, "No one is in control.")


@pytest.fixture
def held_still(studio: StudioProcess) -> Iterator[StudioProcess]:
    """A studio whose robot answers and stands; its stop is cleared afterwards."""
    studio.ask("POST", "/api/robot/connect")
    wait_for(lambda: studio.robot()["robot"] == "disarmed", "the robot answers")
    yield studio
    assert studio.ask("POST", "/api/robot/clear").status == 200
    wait_for(lambda: studio.robot()["robot"] == "disarmed", "the stop is cleared")
    studio.ask("POST", "/api/robot/disconnect")


@pytest.mark.parametrize("way", ["request", "socket"])
def test_a_stop_goes_out_on_two_ways_of_which_each_is_enough(
    ada: Page, held_still: StudioProcess, way: str
) -> None:
    if way == "request":
        ada.evaluate("WebSocket.prototype.send = () => {}")
    else:
        ada.route("**/api/robot/stop*", lambda route: route.abort())
        ada.route("**/api/robot/stop*", lambda route: None, times=1)
    press(ada, "Stop")
    wait_for(lambda: held_still.robot()["robot"] == "stopped", "the robot is stopped")
    assert held_still.robot()["stop_text"] == "stopped by Ada"
    is_state(ada, "stopped")
    expect(ada.locator("#stop")).not_to_have_attribute("data-busy", "")
    assert ada.get_by_text("did not reach the studio").count() == 0


def test_stop_works_while_the_page_is_still_being_read(ada: Page, held_still: StudioProcess) -> None:
    ada.route("**/static/editor.js", lambda route: route.abort())
    ada.reload()
    # Not its answer: on a busy machine the page may give up waiting for it, and send Stop again.
    ada.get_by_role("button", name="Stop", exact=True).press("Enter")
    wait_for(lambda: held_still.robot()["robot"] == "stopped", "the robot is stopped")
    ada.goto("about:blank")  # a Stop that is sent again would come after the stop is cleared


def approve(studio: StudioProcess) -> None:
    job = studio.ask("POST", "/api/jobs", {"gait": "walk"}).content["id"]
    wait_for(lambda: studio.ask("GET", f"/api/jobs/{job}").content["state"] == "done", "the job is done", 60)
    studio.ask("POST", "/api/gaits/walk/check")
    assert studio.ask("POST", "/api/gaits/walk/approve", {"by": "Ada", "accept_warnings": True}).status == 200


def test_a_run_is_begun_at_a_later_pose_and_repeated(ada: Page, studio: StudioProcess) -> None:
    approve(studio)
    expect(ada.get_by_label("Device").locator("option").first).to_have_text("Emulated robot")
    look(ada, "robot-chooser")
    press(ada, "Connect")
    is_state(ada, "disarmed")
    press(ada, "Arm")
    is_state(ada, "\\barmed")
    places = studio.ask("GET", "/api/gaits/walk/run").content["beginnings"]
    begun = ada.get_by_label("Run from")
    begun.select_option("here")
    expect(begun).to_have_value("0")
    begun.select_option(str(places[-2]["waypoint"]))
    times = ada.get_by_label("Times to run")
    times.fill("2")
    times.press("Enter")
    count = studio.ask("GET", f"/api/gaits/walk/run?from={places[-2]['waypoint']}&iterations=2").content[
        "waypoints"
    ]
    expect(ada.locator("#robot .summary")).to_contain_text(f"Waypoints{count}")
    look(ada, "robot-course")
    press(ada, "Send to robot")
    wait_for(lambda: studio.robot()["robot"] in ("done", "fault"), "the run ended", 60)
    assert studio.robot()["run"]["count"] == studio.robot()["run"]["reached"] == count
    is_state(ada, "done")
    ada.get_by_text("What happened").click()
    log = ada.get_by_role("list", name="What happened")
    expect(log).to_contain_text("The last waypoint was reached.")
    expect(log).to_contain_text("Armed by Ada.")
    log.scroll_into_view_if_needed()
    look(ada, "robot-log")
    press(ada, "Disconnect")
    wait_for(lambda: studio.robot()["link"] == "disconnected", "the line is closed")


def test_a_countdown_ends_where_its_cancel_is_out_of_sight(ada: Page, studio: StudioProcess) -> None:
    approve(studio)
    press(ada, "Connect")
    is_state(ada, "disarmed")
    press(ada, "Arm")
    is_state(ada, "\\barmed")
    press(ada, "Send to robot")
    countdown = ada.get_by_role("group", name="Countdown")
    expect(countdown).to_be_visible()
    ada.get_by_role("tab", name="Design").click()
    expect(ada.locator("#announcer")).to_have_text("Sending is cancelled.")
    ada.get_by_role("tab", name="Run").click()
    expect(countdown).to_be_hidden()
    assert studio.robot()["robot"] == "armed"
    press(ada, "Disconnect")
    wait_for(lambda: studio.robot()["link"] == "disconnected", "the line is closed")


def test_who_looks_on_asks_for_control_of_a_run_in_the_step_run(
    ada: Page, grace: Page, studio: StudioProcess
) -> None:
    approve(studio)
    press(ada, "Connect")
    is_state(ada, "disarmed")
    press(ada, "Arm")
    is_state(ada, "\\barmed")
    begun = {"gait": "walk", "by": "Ada", "iterations": 20}
    assert ada.evaluate(
        """async (body) => (await import("/static/api/gaits.js")).api.robot("send", body).then(() => true)""",
        begun,
    )
    is_state(grace, "moving")
    says_who_holds(grace, "Ada is in control.")
    press(grace, "Ask for control")
    says_who_holds(ada, "Grace asks for control.")
    press(ada, "Give control to Grace")
    expect(grace.get_by_role("button", name="Pause robot")).not_to_have_attribute("aria-disabled", "true")
    log = grace.get_by_text("What happened")
    expect(log).to_be_visible()
    press(grace, "Stop")
    is_state(grace, "stopped")
    press(grace, "Clear")
    is_state(grace, "disarmed")
    press(grace, "Disconnect")
    wait_for(lambda: studio.robot()["link"] == "disconnected", "the line is closed")


def test_a_board_that_hung_up_is_offered_where_it_is_now_and_not_connected_by_itself(
    ada: Page, studio: StudioProcess, robot: EmulatedRobot
) -> None:
    moved = {"device": "/dev/ttyACM1", "description": "Feather M0", "serial_number": "F00D"}
    sentence = "The board that was at /dev/ttyACM0 is at /dev/ttyACM1 now (serial number F00D)."
    found = {"ports": [moved], "last": None, "again": moved | {"sentence": sentence}}
    ada.route("**/api/robot/ports", lambda route: route.fulfill(json=found))
    press(ada, "Connect")
    is_state(ada, "disarmed")
    offer = ada.get_by_role("status", name="Where the robot is now")
    expect(offer).to_be_hidden()
    robot.close()
    wait_for(lambda: studio.robot()["link"] == "lost", "the cable is out")
    expect(offer).to_contain_text(sentence)
    expect(ada.get_by_label("Device")).to_contain_text("ttyACM1 · Feather M0 · no. F00D")
    look(ada, "robot-found-again")
    with ada.expect_request("**/api/robot/connect") as asked:
        press(ada, "Connect there")
    assert "/dev/ttyACM1" in (asked.value.post_data or "")
