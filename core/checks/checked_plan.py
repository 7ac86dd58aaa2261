"""The input of the rules: a plan, its waypoints, and the limits that its document sets."""

from dataclasses import dataclass, field

import numpy as np

from core.arrays import Bools, Floats
from core.gait.gait import Gait, travel_world
from core.gait.held_feet import HeldFeet
from core.motion.trajectory import Trajectory
from core.robot.model import RobotModel
from core.wire.waypoint_merging import WaypointPlan
from core.wire.waypoints import Waypoints


@dataclass(frozen=True)
class Asked:
    """What a document asks of its motion beyond the travel; None and 0 ask nothing.

    Args:
        turn: of the body from the first sample to the last, rad.
        heights: of the actuator plane over the standing feet at the first and the last sample, m.
        margin: how far inside the support polygon the point that balance is judged by stays, m.
        motor_speed: limit of each motor's speed, m/s.
        motor_acceleration: limit of each motor's acceleration, m/s².
        held: feet that are in the air at the ends on purpose.
        sent_whole: whether its waypoints are sent as they are, neither merged nor cut.
    """

    turn: float | None = None
    heights: tuple[float, float] | None = None
    margin: float = 0.0
    motor_speed: float | None = None
    motor_acceleration: float | None = None
    held: HeldFeet = field(default_factory=HeldFeet)
    sent_whole: bool = False


@dataclass(frozen=True, eq=False)
class Beyond:
    """Where a motion leaves the motors' range, beside the strokes themselves.

    Args:
        clipped: (n, legs, 3) how far each stroke was beyond the range before it was clipped, m; None where
            none was clipped.
        unreached: (n, legs) feet for which no rod is long enough; None where every rod is.
    """

    clipped: Floats | None = None
    unreached: Bools | None = None


WITHIN = Beyond()


@dataclass(frozen=True, eq=False)
class CheckedPlan:
    """A plan with everything that the rules check.

    Args:
        model: the robot.
        trajectory: the plan in the world frame.
        waypoints: what would be sent.
        expected_displacement: (2,) the body's displacement that the document asks for, m; None where unknown.
        is_draft: whether the plan was only drawn, not computed by hand table or optimiser.
        way: how the waypoints were merged and cut; None where they are one a knot and the path between them
            is not looked at.
        asked: what else the document asks for.
        is_fresh: whether the plan was made from the document as it is.
        beyond: where the motion leaves the motors' range.
    """

    model: RobotModel
    trajectory: Trajectory
    waypoints: Waypoints
    expected_displacement: Floats | None = None
    is_draft: bool = False
    way: WaypointPlan | None = None
    asked: Asked = field(default_factory=Asked)
    is_fresh: bool = True
    beyond: Beyond = WITHIN

    @property
    def knots(self) -> Waypoints:
        """One waypoint a sample."""
        return self.waypoints if self.way is None else self.way.knots


def checked_plan(
    gait: Gait,
    model: RobotModel,
    trajectory: Trajectory,
    way: WaypointPlan,
    *,
    is_draft: bool = False,
    is_fresh: bool = True,
    beyond: Beyond = WITHIN,
) -> CheckedPlan:
    """A gait's plan beside everything that its document asks.

    Args:
        gait: the document.
        model: its robot.
        trajectory: the plan.
        way: what would be sent.
        is_draft: whether the plan was only drawn.
        is_fresh: whether the plan was made from this document.
        beyond: where the motion leaves the motors' range.
    """
    travel = travel_world(gait, model)
    return CheckedPlan(
        model, trajectory, way.waypoints, travel, is_draft, way, asked_of(gait), is_fresh, beyond
    )


def asked_of(gait: Gait) -> Asked:
    """What a document asks of its motion.

    A hand table, a recorded motion and the parts of a sequence bring their own heights, speeds and margins.
    """
    turn = float(gait.step[2] * gait.iterations)
    if gait.recorded is not None or gait.segment_table is not None or gait.sequence:
        return Asked(turn=turn, held=gait.held)
    options = gait.options
    if gait.poses is not None:
        return Asked(turn=turn, margin=options.margin, sent_whole=True)
    end = options.plane_height if options.end_plane_height is None else options.end_plane_height
    return Asked(
        turn=turn,
        heights=(options.plane_height, end),
        margin=options.margin,
        motor_speed=options.motor_speed,
        motor_acceleration=options.motor_acceleration,
        held=gait.held,
    )


def knot_place(plan: CheckedPlan, sample: int) -> dict[str, int | float]:
    """Sample and time of a knot, as a finding names them."""
    times = plan.trajectory.times
    return {"sample": int(sample), "time": float(times[min(int(sample), len(times) - 1)])}


def plane_heights(plan: CheckedPlan) -> Floats:
    """(n,) height of the actuator plane over the platforms of standing feet, m."""
    return np.asarray(plan.trajectory.body_world[:, 2] - plan.model.com_height)
