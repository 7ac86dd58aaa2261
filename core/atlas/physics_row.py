"""What physics made of one gait of an atlas; it is kept beside the rows, and no hash depends on it."""

import math
from collections.abc import Mapping
from dataclasses import dataclass

PHYSICS_FIGURES = (
    "walked",
    "simulated_speed",
    "simulated_turn_rate",
    "max_tilt",
    "swing_load",
    "slip",
)
"""Figures of a simulated gait, in the order in which they are kept."""


@dataclass(frozen=True)
class PhysicsRow:
    """A simulated gait, SI; figures are nan where the simulation gave none.

    Args:
        number: of the gait in its space.
        variations: how many variations of the physics parameters were tried.
        reason: why there are no figures; "" where there are.
        walked: share of the variations that walk, 0 to 1.
        simulated_speed: of the body with the parameters as they are, m/s.
        simulated_turn_rate: the same, rad/s.
        max_tilt: largest lean of the body with the parameters as they are, rad.
        swing_load: largest share of any swing in which its foot carries load, 0 to 1.
        slip: largest way that a foot slid while it should have stood, m.
    """

    number: int
    variations: int
    reason: str = ""
    walked: float = math.nan
    simulated_speed: float = math.nan
    simulated_turn_rate: float = math.nan
    max_tilt: float = math.nan
    swing_load: float = math.nan
    slip: float = math.nan

    @property
    def walks_in_all(self) -> bool:
        """Whether it walks in all variations."""
        return self.walked == 1.0

    @property
    def figures(self) -> dict[str, float]:
        """Its figures by name."""
        return {name: getattr(self, name) for name in PHYSICS_FIGURES}


def physics_content(row: PhysicsRow | None) -> Mapping[str, float | int | None]:
    """The number of variations and the figures; None each where there is none.

    Args:
        row: None of a gait that was not simulated.
    """
    if row is None:
        return dict.fromkeys(("variations", *PHYSICS_FIGURES))
    figures = {name: None if math.isnan(value) else value for name, value in row.figures.items()}
    return {"variations": row.variations, **figures}
