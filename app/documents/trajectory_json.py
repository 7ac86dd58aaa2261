"""A trajectory as JSON content, for results that are kept."""

import hashlib
import json

from app.common.json import Json
from core.motion.trajectory import Trajectory

_FIELDS = (
    "times",
    "body_world",
    "heading",
    "feet_world",
    "contact",
    "body_velocity",
    "feet_velocity",
    "contact_forces",
)


def trajectory_content(trajectory: Trajectory) -> Json:
    """Nested lists by field name; None where the trajectory does not know."""
    values = {name: getattr(trajectory, name) for name in _FIELDS}
    return {name: None if value is None else value.tolist() for name, value in values.items()}


def trajectory_from_content(content: Json) -> Trajectory:
    """Inverse of `trajectory_content`."""
    return Trajectory(**{name: content[name] for name in _FIELDS})


def content_sha256(content: Json) -> str:
    """SHA-256 of a trajectory's content, hexadecimal."""
    return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()
