"""Two pages and one robot over HTTP: one holds it, the other looks on and can stop it."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from pathlib import Path

import pytest

from app.bridge.bridge import RobotBridge
from app.bridge.lease import GONE_SECONDS
from app.bridge.states import RobotState
from app.emulator.emulated_robot import EmulatedRobot
from app.robot.operator_lease import OperatorLease
from app.undo.history import Author
from core.errors import StateError
from tests.support.studio_process import Answer, StudioProcess, running_studio, wait_for
from tests.support.virtual_robot import make_plan

SPEED = 20.0
ADA = {"X-Footfall-Page": "page-a", "X-Footfall-Name": "Ada"}
GRACE = {"X-Footfall-Page": "page-g", "X-Footfall-Name": "Grace"}

Submit = Callable[..., Answer]

LONG = 100.0
"""All of a time that is set counts, s."""


@pytest.fixture
def ask(studio: StudioProcess) -> Iterator[Submit]:
    """Asks the robot for something, and leaves it disconnected."""

    def asked(verb: str, who: dict[str, str] | None = None, **content: object) -> Answer:
        return studio.ask("POST", f"/api/robot/{verb}", content or None, who)

    yield asked
    holder = studio.robot()["lease"]["page"]
    asked("disconnect", {"X-Footfall-Page": holder} if holder else None)


def connected(studio: StudioProcess, ask: Submit, who: dict[str, str]) -> None:
    assert ask("connect", who).status == 200
    wait_for(lambda: studio.robot()["robot"] == "disarmed", "the robot is up")


def test_a_looker_on_moves_nothing_and_can_stop(studio: StudioProcess, ask: Submit) -> None:
    connected(studio, ask, ADA)
    assert studio.robot()["lease"]["name"] == "Ada"
    for verb in ("arm", "pause", "resume", "reset", "disconnect"):
        refused = ask(verb, GRACE)
        assert refused.status == 409
        assert refused.content["error"].startswith("Ada is in control. Ask Ada for control")
    refused = ask("send", GRACE, gait="walk")
    assert (refused.status, refused.content["where"]) == (409, "lease")
    assert ask("arm", ADA).content["robot"] == "armed"
    assert studio.ask("GET", "/api/robot", headers=GRACE).content["lease"]["page"] == "page-a"
    assert ask("stop", GRACE).status == 200
    wait_for(lambda: studio.robot()["robot"] == "stopped", "the robot stands still")
    assert ask("clear", GRACE).status == 409
    assert ask("clear", ADA).status == 200
    wait_for(lambda: studio.robot()["robot"] == "disarmed", "the stop is cleared")


def test_the_holder_gives_the_robot_to_who_asks(studio: StudioProcess, ask: Submit) -> None:
    connected(studio, ask, ADA)
    assert ask("lease/ask", GRACE).content["lease"]["asker"] == {"page": "page-g", "name": "Grace"}
    assert ask("lease/take", GRACE).status == 409
    assert ask("lease/give", GRACE).status == 409
    assert ask("lease/give", ADA).content["lease"]["page"] == "page-g"
    assert ask("arm", ADA).status == 409
    assert ask("arm", GRACE).content["robot"] == "armed"


def test_a_script_needs_no_page_and_holds_the_robot_while_it_is_armed(
    studio: StudioProcess, ask: Submit
) -> None:
    connected(studio, ask, {})
    assert studio.robot()["lease"]["page"] is None
    assert ask("arm", by="Alan").content["lease"]["name"] == "A script of Alan"
    refused = ask("reset", ADA)
    assert refused.status == 409
    assert "Take over" in refused.content["error"]
    assert ask("lease/take", ADA).content["lease"]["name"] == "Ada"
    assert ask("reset").status == 409


def test_a_deed_that_is_refused_does_not_take_the_robot(studio: StudioProcess, ask: Submit) -> None:
    refused = ask("arm", ADA)
    assert (refused.status, "Connect" in refused.content["error"]) == (409, True)
    assert studio.robot()["lease"]["page"] is None


def test_who_disconnects_lets_the_robot_go(studio: StudioProcess, ask: Submit) -> None:
    connected(studio, ask, ADA)
    assert ask("disconnect", ADA).content["lease"]["page"] is None
    assert ask("connect", GRACE).content["lease"]["name"] == "Grace"


def test_an_armed_robot_that_changes_hands_is_disarmed(studio: StudioProcess, ask: Submit) -> None:
    connected(studio, ask, ADA)
    assert ask("arm", ADA).content["robot"] == "armed"
    released = ask("lease/release", ADA).content
    assert (released["robot"], released["lease"]["page"]) == ("disarmed", None)
    assert ask("send", GRACE, gait="walk").status == 409
    assert ask("arm", GRACE).content["robot"] == "armed"
    assert ask("lease/ask", ADA).status == 200
    given = ask("lease/give", GRACE).content
    assert (given["robot"], given["lease"]["name"]) == ("disarmed", "Ada")
    causes = [one["cause"] for one in studio.ask("GET", "/api/robot/transitions").content["transitions"]]
    assert "Disarmed by Ada, for the robot changed hands." in causes


def test_an_unknown_hand_over_is_refused(ask: Submit) -> None:
    assert ask("lease/steal", ADA).status == 422
    assert ask("arm", {"X-Footfall-Page": "no page!"}).status == 422


@pytest.mark.heavy
def test_a_restart_of_the_studio_drops_the_lease(tmp_path: Path, robot: EmulatedRobot) -> None:
    with running_studio(tmp_path, "--robot", robot.device) as studio:
        studio.ask("POST", "/api/robot/connect", headers=ADA)
        assert studio.robot()["lease"]["name"] == "Ada"
    with running_studio(tmp_path, "--robot", robot.device) as studio:
        assert studio.robot()["lease"]["page"] is None


def test_a_run_whose_holder_is_gone_pauses_at_the_next_pose_with_all_feet_down(
    robot: EmulatedRobot,
) -> None:
    time, told, bridge = [0.0], list[str](), RobotBridge()
    service = OperatorLease(
        bridge, lambda: None, lambda page, event: told.append(page), lambda: time[0], 0.02, LONG
    )
    try:
        bridge.connect(robot.device)
        wait_for(lambda: bridge.snapshot.robot is RobotState.DISARMED, "the robot is up")
        with service.held_by(Author("page-a", "Ada")):
            bridge.arm("Ada")
            bridge.send(make_plan([[15.0] * 12, [5.0] * 12] * 10, [False] * 19 + [True]), "Ada")
        wait_for(lambda: "page-a" in told, "the holder's page is asked for a sign of life")
        time[0] += GONE_SECONDS + 1.0
        wait_for(lambda: bridge.snapshot.robot is RobotState.PAUSING, "the run goes on to its next hold")
        assert service.view()["is_gone"]
        with pytest.raises(StateError, match="gone for 16 s"), service.held_by(Author("page-g", "Grace")):
            bridge.resume("Grace")
        service.take(Author("page-g", "Grace"))
        with service.held_by(Author("page-g", "Grace")):
            bridge.resume("Grace")
        assert bridge.snapshot.robot is RobotState.MOVING
        causes = [transition.cause for transition in bridge.transitions]
        assert "Pause by the studio, as Ada is gone." in causes
    finally:
        service.close()
        bridge.close()


@pytest.mark.parametrize(
    ("holder", "named"), [(Author("page-a", "Ada"), "Ada"), (Author(name="Alan"), "a script of Alan")]
)
def test_an_armed_robot_whose_holder_is_gone_is_disarmed_and_says_so(
    robot: EmulatedRobot, caplog: pytest.LogCaptureFixture, holder: Author, named: str
) -> None:
    time, shown, bridge = [0.0], list[str](), RobotBridge()
    service = OperatorLease(
        bridge,
        lambda: shown.append(bridge.snapshot.robot),
        lambda page, event: None,
        lambda: time[0],
        0.02,
        LONG,
    )
    try:
        bridge.connect(robot.device)
        wait_for(lambda: bridge.snapshot.robot is RobotState.DISARMED, "the robot is up")
        with service.held_by(holder):
            bridge.arm(holder.name)
        time[0] += GONE_SECONDS - 0.1
        with service.awaiting():
            time[0] += 1.0
            assert not threading.Event().wait(0.2)
            assert bridge.snapshot.robot is RobotState.ARMED
        wait_for(lambda: bridge.snapshot.robot is RobotState.DISARMED, "the robot is disarmed")
        assert "disarmed" in bridge.snapshot.sentence
        assert named in bridge.snapshot.sentence
        assert named in bridge.transitions[-1].cause
        wait_for(lambda: named in caplog.text, "the log names the holder")
        wait_for(lambda: shown[-1:] == [RobotState.DISARMED], "the pages are told")
    finally:
        service.close()
        bridge.close()


def test_nobody_is_gone_because_the_studio_did_not_run() -> None:
    time, bridge = [0.0], RobotBridge()
    service = OperatorLease(bridge, lambda: None, lambda page, event: None, lambda: time[0], 0.02)
    try:
        with service.held_by(Author("page-a", "Ada")):
            pass
        for _ in range(5):
            time[0] += 3600.0
            assert not service.view()["is_gone"]
            assert not threading.Event().wait(0.05)
        assert not service.view()["is_gone"]
    finally:
        service.close()
        bridge.close()


def test_an_armed_robot_whose_holder_is_there_stays_armed(robot: EmulatedRobot) -> None:
    time, told, bridge = [0.0], list[str](), RobotBridge()
    service = OperatorLease(
        bridge, lambda: None, lambda page, event: told.append(page), lambda: time[0], 0.02, LONG
    )
    try:
        bridge.connect(robot.device)
        wait_for(lambda: bridge.snapshot.robot is RobotState.DISARMED, "the robot is up")
        with service.held_by(Author("page-a", "Ada")):
            bridge.arm("Ada")
        for _ in range(4):
            time[0] += GONE_SECONDS - 1.0
            service.heard("page-a")
            told.clear()
            wait_for(lambda: len(told) > 2, "the lease was looked at")
        assert bridge.snapshot.robot is RobotState.ARMED
    finally:
        service.close()
        bridge.close()


@contextmanager
def refused_after(deed: AbstractContextManager[None]) -> Iterator[None]:
    with deed:
        yield
    raise StateError("The robot is connected already.")


def test_a_deed_that_is_refused_takes_the_robot_from_nobody_who_goes_on_with_it() -> None:
    shown, bridge = list[object](), RobotBridge()
    service = OperatorLease(bridge, lambda: shown.append(service.view()["page"]), lambda page, event: None)
    ada = Author("page-a", "Ada")
    try:
        with pytest.raises(StateError), service.held_by(ada):
            raise StateError("The robot is connected already.")
        assert shown == [None]
        with pytest.raises(StateError), service.held_by(ada), refused_after(service.held_by(ada)):
            assert service.view()["page"] == "page-a"
        assert shown == [None, "page-a", "page-a"]
    finally:
        service.close()
        bridge.close()


def test_the_end_of_a_deed_takes_the_robot_from_nobody_who_came_meanwhile() -> None:
    bridge = RobotBridge()
    service = OperatorLease(bridge, lambda: None, lambda page, event: None)
    ada, grace = Author("page-a", "Ada"), Author("page-g", "Grace")
    try:
        with service.held_by(Author(), ends=True), service.held_by(grace):
            pass
        assert service.view()["page"] == "page-g"
        with service.held_by(grace, ends=True), service.held_by(grace):
            pass
        assert service.view()["page"] == "page-g"
        with service.held_by(grace, ends=True):
            service.ask(ada)
        assert service.view()["page"] is None
    finally:
        service.close()
        bridge.close()


def test_a_robot_whose_line_was_lost_is_the_next_persons_once_its_holder_is_gone() -> None:
    time, bridge = [0.0], RobotBridge()
    service = OperatorLease(bridge, lambda: None, lambda page, event: None, lambda: time[0], most=LONG)
    ada, grace = Author("page-a", "Ada"), Author("page-g", "Grace")
    try:
        with service.held_by(ada):
            pass
        with pytest.raises(StateError, match="Ada is in control"), service.held_by(grace):
            pass
        time[0] += GONE_SECONDS + 1.0
        assert service.view()["page"] is None
        with service.held_by(grace):
            assert service.view()["page"] == "page-g"
    finally:
        service.close()
        bridge.close()
