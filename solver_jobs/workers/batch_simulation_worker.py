"""The process that simulates gaits under many sets of parameters; it alone imports MuJoCo."""

from dataclasses import dataclass, replace
from multiprocessing.connection import Connection

from core.errors import CheckError
from core.identification.learning import Walk
from core.physics.parameters import PhysicsSet
from core.trials.displacement import Displacement, motion_displacement
from solver_jobs.workers.task_worker import Report, run_tasks


@dataclass(frozen=True, eq=False)
class BatchTask:
    """What is simulated.

    Args:
        walk: a gait.
        sets: parameters, one simulation each.
    """

    walk: Walk
    sets: tuple[PhysicsSet, ...]


def run_batch_simulation_worker(pipe: Connection, warm_up: None) -> None:
    """Body of the process.

    Args:
        pipe: the worker's end.
        warm_up: nothing.
    """
    run_tasks(pipe, _displacements)


def _displacements(asked: BatchTask, report: Report) -> tuple[Displacement | None, ...]:
    return tuple(walked(asked.walk, physics, report) for physics in asked.sets)


def walked(walk: Walk, physics: PhysicsSet, report: Report = lambda share: True) -> Displacement | None:
    """How far a simulated robot goes; None where it falls, or its simulation cannot be trusted.

    One lap is simulated, at the time step of variations; each further one begins where the one before ended.

    Args:
        walk: the gait.
        physics: the parameters.
        report: told the share of the simulation that is done; false cancels.

    Raises:
        SimulationCancelledError: `report` said so.
    """
    from solver_jobs.physics.simulate import simulate
    from solver_jobs.physics.stepping import VARIED_STEP

    try:
        motion = simulate(replace(walk.problem, physics=physics), report, time_step=VARIED_STEP)
    except CheckError:
        return None
    if motion.ended_early:
        return None
    feet = motion.feet_world[..., :2]
    return motion_displacement(motion.times, feet, walk.laps, walk.heading, walk.measured.wanted)
