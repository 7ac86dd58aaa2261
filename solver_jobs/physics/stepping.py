"""Simulated runs, stepped by MuJoCo's own loop, several at a time on threads of its own."""

from collections.abc import Sequence

import mujoco
import numpy as np
from mujoco import rollout
from numpy.typing import NDArray

from core.arrays import Floats
from core.errors import CheckError, InfeasibleError
from core.physics.backlash import with_backlash
from core.physics.metrics import FALL_TILT, rotations, tilts
from core.physics.motors import motor_speeds
from core.physics.problem import Rig, SimulationProblem
from core.physics.ramp import TURN, MotorTrajectory, motor_trajectory
from core.robot.kinematics import BodyPose, feet_in_robot
from solver_jobs.physics.mjcf import LINK_RELAXATION, mjcf_text, rest_height
from solver_jobs.physics.states import Layout

TIME_STEP = 0.0005
"""Of the integration, s; halving it moves no foot by 0.5 mm, even of robots that rock (docs/physics.md)."""
VARIED_STEP = 0.001
"""Of variations, s: twice as fast; feet of a robot that rocks are up to 1 mm off those of half the step."""
SETTLING = 50
"""Rows that the robot stands before its time begins: 0.5 s, so that links and soles carry its weight."""
CHUNK = 50
"""Rows between looks at progress, falls and chains."""
LOOP_TOLERANCE = 1e-4
"""Largest violation of an arm's length, m."""

_STATE = mujoco.mjtState.mjSTATE_FULLPHYSICS


class SimulatedRun:
    """One problem's model, its state and what was recorded, a row a turn of the firmware's loop.

    Args:
        problem: what is asked.
        time_step: of the integration, s; divides `TURN`.

    Raises:
        InfeasibleError: a leg cannot be assembled at the first waypoint.
        InputError: the robot has no such masses, or a motor no speed.
    """

    def __init__(self, problem: SimulationProblem, time_step: float) -> None:
        self.problem = problem
        self.driven = motor_trajectory(problem.waypoints, motor_speeds(problem.model, problem.physics))
        pose, feet_robot = _start(problem)
        text = mjcf_text(problem.model, problem.physics, problem.rig, pose, time_step)
        self.model = mujoco.MjModel.from_xml_string(text)
        if problem.rig is Rig.WALKING:
            self.model.dof_frictionloss[:2] = problem.physics.cable_drag
        self.layout = Layout(self.model, problem.model.leg_count)
        self.loop_error = 0.0
        self.ended_early = ""
        self._steps = round(TURN / time_step)
        still = np.repeat(self.driven.strokes[:1], SETTLING + 1, 0)
        rows = np.concatenate([still, self.driven.strokes[1:]]).reshape(-1, problem.model.motor_count)
        self._strokes = with_backlash(rows, problem.physics.backlash)
        self._row = 0
        self._state = self._first_state(pose, feet_robot)
        self._positions: list[Floats] = []
        self._sensors: list[Floats] = []

    @property
    def rows(self) -> int:
        """Rows in all, the settling included."""
        return len(self._strokes) - 1

    @property
    def rows_done(self) -> int:
        """Rows that are computed or need not be."""
        return self.rows if self.ended_early else self._row

    @property
    def recorded(self) -> tuple[Floats, Floats]:
        """Positions (n, nq) and sensors (n, …) from the moment at which the robot's time begins.

        Of a robot that fell before it came to rest, all.
        """
        first = SETTLING - 1 if self._row >= SETTLING else 0
        return np.concatenate(self._positions)[first:], np.concatenate(self._sensors)[first:]

    @property
    def trajectory_done(self) -> MotorTrajectory:
        """The motors' course as far as it came."""
        rows = len(self.recorded[0])
        if self._row < SETTLING:
            still = np.repeat(self.driven.targets[:1], rows, 0)
            return MotorTrajectory(still, still, np.zeros(1, dtype=np.int64))
        arrivals = self.driven.arrivals[self.driven.arrivals < rows]
        return MotorTrajectory(self.driven.targets[:rows], self.driven.strokes[:rows], arrivals)

    def state(self) -> Floats:
        """The engine's state from which the next chunk starts."""
        return self._state

    def controls(self) -> Floats:
        """(CHUNK · steps, motors) where the motors are at each step of the next chunk, m.

        Damping is against the motor's own speed, whose share leads the position by `LINK_RELAXATION`.
        """
        rows = np.minimum(np.arange(self._row, self._row + CHUNK + 1), self.rows)
        start, end = self._strokes[rows[:-1]], self._strokes[rows[1:]]
        shares = (np.arange(1, self._steps + 1) / self._steps + LINK_RELAXATION / TURN)[None, :, None]
        moving = start[:, None] + shares * (end - start)[:, None]
        return np.asarray(moving.reshape(-1, start.shape[1]))

    def take(self, states: Floats, sensors: Floats) -> None:
        """Records a chunk and looks for the end.

        Raises:
            CheckError: a chain opened, or the engine diverged.
        """
        count = min(CHUNK, self.rows - self._row)
        positions = states[self._steps - 1 :: self._steps, 1 : 1 + self.model.nq][:count]
        self._require_finite(positions)
        fallen = self._fallen(positions)
        if fallen is not None:
            count = fallen + 1
            seconds = (self._row + count - SETTLING) * TURN
            when = f"at {seconds:.2f} s" if seconds >= 0 else "before its first move"
            self.ended_early = f"It fell over {when}."
        self._look_at_chains(sensors[: count * self._steps])
        self._positions.append(positions[:count])
        self._sensors.append(sensors[self._steps - 1 :: self._steps][:count])
        self._row += count
        self._state = states[-1]

    def _first_state(self, pose: BodyPose, feet_robot: Floats) -> Floats:
        data = mujoco.MjData(self.model)
        model, layout = self.problem.model, self.layout
        if self.problem.rig is not Rig.CLAMPED:
            half = float(pose.heading) / 2
            data.qpos[:3] = pose.position_world
            data.qpos[3:7] = np.cos(half), 0.0, 0.0, np.sin(half)
        data.qpos[layout.motors] = self.problem.waypoints.strokes[0]
        rest = model.module_centres_robot + (0.0, 0.0, rest_height(model))
        data.qpos[layout.feet] = feet_robot - rest
        state = np.empty(mujoco.mj_stateSize(self.model, _STATE))
        mujoco.mj_getState(self.model, data, state, _STATE)
        return state

    def _fallen(self, positions: Floats) -> int | None:
        """The first row of a chunk at which a walking robot has fallen over."""
        if self.problem.rig is not Rig.WALKING:
            return None
        down = tilts(rotations(positions[:, 3:7])) > FALL_TILT
        return int(down.argmax()) if down.any() else None

    def _require_finite(self, positions: Floats) -> None:
        if not np.isfinite(positions).all():
            raise CheckError(
                f"The simulation diverged after {self._seconds():.1f} s. Take physics "
                "with a softer link or a heavier foot.",
                "physics",
            )

    def _look_at_chains(self, sensors: Floats) -> None:
        lengths = sensors[:, : self.problem.model.motor_count]
        error = float(np.abs(lengths - self.problem.model.leg.link_length).max())
        self.loop_error = max(self.loop_error, error)
        if not error <= LOOP_TOLERANCE:
            raise CheckError(
                f"A leg's chain opened by {error * 1000:.2f} mm after {self._seconds():.1f} s of simulation; "
                f"{LOOP_TOLERANCE * 1000:g} mm is the limit. The result cannot be trusted.",
                "physics",
            )

    def _seconds(self) -> float:
        """The robot's time at the last recorded row, s."""
        return max(self._row - SETTLING, 0) * TURN


def advance(runs: Sequence[SimulatedRun], pool: Sequence[mujoco.MjData]) -> None:
    """Computes the next chunk of every run, on a thread for each of the pool's data.

    Raises:
        CheckError: a chain opened, or the engine diverged.
    """
    states, sensors = rollout.rollout(
        [run.model for run in runs],
        list(pool[: len(runs)]),
        np.stack([run.state() for run in runs]),
        np.stack([run.controls() for run in runs]),
    )
    for run, run_states, run_sensors in zip(runs, states, sensors, strict=True):
        run.take(run_states, run_sensors)


def _start(problem: SimulationProblem) -> tuple[BodyPose, Floats]:
    """The body where the plan begins, its deepest foot on the ground, and (legs, 3) feet in its frame, m."""
    feet_robot = feet_in_robot(problem.model, problem.waypoints.strokes[:1])[0]
    apart: NDArray[np.int64] = np.flatnonzero(~np.isfinite(feet_robot).all(axis=-1))
    if apart.size:
        raise InfeasibleError(
            f"Foot {apart[0] + 1}: its three rods do not meet at the first waypoint's strokes. Change them.",
            "waypoint 1",
        )
    x, y, _ = problem.plan.body_world[0]
    position = np.array([x, y, -feet_robot[:, 2].min()])
    return BodyPose(position, np.asarray(problem.plan.heading[0])), feet_robot
