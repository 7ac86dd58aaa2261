"""Every simulated walk of the physics benchmark, run once and kept as far as tables and plots need it."""

import math
from collections.abc import Iterator
from dataclasses import dataclass

from app.bench.physics.cases import manual_problem, solved_cases, tipping
from app.published.problems import own_problem, published_problem
from app.published.reference import PublishedRun, Reference, is_missing
from app.published.walked import Walked, walked_motion
from core.motion.trajectory import Trajectory
from core.physics.parameters import PhysicsSet, physics_set
from core.physics.problem import SimulationProblem
from core.published.tables import PublishedRow, published_table
from core.robot.kinematics import UnreachableError
from core.robot.model import RobotModel
from solver_jobs import simulate

LARGEST_TIPPED = 0.0201
"""Steps up to this are tried as gaits made to tip; the feet of longer ones do not reach that far, m."""


def walked(problem: SimulationProblem) -> Walked:
    """Simulates one walk in this process."""
    return walked_motion(problem, simulate(problem))


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
    for row in published_table("t4-2").rows:
        gait, step, thesis = row.gait.family, row.gait.step, printed(row, "feet_mm")
        margin, motion = solved[f"{gait} {step * 1000:.0f} mm"]
        theirs, again, cut = None, None, None
        if reference is not None:
            problem, cut = published_problem(reference, gait, step, published)
            theirs, again = reference.run(gait, step, None, problem.model), walked(problem)
        own, own_scales = (walked(own_problem(motion, physics)) for physics in (published, scales))
        yield OptimisedCase(gait, step, thesis, theirs, again, cut, margin, motion, own, own_scales)


def manual_cases(reference: Reference | None) -> Iterator[ManualCase]:
    """The nine cases of Table 4.1."""
    for row in published_table("t4-1").rows:
        family, version, thesis = row.gait.family, row.gait.version or 0, printed(row, "feet_mm")
        own = walked(manual_problem(family, version, physics_set("published")))
        theirs = None if reference is None else _manual_run(reference, row, own.problem.model)
        yield ManualCase(family, version, thesis, theirs, own)


def _manual_run(reference: Reference, row: PublishedRow, model: RobotModel) -> PublishedRun | None:
    """The published run of a gait made by hand; None where it is not in the folder."""
    case = (row.gait.family, row.gait.step, row.gait.version)
    return None if any(map(is_missing, reference.run_paths(*case))) else reference.run(*case, model)


def printed(row: PublishedRow, figure: str) -> float:
    """A printed error of a row, m; nan where it cannot be read."""
    value = row.printed[figure]
    return math.nan if value is None else value / 1000.0


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
