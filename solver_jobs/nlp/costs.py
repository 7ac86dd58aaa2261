"""What is minimised, in the solver's scale: SI times `COST_SCALE`, so that m² become mm²."""

from casadi import SX, dot

from core.motion.support_polygon import GRAVITY
from core.problem.motion_problem import GENTLE_FOOT_SHARE, Cost
from core.robot.model import RobotModel
from solver_jobs.nlp.variables import MM, Symbols, per_interval

COST_SCALE = MM**2
"""The solver's cost is the thesis's in SI times this."""

FORCE_PREFERENCE = 1.0
"""Weight of ½‖λ‖² (N², in the solver's scale), and of the slopes where these are unknowns. It picks the
smallest of equally good contact forces, which the thesis's cost leaves open and which would leave the Hessian
singular; its share of the reported cost is taken off again."""

GENTLE_WEIGHT = 30.0
"""Weight of the gentle cost beside the preference of forces. With 1 the body leans towards where forces are
small: at margin 0 its largest move between knots was up to 1.5 times the least possible."""


def cost_of(kind: Cost, symbols: Symbols, model: RobotModel) -> SX:
    """The cost to report, in the solver's scale."""
    if kind is Cost.GENTLE:
        return _speed(symbols)
    cost = _goal_distance(symbols)
    return cost + COST_SCALE * _effort(symbols, model) if kind is Cost.GOAL_EFFORT else cost


def price_of(kind: Cost, cost: SX, symbols: Symbols) -> SX:
    """What the solver minimises: the cost, weighted, and the preference that makes contact forces unique."""
    return (GENTLE_WEIGHT if kind is Cost.GENTLE else 1.0) * cost + _force_preference(symbols)


def _force_preference(symbols: Symbols) -> SX:
    return FORCE_PREFERENCE / 2 * sum((dot(part, part) for part in (*symbols.force, *symbols.slope)), SX(0))


def _goal_distance(symbols: Symbols) -> SX:
    """½ Σ ‖x − x_g‖² over every knot, (3.4)."""
    total = SX(0)
    for point, (position, velocity) in enumerate(zip(symbols.position, symbols.velocity, strict=True)):
        goal = symbols.goal[3 * point : 3 * point + 3] @ SX.ones(1, position.shape[1])
        total += dot(position - goal, position - goal) + dot(velocity, velocity)
    return total / 2


def _speed(symbols: Symbols) -> SX:
    """½ Σ (‖v_b‖² + s Σ ‖v_f‖²) over every knot, as `Cost.GENTLE` has it."""
    body, *feet = symbols.velocity
    return (dot(body, body) + GENTLE_FOOT_SHARE * sum((dot(foot, foot) for foot in feet), SX(0))) / 2


def _effort(symbols: Symbols, model: RobotModel) -> SX:
    """½ Σ ‖F‖² over every interval, (3.3), with the internal forces F = m_f (a + g) − λ of (3.2), N²."""
    total = SX(0)
    for velocity, force in zip(symbols.velocity[1:], symbols.force, strict=True):
        acceleration = per_interval(velocity[:, 1:] - velocity[:, :-1], symbols) / MM
        internal = model.masses.foot * acceleration - force[:, :-1]
        weight = SX([0.0, 0.0, model.masses.foot * GRAVITY]) @ SX.ones(1, internal.shape[1])
        total += dot(internal + weight, internal + weight)
    return total / 2
