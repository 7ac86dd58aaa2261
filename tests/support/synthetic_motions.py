"""Simulated runs made by hand, whose figures are known."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from core.arrays import Bools, Floats
from core.motion.trajectory import Trajectory
from core.physics.motion import SimulatedMotion
from core.physics.parameters import physics_set
from core.physics.problem import Rig, SimulationProblem
from core.robot.model import load_robot
from core.wire.waypoint_path import waypoints_from_trajectory

MODEL = load_robot("deltawalker")
KNOTS, EACH = 5, 10
"""Waypoints, and samples a move."""


def walking_plan() -> Trajectory:
    """The body goes 4 mm along x over standing feet."""
    body = np.tile([0.0, 0.0, 0.0735], (KNOTS, 1))
    body[:, 0] = np.linspace(0.0, 0.004, KNOTS)
    feet = np.tile(MODEL.module_centres_robot, (KNOTS, 1, 1))
    contact = np.ones((KNOTS, 4), dtype=np.bool_)
    return Trajectory(np.linspace(0.0, 1.6, KNOTS), body, np.zeros(KNOTS), feet, contact)


def problem_of(plan: Trajectory, standing: Bools | None = None, rig: Rig = Rig.WALKING) -> SimulationProblem:
    waypoints = waypoints_from_trajectory(MODEL, plan)
    stands = plan.contact if standing is None else standing
    return SimulationProblem(
        MODEL, waypoints, plan, plan.times, plan.contact, stands, physics_set("scales"), rig
    )


def as_planned(problem: SimulationProblem) -> SimulatedMotion:
    """Exactly the plan, at 20 samples a second; each move takes half a second."""
    n = (KNOTS - 1) * EACH + 1
    times = np.linspace(0.0, 2.0, n)
    knots = np.linspace(0.0, 2.0, KNOTS)
    strokes = spread(times, knots, problem.waypoints.strokes)
    feet = spread(times, knots, problem.plan.feet_world)
    body = spread(times, knots, problem.plan.body_world)
    forces = np.zeros_like(feet)
    forces[..., 2] = 0.570 * 9.81 / 4
    return SimulatedMotion(
        times=times,
        body_world=body,
        attitude=np.tile([1.0, 0.0, 0.0, 0.0], (n, 1)),
        feet_world=feet,
        strokes=strokes,
        targets=strokes,
        motor_forces=np.full_like(strokes, 0.5),
        ground_forces=forces,
        centre_world=body,
        arrivals=np.arange(KNOTS) * EACH,
        loop_error=0.0,
        seconds=0.1,
    )


def spread(times: Floats, knots: Floats, values: Floats) -> Floats:
    """Values of knots, linear in between."""
    columns = values.reshape(len(knots), -1).T
    there = np.stack([np.interp(times, knots, column) for column in columns], axis=-1)
    return there.reshape(len(times), *values.shape[1:])


def leaning(motion: SimulatedMotion, angle: Floats) -> SimulatedMotion:
    """The body turned about the world's x by angles (n,), its soles where they are."""
    zero = np.zeros_like(angle)
    attitude = np.stack([np.cos(angle / 2), np.sin(angle / 2), zero, zero], axis=-1)
    axis = np.stack([zero, -np.sin(angle), np.cos(angle)], axis=-1)
    upright = np.array([0.0, 0.0, 1.0])
    feet = motion.feet_world + MODEL.sole_depth * (axis - upright)[:, None, :]
    return replace(motion, attitude=attitude, feet_world=feet)


def swinging(problem: SimulationProblem, foot: int, first: int, last: int) -> SimulationProblem:
    """The same question of a foot that should be in the air at some waypoints."""
    contact, standing = problem.contact.copy(), problem.standing.copy()
    contact[first : last + 1, foot] = False
    standing[first : last + 2, foot] = False
    return replace(problem, contact=contact, standing=standing)


def turned(motion: SimulatedMotion, angle: Floats) -> SimulatedMotion:
    """The body turned about its axis by angles (n,)."""
    zero = np.zeros_like(angle)
    attitude = np.stack([np.cos(angle / 2), zero, zero, np.sin(angle / 2)], axis=-1)
    return replace(motion, attitude=attitude)


def sliding(motion: SimulatedMotion, foot: int, first: int, last: int, way: float) -> SimulatedMotion:
    """A foot goes along y by a way between two samples, and stays there."""
    feet = motion.feet_world.copy()
    share = np.clip((np.arange(len(feet)) - first) / (last - first), 0.0, 1.0)
    feet[:, foot, 1] += way * share
    return replace(motion, feet_world=feet)


PROBLEM = problem_of(walking_plan())
PLANNED = as_planned(PROBLEM)
"""A run of it that goes as it was planned."""
