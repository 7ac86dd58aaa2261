"""Rotation of horizontal vectors by a symbolic angle."""

from casadi import SX, cos, sin, vertcat


def turned(vector: SX, angle: SX | float) -> SX:
    """A vector turned about z, to the left by a positive angle.

    Args:
        vector: (2,).
        angle: rad.
    """
    cosine, sine = cos(angle), sin(angle)
    return vertcat(cosine * vector[0] - sine * vector[1], sine * vector[0] + cosine * vector[1])
