"""A walk from the standard stance to rest that repeats a cycle of mid-walk: a start for the exact solver."""

from dataclasses import replace

import numpy as np

from core.arrays import Floats
from core.pose_gaits.pose_gait import PoseGait
from core.pose_gaits.pose_problem import REST_HEIGHT, PoseProblem
from core.robot.kinematics import BodyPose, free_strokes


def near_walk(cycle: PoseGait, problem: PoseProblem) -> PoseGait | None:
    """Poses that nearly answer a problem from stance to rest; they keep no limit for certain.

    Args:
        cycle: one cycle in mid-walk, with the same foot order and heading.
        problem: the same from the standard stance to rest.

    Returns:
        None where the cycle does not fit into the walk.
    """
    problem = replace(problem, parts=cycle.problem.parts)
    moves, cycles = cycle.problem.move_count, problem.all_cycles
    lead = problem.move_count - moves * cycles
    airborne = problem.airborne
    repeated = np.vstack([cycle.problem.airborne[:-1]] * cycles + [cycle.problem.airborne[-1:]])
    # Poses before the first cycle, or after the last one, have all feet down.
    before = next(
        (k for k in range(lead + 1) if np.array_equal(airborne[k : k + len(repeated)], repeated)), None
    )
    if before is None:
        return None
    bodies, headings, feet = [], [], []
    for pose in range(len(airborne)):
        place = min(max(pose - before, 0), moves * cycles)
        turns, within = divmod(place, moves)
        if turns == cycles:
            turns, within = cycles - 1, moves
        moved = _Moved(cycle, turns)
        bodies.append(moved(cycle.bodies[within]))
        headings.append(cycle.headings[within] + turns * cycle.turn)
        feet.append(np.array([moved(foot) for foot in cycle.feet[within]]))
    walk_bodies, walk_feet = np.array(bodies), np.array(feet)
    end = _Moved(cycle, cycles)
    homes = np.array(problem.model.module_centres_robot)
    for leg in range(problem.model.leg_count):
        swings = np.nonzero(airborne[:, leg])[0]
        walk_feet[: swings[0], leg] = homes[leg]
        walk_feet[swings[-1] + 1 :, leg] = end(homes[leg])
    walk_bodies[0], walk_bodies[-1] = (0.0, 0.0, REST_HEIGHT), end(np.array([0.0, 0.0, 0.0]))
    walk_bodies[-1, 2] = REST_HEIGHT
    headings[0], headings[-1] = 0.0, cycles * cycle.turn
    turned = np.array(headings)
    strokes = free_strokes(problem.model, walk_feet, BodyPose(walk_bodies, turned))
    return PoseGait(problem, cycle.step, walk_bodies, turned, walk_feet, np.nan_to_num(strokes))


class _Moved:
    """Moves points on by whole cycles: each goes along its own heading and turns on."""

    def __init__(self, cycle: PoseGait, cycles: int) -> None:
        angle = cycles * cycle.turn
        cosine, sine = np.cos(angle), np.sin(angle)
        self._rotation = np.array([[cosine, -sine], [sine, cosine]])
        directions = [cycle.problem.travel_direction(number) for number in range(cycles)]
        self._travel = cycle.step * np.sum(directions, axis=0) if cycles else np.zeros(2)

    def __call__(self, point: Floats) -> Floats:
        """(3,) the point in that cycle."""
        return np.append(self._rotation @ point[:2] + self._travel, point[2])
