"""The figures of a simulated run, all computed from its states, whatever engine made them."""

from __future__ import annotations

from dataclasses import dataclass

from core.arrays import Floats


@dataclass(frozen=True, eq=False)
class SimulationReport:
    """What came of a simulated run, beside its plan.

    Args:
        body_error: mean over waypoints of the distance between planned and simulated body, at each
            waypoint's arrival by index, m (what the thesis's Tables 4.1 and 4.2 call MSE).
        feet_error: (legs,) the same of each foot, m.
        distance: horizontal way of the body from first to last arrival, m.
        planned_distance: the plan's, m.
        heading: turn of the body about the vertical from first to last arrival, rad.
        planned_heading: the plan's, rad.
        max_tilt: largest angle between the body's axis and the vertical, rad.
        max_tilt_time: when, simulated s.
        fell: whether it tipped over.
        fell_time: when, simulated s; None where it did not.
        slip: (legs,) way that each foot slid while it should have stood, m.
        slip_samples: (count, legs) the same by move, m.
        min_margin: smallest distance of the centre of mass to the edge of the support of the feet that
            carry load, m; None where fewer than three ever do.
        min_margin_time: when, simulated s.
        motor_error: (legs, 3) largest distance of a motor from its ramp, m.
        saturation: (legs, 3) share of the time at which a motor's force is at its limit.
        loop_error: largest violation of a rod's length, m.
        realtime_factor: simulated seconds a second of computing.
        ended_early: why it ended before the last waypoint, or "".
    """

    body_error: float
    feet_error: Floats
    distance: float
    planned_distance: float
    heading: float
    planned_heading: float
    max_tilt: float
    max_tilt_time: float
    fell: bool
    fell_time: float | None
    slip: Floats
    slip_samples: Floats
    min_margin: float | None
    min_margin_time: float | None
    motor_error: Floats
    saturation: Floats
    loop_error: float
    realtime_factor: float
    ended_early: str

    @property
    def feet_mean_error(self) -> float:
        """Mean of the feet's errors, m."""
        return float(self.feet_error.mean())
