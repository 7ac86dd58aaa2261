"""The figures of a simulated run, all computed from its states, whatever engine made them."""

from dataclasses import dataclass

from core.arrays import Floats
from core.motion.way_made import WayMade


@dataclass(frozen=True, eq=False)
class SimulationReport:
    """What came of a simulated run, beside its plan.

    Args:
        body_error: mean over waypoints of the distance between planned and simulated body, at each
            waypoint's arrival by index, m (what the thesis's Tables 4.1 and 4.2 call MSE).
        feet_error: (legs,) the same of each foot, m.
        distance: horizontal way of the body from first to last arrival, m.
        planned_distance: the plan's, m.
        way: how much of the whole plan's way and turn is made.
        heading: turn of the body about the vertical from first to last arrival, rad.
        planned_heading: the plan's, rad.
        max_tilt: largest angle between the body's axis and the vertical, rad.
        max_tilt_time: when, simulated s.
        fell: whether it tipped over, or its body sank to the floor.
        fell_time: when, simulated s; None where it did not.
        slip: (legs,) way that each foot slid while it should have stood, m.
        slip_samples: (count, legs) the same by move, m.
        swing_load: (legs,) largest share of a swing's time in which a foot carries load; 0 of one that never
            swings.
        swing_load_times: (legs,) the middle of that swing, simulated s.
        min_margin: smallest distance of the centre of mass to the edge of the support of the feet that
            carry load (within 0.1 s), m; None where fewer than three ever do.
        min_margin_time: when, simulated s.
        motor_error: (legs, 3) largest distance of a motor from its ramp, m.
        motor_error_times: (legs, 3) when, simulated s.
        saturation: (legs, 3) share of the time at which a motor's force is at its limit.
        peak_forces: (legs, 3) largest force of a motor, either way, N.
        peak_force_times: (legs, 3) when, simulated s.
        arrival_times: (reached,) when each waypoint's move had ended, simulated s; fewer than there are
            waypoints where the run ended early.
        loop_error: largest violation of a rod's length, m.
        realtime_factor: simulated seconds a second of computing.
        ended_early: why it ended before the last waypoint, or "".
    """

    body_error: float
    feet_error: Floats
    distance: float
    planned_distance: float
    way: WayMade
    heading: float
    planned_heading: float
    max_tilt: float
    max_tilt_time: float
    fell: bool
    fell_time: float | None
    slip: Floats
    slip_samples: Floats
    swing_load: Floats
    swing_load_times: Floats
    min_margin: float | None
    min_margin_time: float | None
    motor_error: Floats
    motor_error_times: Floats
    saturation: Floats
    peak_forces: Floats
    peak_force_times: Floats
    arrival_times: Floats
    loop_error: float
    realtime_factor: float
    ended_early: str

    @property
    def feet_mean_error(self) -> float:
        """Mean of the feet's errors, m."""
        return float(self.feet_error.mean())
