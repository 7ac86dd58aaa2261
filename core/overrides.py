"""Which rules a person may override, and why; the page, the commands and the documentation take it from here.

A rule that stands in neither table cannot be overridden.
"""

from dataclasses import dataclass

MOST_REASON = 300
"""Letters of a reason."""

_WALKS = "It predicts how the robot stands and walks. A person who has seen it walk may know better."
_PHYSICS = "It judges a simulation. A person who has seen the robot walk may know better."
_ASKED = "It compares the motion with what the gait asks. The motors can follow either."
_MOTORS = "It keeps what is sent within what the motors and their firmware can do."
_COLLIDES = "Parts of the robot would meet."
_PLANNED = "It makes sure that what is sent is what was planned and checked."

OVERRIDABLE = {
    "balance": _WALKS,
    "path_balance": _WALKS,
    "path_ground": _WALKS,
    "path_clearance": _WALKS,
    "contact": _WALKS,
    "clearance": _WALKS,
    "slip": _WALKS,
    "lean": _WALKS,
    "made_travel": _WALKS,
    "made_heading": _WALKS,
    "start_pose": _WALKS,
    "travel": _ASKED,
    "turn": _ASKED,
    "height": _ASKED,
    "simulated_fall": _PHYSICS,
    "simulated_end": _PHYSICS,
    "simulated_tilt": _PHYSICS,
    "simulated_swing": _PHYSICS,
    "simulated_slip": _PHYSICS,
    "simulated_balance": _PHYSICS,
    "simulated_travel": _PHYSICS,
    "simulated_heading": _PHYSICS,
    "simulated_motors": _PHYSICS,
    "simulated_force": _PHYSICS,
}
"""Why each of these rules may be overridden."""

FINAL = {
    "range": _MOTORS,
    "stroke": _MOTORS,
    "motor_speed": _MOTORS,
    "motor_acceleration": _MOTORS,
    "move_size": _MOTORS,
    "deafness": _MOTORS,
    "duration": _MOTORS,
    "coupling": _MOTORS,
    "shoe_distance": _COLLIDES,
    "arm_distance": _COLLIDES,
    "computed": _PLANNED,
    "fresh": _PLANNED,
}
"""Why each of these rules may not be overridden."""


@dataclass(frozen=True)
class OverrideRequest:
    """What a person says who approves in spite of errors.

    Args:
        rules: whose errors are overridden.
        reason: why.
    """

    rules: tuple[str, ...]
    reason: str
