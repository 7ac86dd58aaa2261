"""The published table of trials and its trajectories, as gaits that physics is fitted to."""

import math
import re
from collections.abc import Mapping
from pathlib import PurePath

import numpy as np

from app.learning.walks import heading_of
from app.simulation.problem import way_problem
from app.trials.figures import CM
from core.errors import InputError
from core.identification.learning import Walk
from core.motion.trajectory import Trajectory
from core.physics.masses import default_physics
from core.physics.parameters import PhysicsSet
from core.physics.problem import SimulationProblem
from core.robot.kinematics import free_strokes
from core.robot.model import RobotModel
from core.text.numbers import shortened
from core.text.tables import Table, read_table
from core.trials.displacement import Displacement, MeasuredWalk
from core.wire.trajectory_csv import parse_trajectory_csv
from core.wire.waypoint_merging import plan_of_knots
from core.wire.waypoints import Waypoints

KINDS = {"A": ("walk", "Walk"), "B": ("ambl", "Amble"), "C": ("mtri", "S-Gait"), "D": ("adjs", "C-Gait")}
"""Of a letter in the table, how its trajectories' files begin, and the gait's name."""
COLUMNS = ("dx", "dy", "dist")
ITERATIONS, TRIALS = 3, 3
"""Of the published trials (thesis 5.3.2)."""
_ROW = re.compile(r"Traj([A-D])([a-d])(_.*)?")


def walks_of_table(
    table: str, trajectories: Mapping[str, str], model: RobotModel, iterations: int = ITERATIONS
) -> tuple[Walk, ...]:
    """The gaits of a table in the form of `trajectory_averages.csv`.

    Its +x is the direction that was wanted. Row `TrajBc…` is what came of the trajectory `ambl_c.csv`.

    Args:
        table: the file's text, cm.
        trajectories: text of each trajectory, by file name.
        model: the robot.
        iterations: how often each trajectory was walked.

    Raises:
        InputError: a row or a trajectory is missing or is none.
    """
    read = read_table(table, "table")
    if "Traj" not in read.head or len(read.rows) < 2:
        raise InputError(
            "The table has no column Traj, or no row below it. Take trajectory_averages.csv.", "table"
        )
    files = {PurePath(name).stem: (name, text) for name, text in trajectories.items()}
    return tuple(_walk(read, row, files, model, iterations) for row in range(1, len(read.rows)))


def _walk(
    table: Table,
    row: int,
    files: Mapping[str, tuple[str, str]],
    model: RobotModel,
    iterations: int,
) -> Walk:
    label = _cell(table, row, "Traj").strip()
    found = _ROW.fullmatch(label)
    if found is None:
        raise InputError(f"The table's row “{shortened(label)}” is none of TrajAa to TrajDd.", "table")
    (begin, kind), size = KINDS[found[1]], found[2]
    stem = f"{begin}_{size}"
    if stem not in files:
        raise InputError(f"Row {label} needs the trajectory {stem}.csv; give that file too.", "trajectories")
    name, text = files[stem]
    motion = parse_trajectory_csv(text, name).trajectory
    problem, cut = problem_within_range(model, motion, default_physics(model))
    feet = motion.feet_world[..., :2]
    heading = heading_of(feet, name)
    wanted = iterations * float(np.hypot(*(feet[-1] - feet[0]).mean(axis=0)))
    dx, dy, distance = (_number(table, row, column) for column in COLUMNS)
    displacement = Displacement(distance / CM, math.atan2(dy, dx))
    step_cm = wanted * CM / iterations
    measured = MeasuredWalk(f"{kind}, {step_cm:.1f} cm", kind, wanted, displacement, TRIALS)
    return Walk(measured, problem, iterations, heading, cut)


def _cell(table: Table, row: int, column: str) -> str:
    """A cell; empty where the row ends before it."""
    return dict(zip(table.head, table.rows[row], strict=False)).get(column, "")


def _number(table: Table, row: int, column: str) -> float:
    if not _cell(table, row, column).strip():
        line = table.lines[row]
        raise InputError(f"Line {line} of the table has no number for {column}; write it.", f"table:{line}")
    return table.number(row, table.head.index(column))


def problem_within_range(
    model: RobotModel, motion: Trajectory, physics: PhysicsSet
) -> tuple[SimulationProblem, float]:
    """What physics is asked of a published trajectory, one waypoint a sample.

    Its feet rise beyond the motors' range; the published program kept each stroke within the range, and so is
    it done here (docs/physics.md).

    Args:
        model: the robot.
        motion: the trajectory.
        physics: the parameters.

    Returns:
        The problem, and the most that was cut off a stroke, m.
    """
    wanted = free_strokes(model, motion.feet_world, motion.pose(model))
    made = np.clip(wanted, model.stroke.lower, model.stroke.upper)
    steps = np.diff(motion.times)
    knots = Waypoints(made, np.concatenate([steps[:1], steps]))
    problem = way_problem(model, motion, plan_of_knots(model, motion, knots), physics)
    return problem, float(np.abs(made - wanted).max())
