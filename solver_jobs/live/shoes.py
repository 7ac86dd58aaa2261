"""Room between shoes as rows, linear about a motion: feet stay apart along the direction they have there."""

import numpy as np

from core.arrays import Floats
from core.motion.trajectory import Trajectory
from core.problem.initial_guess import Indices
from core.problem.motion_problem import MotionProblem
from core.robot.shoes import foot_distances, foot_pairs, least_distance, neighbour_pairs
from solver_jobs.live.linearisation import MM, Linearisation
from solver_jobs.live.rows import Rows, dot_terms, make_rows
from solver_jobs.nlp.constraint import Family

NEAR = 0.010
"""Rows are there where a motion brings two feet within this of their least distance, m. Where it does not,
further limits hardly change that, and a program without these rows is smaller."""

ROUNDING_MM = 1e-7
"""What rounding takes from a distance between footholds that are given."""


def shoes_meet(problem: MotionProblem, motion: Trajectory, room: float = 0.0) -> bool:
    """Whether two feet come nearer to each other than their shoes and some room need.

    Args:
        problem: what is asked; nothing meets where the robot has no shoes.
        motion: of the problem.
        room: beyond the least distance, m.
    """
    least = least_distance(problem.model)
    return least is not None and float(foot_distances(motion.feet_world).min()) < least + room


def standing_shoes(linearisation: Linearisation) -> list[Rows]:
    """A row for every two standing feet whose footholds are nearer to each other than their shoes need."""
    least = least_distance(linearisation.problem.model)
    if least is None:
        return []
    pairs = foot_pairs(linearisation.problem.model.leg_count)
    stands = linearisation.contact[:, pairs].all(axis=-1)
    missing = least * MM - ROUNDING_MM - foot_distances(linearisation.known[0, :, 1:])
    knot, pair = np.nonzero(stands & (missing > 0))
    if not len(knot):
        return []
    return [make_rows(Family.SHOE_DISTANCE, "mm", [], (-np.inf, -missing[knot, pair]), knot, pairs[pair])]


def shoe_rows(linearisation: Linearisation, about: Trajectory) -> list[Rows]:
    """Rows for every two neighbouring feet p, q at each knot; none where the motion brings none near others.

    n · (p − q) ≥ d with n = (p − q) / |p − q| of the given motion. Since |p − q| ≥ n · (p − q), a motion that
    keeps the rows keeps the distance.

    Args:
        linearisation: the known part.
        about: a motion near the one sought.
    """
    problem = linearisation.problem
    least = least_distance(problem.model)
    if least is None or not shoes_meet(problem, about, NEAR):
        return []
    pairs = neighbour_pairs(problem.model.leg_count)
    knot, pair = (index.reshape(-1) for index in np.indices((problem.knot_count, len(pairs))))
    first, second = pairs[pair].T
    normal = _directions(about, pairs)[knot, pair]
    terms = dot_terms(linearisation, 0, knot, first + 1, normal) + dot_terms(
        linearisation, 0, knot, second + 1, -normal
    )
    bounds = (least * MM - ROUNDING_MM, np.inf)
    return [make_rows(Family.SHOE_DISTANCE, "mm", terms, bounds, knot, pairs[pair])]


def _directions(about: Trajectory, pairs: Indices) -> Floats:
    """(n, pairs, 2) unit vectors from the second foot of each pair to the first."""
    apart = about.feet_world[:, pairs[:, 0], :2] - about.feet_world[:, pairs[:, 1], :2]
    length = np.linalg.norm(apart, axis=-1, keepdims=True)
    # Feet in one place have no direction; any will do.
    return np.asarray(np.where(length > 0, apart / np.maximum(length, 1e-12), [1.0, 0.0]))
