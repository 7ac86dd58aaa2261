"""The motor test for pages and scripts: begins it, ends it early, and publishes what it finds."""

from collections.abc import Callable

from app.bridge.bridge import RobotBridge
from app.bridge.states import MotorTestProgress, MotorTestState, RobotSnapshot
from app.common.clock import CLOCK, Clock
from app.common.json import Json
from core.errors import StateError
from core.jog.motor_test import MotorFinding, MotorVerdict
from core.robot.model import RobotModel
from core.wire.messages import MOTORS


class MotorTestService:
    """The guided motor test of the robot on the cable; the last result is kept while the studio runs.

    Args:
        bridge: the robot.
        publish: told the view whenever it changes.
        clock: the clocks of the machine.
    """

    def __init__(self, bridge: RobotBridge, publish: Callable[[Json], None], clock: Clock = CLOCK) -> None:
        self._clock = clock
        self._span = clock.start()
        self._bridge = bridge
        self._publish = publish
        self._shown: MotorTestProgress | None = None
        self._changed_at = 0.0
        bridge.subscribe(self._follow)

    def start(self, model: RobotModel, by: str) -> None:
        """Begins the test of all motors.

        Args:
            model: the robot that the person means.
            by: who tests.

        Raises:
            StateError: no cable leads to this robot, or the one on the cable is not armed.
        """
        if not model.wired:
            raise StateError(
                f"{model.title}: this program cannot drive this robot, so it cannot test its motors.", "robot"
            )
        self._bridge.test_motors(model, by)

    def cancel(self) -> None:
        """Ends the test after the motor that is being tested; it goes back first.

        Raises:
            StateError: no test is on.
        """
        test = self._bridge.snapshot.motor_test
        if test is None or test.state is not MotorTestState.RUNNING:
            raise StateError("No motor test is on.", "motor_test")
        self._bridge.end_early()

    def view(self) -> Json:
        """The test that is on or was the last, as JSON content."""
        return self._view(self._bridge.snapshot.motor_test)

    def _follow(self, snapshot: RobotSnapshot) -> None:
        if snapshot.motor_test != self._shown:
            was = None if self._shown is None else self._shown.state
            self._shown = snapshot.motor_test
            if was is not MotorTestState.RUNNING:
                self._span = self._clock.start()
            self._changed_at = self._span.now
            self._publish(self._view(self._shown))

    def _view(self, shown: MotorTestProgress | None) -> Json:
        if shown is None:
            return {"state": None, "by": "", "at": None, "motor": None, "sentence": "", "findings": []}
        return {
            "state": shown.state.value,
            "by": shown.by,
            "at": self._changed_at,
            "motor": None if shown.motor is None else shown.motor + 1,
            "sentence": _sentence(shown),
            "findings": [_finding(finding) for finding in shown.findings],
        }


_ENDS = {
    MotorTestState.RUNNING: "The motor test is running.",
    MotorTestState.DONE: "The motor test is done.",
    MotorTestState.CANCELLED: "The motor test was ended early.",
    MotorTestState.STOPPED: "The motor test was stopped.",
}


def _sentence(shown: MotorTestProgress) -> str:
    """How far the test is, and which motors are not good."""
    count = sum(one.verdict is not MotorVerdict.NOT_TESTED for one in shown.findings)
    tested = f"{_ENDS[shown.state]} {count} of {MOTORS} motors tested"
    untested = [str(one.motor + 1) for one in shown.findings if one.verdict is MotorVerdict.NOT_TESTED]
    good = [one for one in shown.findings if one.verdict is MotorVerdict.GOOD]
    bad = [
        str(one.motor + 1)
        for one in shown.findings
        if one.verdict not in (MotorVerdict.GOOD, MotorVerdict.NOT_TESTED)
    ]
    if not shown.findings:
        return f"{tested}."
    said = [
        "all good" if len(good) == len(shown.findings) else "",
        f"not good: {', '.join(bad)}" if bad else "",
        f"could not be tested: {', '.join(untested)}" if untested else "",
    ]
    return f"{tested}; {'; '.join(filter(None, said))}."


def _finding(finding: MotorFinding) -> Json:
    return {
        "motor": finding.motor + 1,
        "foot": finding.motor // 3 + 1,
        "motor_of_foot": finding.motor % 3 + 1,
        "verdict": finding.verdict.value,
        "sentence": finding.sentence,
        "remedy": finding.remedy,
        "moved_mm": _mm(finding.moved),
        "off_mm": _mm(finding.off),
        "other": None if finding.other is None else finding.other + 1,
    }


def _mm(metres: float | None) -> float | None:
    return None if metres is None else round(metres * 1000, 2) + 0.0
