"""What is asked of a pose gait: the problem that a solver is given and that the checker holds its answer to.

Every message of the firmware is one pose of all motors, to which they ramp together. So a fast gait has few
poses, and between two of them every motor moves along a straight line.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property, lru_cache
from types import MappingProxyType

import numpy as np

from core.arrays import Bools, Floats
from core.errors import InputError
from core.gait.poses import MOST_SWAY, POSE_LIMITS, PinnedPose
from core.motion.support_polygon import stability_margins, support_polygon
from core.problem.motion_problem import PLANE_HEIGHTS
from core.robot.arms import ARM_GAP
from core.robot.model import RobotModel
from core.wire.robot_time import PUBLISHED, TimeLaw, deaf_seconds, longest_move

FRACTIONS = (0.15, 0.3, 0.5, 0.7, 0.85)
"""Places within each move at which a solver holds its rows."""
SWING_SHARE = 0.8
"""Of the height that a straight rise between two poses would have, this much is asked within a move."""
REST_HEIGHT = 0.0535
"""Actuator plane in the standard stance, m: feet centred, every motor at 5.5 mm on the DeltaWalker."""
SHORTEST_MOVE = 0.007
"""Shorter moves take no less time: a second ramp makes up for what the first one saves, m."""
GRID = 81
"""Places of the body along x and along y that are tried for one that is balanced without two feet in turn."""
LONGEST_RAMP = 0.015
"""Up to here a ramp of d lasts 2 d / v, m (docs/firmware.md)."""
WHOLE_MOVE = 0.0048
"""Where moves may be this long, dividing them makes no gait faster, m."""
LEAST_CLEARANCE = 0.0005
"""A swing that is lower drags, m."""
POSE_BOUNDS: Mapping[str, tuple[float, float]] = MappingProxyType(
    {
        "margin": (0.0, 0.05),
        "clearance": (LEAST_CLEARANCE, 0.015),
        **POSE_LIMITS,
        "stop_bound": (0.8, 10.0),
    }
)
"""Least and most of each limit of `PoseBounds` that is one number, SI."""
MOST_CYCLES = 20
MOST_PARTS = 4
MOST_TURN = math.radians(120.0)
"""Largest turn of the body a cycle, rad."""


@dataclass(frozen=True)
class PoseBounds:
    """Limits of a pose gait, SI.

    Args:
        margin: static stability margin that holds at every place of every move, m.
        clearance: height of a swinging foot at its pose in the air, above the plane of the standing ones, m.
        slip: how far a standing foot may be off its foothold within a move, in x and y; half of it in z, m.
        shoe_distance: least distance between the middles of two feet, m.
        arm_distance: least room between the arms of neighbouring legs, m; 0 where they may touch.
        stop_bound: longest time until the robot hears a stop, s.
        plane_height: lowest and highest actuator plane of a pose, m.
    """

    margin: float = 0.006
    clearance: float = 0.003
    slip: float = 0.0005
    shoe_distance: float = 0.028
    arm_distance: float = ARM_GAP
    stop_bound: float = 1.5
    plane_height: tuple[float, float] = PLANE_HEIGHTS

    def __post_init__(self) -> None:
        for name, (least, most) in POSE_BOUNDS.items():
            value, unit = getattr(self, name), "s" if name == "stop_bound" else "m"
            if not least <= value <= most:
                option = f"--{name.replace('_', '-')}"
                raise InputError(
                    f"{option} is {value:g} {unit}; it must lie between {least:g} and {most:g} {unit}.",
                    option,
                )


@dataclass(frozen=True, eq=False)
class PoseProblem:
    """A pose gait that is wanted.

    Args:
        model: the robot.
        order: every foot once, in the order of their steps, counted from 1.
        heading: which way the body travels at the beginning, rad from x.
        step: travel of the body a cycle, m; None for the step of the fastest walk, 0 for a turn on the spot.
        turn: of the body a cycle, rad, to the left where it is above 0.
        free_turn: on the spot, whether the turn is that of the fastest; then only the sign of `turn` counts.
        sway: how far the heading may leave an even turn, rad.
        overlap: whether a foot is lifted in the move that lowers the one before it, where the others balance
            the body; four legs are too few.
        cycles: from the standard stance to rest; None for one cycle in mid-walk, which repeats itself.
        parts: moves into which each lift, each lowering and each move of the body alone is divided; None for
            the number with which the gait is fastest.
        bounds: the limits.
        law: the robot's time.
        pinned: where the body is to be at some poses; only where no move is divided, and not at an end.
    """

    model: RobotModel
    order: tuple[int, ...]
    heading: float
    step: float | None = None
    turn: float = 0.0
    free_turn: bool = False
    sway: float = 0.0
    overlap: bool = False
    cycles: int | None = None
    parts: int | None = None
    bounds: PoseBounds = field(default_factory=PoseBounds)
    law: TimeLaw = PUBLISHED
    pinned: tuple[PinnedPose, ...] = ()

    def __post_init__(self) -> None:
        legs = self.model.leg_count
        if sorted(self.order) != list(range(1, legs + 1)):
            raise InputError(
                f"--order is {','.join(map(str, self.order))}; it must name each foot 1 to {legs} once.",
                "--order",
            )
        self._require_way()
        if self.cycles is not None and not 1 <= self.cycles <= MOST_CYCLES:
            raise InputError(
                f"--cycles is {self.cycles}; it must lie between 1 and {MOST_CYCLES}.", "--cycles"
            )
        if self.parts is not None and not 1 <= self.parts <= MOST_PARTS:
            raise InputError(f"parts is {self.parts}; it must lie between 1 and {MOST_PARTS}.", "parts")
        if self.pinned:
            self._require_pinned()

    def _require_way(self) -> None:
        """The body goes somewhere or turns, by no more than a cycle can.

        Raises:
            InputError: it does neither, or too much.
        """
        if self.step is not None and not (math.isfinite(self.step) and 0.0 <= self.step <= 0.2):
            raise InputError(
                f"--step is {self.step * 1000:g} mm; it must lie above 0 and up to 200 mm, be 0 for a turn "
                "on the spot, or be “free”.",
                "--step",
            )
        if not abs(self.turn) <= MOST_TURN:
            raise InputError(
                f"--turn is {self.turn:g} rad a cycle; it must lie between {-MOST_TURN:.3g} and "
                f"{MOST_TURN:.3g} rad.",
                "--turn",
            )
        if self.step == 0.0 and self.turn == 0.0:
            raise InputError("The step is 0 mm and the turn 0 rad; the robot has to go somewhere.", "--step")
        if self.free_turn and self.step != 0.0:
            raise InputError("Only a turn on the spot can be as fast as possible; set --step 0.", "--turn")
        if not 0.0 <= self.sway <= MOST_SWAY:
            raise InputError(
                f"--sway is {self.sway:g} rad; it must lie between 0 and {MOST_SWAY:.3g} rad.", "--sway"
            )

    def _require_pinned(self) -> None:
        """Pinned poses are poses of this gait.

        Raises:
            InputError: a pinned pose does not exist, or is an end.
        """
        if self.is_turned:
            raise InputError(
                "A gait that turns or sways cannot have pinned poses (poses.pinned).", "poses.pinned"
            )
        if self.may_divide or self.parts not in (None, 1):
            raise InputError(
                f"A stop bound of {self.bounds.stop_bound:g} s may divide moves, so no pose can be pinned "
                "(poses.pinned). Unpin the poses, or choose a stop bound of at least "
                f"{math.ceil(deaf_seconds(WHOLE_MOVE) * 10) / 10:g} s.",
                "poses.pinned",
            )
        for pin in self.pinned:
            if not 1 < pin.pose <= self.move_count:
                raise InputError(
                    f"poses.pinned names pose {pin.pose}; 2 to {self.move_count} can be pinned: "
                    "where the gait begins and ends is given.",
                    "poses.pinned",
                )

    @property
    def on_the_spot(self) -> bool:
        """Whether the body turns where it is."""
        return self.step == 0.0

    @property
    def is_free(self) -> bool:
        """Whether the step, or on the spot the turn, is that of the fastest gait."""
        return self.step is None or self.free_turn

    @property
    def way_word(self) -> str:
        """The word for the motion of a cycle: "step", or "turn" on the spot."""
        return "turn" if self.on_the_spot else "step"

    @property
    def is_turned(self) -> bool:
        """Whether the heading is anything but 0 throughout."""
        return self.turn != 0.0 or self.sway > 0.0

    @property
    def largest_move(self) -> float:
        """Largest move of a motor that keeps the stop bound and has a ramp without even speed, m."""
        return min(longest_move(self.bounds.stop_bound), LONGEST_RAMP)

    @property
    def parts_to_try(self) -> tuple[int, ...]:
        """Numbers of parts that may be fastest; more than one where the stop bound leaves short moves."""
        if self.parts is not None:
            return (self.parts,)
        return (1, 2) if self.may_divide else (1,)

    @property
    def may_divide(self) -> bool:
        """Whether the stop bound leaves such short moves that dividing them may make the gait faster."""
        return self.largest_move < WHOLE_MOVE

    @property
    def is_pinnable(self) -> bool:
        """Whether poses can be pinned: no move is divided, and the heading is 0 throughout."""
        return not self.may_divide and not self.is_turned

    @property
    def all_cycles(self) -> int:
        """Cycles that the poses go through."""
        return 1 if self.cycles is None else self.cycles

    @cached_property
    def airborne(self) -> Bools:
        """(poses, legs) true where a foot is in the air at a pose (see `airborne_feet`)."""
        return airborne_feet(self)

    @property
    def move_count(self) -> int:
        """Number of moves: one fewer than poses."""
        return len(self.airborne) - 1

    @property
    def moves_a_cycle(self) -> int:
        """Moves of one cycle in mid-walk."""
        return len(airborne_feet(self, in_mid_walk=True)) - 1

    @cached_property
    def moving(self) -> Bools:
        """(moves, legs) true where a foot is in the air at an end of a move; the others stand throughout."""
        return np.asarray(self.airborne[:-1] | self.airborne[1:])

    @cached_property
    def floor(self) -> Floats:
        """(poses, legs) least height of each foot, m: 0 on the ground, the clearance in mid-swing."""
        return self.bounds.clearance * swing_shares(self.airborne)

    def pinned_offset(self, pin: PinnedPose) -> Floats:
        """(2,) from where an even travel has the body at a pinned pose to where it is to be, m."""
        ahead = np.array([math.cos(self.heading), math.sin(self.heading)])
        return np.asarray(pin.along * ahead + pin.sideways * np.array([-ahead[1], ahead[0]]))

    def pinned_place(self, pin: PinnedPose, step: float) -> Floats:
        """(2,) from the body's first place to where it is to be at a pinned pose, m.

        Args:
            pin: one of `pinned`.
            step: travel of the body a cycle, m.
        """
        share = (pin.pose - 1) / self.move_count
        return share * step * self.whole_travel() + self.pinned_offset(pin)

    def required_height(self, move: int, foot: int, share: float) -> float:
        """Least height of a swinging foot at a share of a move, above the plane of the standing feet, m."""
        return SWING_SHARE * float((1 - share) * self.floor[move, foot] + share * self.floor[move + 1, foot])

    def travel_direction(self, cycle: int = 0) -> Floats:
        """(2,) unit vector along which a cycle travels, counted from 0: its heading after half a turn."""
        angle = self.heading + self.turn * (cycle + 0.5)
        return np.array([math.cos(angle), math.sin(angle)])

    def whole_travel(self) -> Floats:
        """(2,) from the first place of the body to the last, for a step of 1."""
        directions = [self.travel_direction(cycle) for cycle in range(self.all_cycles)]
        return np.asarray(np.sum(directions, axis=0))


def swing_shares(airborne: Bools) -> Floats:
    """(poses, legs) share of the clearance that is due at each pose.

    1 in the middle of a swing, less before and after where a swing has several poses in the air: of three of
    them 1/2, 1, 1/2.
    """
    shares = np.zeros(airborne.shape)
    for pose, foot in zip(*np.nonzero(airborne), strict=True):
        before = next(k for k in range(pose, -1, -1) if not airborne[k, foot])
        after = next(k for k in range(pose, len(airborne)) if not airborne[k, foot])
        shares[pose, foot] = min(pose - before, after - pose) / math.ceil((after - before - 1) / 2)
    return shares


def airborne_feet(problem: PoseProblem, *, in_mid_walk: bool = False) -> Bools:
    """(poses, legs) which feet are in the air at each pose.

    A foot takes two moves, one that lifts it and one that lowers it; the body goes on in both. Where the body
    cannot be balanced for two feet in turn at the same place, a move of the body alone stands between them;
    so it does at the beginning of a walk from the standard stance, and at its end unless the last pose of a
    cycle is such a place already.

    Args:
        problem: what is asked.
        in_mid_walk: one cycle that repeats itself, whatever the problem's cycles.
    """
    order, parts, legs = problem.order, problem.parts or 1, problem.model.leg_count
    cycle: list[int | None] = []
    for place, (here, following) in enumerate(zip(order, order[1:] + order[:1], strict=True)):
        cycle += [here] * (2 * parts - 1)
        if problem.overlap and place < legs - 1 and _is_balanced_without(problem, {here, following}):
            continue
        cycle += [None]
        needs_shift = not _shares_balance(problem.model, here, following, problem.bounds.margin)
        cycle += [None] * parts if needs_shift else []
    if in_mid_walk or problem.cycles is None:
        poses = [None, *cycle]
    else:
        needs_shift = not _shares_balance(problem.model, order[-1], order[0], problem.bounds.margin)
        poses = [None] * (1 + parts) + cycle * problem.cycles + ([] if needs_shift else [None] * parts)
    airborne = np.zeros((len(poses), legs), dtype=np.bool_)
    for pose, foot in enumerate(poses):
        if foot is not None:
            airborne[pose, foot - 1] = True
    return airborne


def _is_balanced_without(problem: PoseProblem, feet: set[int]) -> bool:
    """Whether the others balance the body in the middle of the standard stance with these feet in the air."""
    homes = problem.model.module_centres_robot[:, :2]
    standing = [leg for leg in range(problem.model.leg_count) if leg + 1 not in feet]
    if len(standing) < 3:
        return False
    contact = np.isin(np.arange(len(homes)), standing)[None]
    room = stability_margins(np.zeros((1, 2)), np.pad(homes, ((0, 0), (0, 1)))[None], contact)
    return bool(room[0] > problem.bounds.margin)


@lru_cache(maxsize=256)
def _shares_balance(model: RobotModel, first: int, second: int, margin: float) -> bool:
    """Whether one place of the body is balanced without either foot, in the standard stance."""
    feet = model.module_centres_robot[:, :2]
    axis = np.linspace(-model.radius, model.radius, GRID)
    places = np.stack(np.meshgrid(axis, axis), axis=-1).reshape(-1, 2)
    least = np.full(len(places), np.inf)
    for foot in (first, second):
        polygon = support_polygon(np.delete(feet, foot - 1, axis=0))
        if len(polygon) < 3:
            return False
        edges = np.roll(polygon, -1, axis=0) - polygon
        inward = np.stack([-edges[:, 1], edges[:, 0]], axis=-1) / np.linalg.norm(edges, axis=1, keepdims=True)
        least = np.minimum(least, (places @ inward.T - (inward * polygon).sum(axis=1)).min(axis=1))
    return bool(least.max() > max(margin, 0.001))
