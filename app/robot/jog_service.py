"""The jog service: previews where jog steps lead, and sends them to the robot."""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from itertools import pairwise

import numpy as np

from app.bridge.bridge import RobotBridge
from app.bridge.jog import MOVED_MM, JogPlan
from app.bridge.states import RobotSnapshot
from app.common.json import Json
from app.robot.views import allowed, jog_stop_seconds
from core.arrays import Floats
from core.errors import CheckError, InfeasibleError, StateError
from core.findings import Finding
from core.jog.check import RANGE_RULE, JogCheck, check_jog
from core.jog.steps import Axis, JogPart, JogStep, jog_range, jog_strokes
from core.motion.trajectory import Trajectory
from core.robot.coupled_strokes import real_strokes
from core.robot.kinematics import feet_in_robot
from core.robot.model import RobotModel
from core.wire.robot_time import ARRIVAL_THRESHOLD, PUBLISHED, far_motors

STANDING_STROKE = 0.008
"""Every motor's stroke where steps begin on a robot that tells none, m."""


class JogFrom(StrEnum):
    """Where steps begin."""

    MEASURED = "measured"
    GIVEN = "given"
    STANDING = "standing"
    """Every motor at one stroke."""


@dataclass(frozen=True)
class JogLook:
    """Whose ranges are to be told: the body's, or those of a foot or its motors (0-based)."""

    part: JogPart
    foot: int = 0


@dataclass(frozen=True, eq=False)
class JogRequest:
    """Steps by hand on a robot.

    Args:
        model: the robot.
        steps: one after the other.
        given: (legs, 3) strokes to begin with, m; None for the measured ones.
        look: whose ranges are to be told.
    """

    model: RobotModel
    steps: tuple[JogStep, ...]
    given: Floats | None = None
    look: JogLook | None = None


class JogService:
    """Previews of steps by hand, and the steps themselves.

    Args:
        bridge: the robot.
    """

    def __init__(self, bridge: RobotBridge) -> None:
        self._bridge = bridge

    def preview(self, wish: JogRequest) -> Json:
        """Where the steps would lead, and what is to be said of it, as JSON content; nothing moves."""
        snapshot = self._bridge.snapshot
        begin, measured = _beginning(wish, snapshot)
        answer = check_jog(wish.model, measured, wish.steps)
        return {
            "robot": wish.model.name,
            "wired": wish.model.wired,
            "from": begin.value,
            "text": jog_text(wish.steps),
            "start_mm": _flat_mm(answer.start),
            "target_mm": None if answer.target is None else _flat_mm(answer.target),
            "residual_mm": None if answer.target is None else _flat_mm(answer.wanted - answer.target),
            "heights_mm": _mm(answer.feet[:, 2] - answer.feet[:, 2].min()),
            "margin_mm": None if answer.margin is None else round(answer.margin * 1000, 2),
            "moves": len(answer.way) if wish.model.wired else 0,
            "seconds": _seconds(answer),
            "stop_seconds": jog_stop_seconds(answer.largest_move, snapshot),
            "findings": [_finding(finding) for finding in answer.findings],
            "reason": _hindrance(wish, begin, answer, snapshot),
            "handles": [] if wish.look is None else _handles(wish, wish.look, answer),
        }

    def move(self, wish: JogRequest, by: str, seen_mm: Sequence[float] | None = None) -> None:
        """Lets the robot make the steps, which are judged anew from where it stands now.

        Args:
            wish: the steps.
            by: who does it.
            seen_mm: (motors,) target that the person saw, mm.

        Raises:
            StateError: no cable leads to the robot, it may not be jogged now, or it would go
                elsewhere than seen.
            InfeasibleError: a motor would leave its range.
            CheckError: it would tip, or not move at all.
        """
        snapshot = self._bridge.snapshot
        begin, measured = _beginning(wish, snapshot)
        if (reason := _why_not_now(wish, begin, snapshot)) is not None:
            raise StateError(reason, "jog")
        answer = check_jog(wish.model, measured, wish.steps)
        for error in answer.errors:
            raise (InfeasibleError if error.rule == RANGE_RULE else CheckError)(error.sentence, "steps")
        _require_seen(answer, seen_mm)
        self._bridge.jog(JogPlan(jog_text(wish.steps), measured, answer.way), by)

    def ghost(self, wish: JogRequest, place: tuple[float, float, float]) -> Trajectory:
        """The robot at the target, standing still.

        Args:
            wish: the steps.
            place: the body's x and y in the world, m, and its heading, rad.

        Raises:
            InfeasibleError: the steps lead out of range.
        """
        _, measured = _beginning(wish, self._bridge.snapshot)
        answer = check_jog(wish.model, measured, wish.steps)
        if answer.target is None:
            raise InfeasibleError(answer.errors[0].sentence, "steps")
        return standing_trajectory(wish.model, answer.feet, place)


def standing_trajectory(
    model: RobotModel, feet_robot: Floats, place: tuple[float, float, float]
) -> Trajectory:
    """A level robot at rest on its deepest foot, for one second.

    Args:
        model: the robot.
        feet_robot: (legs, 3) platform centres in the robot's frame, m.
        place: the body's x and y in the world, m, and its heading, rad.
    """
    x, y, heading = place
    plane = np.array([x, y, -float(feet_robot[:, 2].min())])
    cosine, sine = np.cos(heading), np.sin(heading)
    turn = np.array([[cosine, -sine, 0.0], [sine, cosine, 0.0], [0.0, 0.0, 1.0]])
    feet = feet_robot @ turn.T + plane
    return Trajectory(
        times=np.array([0.0, 1.0]),
        body_world=np.tile(plane + [0.0, 0.0, model.com_height], (2, 1)),
        heading=np.full(2, heading),
        feet_world=np.tile(feet, (2, 1, 1)),
        contact=np.tile(feet[:, 2] <= ARRIVAL_THRESHOLD, (2, 1)),
    )


def jog_text(steps: Sequence[JogStep]) -> str:
    """What some steps move, for a person; steps of the same thing are added up."""
    sums: dict[tuple[JogPart, int | None, int | None, Axis | None], float] = {}
    for step in steps:
        key = (step.part, step.foot, step.motor, step.axis)
        sums[key] = sums.get(key, 0.0) + step.by
    return ", ".join(f"{_title(*key)} by {by * 1000:+.1f} mm" for key, by in sums.items()) or "nothing"


def _title(part: JogPart, foot: int | None, motor: int | None, axis: Axis | None) -> str:
    if part is JogPart.MOTOR:
        return f"motor {(motor or 0) + 1} of foot {(foot or 0) + 1}"
    what = "the body" if part is JogPart.BODY else f"foot {(foot or 0) + 1}"
    return f"{what} along {axis}"


def _beginning(wish: JogRequest, snapshot: RobotSnapshot) -> tuple[JogFrom, Floats]:
    """Where steps begin, and the strokes there."""
    shape = (wish.model.leg_count, 3)
    if wish.given is not None:
        return JogFrom.GIVEN, real_strokes(wish.model, wish.given)
    if wish.model.wired and snapshot.strokes is not None:
        return JogFrom.MEASURED, np.array(snapshot.strokes).reshape(shape)
    return JogFrom.STANDING, np.full(shape, STANDING_STROKE)


def _why_not_now(wish: JogRequest, begin: JogFrom, snapshot: RobotSnapshot) -> str | None:
    """Why no step at all can be made now; None where one can."""
    if not wish.model.wired:
        return (
            f"{wish.model.title}: this program cannot drive this robot; its steps are shown in the "
            "preview only."
        )
    if (reason := allowed(snapshot)["jog"]) is not None:
        return reason
    if begin is JogFrom.GIVEN:
        return "The robot is moved from where it stands; leave from_mm out."
    if begin is JogFrom.STANDING:
        return "The robot has not reported its strokes yet. Wait for its telemetry."
    return None


def _hindrance(wish: JogRequest, begin: JogFrom, answer: JogCheck, snapshot: RobotSnapshot) -> str | None:
    """Why these steps cannot be made now; None where they can."""
    if (reason := _why_not_now(wish, begin, snapshot)) is not None:
        return reason
    if not wish.steps:
        return "Choose a step first: the target is where the robot stands."
    return answer.errors[0].sentence if answer.errors else None


def _require_seen(answer: JogCheck, seen_mm: Sequence[float] | None) -> None:
    if seen_mm is None or answer.target is None:
        return
    target_mm = answer.target.reshape(-1) * 1000
    if len(seen_mm) != len(target_mm) or float(np.abs(target_mm - np.array(seen_mm)).max()) > MOVED_MM:
        raise StateError(
            "The robot stands elsewhere than when you looked; look at the target again.", "seen_mm"
        )


def _seconds(answer: JogCheck) -> float:
    """Expected seconds of all moves."""
    pairs = pairwise([answer.start, *answer.way])
    moves = [np.abs(there - here).ravel() for here, there in pairs]
    return sum(PUBLISHED.move_seconds(float(move.max()), float(far_motors(move))) for move in moves)


def _handles(wish: JogRequest, look: JogLook, answer: JogCheck) -> list[Json]:
    """Present place, target and range of what can be stepped, mm, in the order x, y, z or of the motors.

    A foot's x and y are from its module's centre and its z from the deepest foot as they stand; the body's
    are from where it stands, and its z is the actuator plane's height over the deepest foot.
    """
    if look.part is JogPart.MOTOR:
        return [_motor_handle(wish.model, answer, look.foot, motor) for motor in range(3)]
    return [_place_handle(wish, look, answer, axis) for axis in Axis]


def _motor_handle(model: RobotModel, answer: JogCheck, foot: int, motor: int) -> Json:
    start = float(answer.start[foot, motor])
    target = start if answer.target is None else float(answer.target[foot, motor])
    least, most = model.stroke.lower, model.stroke.upper
    return {"motor": motor + 1, "axis": None} | _row_mm(start, target, least, most)


def _place_handle(wish: JogRequest, look: JogLook, answer: JogCheck, axis: Axis) -> Json:
    model, along = wish.model, list(Axis).index(axis)
    foot = None if look.part is JogPart.BODY else look.foot
    step = JogStep(look.part, 0.0, foot, None, axis)
    steps = () if answer.target is None else wish.steps
    least, most = jog_range(model, jog_strokes(model, answer.start, steps), step)
    before = feet_in_robot(model, answer.start)
    after = before if answer.target is None else feet_in_robot(model, answer.wanted)
    ground = float(before[:, 2].min())
    if foot is None:
        start = -ground if axis is Axis.Z else 0.0
        target = start + sum(one.by for one in steps if one.part is JogPart.BODY and one.axis is axis)
    else:
        origin = ground if axis is Axis.Z else model.module_centres_robot[foot, along]
        start, target = float(before[foot, along] - origin), float(after[foot, along] - origin)
    return {"motor": None, "axis": axis.value} | _row_mm(start, target, target + least, target + most)


def _row_mm(start: float, target: float, least: float, most: float) -> dict[str, float]:
    named = {"start_mm": start, "target_mm": target, "least_mm": least, "most_mm": most}
    return {name: round(value * 1000, 2) + 0.0 for name, value in named.items()}


def _finding(finding: Finding) -> Json:
    return {
        "rule": finding.rule,
        "severity": finding.severity.value,
        "sentence": finding.sentence,
        "foot": finding.foot,
        "actuator": finding.actuator,
    }


def _mm(values: Floats) -> list[float]:
    rounded: list[float] = (np.round(values * 1000, 3) + 0.0).tolist()
    return rounded


def _flat_mm(strokes: Floats) -> list[float]:
    return _mm(strokes.reshape(-1))
