"""A simulated walk beside its plan, as far as tables and plots need it."""

from dataclasses import dataclass

import numpy as np

from app.published.reference import MANUAL_FEET, MANUAL_HEIGHT
from core.arrays import Floats
from core.physics.findings import longest_slides
from core.physics.metrics import report
from core.physics.motion import SimulatedMotion
from core.physics.problem import SimulationProblem
from core.physics.report import SimulationReport


@dataclass(frozen=True, eq=False)
class Walked:
    """One simulated walk.

    Args:
        problem: what was asked.
        report: its figures.
        body: (reached, 3) at each waypoint's arrival, m.
        feet: (reached, legs, 3) m.
        robot_seconds: from first to last arrival.
    """

    problem: SimulationProblem
    report: SimulationReport
    body: Floats
    feet: Floats
    robot_seconds: float

    @property
    def longest_slide(self) -> float:
        """The longest way that any sole slid during one stance, m."""
        return float(longest_slides(self.report, self.problem)[0].max())

    @property
    def planned(self) -> tuple[Floats, Floats]:
        """Body (reached, 3) and feet (reached, legs, 3) of the plan, m."""
        plan = self.problem.plan
        rows = np.searchsorted(plan.times, self.problem.times[: len(self.body)] - 1e-9)
        return plan.body_world[rows], plan.feet_world[rows]

    @property
    def standing_error(self) -> float:
        """The error as Table 4.1 defines it (see `Reference.manual_run`), m."""
        planned_body, planned_feet = self.planned
        plane = planned_body - [0.0, 0.0, self.problem.model.com_height]
        wanted = planned_feet - plane[:, None] + [0.0, 0.0, MANUAL_HEIGHT]
        gaps = np.linalg.norm(self.feet - wanted, axis=-1).mean(axis=0)
        return float(gaps[:MANUAL_FEET].mean())


def walked_motion(problem: SimulationProblem, motion: SimulatedMotion) -> Walked:
    """A simulated walk of its states.

    Args:
        problem: what was asked.
        motion: what came of it.
    """
    figures = report(problem, motion)
    reached = motion.arrivals[: problem.waypoints.count]
    whole = float(motion.times[reached[-1]] - motion.times[reached[0]])
    body, feet = motion.body_world[reached], motion.feet_world[reached]
    return Walked(problem, figures, body, feet, whole)
