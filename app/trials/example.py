"""An example of a trial for an empty list: made by physics from a gait of the library, and marked as such."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from app.common.json import Json
from app.plans.make_plan import make_plan
from app.simulation.service import SimulationTier
from app.trials.planned import planned_of_gait, sent_problem
from app.trials.service import TrialDescription, TrialService
from core.arrays import interpolated
from core.errors import StateError
from core.gait.gait import Gait
from core.library.library import library
from core.physics.motion import SimulatedMotion
from core.problem.motion_problem import MotionProblem
from core.trials.alignment import repeated_motion
from core.vision.track import FootTrack
from core.vision.track_csv import FRAME_RATE
from solver_jobs import MotionResult

EXAMPLE_GAIT = "walk-manual-0"
"""The gait of the library that walks; made by hand, so that no solver has to answer first."""
ITERATIONS = 3
"""How often it is walked, as in the published trials."""
NOISE = 3e-4
"""Standard deviation of a foot's place in a frame, m; about a pixel of the published videos."""
SEED = 1
TITLE = "Example, made by simulation"
BY = "the simulation"


@dataclass(frozen=True, eq=False)
class ExampleTrials:
    """Makes an example when a person asks for one.

    Args:
        trials: where it is kept.
        tier: what simulates.
    """

    trials: TrialService
    tier: SimulationTier
    _known: list[SimulatedMotion] = field(default_factory=list, init=False)

    def add(self) -> Json:
        """Simulates the gait, keeps the feet's ways with a little noise as a trial, and gives its summary.

        Waits for the simulation, a few seconds; not for the event loop's thread.

        Raises:
            StateError: the robot does not walk to the end in physics, or the simulation broke off.
        """
        gait = library()[EXAMPLE_GAIT].gait
        planned = planned_of_gait(gait, make_plan(gait, None, _unasked), ITERATIONS)
        if planned.sent is None:
            raise StateError("The example's gait has no waypoints, so it cannot be simulated.", "example")
        motion = self._simulated(planned.sent)
        return self.trials.add(example_track(motion, planned.laps), example_words(gait), planned)

    def _simulated(self, sent: Mapping[str, Any]) -> SimulatedMotion:
        """The motion in physics, which is the same each time; simulated once."""
        if not self._known:
            self._known.append(self.tier.submit(sent_problem(dict(sent))).result().motion)
        return self._known[0]


def example_words(gait: Gait) -> TrialDescription:
    """What is said of the example of a gait."""
    wanted_cm = float(np.hypot(*gait.step[:2])) * ITERATIONS * 100.0
    note = (
        f"{TITLE} from “{gait.name}” of the library, with {NOISE * 1000:g} mm of noise in each place. No "
        "robot did this, and nothing is learned from it."
    )
    return TrialDescription(
        f"{TITLE}: {gait.name}",
        BY,
        round(wanted_cm, 3),
        ITERATIONS,
        note,
        gait=EXAMPLE_GAIT,
        gait_name=gait.name,
        is_example=True,
    )


def example_track(motion: SimulatedMotion, laps: int) -> FootTrack:
    """The feet of a simulation as a camera under the platform might have seen them; the same each time.

    Args:
        motion: one lap, from rest to rest.
        laps: how often it is walked, each from where the one before ended.

    Raises:
        StateError: the robot did not come to the end.
    """
    if motion.ended_early:
        raise StateError(
            f"The example's robot did not come to the end in physics: {motion.ended_early}", "example"
        )
    feet = motion.feet_world[..., :2]
    times, ways = repeated_motion(motion.times - motion.times[0], feet, laps)
    frames = np.arange(0.0, times[-1], 1.0 / FRAME_RATE)
    seen = interpolated(frames, times, ways)
    noise = np.random.default_rng(SEED).normal(0.0, NOISE, seen.shape)
    return FootTrack(frames, seen + noise, np.zeros(seen.shape[:2], dtype=np.bool_))


def _unasked(problem: MotionProblem) -> MotionResult:
    """The solver of a gait that needs none."""
    raise StateError(f"The gait of the example needs no solver, and one was asked: {problem}.", "example")
