"""When each iteration of a run ended, by what the robot said of its waypoints."""

import numpy as np

from core.arrays import Floats, stretches
from core.motion.trajectory import Trajectory
from core.runs.pose import RanPlan
from core.runs.reading import RunSeries


def plan_ends(trajectory: Trajectory) -> Floats | None:
    """(iterations,) the plan's time at which each iteration ends, s; None where its feet do not tell.

    An iteration is over when every foot has stepped once: between its last landing and the next one's first
    lift. The last one ends with the plan.

    Args:
        trajectory: the plan.
    """
    contact, times = trajectory.contact, trajectory.times
    swings = [stretches(~contact[:, leg]) for leg in range(contact.shape[1])]
    counts = {len(swing) for swing in swings}
    if len(counts) != 1 or counts == {0}:
        return None
    (count,) = counts
    last = len(times) - 1
    ends = []
    for number in range(count - 1):
        landed = max(swing[number][1] + 1 for swing in swings)
        lifts = min(swing[number + 1][0] for swing in swings)
        if landed > lifts:
            return None
        ends.append((times[min(landed, last)] + times[lifts]) / 2.0)
    return np.array([*ends, times[-1]])


def iteration_arrivals(plan: RanPlan, series: RunSeries) -> Floats | None:
    """(iterations,) when the robot had arrived at each iteration's last waypoint, s on the run's clock.

    Iterations that the run did not bring to an end are left out; None where the plan does not tell where they
    end.

    Args:
        plan: what was to be done.
        series: what was done.
    """
    ends = plan_ends(plan.trajectory)
    if ends is None:
        return None
    lasts = np.searchsorted(plan.times, ends + 1e-6, side="right") - 1
    arrived = {(c.lap, c.index): c.arrived for c in series.streamed if c.is_reached}
    laps = 1 + max((lap for lap, _ in arrived), default=-1)
    wanted = [(lap, int(last)) for lap in range(laps) for last in lasts]
    return np.array([arrived[place] for place in wanted if place in arrived])
