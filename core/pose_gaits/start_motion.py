"""Where the search for a pose gait starts, in mm."""

import math

import numpy as np

from core.arrays import Floats
from core.pose_gaits.pose_gait import PoseGait
from core.pose_gaits.pose_problem import PoseProblem

MM = 1000.0
TURN_GUESS = math.radians(40.0)
"""Turn a cycle from which the search for the fastest turn on the spot begins, rad."""
START_HEIGHT = 56.0
"""Actuator plane at the start of the search, mm."""


class StartMotion:
    """Where the search starts: the body goes on evenly, each foot in its own moves, about its home.

    Args:
        problem: what is asked.
        step: travel a cycle, mm.
    """

    def __init__(self, problem: PoseProblem, step: float) -> None:
        self._problem = problem
        self._homes = problem.model.module_centres_robot[:, :2] * MM
        self._travel = 0.0 if problem.on_the_spot else step * problem.all_cycles
        self._turn = start_turn(problem) * problem.all_cycles
        done = np.vstack([np.zeros(problem.model.leg_count), np.cumsum(problem.moving, axis=0)])
        self._progress = done / np.maximum(done[-1], 1)
        self._shares = np.linspace(0.0, 1.0, problem.move_count + 1)
        self._offset = (
            self._progress.mean(axis=0) - 0.5 if problem.cycles is None else np.zeros(len(self._homes))
        )
        poses = range(problem.move_count + 1)
        self.bodies = np.array([self._body(self._shares[pose]) for pose in poses])
        self.headings = [self._turn * self._shares[pose] for pose in poses]
        self.feet = [self._feet(self._progress[pose], problem.floor[pose]) for pose in poses]

    def _along(self, share: float) -> Floats:
        angle = self._problem.heading + self._turn * share / 2
        return np.asarray(self._travel * share * np.array([np.cos(angle), np.sin(angle)]))

    def _body(self, share: float) -> Floats:
        return np.append(self._along(share), START_HEIGHT)

    def _feet(self, progress: Floats, heights: Floats) -> Floats:
        """(legs, 3) mm."""
        shares = progress - self._offset
        return np.array(
            [
                [*(rotation_about_z(self._turn * share) @ home + self._along(share)), height * MM]
                for share, home, height in zip(shares, self._homes, heights, strict=True)
            ]
        )

    def within(self, move: int, share: float) -> tuple[Floats, Floats, float]:
        """Body, feet and heading at a share of a move, mm and rad."""
        place = (1 - share) * self._shares[move] + share * self._shares[move + 1]
        progress = (1 - share) * self._progress[move] + share * self._progress[move + 1]
        heights = (1 - share) * self._problem.floor[move] + share * self._problem.floor[move + 1]
        return self._body(place), self._feet(progress, heights), float(self._turn * place)


def start_turn(problem: PoseProblem) -> float:
    """Turn of the body a cycle with which the search starts, rad."""
    return math.copysign(TURN_GUESS, problem.turn) if problem.free_turn else problem.turn


class PosesStart:
    """The same from poses that are known; within a move everything goes straight.

    Args:
        gait: the poses.
    """

    def __init__(self, gait: PoseGait) -> None:
        self.bodies = gait.bodies * MM
        self.headings = gait.headings.tolist()
        self.feet = list(gait.feet * MM)

    def within(self, move: int, share: float) -> tuple[Floats, Floats, float]:
        """Body, feet and heading at a share of a move, mm and rad."""

        def mixed(first: Floats, last: Floats) -> Floats:
            return np.asarray((1 - share) * first + share * last)

        turn = (1 - share) * self.headings[move] + share * self.headings[move + 1]
        body = mixed(self.bodies[move], self.bodies[move + 1])
        return body, mixed(self.feet[move], self.feet[move + 1]), turn


def rotation_about_z(angle: float) -> Floats:
    """(2, 2) turn of horizontal vectors."""
    return np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
