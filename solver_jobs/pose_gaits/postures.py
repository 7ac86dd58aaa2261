"""The robot at a place of a move in CasADi: strokes of its legs, and heights over its standing feet; mm."""

from dataclasses import dataclass

from casadi import DM, SX, fmax, sqrt, vertcat

from core.pose_gaits.start_motion import MM
from core.robot.model import RobotModel
from solver_jobs.nlp.leg_equations import motor_arms, squared_offsets
from solver_jobs.pose_gaits.turning import turned

LEAST_DEPTH = 5.0
"""A rod's depth that the equations do not go below while IPOPT looks around, mm."""


@dataclass(frozen=True, eq=False)
class Posture:
    """The robot at a place of a move.

    Args:
        body: (3,) mm.
        feet: (3,) each, mm.
        strokes: (3·legs,) mm.
        heading: rad.
    """

    body: SX
    feet: list[SX]
    strokes: SX
    heading: SX | float


def leg_strokes(model: RobotModel, leg: int, body: SX, foot: SX, heading: SX | float) -> SX:
    """(3,) strokes of a leg by inverse kinematics, mm.

    Args:
        model: the robot.
        leg: counted from 0.
        body: (3,) mm.
        foot: (3,) platform centre, mm.
        heading: of the body, rad.
    """
    robot = turned(foot[:2] - body[:2], -heading)
    rotation = model.R_robot_from_module[leg][:2, :2].T
    module = DM(rotation) @ (robot - DM(model.module_centres_robot[leg, :2] * MM))
    arms = motor_arms(model.leg.reach_radius * MM, (module[0], module[1], SX(0)))
    depths = [
        sqrt(fmax((model.leg.link_length * MM) ** 2 - d, LEAST_DEPTH**2)) for d in squared_offsets(arms)
    ]
    return vertcat(*(body[2] - foot[2] - depth for depth in depths))


def plane_height(foot: SX, standing: list[SX]) -> SX:
    """Height at a foot of the plane that fits the standing feet best; three of them lie on it.

    With places relative to the foot it is the intercept of the least-squares plane, by Cramer's rule.
    """
    xs, ys = ([point[axis] - foot[axis] for point in standing] for axis in (0, 1))
    zs = [point[2] for point in standing]
    sums = {
        (i, j): sum(a * b for a, b in zip(u, v, strict=True))
        for i, u in enumerate((xs, ys, [SX(1)] * len(xs)))
        for j, v in enumerate((xs, ys, [SX(1)] * len(xs), zs))
    }

    def determinant(columns: tuple[int, int, int]) -> SX:
        a, b, c = columns
        return SX(
            sums[0, a] * (sums[1, b] * sums[2, c] - sums[1, c] * sums[2, b])
            - sums[0, b] * (sums[1, a] * sums[2, c] - sums[1, c] * sums[2, a])
            + sums[0, c] * (sums[1, a] * sums[2, b] - sums[1, b] * sums[2, a])
        )

    height: SX = determinant((0, 1, 3)) / determinant((0, 1, 2))
    return height
