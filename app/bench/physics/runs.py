"""Every simulated walk of the physics benchmark, run once and kept as far as tables and plots need it."""

import time
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from app.bench.common.published import (
    MANUAL_FEET,
    MANUAL_HEIGHT,
    TABLE_4_1,
    TABLE_4_2,
    PublishedRun,
    Reference,
)
from app.bench.physics.cases import manual_problem, own_problem, published_problem, solved_cases, tipping
from core.arrays import Floats
from core.motion.trajectory import Trajectory
from core.physics.findings import longest_slides
from core.physics.metrics import report
from core.physics.parameters import PhysicsSet, physics_set
from core.physics.problem import SimulationProblem
from core.physics.report import SimulationReport
from core.robot.kinematics import UnreachableError
from solver_jobs import simulate

LARGEST_TIPPED = 0.0201
"""Steps up to this are tried as gaits made to tip; the feet of longer ones do not reach that far, m."""


@dataclass(frozen=True, eq=False)
class Walked:
    """One simulated walk.

    Args:
        problem: what was asked.
        report: its figures.
        body: (reached, 3) at each waypoint's arrival, m.
        feet: (reached, legs, 3) m.
        robot_seconds: from first to last arrival.
        processor_seconds: computing time of one core, whatever else the machine does.
    """

    problem: SimulationProblem
    report: SimulationReport
    body: Floats
    feet: Floats
    robot_seconds: float
    processor_seconds: float

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


def walked(problem: SimulationProblem) -> Walked:
    """Simulates one walk in this process."""
    begin = time.process_time()
    motion = simulate(problem)
    spent = time.process_time() - begin
    figures = report(problem, motion)
    reached = motion.arrivals[: problem.waypoints.count]
    whole = float(motion.times[reached[-1]] - motion.times[reached[0]])
    return Walked(problem, figures, motion.body_world[reached], motion.feet_world[reached], whole, spent)


@dataclass(frozen=True, eq=False)
class OptimisedCase:
    """An optimised gait: published, the published trajectory in our physics, and our own.

    Args:
        gait: name of the gait.
        step: m.
        thesis: Table 4.2, m.
        theirs: the published run; None where the data is not at hand.
        again: the published trajectory in our physics; None likewise.
        cut: the most that the motors' range cut off a published stroke, m.
        margin: stability margin of our own gait, m.
        motion: our own gait.
        own: our own gait in the published robot's physics.
        own_scales: the same with the robot's weight on the scales.
    """

    gait: str
    step: float
    thesis: float
    theirs: PublishedRun | None
    again: Walked | None
    cut: float | None
    margin: float
    motion: Trajectory
    own: Walked
    own_scales: Walked


@dataclass(frozen=True, eq=False)
class ManualCase:
    """A gait made by hand: published, and ours of the same table of segments.

    Args:
        family: name of the gait.
        version: 0, 1 or 2.
        thesis: Table 4.1, m.
        theirs: the published run; None where there is none, or the data is not at hand.
        own: in the published robot's physics.
    """

    family: str
    version: int
    thesis: float
    theirs: PublishedRun | None
    own: Walked


def optimised_cases(reference: Reference | None) -> Iterator[OptimisedCase]:
    """The sixteen cases of Table 4.2."""
    published, scales = physics_set("published"), physics_set("scales")
    solved = solved_cases("steps")
    for (gait, step), thesis in TABLE_4_2.items():
        margin, motion = solved[f"{gait} {step * 1000:.0f} mm"]
        theirs, again, cut = None, None, None
        if reference is not None:
            problem, cut = published_problem(reference, gait, step, published)
            theirs, again = reference.optimised_run(gait, step, problem.model), walked(problem)
        own, own_scales = (walked(own_problem(motion, physics)) for physics in (published, scales))
        yield OptimisedCase(gait, step, thesis, theirs, again, cut, margin, motion, own, own_scales)


def manual_cases(reference: Reference | None) -> Iterator[ManualCase]:
    """The nine cases of Table 4.1."""
    for (family, version), thesis in TABLE_4_1.items():
        own = walked(manual_problem(family, version, physics_set("published")))
        theirs = None if reference is None else reference.manual_run(family, version, own.problem.model)
        yield ManualCase(family, version, thesis, theirs, own)


def paper_cases() -> Iterator[tuple[str, Walked]]:
    """Our own gaits for the three goals of the paper's Table I, by its letters."""
    for name, (_, motion) in solved_cases("paper").items():
        yield name.removeprefix("paper ")[0], walked(own_problem(motion, physics_set("published")))


def tipped(case: OptimisedCase, physics: PhysicsSet) -> Walked | None:
    """Our own gait made to tip, or None where its feet do not reach so far."""
    if case.step > LARGEST_TIPPED:
        return None
    try:
        return walked(own_problem(tipping(case.motion), physics))
    except UnreachableError:
        return None
