"""The roles of feet in a ring of any number: front, back, and the sides counted from the front."""

import numpy as np


def ring_roles(legs: int, heading: float) -> tuple[str, ...]:
    """F and B for feet straight ahead and behind, else L1, L2, … and R1, R2, … from the front on either side.

    Args:
        legs: number of feet in an even ring, the first on +x, counter-clockwise.
        heading: which way the robot goes, rad from +x.

    Returns:
        (legs,) names, foot 1 first.
    """
    degrees = 360.0 * np.arange(legs) / legs - np.degrees(heading)
    away = np.round(np.mod(degrees + 180.0, 360.0) - 180.0, 6)
    ahead, behind = away == 0.0, np.abs(away) == 180.0
    names = np.full(legs, "", dtype=object)
    names[ahead], names[behind] = "F", "B"
    for letter, side in (("L", away > 0), ("R", away < 0)):
        feet = np.nonzero(side & ~behind)[0]
        for number, foot in enumerate(feet[np.argsort(np.abs(away[feet]))], 1):
            names[foot] = f"{letter}{number}"
    return tuple(names)
