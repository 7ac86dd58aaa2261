"""One gait of a space, by its parameters."""

import math
from dataclasses import dataclass

from core.pose_gaits.pose_problem import PoseBounds, PoseProblem
from core.robot.model import RobotModel


@dataclass(frozen=True)
class AtlasPoint:
    """Parameters of a gait, SI.

    Args:
        number: of the gait in its space.
        robot: its name.
        numbers: numbers of the robot's parameters file that differ, each with its key.
        order: every foot once, counted from 1.
        overlap: whether a foot is lifted in the move that lowers the one before it.
        moves: into how many each lift, each lowering and each move of the body alone is divided.
        step_x: travel of the body a cycle along x, m.
        step_y: the same along y, m.
        turn: of the body a cycle, rad, to the left where it is above 0.
        height: actuator plane of the body above the standing feet, m.
        clearance: of a swinging foot, m.
        margin: static stability margin, m.
        stop_bound: longest time until the robot hears a stop, s.
        lost: limbs that are held up, counted from 1.
    """

    number: int
    robot: str
    order: tuple[int, ...]
    margin: float
    numbers: tuple[tuple[str, float], ...] = ()
    overlap: bool = False
    moves: int = 1
    step_x: float = 0.03
    step_y: float = 0.0
    turn: float = 0.0
    height: float = 0.057
    clearance: float = 0.003
    stop_bound: float = 1.5
    lost: tuple[int, ...] = ()

    @property
    def step(self) -> float:
        """Travel of the body a cycle, m."""
        return math.hypot(self.step_x, self.step_y)

    def pose_problem(self, model: RobotModel) -> PoseProblem:
        """What is asked of a gait for the robot's clock: one cycle in mid-walk.

        In a curve its step is along the heading half way through.

        Args:
            model: the robot.

        Raises:
            InputError: it goes nowhere.
        """
        on_the_spot = self.step == 0.0
        return PoseProblem(
            model,
            self.order,
            math.atan2(self.step_y, self.step_x) - (0.0 if on_the_spot else self.turn / 2.0),
            step=self.step,
            turn=self.turn,
            overlap=self.overlap,
            parts=self.moves,
            bounds=PoseBounds(margin=self.margin, clearance=self.clearance, stop_bound=self.stop_bound),
        )
