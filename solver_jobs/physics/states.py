"""From the engine's states to a simulated motion in the plan's frame."""

from typing import Any

import mujoco
import numpy as np

from core.arrays import Floats
from core.physics.metrics import rotations
from core.physics.motion import SimulatedMotion
from core.physics.problem import Rig, SimulationProblem
from core.physics.ramp import TURN, MotorTrajectory
from core.robot.closed_chain import foot_joints, motor_joint
from solver_jobs.physics.mjcf import ground_sensor, rest_height


class Layout:
    """Where the engine keeps what, by the names of the model.

    Args:
        model: compiled.
        legs: how many.
    """

    def __init__(self, model: Any, legs: int) -> None:
        def slides(names: list[str]) -> list[int]:
            return [int(model.joint(name).qposadr[0]) for name in names]

        self.motors = np.array([slides([motor_joint(leg, m) for m in range(3)]) for leg in range(legs)])
        self.feet = np.array([slides(list(foot_joints(leg))) for leg in range(legs)])
        self.ground = int(model.sensor(ground_sensor(0)).adr[0])
        self.stiffness = float(model.actuator_gainprm[0, 0])


def simulated_motion(
    problem: SimulationProblem,
    driven: MotorTrajectory,
    layout: Layout,
    recorded: tuple[Floats, Floats],
    loop_error: float,
    seconds: float,
    ended_early: str,
) -> SimulatedMotion:
    """What a run did, moved and turned about the vertical so that it starts where the plan does.

    Args:
        problem: what was asked.
        driven: of the motors, as far as the run came.
        layout: of the engine's values.
        recorded: positions and sensors, a row a turn.
        loop_error: m.
        seconds: computing time.
        ended_early: why, or "".
    """
    positions, sensors = recorded
    n, model = len(positions), problem.model
    legs, motors = model.leg_count, model.motor_count
    origin, attitude = _body(problem, positions)
    ground = sensors[:, layout.ground : layout.ground + 3 * legs].reshape(n, legs, 3)
    forces = sensors[:, motors : 2 * motors].reshape(n, legs, 3)
    rotation = rotations(attitude)
    feet_robot = positions[:, layout.feet] + model.module_centres_robot + (0.0, 0.0, rest_height(model))
    feet = np.einsum("nij,nlj->nli", rotation, feet_robot) + origin[:, None]
    body = origin + model.com_height * rotation[:, :, 2]
    move = _Alignment(problem, body[0], rotation[0])
    return SimulatedMotion(
        times=TURN * np.arange(n, dtype=np.float64),
        body_world=move.points(body),
        attitude=move.attitudes(attitude),
        feet_world=move.points(feet),
        strokes=positions[:, layout.motors] + forces / layout.stiffness,
        targets=driven.targets,
        motor_forces=forces,
        ground_forces=move.vectors(ground),
        centre_world=move.points(sensors[:, -3:]),
        arrivals=driven.arrivals,
        loop_error=loop_error,
        seconds=seconds,
        ended_early=ended_early,
    )


def _body(problem: SimulationProblem, positions: Floats) -> tuple[Floats, Floats]:
    """Origin (n, 3) of the body's frame in m, and its attitude (n, 4)."""
    if problem.rig is not Rig.CLAMPED:
        return positions[:, :3], positions[:, 3:7] / np.linalg.norm(positions[:, 3:7], axis=1, keepdims=True)
    half = float(problem.plan.heading[0]) / 2
    origin = problem.plan.body_world[0] - (0.0, 0.0, problem.model.com_height)
    attitude = np.array([np.cos(half), 0.0, 0.0, np.sin(half)])
    return np.tile(origin, (len(positions), 1)), np.tile(attitude, (len(positions), 1))


class _Alignment:
    """Moves level and turns about z, so that the body's first place and heading are the plan's."""

    def __init__(self, problem: SimulationProblem, body_world: Floats, rotation: Floats) -> None:
        turn = float(problem.plan.heading[0]) - float(np.arctan2(rotation[1, 0], rotation[0, 0]))
        cosine, sine = np.cos(turn), np.sin(turn)
        self._half = turn / 2
        self._rotation = np.array([[cosine, -sine, 0.0], [sine, cosine, 0.0], [0.0, 0.0, 1.0]])
        self._pivot = body_world * (1.0, 1.0, 0.0)
        self._place = problem.plan.body_world[0] * (1.0, 1.0, 0.0)

    def points(self, points: Floats) -> Floats:
        return np.asarray(self.vectors(points - self._pivot) + self._place)

    def vectors(self, vectors: Floats) -> Floats:
        return np.asarray(vectors @ self._rotation.T)

    def attitudes(self, attitude: Floats) -> Floats:
        """The turn about z, then the attitude, as a product of quaternions."""
        w, x, y, z = attitude.T
        c, s = np.cos(self._half), np.sin(self._half)
        return np.stack([c * w - s * z, c * x - s * y, c * y + s * x, c * z + s * w], axis=-1)


def new_pool(model: mujoco.MjModel, threads: int) -> list[mujoco.MjData]:
    """The engine's working memory, one for each thread."""
    return [mujoco.MjData(model) for _ in range(threads)]
