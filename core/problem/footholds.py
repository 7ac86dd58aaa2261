"""Where along its way each foot rests between its swings."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from core.arrays import SAME, Floats
from core.motion.contact_timeline import Swing
from core.problem.motion_problem import Boundary, MotionProblem

LEVEL = SAME
"""Feet below this, m, stand level. Feet that do not could push against each other to shift the torque, since
friction has no limit in the model."""


def are_footholds_given(problem: MotionProblem) -> bool:
    """Whether every foot steps once at most, on level ground, so that start and goal say where it stands."""
    feet = [swing.foot for swing in problem.timeline.swings()]
    return problem.boundary is Boundary.REST and is_level(problem) and len(feet) == len(set(feet))


def is_level(problem: MotionProblem) -> bool:
    """Whether all feet that stand at start and goal do so on the ground."""
    ends = ((problem.start, problem.held_start), (problem.goal, problem.held_end))
    return all(bool((pose.feet_world[~held, 2] <= LEVEL).all()) for pose, held in ends)


def way_shares(problem: MotionProblem, swings: Sequence[Swing]) -> tuple[Floats, ...]:
    """Share of its path that each foot has covered before, between and after its swings, 0 to 1.

    Where every foot that steps swings equally often, its way is shared evenly among its swings. Else, as in a
    transition between gaits, a foot that swings seldom would fall behind the others: each foot then rests
    where the walk is in the middle of that stance. The walk goes on with every swing, by one part in as many
    as there are feet that step at that time; a swing that is half over counts half. A foot in the air from
    the start or to the end on purpose is carried by the body and does not step.

    Args:
        problem: what is asked.
        swings: of `core.problem.initial_guess.problem_swings`, by foot and then by time.

    Returns:
        For each foot (swings + 1,), the first 0 and the last 1; (1,) of 0 for a foot without a swing.
    """
    own = [[swing for swing in swings if swing.foot == foot] for foot in range(problem.model.leg_count)]
    carried = problem.held_start | problem.held_end
    counts = {len(found) for found, held in zip(own, carried, strict=True) if found and not held}
    one_sided = bool((problem.held_start != problem.held_end).any())
    if len(counts) < 2 and not one_sided:
        return tuple(np.linspace(0.0, 1.0, len(found) + 1) if found else np.zeros(1) for found in own)
    last = problem.knot_count - 2
    held = [
        swing
        for swing in swings
        if (problem.held_start[swing.foot] and swing.first == 0)
        or (problem.held_end[swing.foot] and swing.last == last)
    ]
    steps = [swing for swing in swings if swing not in held]
    walk = _Walk.of(steps, held, sum(1 for found in own if found))
    return tuple(_shares(found, walk) for found in own)


@dataclass(frozen=True, eq=False)
class _Walk:
    """All steps: when each begins, how long it lasts in samples, and how much of the walk it is."""

    first: Floats
    length: Floats
    part: Floats

    @classmethod
    def of(cls, steps: Sequence[Swing], held: Sequence[Swing], feet: int) -> _Walk:
        """The walk of so many feet, some of which are held for a while."""
        first = np.array([swing.first - 0.5 for swing in steps])
        length = np.array([swing.last - swing.first + 1.0 for swing in steps])
        middle = first + length / 2
        carried = np.zeros(len(steps))
        for swing in held:
            carried += (middle >= swing.first) & (middle <= swing.last)
        part = 1.0 / np.maximum(feet - carried, 1.0)
        return cls(first, length, part / max(float(part.sum()), 1e-9))

    def over(self, times: Floats) -> Floats:
        """(n,) how much of the walk is over at some samples, from 0 to 1."""
        done = np.clip((times[:, None] - self.first) / self.length, 0.0, 1.0)
        return np.asarray(done @ self.part)


def _shares(own: Sequence[Swing], walk: _Walk) -> Floats:
    """One foot's shares by how far the walk is in the middle of each of its inner stances."""
    if not own:
        return np.zeros(1)
    middles = np.array([(a.last + b.first) / 2 for a, b in pairwise(own)])
    return np.concatenate([[0.0], walk.over(middles), [1.0]])
