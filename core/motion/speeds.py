"""How fast feet and motors go in a motion."""

import numpy as np

from core.arrays import Floats
from core.motion.trajectory import Trajectory
from core.robot.coupled_strokes import real_strokes
from core.robot.kinematics import feet_in_modules, free_strokes
from core.robot.leg import stroke_rates
from core.robot.model import RobotModel


def foot_speeds(trajectory: Trajectory) -> Floats:
    """Speed of each foot in the world: ‖v‖ at each knot.

    Where velocities are unknown it is the mean speed of the move that ends at the knot, 0 at the first.

    Args:
        trajectory: n knots.

    Returns:
        (n, legs) m/s.
    """
    velocity = trajectory.feet_velocity
    if velocity is None:
        velocity = _mean_rates(trajectory.times, trajectory.feet_world)
    return np.asarray(np.linalg.norm(velocity, axis=-1))


def motor_speeds(model: RobotModel, trajectory: Trajectory) -> Floats:
    """How fast each motor extends or retracts: |ḣ| at each knot; of coupled motors what they make of it.

    Where velocities are unknown it is the mean speed of the move that ends at the knot, 0 at the first.

    Args:
        model: the robot.
        trajectory: n knots.

    Returns:
        (n, legs, 3) m/s; nan where no rod is long enough.
    """
    t = trajectory
    if t.body_velocity is None or t.feet_velocity is None:
        strokes = real_strokes(model, free_strokes(model, t.feet_world, t.pose(model)))
        return np.abs(_mean_rates(t.times, strokes))
    return np.abs(real_strokes(model, motor_rates(model, t, np.gradient(t.heading, t.times))))


def motor_accelerations(model: RobotModel, trajectory: Trajectory) -> Floats:
    """How fast each motor's speed changes from sample to sample: |Δḣ| / Δt.

    Where velocities are unknown speeds are the mean ones of the moves that end at each knot, 0 at the first.

    Args:
        model: the robot.
        trajectory: n knots.

    Returns:
        (n − 1, legs, 3) m/s²; nan where no rod is long enough.
    """
    t = trajectory
    if t.body_velocity is None or t.feet_velocity is None:
        rates = _mean_rates(t.times, real_strokes(model, free_strokes(model, t.feet_world, t.pose(model))))
    else:
        rates = real_strokes(model, motor_rates(model, t, np.gradient(t.heading, t.times)))
    return np.asarray(np.abs(np.diff(rates, axis=0)) / np.diff(t.times)[:, None, None])


def motor_rates(model: RobotModel, trajectory: Trajectory, heading_rate: Floats) -> Floats:
    """Rate of every stroke: a foot's velocity seen from the moving and turning body.

    v_rel = R_z(−θ)(v_foot − v_body − θ̇ e_z × (p_foot − p_body)), then the leg's own `stroke_rates`.

    Args:
        model: the robot.
        trajectory: n knots, with velocities.
        heading_rate: (n,) rad/s.

    Returns:
        (n, legs, 3) m/s; nan where no rod is long enough.
    """
    t = trajectory
    rate = np.asarray(heading_rate)[:, None]
    arm = t.feet_world - t.body_world[:, None, :]
    relative = np.asarray(t.feet_velocity) - np.asarray(t.body_velocity)[:, None, :]
    relative[..., 0] += rate * arm[..., 1]
    relative[..., 1] -= rate * arm[..., 0]
    cosine, sine = np.cos(t.heading)[:, None], np.sin(t.heading)[:, None]
    x, y, z = (relative[..., axis] for axis in range(3))
    seen = np.stack([cosine * x + sine * y, cosine * y - sine * x, z], axis=-1)
    in_modules = np.einsum("lji,nlj->nli", model.R_robot_from_module, seen)
    return stroke_rates(model.leg, feet_in_modules(model, t.feet_world, t.pose(model)), in_modules)


def _mean_rates(times: Floats, values: Floats) -> Floats:
    steps = np.diff(times).reshape(-1, *[1] * (values.ndim - 1))
    moved = np.diff(values, axis=0) / steps
    return np.concatenate([np.zeros_like(values[:1]), moved])
