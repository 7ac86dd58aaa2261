import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.problem.motion_problem import CYLINDER, Workspace
from core.problem.workspace_outline import reach_radii
from core.robot.leg import strokes_from_foot
from core.robot.model import load_robot

ROBOT = load_robot("deltawalker")
RAYS = 24


def is_reached(radii: np.ndarray, height: float) -> np.ndarray:
    angles = 2 * np.pi * np.arange(RAYS) / RAYS
    points = np.stack([radii * np.cos(angles), radii * np.sin(angles), np.full(RAYS, height)], axis=-1)
    strokes = strokes_from_foot(ROBOT.leg, points)
    within = (strokes >= ROBOT.stroke.lower) & (strokes <= ROBOT.stroke.upper)
    return np.asarray(within.all(axis=-1))


@given(height=st.floats(-0.067, -0.052))
def test_a_foot_is_in_reach_up_to_the_outline_and_out_of_reach_beyond_it(height: float) -> None:
    radii = reach_radii(ROBOT, Workspace.STROKE, np.array(height), RAYS)
    if (radii == 0).all():
        assert not is_reached(np.zeros(RAYS), height).any()
        return
    for share in (0.02, 0.5, 0.999):
        assert is_reached(share * radii, height).all()
    assert not is_reached(1.001 * radii + 1e-6, height).any()


def test_heights_may_have_any_shape() -> None:
    heights = np.linspace(-0.06, -0.05, 6).reshape(3, 2)
    radii = reach_radii(ROBOT, Workspace.STROKE, heights, RAYS)
    assert radii.shape == (3, 2, RAYS)
    assert radii[1, 1] == pytest.approx(reach_radii(ROBOT, Workspace.STROKE, heights[1, 1], RAYS))


def test_the_cylinder_is_round_between_its_ends_and_nothing_beyond_them() -> None:
    heights = -CYLINDER.depth + np.array([-0.0026, -0.0024, 0.0074, 0.0076])
    radii = reach_radii(ROBOT, Workspace.CYLINDER, heights, 4)
    assert radii == pytest.approx(np.array([[0.0] * 4, [0.0135] * 4, [0.0135] * 4, [0.0] * 4]))
