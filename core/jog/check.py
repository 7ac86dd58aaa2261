"""What is to be known of steps by hand before they are made: range, threshold, balance, coupling."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from core.arrays import Floats, first_lowest, first_place
from core.checks.balance import STROKE_BALANCE_SLACK
from core.checks.ground import CLEARANCE_LIMIT
from core.findings import Finding, Severity, found
from core.jog.steps import Axis, JogStep, jog_range, jog_strokes, jog_way, within_range
from core.motion.balance import BALANCE_RESERVE, STANDING_DEPTH
from core.motion.support_polygon import stability_margins
from core.robot.coupled_strokes import heights_over_standing, real_strokes
from core.robot.kinematics import feet_in_robot
from core.robot.model import RobotModel
from core.wire.robot_time import ARRIVAL_THRESHOLD

DOWN_DEPTH = STANDING_DEPTH + ARRIVAL_THRESHOLD
"""Feet within this of the deepest one are taken to stand: measured strokes are that uncertain, m."""

WORSE = 1e-5
"""A step that takes less from the balance than this does not make it worse, m."""

NOTICED = 0.0001
"""A motor that stands further beyond its range is named, m."""

WIRE_ROUNDING = 5e-8
"""Half of the last decimal that a waypoint is sent with, m."""

RANGE_RULE, THRESHOLD_RULE, BALANCE_RULE = "stroke", "threshold", "balance"


@dataclass(frozen=True, eq=False)
class JogCheck:
    """Where steps by hand lead.

    Args:
        start: (legs, 3) strokes from which they are made: the measured ones within the range, m.
        wanted: (legs, 3) strokes that the steps ask for, m; nan where no rod is long enough.
        target: (legs, 3) strokes that the robot makes of them, m; None where it cannot.
        way: (legs, 3) strokes after each move; empty where there is no target, m.
        feet: (legs, 3) platform centres at the target, or where it stands, in the robot's frame, m.
        margin: distance of the centre of mass from the edge of the support polygon there, m; None where it
            is not judged.
        findings: what is to be said, errors first.
    """

    start: Floats
    wanted: Floats
    target: Floats | None
    way: tuple[Floats, ...]
    feet: Floats
    margin: float | None
    findings: tuple[Finding, ...]

    @property
    def errors(self) -> tuple[Finding, ...]:
        """Why the steps must not be made."""
        return tuple(f for f in self.findings if f.severity is Severity.ERROR)

    @property
    def largest_move(self) -> float:
        """Largest distance of a motor in one move, m; 0 where there is none."""
        places = [self.start, *self.way]
        return float(np.abs(np.diff(places, axis=0)).max(initial=0.0))


def check_jog(model: RobotModel, measured: Floats, steps: Sequence[JogStep]) -> JogCheck:
    """Judges steps by hand from where the motors stand.

    Args:
        model: the robot.
        measured: (legs, 3) strokes, m.
        steps: to be made together.

    Raises:
        InputError: a step is not one of this robot.
    """
    for step in steps:
        step.require_fit(model)
    limits = model.stroke
    start = np.clip(measured, limits.lower, limits.upper)
    wanted = jog_strokes(model, start, steps)
    made = real_strokes(model, wanted)
    findings = _beyond(model, measured)
    if not within_range(model, made):
        blocked = _out_of_range(model, start, made, steps)
        return JogCheck(start, wanted, None, (), feet_in_robot(model, start), None, (blocked, *findings))
    if model.is_coupled:
        lost = _coupling(model, start, wanted, made, steps)
        return JogCheck(start, wanted, made, (made,), feet_in_robot(model, made), None, (*findings, *lost))
    way = jog_way(model, start, steps) if steps else ()
    if (outside := next((place for place in way if not within_range(model, place)), None)) is not None:
        blocked = _out_of_range(model, start, outside, steps)
        return JogCheck(start, wanted, None, (), feet_in_robot(model, start), None, (blocked, *findings))
    margins = _margins(model, np.array([start, *way]))
    all_found = [*_threshold(start, made, steps), *_balance(model, way, margins), *findings]
    ordered = tuple(sorted(all_found, key=lambda f: f.severity is not Severity.ERROR))
    return JogCheck(start, wanted, made, way, feet_in_robot(model, made), _known(margins[-1]), ordered)


def _beyond(model: RobotModel, measured: Floats) -> tuple[Finding, ...]:
    """Motors that stand outside the range which may be sent."""
    lower, upper = model.stroke.lower, model.stroke.upper
    beyond = []
    for foot, motor in np.argwhere(np.maximum(lower - measured, measured - upper) > NOTICED):
        value = float(measured[foot, motor])
        limit = lower if value < lower else upper
        sentence = (
            f"Motor {motor + 1} of foot {foot + 1} stands at {value * 1000:.2f} mm, beyond its range; it is "
            f"taken to stand at {limit * 1000:.1f} mm."
        )
        beyond.append(
            Finding(RANGE_RULE, Severity.WARNING, sentence, value, limit, None, int(foot), int(motor))
        )
    return tuple(beyond)


def _out_of_range(model: RobotModel, start: Floats, made: Floats, steps: Sequence[JogStep]) -> Finding:
    """The motor that is asked for most beyond its range, and how far the last step could go."""
    lower, upper = model.stroke.lower, model.stroke.upper
    away = np.nan_to_num(np.maximum(lower - made, made - upper), nan=np.inf)
    foot, motor = first_place(away)
    value, last = float(made[foot, motor]), steps[-1]
    if np.isfinite(value):
        what = (
            f"Motor {motor + 1} of foot {foot + 1} would go to {value * 1000:.2f} mm; its range is "
            f"{lower * 1000:.1f} to {upper * 1000:.1f} mm."
        )
    else:
        what = f"No rod of foot {foot + 1} is long enough."
    before = jog_strokes(model, start, steps[:-1])
    hint = "Take steps back."
    if within_range(model, before):
        least, most = jog_range(model, before, last)
        hint = f"This step may have {least * 1000:.1f} to {most * 1000:.1f} mm."
    known = value if np.isfinite(value) else None
    limit = upper if known is None or known > upper else lower
    return found(RANGE_RULE, Severity.ERROR, what, hint, known, limit, foot=foot, actuator=motor)


def _threshold(start: Floats, target: Floats, steps: Sequence[JogStep]) -> list[Finding]:
    """The firmware takes a target within its threshold on every motor for reached, and moves nothing."""
    largest = float(np.abs(target - start).max())
    if not steps or largest > ARRIVAL_THRESHOLD + WIRE_ROUNDING:
        return []
    words = (
        f"No motor would move: the largest change is {largest * 1000:.2f} mm, and the robot moves only where "
        f"one is more than {ARRIVAL_THRESHOLD * 1000:.1f} mm."
    )
    return [found(THRESHOLD_RULE, Severity.ERROR, words, "Take a longer step.", largest, ARRIVAL_THRESHOLD)]


def _standing(feet: Floats) -> Floats:
    """(n, legs) true for feet within the depth in which they may stand."""
    return np.asarray(feet[..., 2] <= feet[..., 2].min(axis=-1, keepdims=True) + DOWN_DEPTH)


def _margins(model: RobotModel, places: Floats) -> Floats:
    """(n,) static stability margin of a level body on the deepest feet, by forward kinematics, m."""
    feet = feet_in_robot(model, places)
    return stability_margins(np.zeros((len(places), 2)), feet, np.asarray(_standing(feet), dtype=np.bool_))


def _balance(model: RobotModel, way: Sequence[Floats], margins: Floats) -> list[Finding]:
    """The least balance on the way; one that a step makes no worse blocks it not, or none could mend it."""
    if not way:
        return []
    worst = 1 + int(first_lowest(margins[1:]))
    value, before = float(margins[worst]), float(margins[0])
    if value >= BALANCE_RESERVE or value >= before - WORSE > BALANCE_RESERVE:
        return []
    tips = value < -STROKE_BALANCE_SLACK
    blocks = tips and value < before - WORSE
    feet = np.nonzero(_standing(feet_in_robot(model, way[worst - 1])))[0]
    names = ", ".join(str(foot + 1) for foot in feet)
    down = f"feet {names}" if len(feet) > 1 else f"only foot {names}"
    side = "outside" if value < 0 else "inside"
    place = f"{abs(value) * 1000:.1f} mm {side} the edge of the support"
    outcome = "the robot would tip" if blocks else "it does not balance" if tips else "it hardly balances"
    remedy = "Move the body over the feet that stay down first." if len(feet) > 2 else "Keep three feet down."
    words = f"With {down} down the centre of mass is {place}: {outcome}."
    severity, limit = (
        (Severity.ERROR, -STROKE_BALANCE_SLACK) if blocks else (Severity.WARNING, BALANCE_RESERVE)
    )
    return [found(BALANCE_RULE, severity, words, remedy, value, limit)]


def _known(value: float) -> float | None:
    return float(value) if np.isfinite(value) else None


def _coupling(
    model: RobotModel, start: Floats, wanted: Floats, made: Floats, steps: Sequence[JogStep]
) -> list[Finding]:
    """What motors that share actuators lose, and whether a foot that is stepped really lifts."""
    off = np.abs(wanted - made)
    foot, motor = first_place(off)
    largest = float(off[foot, motor])
    lost = []
    if largest > NOTICED:
        sentence = (
            f"{model.actuator_count} motors cannot make these {model.motor_count} strokes: in the sense of "
            f"least squares that of motor {motor + 1} of foot {foot + 1} stays {largest * 1000:.1f} mm off."
        )
        lost.append(Finding("coupling", Severity.WARNING, sentence, largest, NOTICED, None, foot, motor))
    lifted = {step.foot for step in steps if step.axis is Axis.Z and step.foot is not None}
    return lost + [_lift(model, start, wanted, made, foot) for foot in sorted(lifted)]


def _lift(model: RobotModel, start: Floats, wanted: Floats, made: Floats, foot: int) -> Finding:
    """How high a foot comes over the plane of the other ones, against what was asked."""
    others = np.ones((2, model.leg_count), dtype=np.bool_)
    others[:, foot] = False
    heights = heights_over_standing(feet_in_robot(model, np.array([start, made])), others)[:, foot]
    asked = feet_in_robot(model, np.array([start, wanted]))[:, foot, 2]
    rise, wish = float(heights[1] - heights[0]), float(asked[1] - asked[0])
    slides = wish >= CLEARANCE_LIMIT > rise
    end = " It slides rather than lifts." if slides else ""
    sentence = (
        f"Foot {foot + 1} rises by {_mm(rise)} mm over the plane of the other feet, where {_mm(wish)} mm are "
        f"asked for.{end}"
    )
    return Finding("coupling", Severity.WARNING, sentence, rise, wish, None, foot)


def _mm(metres: float) -> str:
    """Millimetres with one decimal; what rounds to nothing has no sign."""
    return f"{round(metres * 1000, 1) + 0.0:.1f}"
