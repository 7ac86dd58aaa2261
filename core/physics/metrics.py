"""From the states of a simulated run to its figures: errors, tilt, falls, slip, balance, tracking."""

import numpy as np
from numpy.typing import NDArray

from core.arrays import Bools, Floats, interpolated, stretches
from core.motion.support_polygon import stability_margins
from core.motion.way_made import WayMade, way_made
from core.physics.motion import SimulatedMotion
from core.physics.motors import motor_force_limits
from core.physics.problem import Rig, SimulationProblem
from core.physics.report import SimulationReport

FALL_TILT = float(np.radians(30.0))
"""A body that leans further has fallen over, rad; a robot that only rocks onto a lifted foot leans by a few
degrees."""
FALL_HEIGHT = 0.030
"""A body whose actuator plane is lower over the standing feet's platforms has fallen, m; the shortest legs
hold it at 48."""
LOAD = 0.05
"""A foot carries load where the ground pushes it up by more than this, N; a fifth of a foot's own weight."""
HANDING_OVER = 0.1
"""Time within which a foot that loses its load still counts as bearing, s."""
SWING_REST = 0.2
"""Motors rest at least so long before and after each arrival, s; so a swing of one waypoint lasts too."""
ON_GRID = 1e-9
"""Times this near to a sample are at the sample, s."""
AT_LIMIT = 0.98
"""A motor's force is at its limit from this share of it on."""


def report(problem: SimulationProblem, motion: SimulatedMotion) -> SimulationReport:
    """Compares a simulated run with its plan.

    Errors are the mean of |p_plan(k) − p_simulated(k)| over the waypoints k, each at the end of its move, by
    index (thesis 4.2 calls this the mean square error). Where the robot does not walk, its feet are compared
    in the body's own frame, since nothing ties the body to the plan's world.

    Args:
        problem: what was asked.
        motion: what came of it; of a run that ended early the waypoints that were reached count.
    """
    arrivals = motion.arrivals[: problem.waypoints.count]
    rotation = rotations(motion.attitude)
    body_error, feet_error = _errors(problem, motion, rotation, arrivals)
    tilt = tilts(rotation)
    worst = int(tilt.argmax())
    down = _fallen(problem, motion, tilt)
    slips = _slips(problem, motion, rotation, arrivals)
    swing_load, swing_load_times = _swing_loads(problem, motion, arrivals)
    margin, margin_time = _smallest_margin(motion)
    planned = _planned_at(problem, len(arrivals))
    track = np.abs(motion.strokes - motion.targets)
    force, limits = np.abs(motion.motor_forces), motor_force_limits(problem.model, problem.physics)
    way, planned_way = (
        points[-1, :2] - points[0, :2] for points in (motion.body_world[arrivals], planned[0])
    )
    heading = np.unwrap(np.arctan2(rotation[:, 1, 0], rotation[:, 0, 0]))[arrivals]
    middles = soles(problem, motion, rotation)[..., :2].mean(axis=1)
    return SimulationReport(
        body_error=body_error,
        feet_error=feet_error,
        distance=float(np.linalg.norm(way)),
        planned_distance=float(np.linalg.norm(planned_way)),
        way=_way(problem, middles[arrivals], heading),
        heading=float(heading[-1] - heading[0]),
        planned_heading=float(planned[1][-1] - planned[1][0]),
        max_tilt=float(tilt[worst]),
        max_tilt_time=float(motion.times[worst]),
        fell=bool(down.any()),
        fell_time=float(motion.times[int(down.argmax())]) if down.any() else None,
        slip=slips.sum(axis=0),
        slip_samples=slips,
        swing_load=swing_load,
        swing_load_times=swing_load_times,
        min_margin=margin,
        min_margin_time=margin_time,
        motor_error=track.max(axis=0),
        motor_error_times=motion.times[track.argmax(axis=0)],
        saturation=(force >= AT_LIMIT * limits).mean(axis=0),
        peak_forces=force.max(axis=0),
        peak_force_times=motion.times[force.argmax(axis=0)],
        arrival_times=motion.times[arrivals],
        loop_error=motion.loop_error,
        realtime_factor=motion.realtime_factor,
        ended_early=motion.ended_early,
    )


def rotations(attitude: Floats) -> Floats:
    """(n, 3, 3) R_world_body of unit quaternions (n, 4), w first."""
    w, x, y, z = np.moveaxis(attitude, -1, 0)
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)


def tilts(rotation: Floats) -> Floats:
    """(n,) angle between the body's axis and the vertical, rad, of rotations R_world_body (n, 3, 3)."""
    axis = rotation[:, :, 2]
    return np.asarray(np.arctan2(np.hypot(axis[:, 0], axis[:, 1]), axis[:, 2]))


def carrying(motion: SimulatedMotion) -> Bools:
    """(n, legs) feet that carry load: the ground pushes them up by more than `LOAD`."""
    return np.asarray(motion.ground_forces[..., 2] > LOAD)


def bearing(motion: SimulatedMotion) -> Bools:
    """(n, legs) feet that carry load within `HANDING_OVER`.

    While feet hand over, the robot rocks from one to the other within hundredths of a second, and leans on
    both.
    """
    return _within(carrying(motion), motion.times)


def soles(problem: SimulationProblem, motion: SimulatedMotion, rotation: Floats) -> Floats:
    """(n, legs, 3) middles of the soles, m: `sole_depth` below the platforms along the body's axis.

    A delta's foot keeps the body's attitude. A body that leans moves its platforms sideways while the soles
    stay where they are.
    """
    return np.asarray(motion.feet_world - problem.model.sole_depth * rotation[:, None, :, 2])


def _way(problem: SimulationProblem, middles: Floats, headings: Floats) -> WayMade:
    """What is made of the whole plan's way; a robot that does not walk is asked for none.

    Args:
        problem: what was asked.
        middles: (reached, 2) of the soles at the arrivals, m.
        headings: (reached,) rad.
    """
    if problem.rig is not Rig.WALKING:
        return WayMade(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    _, planned, feet = _planned_at(problem, problem.waypoints.count)
    return way_made((feet[..., :2].mean(axis=1), planned), (middles, headings))


def _planned_at(problem: SimulationProblem, reached: int) -> tuple[Floats, Floats, Floats]:
    """The plan's body (reached, 3), heading (reached,) and feet (reached, legs, 3) at the first waypoints."""
    plan, times = problem.plan, problem.times[:reached]
    columns = np.concatenate(
        [plan.body_world, plan.heading[:, None], plan.feet_world.reshape(plan.knot_count, -1)], axis=1
    )
    there = interpolated(times, plan.times, columns)
    return there[:, :3], there[:, 3], there[:, 4:].reshape(reached, plan.leg_count, 3)


def _errors(
    problem: SimulationProblem, motion: SimulatedMotion, rotation: Floats, arrivals: NDArray[np.int64]
) -> tuple[float, Floats]:
    """Mean distance of the body, and of each foot (legs,), m."""
    body, heading, feet = _planned_at(problem, len(arrivals))
    real_body, real_feet = motion.body_world[arrivals], motion.feet_world[arrivals]
    body_error = float(np.linalg.norm(real_body - body, axis=-1).mean())
    if problem.rig is not Rig.WALKING:
        feet = _in_body(feet, body, _about_z(heading))
        real_feet = _in_body(real_feet, real_body, rotation[arrivals])
    return body_error, np.asarray(np.linalg.norm(real_feet - feet, axis=-1).mean(axis=0))


def _in_body(feet_world: Floats, body_world: Floats, R_world_body: Floats) -> Floats:
    return np.asarray(np.einsum("nji,nlj->nli", R_world_body, feet_world - body_world[:, None]))


def _about_z(angle: Floats) -> Floats:
    """(n, 3, 3) rotations about z by angles (n,), rad."""
    zero = np.zeros_like(angle)
    return rotations(np.stack([np.cos(angle / 2), zero, zero, np.sin(angle / 2)], axis=-1))


def _fallen(problem: SimulationProblem, motion: SimulatedMotion, tilt: Floats) -> Bools:
    """(n,) samples at which a walking robot has fallen."""
    plane_height = motion.body_world[:, 2] - problem.model.com_height
    down = (tilt > FALL_TILT) | (plane_height < FALL_HEIGHT)
    return np.asarray(down & (problem.rig is Rig.WALKING))


def _slips(
    problem: SimulationProblem, motion: SimulatedMotion, rotation: Floats, arrivals: NDArray[np.int64]
) -> Floats:
    """(count, legs) way that each sole slid during each move, while it should have stood and carried load, m.

    The way is the sum of the horizontal steps from sample to sample at both of which the foot carries load.
    """
    steps = np.linalg.norm(np.diff(soles(problem, motion, rotation)[..., :2], axis=0), axis=-1)
    carries = carrying(motion)
    slid = np.cumsum(steps * (carries[1:] & carries[:-1]), axis=0)
    way = np.concatenate([np.zeros((1, problem.model.leg_count)), slid])
    slips = np.zeros(problem.standing.shape)
    slips[1 : len(arrivals)] = np.diff(way[arrivals], axis=0)
    return np.asarray(np.where(problem.standing, slips, 0.0))


def _swing_loads(
    problem: SimulationProblem, motion: SimulatedMotion, arrivals: NDArray[np.int64]
) -> tuple[Floats, Floats]:
    """(legs,) largest share of a swing in which a foot carries load, and (legs,) the middle of that swing, s.

    A swing lasts from its first waypoint in the air to its last one, with the rest of the motors at both.
    """
    carries, legs = carrying(motion), problem.model.leg_count
    shares, middles = np.zeros(legs), np.zeros(legs)
    for foot in range(legs):
        for first, last in stretches(~problem.contact[: len(arrivals), foot]):
            ends = motion.times[arrivals[[first, last]]]
            rest = SWING_REST + ON_GRID
            begin, end = np.searchsorted(motion.times, ends + [-rest, rest])
            share = float(carries[begin:end, foot].mean())
            if share > shares[foot]:
                shares[foot], middles[foot] = share, ends.mean()
    return shares, middles


def _smallest_margin(motion: SimulatedMotion) -> tuple[float | None, float | None]:
    """The centre of mass's smallest distance to the edge of the feet that bear, where three do."""
    bears = bearing(motion)
    known = bears.sum(axis=1) >= 3
    if not known.any():
        return None, None
    margins = stability_margins(motion.centre_world[known, :2], motion.feet_world[known], bears[known])
    worst = int(margins.argmin())
    return float(margins[worst]), float(motion.times[known][worst])


def _within(flags: Bools, times: Floats) -> Bools:
    """(n, legs) whether a flag is up at any time within `HANDING_OVER`, before or after."""
    first = np.searchsorted(times, times - HANDING_OVER - ON_GRID)
    after = np.searchsorted(times, times + HANDING_OVER + ON_GRID)
    count = np.concatenate([np.zeros_like(flags[:1], dtype=np.int64), np.cumsum(flags, axis=0)])
    return np.asarray(count[after] > count[first])
