"""The nearest point that a leg can reach."""

import numpy as np

from core.arrays import Bools, Floats
from core.robot.leg import foot_from_strokes, foot_jacobian
from core.robot.model import RobotModel, StrokeLimits


def nearest_reachable(model: RobotModel, foot_module: Floats) -> Floats:
    """The point of a leg's workspace that is nearest to a target, by projected Gauss–Newton over strokes.

    Minimises ‖FK(h) − target‖² over lower ≤ h ≤ upper from several starts.

    Args:
        model: the robot.
        foot_module: (3,) target in the module's frame, m.

    Returns:
        (3,) m.
    """
    lower, upper = model.stroke.lower, model.stroke.upper
    levels = np.linspace(lower, upper, 5)
    grid = np.stack(np.meshgrid(levels, levels, levels, indexing="ij"), axis=-1).reshape(-1, 3)
    feet = foot_from_strokes(model.leg, grid)
    distances = np.nan_to_num(np.linalg.norm(feet - foot_module, axis=-1), nan=np.inf)
    starts = grid[np.argsort(distances)[:3]]
    candidates = [_descend(model, start, foot_module) for start in starts]
    return min(candidates, key=lambda point: float(np.linalg.norm(point - foot_module)))


def _descend(model: RobotModel, strokes: Floats, target: Floats) -> Floats:
    """Projected Levenberg–Marquardt on the strokes; returns the foot that it ends at."""
    damping = 1e-6
    foot = foot_from_strokes(model.leg, strokes)
    for _ in range(60):
        jacobian = foot_jacobian(model.leg, strokes)
        free = _free_motors(model.stroke, strokes, jacobian.T @ (foot - target))
        if not free.any():
            break
        reduced = jacobian[:, free]
        normal = reduced.T @ reduced + damping * np.eye(int(free.sum()))
        proposal = strokes.copy()
        proposal[free] -= np.linalg.solve(normal, reduced.T @ (foot - target))
        proposal = np.clip(proposal, model.stroke.lower, model.stroke.upper)  # the projection of the method
        moved = foot_from_strokes(model.leg, proposal)
        if (
            np.isfinite(moved).all()
            and np.linalg.norm(moved - target) < np.linalg.norm(foot - target) - 1e-15
        ):
            strokes, foot, damping = proposal, moved, damping / 4
        elif damping > 1e6:
            break
        else:
            damping *= 8
    return foot


def _free_motors(limits: StrokeLimits, strokes: Floats, gradient: Floats) -> Bools:
    held_low = (strokes <= limits.lower) & (gradient > 0)
    held_high = (strokes >= limits.upper) & (gradient < 0)
    return ~(held_low | held_high)
