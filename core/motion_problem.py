"""The optimisation problem as a value: what a solver is given and what the checker holds it to."""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import StrEnum

import numpy as np

from core.arrays import Floats, frozen_floats
from core.errors import InputError
from core.robot import RobotModel
from core.timeline import ContactTimeline
from core.trajectory import quarter_turn


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


@dataclass(frozen=True)
class CylinderWorkspace:
    """The paper's cylinder, m (P (13), (14); T prints 0.048 for the depth, which nothing can satisfy)."""

    radius: float = 0.0135
    depth: float = 0.058
    below: float = 0.0025
    above: float = 0.0075


CYLINDER = CylinderWorkspace()


@dataclass(frozen=True)
class MotionLimits:
    """Bounds of the problem, SI.

    Args:
        plane_height: lowest and highest actuator plane, T (3.8).
        foot_speed: T (3.10).
        body_speed: the same for the body, without which the optimum throws it about.
        grounded_height: how high a standing foot may be, T (3.12).
        clearance: how high the highest knot of each swing is at least.
        margin: how far inside the support polygon the centre of pressure stays.
        workspace: which form of reach holds.
    """

    plane_height: tuple[float, float] = (0.053, 0.0605)
    foot_speed: float = 0.015
    body_speed: float = 0.015
    grounded_height: float = 0.00025
    clearance: float = 0.003
    margin: float = 0.0
    workspace: Workspace = Workspace.STROKE


@dataclass(frozen=True, eq=False)
class RestPose:
    """Body and feet at rest: centre of mass (3,) and platforms (legs, 3) in the world, m."""

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


@dataclass(frozen=True, eq=False)
class MotionProblem:
    """Move from one pose at rest to another with a known contact sequence.

    State: positions and velocities of body and feet; unknown beside it: contact forces. Knots are
    `timeline.sample_time` apart and accelerations are constant between them (exact double integrator).

    Args:
        model: the robot; its heading stays 0.
        timeline: which foot stands at each knot; all feet stand at the last.
        start: pose of the first knot.
        goal: pose of the last knot.
        limits: bounds.
        cost: what is minimised.
        quarter_turns: how far it is turned from direction 1, in which solvers work, so that every direction
            has the same answer.
    """

    model: RobotModel
    timeline: ContactTimeline
    start: RestPose
    goal: RestPose
    limits: MotionLimits
    cost: Cost
    quarter_turns: int = 0

    def __post_init__(self) -> None:
        legs = self.model.leg_count
        counts = {self.timeline.leg_count, len(self.start.feet_world), len(self.goal.feet_world)}
        if counts != {legs}:
            raise InputError(f"Timeline, start and goal must each have {legs} feet.", "timeline")

    @property
    def knot_count(self) -> int:
        """Number of knots."""
        return self.timeline.sample_count

    def turned(self, quarter_turns: int) -> MotionProblem:
        """The same problem turned about the world's z by 90° a turn."""
        return replace(
            self,
            timeline=self.timeline.turned(quarter_turns),
            start=self.start.turned(quarter_turns),
            goal=self.goal.turned(quarter_turns),
            quarter_turns=(self.quarter_turns + quarter_turns) % 4,
        )


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
    last = first + int(np.argmin(np.append(few[first:], False))) - 1
    feet = ", ".join(str(foot + 1) for foot in np.nonzero(~timeline.stance[:, first])[0])
    return (
        f"Feet {feet} are in the air together at samples {first + 1} to {last + 1}: the feet that stand have "
        f"no area between them, so no stability margin of {margin * 1000:g} mm can be kept. Set one of them "
        "to stance there, or ask for margin 0."
    )


def standing_pose(model: RobotModel, plane_height: float, shift_xy: tuple[float, float]) -> RestPose:
    """Every foot under its module's centre, with the body axis shifted.

    Args:
        model: the robot.
        plane_height: of the actuator plane above the standing feet's platforms, m.
        shift_xy: where the body axis stands in the world, m.
    """
    x, y = shift_xy
    body = np.array([x, y, plane_height + model.com_height])
    return RestPose(body, model.module_centres_robot + np.array([x, y, 0.0]))
