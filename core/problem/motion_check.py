"""The independent checker: holds a solved motion to every constraint of its problem, in plain numpy.

It shares only the leg's geometry with the solvers. Each family has one function that returns its largest
violation, 0 where the family holds: m, m/s, N, or N·m. Sources: thesis (3.5) to (3.18) with the corrections
of docs/sources.md.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from core.arrays import Bools, Floats
from core.errors import InputError
from core.motion.speeds import motor_rates
from core.motion.support_polygon import GRAVITY, centre_of_pressure, stability_margins
from core.motion.trajectory import Trajectory
from core.problem.motion_problem import CYLINDER, GROUNDED_HEIGHT, Boundary, MotionProblem, Workspace
from core.robot.kinematics import actuator_plane_pose, feet_in_modules
from core.robot.leg import strokes_from_foot
from core.robot.shoes import foot_distances, least_distance

TOLERANCE = 1e-6
"""Largest violation of a motion that counts as confirmed, SI."""

_OUT_OF_RANGE = 1.0


@dataclass(frozen=True)
class MotionCheck:
    """What the checker measured.

    Args:
        violations: the largest violation of each family, SI, by its name in the contract.
        min_margin: smallest distance of the body point's ground projection to the support polygon's edge, m.
        min_cop_margin: the same for the centre of pressure, m.
    """

    violations: dict[str, float]
    min_margin: float
    min_cop_margin: float

    @property
    def max_violation(self) -> float:
        """The largest violation of all families, SI."""
        return max(self.violations.values())

    @property
    def worst_family(self) -> str:
        """Name of the family with the largest violation."""
        return max(self.violations, key=lambda family: self.violations[family])

    @property
    def confirmed(self) -> bool:
        """Whether every constraint holds to the tolerance."""
        return self.max_violation <= TOLERANCE


@dataclass(frozen=True, eq=False)
class _Motion:
    """A trajectory with everything known, and its problem."""

    problem: MotionProblem
    trajectory: Trajectory
    body: Floats
    feet: Floats
    body_velocity: Floats
    feet_velocity: Floats
    forces: Floats
    standing: Bools
    heading: Floats

    @property
    def intervals(self) -> Floats:
        return self.problem.intervals[:, None]

    @property
    def body_acceleration(self) -> Floats:
        return np.asarray(np.diff(self.body_velocity, axis=0) / self.intervals)

    @property
    def feet_acceleration(self) -> Floats:
        return np.asarray(np.diff(self.feet_velocity, axis=0) / self.intervals[..., None])

    @property
    def feet_module(self) -> Floats:
        model = self.problem.model
        return feet_in_modules(model, self.feet, actuator_plane_pose(model, self.body, self.problem.heading))

    @property
    def stroke_rates(self) -> Floats:
        """(n, legs, 3) speed of every motor, m/s: a foot's velocity seen from the turning body."""
        return motor_rates(self.problem.model, self.trajectory, self.problem.heading_rate)


def check_motion(problem: MotionProblem, trajectory: Trajectory) -> MotionCheck:
    """Measures how far a motion is from satisfying its problem.

    Args:
        problem: what was asked.
        trajectory: with velocities and contact forces; contact is taken from the problem's timeline.

    Raises:
        InputError: velocities or forces are missing, or knots or contact do not match the problem.
    """
    motion = _motion(problem, trajectory)
    families = FAMILIES | {name: OPTIONAL_FAMILIES[name] for name in _asked(problem)}
    violations = {name: _violation(float(family(motion))) for name, family in families.items()}
    pressure = centre_of_pressure(
        motion.body[:-1],
        motion.body_acceleration,
        motion.feet_acceleration,
        problem.model.masses.body,
        problem.model.masses.foot,
    )
    feet, standing = motion.feet, motion.standing
    margins = stability_margins(pressure, feet[:-1], standing[:-1])
    min_cop_margin = min(float(margins.min()), *_rest_margins(problem))
    late = _violation(float(np.abs(trajectory.times - problem.times).max()))
    violations["dynamics"] = max(violations["dynamics"], late)
    violations["body_torque"] = max(violations["body_torque"], problem.limits.margin - min_cop_margin, 0.0)
    return MotionCheck(
        violations=violations,
        min_margin=float(stability_margins(motion.body[:, :2], feet, standing).min()),
        min_cop_margin=min_cop_margin,
    )


def _rest_margins(problem: MotionProblem) -> list[float]:
    """Distance of the resting body's ground point to the edge at ends where feet are held up, m."""
    if problem.boundary is Boundary.PERIODIC:
        return [float("inf")]
    found = [float("inf")]
    for pose, held in ((problem.start, problem.held_start), (problem.goal, problem.held_end)):
        if held.any():
            point, feet = pose.body_world[None, :2], pose.feet_world[None]
            found.append(float(stability_margins(point, feet, ~held[None])[0]))
    return found


def _violation(value: float) -> float:
    # A comparison with nan is false, so that max() alone would pass it over.
    return max(0.0, value) if np.isfinite(value) else float("inf")


def _motion(problem: MotionProblem, trajectory: Trajectory) -> _Motion:
    velocities = (trajectory.body_velocity, trajectory.feet_velocity)
    if velocities[0] is None or velocities[1] is None or trajectory.contact_forces is None:
        raise InputError("The checker needs velocities and contact forces.", "trajectory")
    if trajectory.feet_world.shape[:2] != (problem.knot_count, problem.model.leg_count):
        raise InputError("The trajectory's samples or feet do not match its problem.", "trajectory")
    # The last knot is the goal, where motions stand though a timeline may end in the air; held feet do not.
    same = np.array_equal(trajectory.contact[:-1], problem.timeline.contact[:-1])
    if not same or trajectory.contact[-1, problem.held_end].any():
        raise InputError("The trajectory's contact is not that of its problem's timeline.", "trajectory")
    return _Motion(
        problem=problem,
        trajectory=trajectory,
        body=trajectory.body_world,
        feet=trajectory.feet_world,
        body_velocity=velocities[0],
        feet_velocity=velocities[1],
        forces=trajectory.contact_forces[:-1],
        standing=problem.timeline.contact,
        heading=trajectory.heading,
    )


def _asked(problem: MotionProblem) -> list[str]:
    limits = problem.limits
    asked = {
        "friction": limits.friction,
        "motor_speed": limits.motor_speed,
        "motor_acceleration": limits.motor_acceleration,
        "shoe_distance": least_distance(problem.model),
    }
    return [name for name, limit in asked.items() if limit is not None]


def _boundary(m: _Motion) -> float:
    """(3.5), (3.6): first and last state are the given poses at rest, or one is the other moved on."""
    start, goal = m.problem.start, m.problem.goal
    if m.problem.boundary is Boundary.PERIODIC:
        differences = [
            m.body[-1] - m.body[0] - (goal.body_world - start.body_world),
            m.feet[-1] - m.feet[0] - (goal.feet_world - start.feet_world),
            m.body[0, :2] - start.body_world[:2],
            *(v[-1] - v[0] for v in (m.body_velocity, m.feet_velocity)),
            np.where(m.problem.held_start, m.feet[0, :, 2] - start.feet_world[:, 2], 0.0),
            m.heading - m.problem.heading,
        ]
        return max(float(np.abs(d).max()) for d in differences)
    differences = [
        m.heading - m.problem.heading,
        m.body[0] - m.problem.start.body_world,
        m.body[-1] - m.problem.goal.body_world,
        m.feet[0] - m.problem.start.feet_world,
        m.feet[-1] - m.problem.goal.feet_world,
        *(v[k] for v in (m.body_velocity, m.feet_velocity) for k in (0, -1)),
    ]
    return max(float(np.abs(d).max()) for d in differences)


def _dynamics(m: _Motion) -> float:
    """(3.2), (3.7): positions follow velocities exactly, and contact forces carry weight and acceleration."""
    half = m.intervals / 2
    body_gap = np.diff(m.body, axis=0) - half * (m.body_velocity[1:] + m.body_velocity[:-1])
    feet_gap = np.diff(m.feet, axis=0) - half[..., None] * (m.feet_velocity[1:] + m.feet_velocity[:-1])
    masses = m.problem.model.masses
    momentum = masses.body * m.body_acceleration + masses.foot * m.feet_acceleration.sum(axis=1)
    weight = np.array([0.0, 0.0, m.problem.model.total_model_mass * GRAVITY])
    force_gap = momentum + weight - m.forces.sum(axis=1)
    return max(float(np.abs(gap).max()) for gap in (body_gap, feet_gap, force_gap))


def _body_height(m: _Motion) -> float:
    """(3.8) for the actuator plane."""
    lower, upper = m.problem.limits.plane_height
    plane = m.body[:, 2] - m.problem.model.com_height
    return float(max((lower - plane).max(), (plane - upper).max()))


def _foot_height(m: _Motion) -> float:
    """(3.9): no foot below the ground."""
    return float((-m.feet[..., 2]).max())


def _foot_speed(m: _Motion) -> float:
    """(3.10)."""
    return float(np.linalg.norm(m.feet_velocity, axis=-1).max() - m.problem.limits.foot_speed)


def _body_speed(m: _Motion) -> float:
    return float(np.linalg.norm(m.body_velocity, axis=-1).max() - m.problem.limits.body_speed)


def _grounded_velocity(m: _Motion) -> float:
    """(3.11): a standing foot is at rest."""
    return float(np.abs(m.feet_velocity[m.standing]).max())


def _grounded_height(m: _Motion) -> float:
    """(3.12)."""
    return float(m.feet[m.standing][:, 2].max() - GROUNDED_HEIGHT)


def _contact_force(m: _Motion) -> float:
    """(3.13): the ground only pushes."""
    return float((-m.forces[..., 2]).max())


def _floating_force(m: _Motion) -> float:
    """(3.14): no force on a foot in the air."""
    floating = m.forces[~m.standing[:-1]]
    return float(np.abs(floating).max()) if floating.size else 0.0


def _body_torque(m: _Motion) -> float:
    """(3.15): contact forces turn nothing about the body's point."""
    arms = m.feet[:-1] - m.body[:-1, None, :]
    return float(np.abs(np.cross(m.forces, arms).sum(axis=1)).max())


def _workspace(m: _Motion) -> float:
    """(3.16) to (3.18) with P's depth, or every motor within its stroke."""
    model, feet_module = m.problem.model, m.feet_module
    if m.problem.limits.workspace is Workspace.CYLINDER:
        height = feet_module[..., 2] + CYLINDER.depth
        outside = np.linalg.norm(feet_module[..., :2], axis=-1) - CYLINDER.radius
        return float(max(outside.max(), (-CYLINDER.below - height).max(), (height - CYLINDER.above).max()))
    strokes = strokes_from_foot(model.leg, feet_module)
    if not np.isfinite(strokes).all():
        return _OUT_OF_RANGE
    return float(max((model.stroke.lower - strokes).max(), (strokes - model.stroke.upper).max()))


def _clearance(m: _Motion) -> float:
    """The highest knot of each swing is at least the clearance.

    A foot that is held up at an end is as high as that there by the boundary, and need not rise further.
    """
    first_held, last_held = m.problem.held_start, m.problem.held_end
    shortfalls = [
        m.problem.limits.clearance - m.feet[swing.first : swing.last + 1, swing.foot, 2].max()
        for swing in m.problem.timeline.swings()
        if not (swing.first == 0 and first_held[swing.foot])
        and not (swing.last == m.problem.knot_count - 1 and last_held[swing.foot])
    ]
    return float(max(shortfalls, default=0.0))


def _friction(m: _Motion) -> float:
    """Friction cone of each foot: ‖λ_xy‖ ≤ μ λ_z."""
    sideways = np.linalg.norm(m.forces[..., :2], axis=-1)
    return float((sideways - (m.problem.limits.friction or 0.0) * m.forces[..., 2]).max())


def _motor_speed(m: _Motion) -> float:
    return float(np.abs(m.stroke_rates).max() - (m.problem.limits.motor_speed or 0.0))


def _motor_acceleration(m: _Motion) -> float:
    change = np.diff(m.stroke_rates, axis=0) / m.intervals[..., None]
    return float(np.abs(change).max() - (m.problem.limits.motor_acceleration or 0.0))


def _shoe_distance(m: _Motion) -> float:
    """Every two feet p, q: |p_xy − q_xy| ≥ d, so that there is room between their shoes."""
    return (least_distance(m.problem.model) or 0.0) - float(foot_distances(m.feet).min())


FAMILIES: dict[str, Callable[[_Motion], float]] = {
    "dynamics": _dynamics,
    "body_height": _body_height,
    "foot_height": _foot_height,
    "foot_speed": _foot_speed,
    "grounded_velocity": _grounded_velocity,
    "grounded_height": _grounded_height,
    "contact_force": _contact_force,
    "floating_force": _floating_force,
    "body_torque": _body_torque,
    "body_speed": _body_speed,
    "workspace": _workspace,
    "clearance": _clearance,
    "boundary": _boundary,
}
"""Every family of constraints, by its name in the contract."""

OPTIONAL_FAMILIES: dict[str, Callable[[_Motion], float]] = {
    "friction": _friction,
    "motor_speed": _motor_speed,
    "motor_acceleration": _motor_acceleration,
    "shoe_distance": _shoe_distance,
}
"""Families that count only where the problem, or for shoes the robot, asks for them."""
