"""The gait: the document that a person edits, saves, optimises and sends."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import StrEnum

import numpy as np

from core.arrays import Floats
from core.errors import InputError
from core.motion_problem import Cost, MotionLimits, MotionProblem, Workspace, standing_pose
from core.robot import RobotModel
from core.segments import SegmentTable
from core.timeline import ContactTimeline
from core.trajectory import quarter_turn

MAX_STEP = 0.2
"""Larger steps an iteration than any workspace here, m; a guard against mm given for m."""


MOST_NAME, MOST_NOTES = 120, 20_000
"""Characters that a gait's name and notes may have."""


class Orientation(StrEnum):
    """Which way the robot's feet are seen (thesis 3.2)."""

    FB = "FB"
    """Front and back pairs; moves along the diagonals."""
    FBS = "FBS"
    """Front, sides, back; moves along the axes."""


_ROLES = {Orientation.FB: ("FR", "FL", "BL", "BR"), Orientation.FBS: ("F", "L", "B", "R")}


@dataclass(frozen=True)
class GaitOptions:
    """What the optimiser is asked, SI; defaults as in the contract."""

    clearance: float = 0.003
    margin: float = 0.0
    body_speed: float = 0.015
    plane_height: float = 0.0535
    workspace: Workspace = Workspace.STROKE
    cost: Cost = Cost.GOAL
    phase_knots: int = 5
    closing_knots: int = 5

    def __post_init__(self) -> None:
        bounds_mm = {
            "clearance": (0.0, 20.0, "mm"),
            "margin": (-50.0, 50.0, "mm"),
            "body_speed": (0.5, 1000.0, "mm/s"),
            "plane_height": (30.0, 100.0, "mm"),
        }
        for name, (lower, upper, unit) in bounds_mm.items():
            value = getattr(self, name) * 1000.0
            if not (np.isfinite(value) and lower <= value <= upper):
                words = name.replace("_", " ")
                raise InputError(
                    f"The {words} is {value:g} {unit}; it must lie between {lower:g} and {upper:g} {unit}.",
                    name,
                )
        if self.phase_knots < 2 or self.closing_knots < 0:
            raise InputError("phase_knots must be at least 2 and closing_knots at least 0.", "phase_knots")


@dataclass(frozen=True)
class Gait:
    """The document.

    Args:
        name: what a person calls it.
        robot: name of the robot's parameters file.
        orientation: FB or FBS.
        direction: 1 to 4 (thesis Table 3.1).
        order: feet in the order of their steps at direction 1, counted from 1.
        step: (dx, dy, yaw) of the body an iteration in world axes at direction 1, m, m, rad.
        iterations: how often every foot steps.
        timeline: contact of the robot's own feet, all iterations and the closing stance.
        segment_table: of one iteration at direction 1, where the gait is made by hand; else None.
        options: what the optimiser is asked.
        notes: a person's words.
    """

    name: str
    robot: str
    orientation: Orientation
    direction: int
    order: tuple[int, ...]
    step: tuple[float, float, float]
    iterations: int
    timeline: ContactTimeline
    segment_table: SegmentTable | None = None
    options: GaitOptions = field(default_factory=GaitOptions)
    notes: str = ""

    def __post_init__(self) -> None:
        _require_text("name", self.name, MOST_NAME)
        _require_text("notes", self.notes, MOST_NOTES)
        if not self.name.strip():
            raise InputError("The gait has no name; give it one.", "name")
        if self.direction not in (1, 2, 3, 4):
            raise InputError(f"direction is {self.direction}; it must be 1, 2, 3 or 4.", "direction")
        if not 1 <= self.iterations <= 20:
            raise InputError(f"iterations is {self.iterations}; it must lie between 1 and 20.", "iterations")
        if not all(np.isfinite(self.step)) or np.hypot(*self.step[:2]) > MAX_STEP:
            raise InputError(
                f"step is {self.step}; it must be finite and at most {MAX_STEP} m an iteration.", "step"
            )
        if sorted(self.order) != list(range(1, self.timeline.leg_count + 1)):
            raise InputError(
                f"order is {list(self.order)}; it must name each foot 1 to {self.timeline.leg_count} once.",
                "order",
            )

    @property
    def quarter_turns(self) -> int:
        """How far the gait is turned from direction 1, in steps of 90°."""
        return self.direction - 1

    @property
    def step_world(self) -> Floats:
        """(2,) the body's displacement an iteration in the world, m."""
        return np.asarray(quarter_turn(self.quarter_turns)[:2, :2] @ np.array(self.step[:2]))

    @property
    def roles(self) -> tuple[str, ...]:
        """Each foot's role, foot 1 first (thesis Table 3.1); numbers where the robot has not four feet."""
        legs = self.timeline.leg_count
        if legs != 4:
            return tuple(str(foot + 1) for foot in range(legs))
        names = _ROLES[self.orientation]
        return tuple(names[(foot - self.quarter_turns) % 4] for foot in range(4))


def _require_text(field_name: str, text: str, most: int) -> None:
    if len(text) > most:
        raise InputError(f"{field_name} has {len(text)} characters; at most {most} are kept.", field_name)
    try:
        text.encode()
    except UnicodeEncodeError as error:
        raise InputError(
            f"{field_name} holds half a character at {error.start}; type it again.", field_name
        ) from error


def heading_step(orientation: Orientation, step: float) -> tuple[float, float, float]:
    """A step along the gait's heading at direction 1: FB along the diagonal, FBS along x.

    Args:
        orientation: of the gait.
        step: body displacement an iteration, m.
    """
    if orientation is Orientation.FB:
        return (step / np.sqrt(2.0), step / np.sqrt(2.0), 0.0)
    return (step, 0.0, 0.0)


def motion_problem(gait: Gait, model: RobotModel) -> MotionProblem:
    """The optimisation problem of a gait: from standing at the origin to standing all iterations further on.

    Raises:
        InputError: the gait turns, which the problem does not hold yet, or its last sample is no stance.
    """
    if gait.step[2] != 0.0:
        raise InputError("A gait with yaw cannot be optimised in this version; set yaw to 0.", "yaw")
    if not gait.timeline.stance[:, -1].all():
        feet = [str(f + 1) for f in np.nonzero(~gait.timeline.stance[:, -1])[0]]
        raise InputError(
            f"Foot {', '.join(feet)} is in the air at the last sample; every foot must stand there. "
            "Set the last sample to stance.",
            "timeline",
        )
    options = gait.options
    dx, dy = gait.step_world * gait.iterations
    limits = MotionLimits(
        clearance=options.clearance,
        margin=options.margin,
        body_speed=options.body_speed,
        workspace=options.workspace,
    )
    return MotionProblem(
        model=model,
        timeline=gait.timeline,
        start=standing_pose(model, options.plane_height, (0.0, 0.0)),
        goal=standing_pose(model, options.plane_height, (float(dx), float(dy))),
        limits=limits,
        cost=options.cost,
        quarter_turns=gait.quarter_turns,
    )
