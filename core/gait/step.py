"""The step of a gait, (dx, dy, yaw) of the body an iteration in m, m and rad, and its bounds."""

import math

import numpy as np

from core.errors import InputError

Step = tuple[float, float, float]

MAX_STEP = 0.2
"""Larger steps an iteration than any workspace here, m; a guard against mm given for m."""
MAX_TURN = 2.0 * math.pi
"""Larger turns an iteration than any robot here makes, rad; a guard against degrees given for rad."""
LEAST_STEP = 1e-9
"""A travel, m, or a turn, rad, that is nearer to 0 and not 0 is a slip of the pen, or rounding."""


def require_step(step: Step, iterations: int | None) -> None:
    """Raises InputError unless a robot could make the step.

    Args:
        step: of the document.
        iterations: of all parts of a sequence, whose step is their sum; None for a gait of its own.
    """
    if not all(np.isfinite(step)):
        raise InputError(f"The step is {step}; each of its numbers must be finite.", "step")
    length, turn = float(np.hypot(*step[:2])), abs(step[2])
    if length > MAX_STEP * (iterations or 1):
        raise InputError(
            f"The step is {length * 1000:.4g} mm; it must be at most {MAX_STEP * 1000:.0f} mm an iteration.",
            "step",
        )
    if turn > MAX_TURN * (iterations or 1):
        raise InputError(
            f"The turn is {turn:.4g} rad; it must be at most {MAX_TURN:.3g} rad an iteration.", "step"
        )
    for words, value, unit in (("step", length, "m"), ("turn", turn, "rad")):
        if iterations is None and 0.0 < value < LEAST_STEP:
            raise InputError(
                f"The {words} is {value:.3g} {unit}; it must be 0 or at least {LEAST_STEP:g} {unit}.", "step"
            )


def without_rounding(step: Step) -> Step:
    """A step that was measured, with 0 for what is too small to be one."""
    dx, dy, yaw = step
    is_still = float(np.hypot(dx, dy)) < LEAST_STEP
    return 0.0 if is_still else dx, 0.0 if is_still else dy, 0.0 if abs(yaw) < LEAST_STEP else yaw
