"""Variations of the physics parameters that a robust gait must tolerate."""

from dataclasses import dataclass, replace

import numpy as np

from core.errors import InputError
from core.physics.findings import SWING_LIMIT, TILT_LIMIT, gets_on
from core.physics.motors import LEAST_SHARE
from core.physics.parameters import PhysicsSet
from core.physics.problem import SimulationProblem
from core.physics.report import SimulationReport

FRICTION = (0.6, 1.3)
"""Factor on friction: 0.5 to 1.0 of the default."""
BODY_MASS = (0.85, 1.15)
"""Factor on the body's mass: a battery or a camera more or less."""
MOTOR_SPEED = (0.8, 1.0)
"""Factor on all motors' speed: supply voltage and load."""
WEAK_SHARE = (0.5, 1.0)
"""Share of speed and force of the one weak motor."""
GROUND_TILT = np.radians(1.0)
"""Steepest ground, rad."""
STIFFNESS = (0.25, 3.0)
"""Factor on the links' stiffness: 5 to 60 kN/m of the default, all factors in it equally likely."""
MOST_VARIATIONS = 1000


@dataclass(frozen=True)
class Variation:
    """One set of parameters near a given one.

    Args:
        physics: the parameters.
        words: what differs, for a person.
    """

    physics: PhysicsSet
    words: str


@dataclass(frozen=True)
class VariedRun:
    """What came of one variation.

    Args:
        variation: the parameters.
        fell: whether it tipped over.
        max_tilt: largest angle between the body's axis and the vertical, rad.
        swing_load: largest share of any swing in which its foot carries load.
        distance: horizontal way of the body, m.
        way_share: part of the asked way that is made; None where none is asked.
        turn_share: the same of the turn.
        feet_error: mean of the feet's errors against the plan, m.
        ended_early: why it ended before the last waypoint, or "".
    """

    variation: Variation
    fell: bool
    max_tilt: float
    swing_load: float
    distance: float
    way_share: float | None
    turn_share: float | None
    feet_error: float
    ended_early: str

    @property
    def walks(self) -> bool:
        """Whether it neither fell nor rocked onto a foot that should be in the air, and got on."""
        is_upright = self.max_tilt <= TILT_LIMIT and self.swing_load <= SWING_LIMIT
        advances = all(share is None or gets_on(share) for share in (self.way_share, self.turn_share))
        return is_upright and advances and not self.fell and not self.ended_early


def variations(physics: PhysicsSet, count: int, seed: int, motors: int) -> tuple[Variation, ...]:
    """Parameters drawn about a set; friction, mass, speed, a weak motor, slope and soft links differ at once.

    Args:
        physics: what they lie about.
        count: how many.
        seed: the same seed gives the same variations; a larger count begins with those of a smaller one.
        motors: of the robot, one of which is weak each time.

    Raises:
        InputError: the count is none.
    """
    if not 1 <= count <= MOST_VARIATIONS:
        raise InputError(
            f"{count} variations are asked for; it must be 1 to {MOST_VARIATIONS}.", "variations"
        )
    random = np.random.default_rng(seed)
    return tuple(_variation(physics, random, number, motors) for number in range(1, count + 1))


def varied_run(variation: Variation, report: SimulationReport) -> VariedRun:
    """The few figures of a variation's report."""
    return VariedRun(
        variation=variation,
        fell=report.fell,
        max_tilt=report.max_tilt,
        swing_load=float(report.swing_load.max()),
        distance=report.distance,
        way_share=report.way.share,
        turn_share=report.way.turn_share,
        feet_error=report.feet_mean_error,
        ended_early=report.ended_early,
    )


def varied_problem(problem: SimulationProblem, variation: Variation) -> SimulationProblem:
    """The same question with a variation's parameters."""
    return replace(problem, physics=variation.physics)


def _variation(physics: PhysicsSet, random: np.random.Generator, number: int, motors: int) -> Variation:
    slope, towards = random.uniform(0.0, GROUND_TILT), random.uniform(0.0, 2 * np.pi)
    speed = max(physics.motor_speed * random.uniform(*MOTOR_SPEED), LEAST_SHARE / WEAK_SHARE[0])
    varied = replace(
        physics,
        name=f"{physics.name}-{number}",
        friction=physics.friction * random.uniform(*FRICTION),
        body_mass_factor=physics.body_mass_factor * random.uniform(*BODY_MASS),
        motor_speed=speed,
        weak_motor=int(random.integers(motors)),
        weak_share=random.uniform(*WEAK_SHARE),
        ground_tilt=(-slope * np.sin(towards), slope * np.cos(towards)),
        link_stiffness=physics.link_stiffness * float(np.exp(random.uniform(*np.log(STIFFNESS)))),
    )
    words = _words(varied, float(np.degrees(slope)), float(np.degrees(towards)))
    return Variation(replace(varied, title=words), words)


def _words(physics: PhysicsSet, slope_deg: float, towards_deg: float) -> str:
    foot, motor = divmod(physics.weak_motor or 0, 3)
    return (
        f"friction {physics.friction:.2f}, body × {physics.body_mass_factor:.2f}, "
        f"motors at {physics.motor_speed * 100:.0f} %, motor {motor + 1} of foot {foot + 1} at "
        f"{physics.weak_share * 100:.0f} % of that, {slope_deg:.1f}° down towards {towards_deg:.0f}°, "
        f"links {physics.link_stiffness / 1000:.0f} kN/m"
    )
