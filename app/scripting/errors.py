"""The refusals that scripts meet; `footfall` has them by these names."""

from core.errors import (
    CheckError,
    FootfallError,
    InfeasibleError,
    InputError,
    RobotError,
    StateError,
    StorageError,
)

__all__ = [
    "CheckError",
    "FootfallError",
    "InfeasibleError",
    "InputError",
    "RobotError",
    "StateError",
    "StorageError",
]
