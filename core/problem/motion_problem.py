"""The optimisation problem as a value: what a solver is given and what the checker holds it to."""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import StrEnum

import numpy as np

from core.arrays import Bools, Floats, frozen_floats
from core.errors import InputError
from core.motion.contact_timeline import ContactTimeline
from core.motion.trajectory import quarter_turn
from core.robot.model import RobotModel


class Workspace(StrEnum):
    """Where a foot may be relative to its module."""

    CYLINDER = "cylinder"
    """P (13), (14): radius 13.5 mm, −2.5…+7.5 mm about 58 mm below the actuator plane."""
    STROKE = "stroke"
    """Every motor within its stroke by inverse kinematics."""


class Cost(StrEnum):
    """What is minimised."""

    GOAL = "goal"
    """Distance of every state to the goal, T (3.4)."""
    GOAL_EFFORT = "goal+effort"
    """The same and the internal forces, T (3.3)."""
    GENTLE = "gentle"
    """½ Σ (‖v_b‖² + s Σ ‖v_f‖²) over every knot, with the small share s of the feet: the body moves evenly
    over the time there is."""


GENTLE_FOOT_SHARE = 0.01
"""Share of the feet's speeds beside the body's in `Cost.GENTLE`, which would leave open how feet swing."""


class Boundary(StrEnum):
    """What holds at the first and the last knot."""

    REST = "rest"
    """From rest in the start pose to rest in the goal pose, T (3.5) and (3.6)."""
    PERIODIC = "periodic"
    """The last knot is the first, moved from start to goal; speeds need not be 0. The body's first ground
    point is that of the start pose."""


@dataclass(frozen=True)
class CylinderWorkspace:
    """The paper's cylinder, m (P (13), (14); T prints 0.048 for the depth, which nothing can satisfy)."""

    radius: float = 0.0135
    depth: float = 0.058
    below: float = 0.0025
    above: float = 0.0075


CYLINDER = CylinderWorkspace()


PLANE_HEIGHTS = (0.053, 0.0605)
"""Lowest and highest actuator plane above the standing feet's platforms, m, T (3.8)."""
GROUNDED_HEIGHT = 0.00025
"""How high a standing foot may be, m, T (3.12)."""


@dataclass(frozen=True, kw_only=True)
class MotionLimits:
    """Bounds of the problem, SI; `GaitOptions.motion_limits` makes them of a gait's options.

    Args:
        foot_speed: T (3.10).
        body_speed: the same for the body, without which the optimum throws it about.
        clearance: how high the highest knot of each swing is at least.
        margin: how far inside the support polygon the centre of pressure stays.
        workspace: which form of reach holds.
        friction: coefficient of the friction cone of each foot; None for none.
        motor_speed: how fast a motor may extend or retract, m/s; None for none.
        motor_acceleration: how fast that speed may change from sample to sample, m/s²; None for none.
        plane_height: lowest and highest actuator plane.
    """

    foot_speed: float
    body_speed: float
    clearance: float
    margin: float
    workspace: Workspace
    friction: float | None
    motor_speed: float | None
    motor_acceleration: float | None
    plane_height: tuple[float, float] = PLANE_HEIGHTS


def raised_feet(feet_world: Floats) -> Bools:
    """(legs,) which of (legs, 3) platforms are above what counts as ground."""
    return np.asarray(feet_world[:, 2] > GROUNDED_HEIGHT)


@dataclass(frozen=True, eq=False)
class RestPose:
    """Body and feet at rest: centre of mass (3,) and platforms (legs, 3) in the world, m.

    A foot above the ground is held up.
    """

    body_world: Floats
    feet_world: Floats

    def __post_init__(self) -> None:
        object.__setattr__(self, "body_world", frozen_floats(self.body_world, (3,), "body"))
        object.__setattr__(self, "feet_world", frozen_floats(self.feet_world, (None, 3), "feet"))

    def turned(self, quarter_turns: int) -> RestPose:
        """The pose turned about the world's z by 90° a turn, feet handed on to the next legs."""
        rotation = quarter_turn(quarter_turns)
        shift = (quarter_turns % 4) * len(self.feet_world) // 4
        return RestPose(self.body_world @ rotation.T, np.roll(self.feet_world @ rotation.T, shift, axis=0))

    def raised(self, feet: tuple[int, ...], height: float) -> RestPose:
        """The pose with some feet, counted from 1, held in the air.

        Args:
            feet: which.
            height: above where they stood, m.
        """
        lifted = np.array(self.feet_world)
        lifted[[foot - 1 for foot in feet], 2] += height
        return RestPose(self.body_world, lifted) if feet else self


@dataclass(frozen=True, eq=False)
class MotionProblem:
    """Move from one pose at rest to another with a known contact sequence.

    State: positions and velocities of body and feet; unknown beside it: contact forces. Knots are
    `timeline.sample_time` apart and accelerations are constant between them (exact double integrator).

    Args:
        model: the robot.
        timeline: which foot stands at each knot; at the last all stand but those that the goal holds up.
        start: pose of the first knot.
        goal: pose of the last knot.
        limits: bounds.
        cost: what is minimised.
        quarter_turns: how far it is turned from direction 1, in which solvers work, so that every direction
            has the same answer.
        boundary: what holds at the ends.
        heading_profile: (n,) turn of the body at each knot, rad, which is given and not sought; None for 0.
        durations: (n − 1,) time from each knot to the next, s; None for the timeline's sample time.
    """

    model: RobotModel
    timeline: ContactTimeline
    start: RestPose
    goal: RestPose
    limits: MotionLimits
    cost: Cost
    quarter_turns: int = 0
    boundary: Boundary = Boundary.REST
    heading_profile: Floats | None = None
    durations: Floats | None = None

    def __post_init__(self) -> None:
        legs = self.model.leg_count
        shapes = {"heading_profile": self.knot_count, "durations": self.knot_count - 1}
        for name, length in shapes.items():
            if (given := getattr(self, name)) is not None:
                object.__setattr__(self, name, frozen_floats(given, (length,), name))
        if (self.intervals <= 0).any():
            raise InputError("Every duration between two samples must be above 0 s.", "durations")
        counts = {self.timeline.leg_count, len(self.start.feet_world), len(self.goal.feet_world)}
        if counts != {legs}:
            raise InputError(f"Timeline, start and goal must each have {legs} feet.", "timeline")

    @property
    def knot_count(self) -> int:
        """Number of knots."""
        return self.timeline.sample_count

    @property
    def held_start(self) -> Bools:
        """(legs,) feet that rest in the air at the first knot: they swing there and `start` holds them up."""
        return self._held(self.start, 0)

    @property
    def held_end(self) -> Bools:
        """(legs,) the same for the last knot and `goal`."""
        return self._held(self.goal, -1)

    def _held(self, pose: RestPose, knot: int) -> Bools:
        return raised_feet(pose.feet_world) & ~self.timeline.stance[:, knot]

    @property
    def heading(self) -> Floats:
        """(n,) turn of the body about z at each knot, rad."""
        return np.zeros(self.knot_count) if self.heading_profile is None else self.heading_profile

    @property
    def heading_rate(self) -> Floats:
        """(n,) speed of turning at each knot by central differences, rad/s."""
        return np.asarray(np.gradient(self.heading, self.times))

    @property
    def intervals(self) -> Floats:
        """(n − 1,) time from each knot to the next, s."""
        if self.durations is None:
            return np.full(self.knot_count - 1, self.timeline.sample_time)
        return self.durations

    @property
    def times(self) -> Floats:
        """(n,) time of each knot, s."""
        return self.timeline.times if self.durations is None else np.append(0.0, np.cumsum(self.durations))

    def turned(self, quarter_turns: int) -> MotionProblem:
        """The same problem turned about the world's z by 90° a turn.

        Raises:
            InputError: the ring of legs does not map onto itself under such a turn.
        """
        if not maps_onto_itself(self.model.leg_count, quarter_turns):
            raise InputError(
                f"A ring of {self.model.leg_count} legs differs after a turn of {90 * quarter_turns}°.",
                "direction",
            )
        return replace(
            self,
            timeline=self.timeline.turned(quarter_turns),
            start=self.start.turned(quarter_turns),
            goal=self.goal.turned(quarter_turns),
            quarter_turns=(self.quarter_turns + quarter_turns) % 4,
        )


def maps_onto_itself(legs: int, quarter_turns: int) -> bool:
    """Whether an even ring of so many legs is the same after a number of quarter turns."""
    return quarter_turns * legs % 4 == 0


def missing_support(timeline: ContactTimeline, margin: float) -> str | None:
    """Why no stability margin can be kept where fewer than three feet stand; None where it may be.

    Args:
        timeline: which foot stands at each knot.
        margin: how far inside the support polygon the centre of pressure has to stay, m.
    """
    few = timeline.stance.sum(axis=0) < 3
    if margin <= 0 or not few.any():
        return None
    first = int(np.nonzero(few)[0][0])
    # Up to where other feet are in the air.
    same = (timeline.stance[:, first:] == timeline.stance[:, first, None]).all(axis=0)
    last = first + int(np.argmin(np.append(same, False))) - 1
    feet = ", ".join(str(foot + 1) for foot in np.nonzero(~timeline.stance[:, first])[0])
    if not timeline.stance[:, first].any():
        return f"No foot stands at samples {first + 1} to {last + 1}, so the robot falls there."
    return (
        f"Feet {feet} are in the air together at samples {first + 1} to {last + 1}: the feet that stand have "
        f"no area between them, so no stability margin of {margin * 1000:g} mm can be kept. Set one of them "
        "to stance there; at margin 0 the robot would have to balance on what is left."
    )


def standing_pose(
    model: RobotModel, plane_height: float, shift_xy: tuple[float, float], heading: float = 0.0
) -> RestPose:
    """Every foot under its module's centre, with the body axis shifted and turned.

    Args:
        model: the robot.
        plane_height: of the actuator plane above the standing feet's platforms, m.
        shift_xy: where the body axis stands in the world, m.
        heading: turn of the body about z, rad.
    """
    x, y = shift_xy
    body = np.array([x, y, plane_height + model.com_height])
    feet = (
        model.module_centres_robot if heading == 0.0 else turned_about_z(model.module_centres_robot, heading)
    )
    return RestPose(body, feet + np.array([x, y, 0.0]))


def turned_about_z(points: Floats, angle: float) -> Floats:
    """(..., 3) points turned about z by an angle, rad."""
    cosine, sine = np.cos(angle), np.sin(angle)
    rotation = np.array([[cosine, -sine, 0.0], [sine, cosine, 0.0], [0.0, 0.0, 1.0]])
    return np.asarray(points @ rotation.T)
