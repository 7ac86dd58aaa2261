"""A request for the fastest gait, and the options of which each has its price."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from enum import StrEnum

import numpy as np

from app.fastest.search import chosen_gait
from core.errors import InputError
from core.gait.foot_orders import order_title
from core.gait.gait import Gait
from core.gait.poses import Poses
from core.library.library import library
from core.library.new_gait import with_robot
from core.pose_gaits.choices import Choice, choices
from core.pose_gaits.front import MARGINS, STOP_BOUNDS
from core.pose_gaits.gait_poses import USUAL_STEP, new_pose_gait, pose_problem
from core.pose_gaits.pose_problem import PoseProblem
from core.pose_gaits.start_motion import TURN_GUESS
from core.robot.arms import ARM_GAP
from core.robot.model import RobotModel, load_robot

STEPS = (None, 0.020, 0.030, 0.040)
"""Steps with a price, m; None for that of the fastest gait."""
CLEARANCES = (0.002, 0.003, 0.004)
"""Clearances with a price, m."""
SWAYS = (0.0, math.radians(5.0))
"""Sways with a price, rad."""
TURNS = (0.0, math.radians(10.0), math.radians(-10.0), math.radians(30.0), math.radians(-30.0))
"""Turns of a walk with a price, rad a cycle, to the left where above 0."""
SAME_ANGLE = 1e-9
"""Directions that differ by less are the same, rad."""


class Course(StrEnum):
    """Where a gait goes: straight on or in a curve, or round on the spot by some turn or to one side."""

    WALK = "walk"
    TURN = "turn"
    """By so much a cycle."""
    LEFT = "left"
    """As fast as it can."""
    RIGHT = "right"


@dataclass(frozen=True)
class FastestRequest:
    """A gait for the robot's clock that is to be as fast as it can be, SI.

    Args:
        robot: its name.
        order: every foot once, counted from 1; it begins with foot 1.
        heading: direction of travel, rad from x.
        overlap: whether a foot is lifted in the move that lowers the one before it.
        course: whether it walks, or turns on the spot by so much or as fast as it can.
        turn: of a walk, and on the spot where it is given, rad a cycle; to the left where it is above 0.
        step: of a walk, m a cycle; None for that of the fastest.
        margin: static stability margin, m.
        clearance: of a swinging foot, m.
        stop_bound: longest time until the robot hears a stop, s.
        slip: how far a standing foot may be off its foothold within a move, m.
        shoe_distance: least distance between the middles of two feet, m.
        arm_distance: least room between the arms of neighbouring legs, m.
        sway: how far the heading may leave an even turn, rad.
        cycles: from the standard stance to rest.
    """

    robot: str = "deltawalker"
    order: tuple[int, ...] = (1, 2, 3, 4)
    heading: float = 0.0
    overlap: bool = False
    course: Course = Course.WALK
    turn: float = 0.0
    step: float | None = None
    margin: float = 0.006
    clearance: float = 0.003
    stop_bound: float = 1.5
    slip: float = 0.0005
    shoe_distance: float = 0.028
    arm_distance: float = ARM_GAP
    sway: float = 0.0
    cycles: int = 3

    @property
    def model(self) -> RobotModel:
        """The robot."""
        return load_robot(self.robot)

    @property
    def choice(self) -> Choice:
        """Foot order, direction and overlap."""
        has_heading = self.course is Course.WALK and abs(self.heading) > SAME_ANGLE
        heading = self.heading if has_heading else 0.0
        return Choice(self.order, heading, self.overlap)

    def document(self, name: str | None = None) -> Gait:
        """The gait document that asks this, without poses.

        Args:
            name: what a person calls it; None for the name of its foot order.

        Raises:
            InputError: it asks for what such a gait cannot have.
        """
        if self.course is Course.TURN and self.turn == 0.0:
            raise InputError("The turn is 0 rad; enter how far the robot turns in each cycle.", "turn")
        model = self.model
        gait = with_robot(library()["walk"].gait, model, self.order)
        if self.course is Course.WALK:
            step = (USUAL_STEP if self.step is None else self.step, 0.0, self.turn)
        elif self.course is Course.TURN:
            step = (0.0, 0.0, self.turn)
        else:
            step = (0.0, 0.0, TURN_GUESS if self.course is Course.LEFT else -TURN_GUESS)
        asked = replace(
            gait, order=self.order, direction=1, step=step, iterations=self.cycles, held=gait.held
        ).with_options(margin=self.margin, clearance=self.clearance, stop_bound=self.stop_bound)
        poses = Poses(
            free_step=self.step is None if self.course is Course.WALK else self.course is not Course.TURN,
            slip=self.slip,
            shoe_distance=self.shoe_distance,
            arm_distance=self.arm_distance,
            sway=self.sway,
        )
        chosen = chosen_gait(new_pose_gait("fastest", asked, poses, model), self.choice, model)
        return chosen if name is None else replace(chosen, name=name)

    def problem(self) -> PoseProblem:
        """One cycle of it in mid-walk.

        Raises:
            InputError: it asks for what such a gait cannot have.
        """
        return replace(pose_problem(self.document(), self.model), cycles=None)


@dataclass(frozen=True)
class Option:
    """One value of an option, with everything else as it is asked.

    Args:
        group: which option.
        value: as JSON.
        request: the request with it.
        name: title of a foot order that has one.
    """

    group: str
    value: object
    request: FastestRequest
    name: str | None = None


def options(request: FastestRequest) -> list[Option]:
    """The values of every option of a request that have a price, those first that are most often looked at.

    Raises:
        InputError: the request asks for what such a gait cannot have.
    """
    return [*_bounds(request), *_orders(request), *_courses(request)]


def _bounds(asked: FastestRequest) -> Iterator[Option]:
    for bound in STOP_BOUNDS:
        yield Option("stop_bound", bound, replace(asked, stop_bound=bound))
    for margin in MARGINS:
        yield Option("margin", margin, replace(asked, margin=margin))
    if asked.course is Course.WALK:
        for step in STEPS:
            yield Option("step", step, replace(asked, step=step))
    for clearance in CLEARANCES:
        yield Option("clearance", clearance, replace(asked, clearance=clearance))
    for sway in SWAYS:
        yield Option("sway", sway, replace(asked, sway=sway))


def _orders(asked: FastestRequest) -> Iterator[Option]:
    """Foot orders in the same sequence whichever is asked; the asked one first where it is not among them."""
    first = tuple(range(1, asked.model.leg_count + 1))
    found = list(choices(replace(asked.problem(), order=first)).tried)
    own = asked.choice
    if not any(_is_same(own, one, asked.course) for one in found):
        found.insert(0, own)
    for one in found:
        value = {"order": list(one.order), "heading": one.heading, "overlap": one.overlap}
        yield Option(
            "order",
            value,
            replace(asked, order=one.order, heading=one.heading, overlap=one.overlap),
            order_title(asked.model, one.order),
        )


def _is_same(own: Choice, other: Choice, course: Course) -> bool:
    is_turned = course is Course.WALK and abs(np.sin((own.heading - other.heading) / 2.0)) > SAME_ANGLE
    return (own.order, own.overlap) == (other.order, other.overlap) and not is_turned


def _courses(asked: FastestRequest) -> Iterator[Option]:
    for turn in TURNS:
        yield Option(
            "course", {"course": "walk", "turn": turn}, replace(asked, course=Course.WALK, turn=turn)
        )
    for course in (Course.LEFT, Course.RIGHT):
        yield Option("course", {"course": course.value, "turn": 0.0}, replace(asked, course=course, turn=0.0))
