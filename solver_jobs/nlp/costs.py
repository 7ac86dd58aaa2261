"""What is minimised, in the solver's scale: SI times `COST_SCALE`, so that m² become mm²."""

from casadi import SX, dot

from core.motion.support_polygon import GRAVITY
from core.problem.motion_problem import Cost
from core.robot.model import RobotModel
from solver_jobs.nlp.variables import MM, Symbols, per_interval

COST_SCALE = MM**2
"""The solver's cost is the thesis's in SI times this."""

FORCE_PREFERENCE = 1.0
"""Weight of ½‖λ‖² (N², in the solver's scale), and of the slopes where these are unknowns. It picks the
smallest of equally good contact forces, which the thesis's cost leaves open and which would leave the Hessian
singular; its share of the reported cost is taken off again."""


def cost_of(kind: Cost, symbols: Symbols, model: RobotModel) -> SX:
    """The cost to report, in the solver's scale."""
    cost = _goal_distance(symbols)
    return cost + COST_SCALE * _effort(symbols, model) if kind is Cost.GOAL_EFFORT else cost


def force_preference(symbols: Symbols) -> SX:
    """What is added to the cost so that contact forces are unique."""
    return FORCE_PREFERENCE / 2 * sum((dot(part, part) for part in (*symbols.force, *symbols.slope)), SX(0))


def _goal_distance(symbols: Symbols) -> SX:
    """½ Σ ‖x − x_g‖² over every knot, (3.4)."""
    total = SX(0)
    for point, (position, velocity) in enumerate(zip(symbols.position, symbols.velocity, strict=True)):
        goal = symbols.goal[3 * point : 3 * point + 3] @ SX.ones(1, position.shape[1])
        total += dot(position - goal, position - goal) + dot(velocity, velocity)
    return total / 2


def _effort(symbols: Symbols, model: RobotModel) -> SX:
    """½ Σ ‖F‖² over every interval, (3.3), with the internal forces F = m_f (a + g) − λ of (3.2), N²."""
    total = SX(0)
    for velocity, force in zip(symbols.velocity[1:], symbols.force, strict=True):
        acceleration = per_interval(velocity[:, 1:] - velocity[:, :-1], symbols) / MM
        internal = model.masses.foot * acceleration - force[:, :-1]
        weight = SX([0.0, 0.0, model.masses.foot * GRAVITY]) @ SX.ones(1, internal.shape[1])
        total += dot(internal + weight, internal + weight)
    return total / 2
