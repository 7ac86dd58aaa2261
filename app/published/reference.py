"""The published data: simulated runs, trajectories and foot tracks, read from a folder of theirs."""

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from app.export.trajectory_files import read_bytes
from core.arrays import FARTHEST, Floats
from core.errors import InputError
from core.physics.metrics import tilts
from core.robot.model import RobotModel
from core.text.decoding import text_of, without_mark
from core.text.numbers import shortened
from core.text.tables import read_table

MANUAL_HEIGHT = 0.053
"""Height at which Table 4.1 takes the body to stay, actuator plane over the standing feet, m."""
MANUAL_FEET = 3
"""Table 4.1 is the mean over so many feet, the first ones."""

_OPTIMISED = {"walk": ("A", "walk"), "amble": ("B", "ambl"), "s-gait": ("C", "mtri"), "c-gait": ("D", "adjs")}
"""Letter of a gait's simulated files, and the beginning of its trajectories' names."""
_BY_HAND = {"walk": "A", "amble": "B", "s-gait": "C"}
_FOLDERS = ("simulation_manual", "simulation_optimised", "trajectories")
_THREE = "e"
"""Name of the size of a trajectory of three iterations."""
_STEPS = {0.010: "a", 0.015: "b", 0.020: "c", 0.025: "d"}
_POSITIONS = 15
"""Rows of body and four feet, xyz."""
_RUN_ROWS, _TRAJECTORY_ROWS = (1 + _POSITIONS,), (_POSITIONS, 2 * _POSITIONS)
"""Rows that a file may have: the time and positions, or positions with or without velocities."""


@dataclass(frozen=True, eq=False)
class PublishedRun:
    """Positions of a simulated run, and where they were wanted, at each waypoint; m.

    Args:
        body: (n, 3) the body's point, simulated.
        feet: (n, legs, 3) simulated.
        wanted_body: (n, 3).
        wanted_feet: (n, legs, 3).
    """

    body: Floats
    feet: Floats
    wanted_body: Floats
    wanted_feet: Floats

    @property
    def body_error(self) -> float:
        """Mean distance of the body, m."""
        return float(np.linalg.norm(self.body - self.wanted_body, axis=-1).mean())

    @property
    def feet_error(self) -> Floats:
        """(legs,) mean distance of each foot, m."""
        return np.asarray(np.linalg.norm(self.feet - self.wanted_feet, axis=-1).mean(axis=0))

    @property
    def tilts(self) -> Floats:
        """(n,) lean of the body, rad: of the turn that lays the wanted feet over the simulated ones best.

        No attitude was published; as long as the motors follow, the feet turn with the body. Kabsch 1976.
        """
        wanted, found = (feet - feet.mean(axis=1, keepdims=True) for feet in (self.wanted_feet, self.feet))
        left, _, right = np.linalg.svd(np.einsum("nli,nlj->nij", wanted, found))
        proper = np.tile(np.eye(3), (len(left), 1, 1))
        proper[:, 2, 2] = np.sign(np.linalg.det(left @ right))
        rotation = np.einsum("nij,njk,nkl->nli", left, proper, right)
        return tilts(rotation)


@dataclass(frozen=True)
class Reference:
    """The folder with the published data, which does not come with the program.

    Args:
        folder: holds `simulation_manual`, `simulation_optimised` and `trajectories`.

    Raises:
        InputError: it cannot be read, or does not hold them.
    """

    folder: Path

    def __post_init__(self) -> None:
        try:
            missing = [name for name in _FOLDERS if not (self.folder / name).is_dir()]
        except (OSError, ValueError) as error:
            raise _unreadable(self.folder, error) from error
        if missing:
            raise InputError(
                f"{self.folder} holds no {missing[0]}; name the published data's folder, which holds "
                f"{', '.join(_FOLDERS)}.",
                "reference",
            )

    def trajectory_path(self, gait: str, step: float, iterations: int = 1) -> Path:
        """File of an optimised trajectory, direction 1; three iterations in one are 6 cm long."""
        size = _THREE if iterations > 1 else _STEPS[step]
        return self.folder / "trajectories" / "direction1" / f"{_OPTIMISED[gait][1]}_{size}.csv"

    def run_paths(self, gait: str, step: float, version: int | None) -> tuple[Path, Path]:
        """Files of a gait's simulated run, and of its plan."""
        if version is None:
            name = f"traj{_OPTIMISED[gait][0]}{_STEPS[step]}_o1.csv"
            simulated = self.folder / "simulation_optimised" / "simulated" / name
            return simulated, self.trajectory_path(gait, step)
        name, root = f"traj{_BY_HAND[gait]}{version}_o1.csv", self.folder / "simulation_manual"
        return root / "simulated" / name, root / "planned" / name

    def track_paths(self, gait: str, step: float) -> tuple[Path, ...]:
        """Files of the foot tracks of an optimised gait's trials, three iterations each."""
        name = f"traj{_OPTIMISED[gait][0]}{_STEPS[step]}_t[0-9]_o1_3x.csv"
        return tuple(sorted((self.folder / "robot_trials" / "tracks_cm").glob(name)))

    def run(self, gait: str, step: float, version: int | None, model: RobotModel) -> PublishedRun:
        """The simulated run of a gait.

        Table 4.2 wants body and feet at the plan's. The body of the run is the actuator plane, the plan's the
        mass centre. Table 4.1 wants each foot at its place in the robot's frame as though the robot stood
        still at the origin, 53 mm high: the distance that the robot goes counts as error.

        Args:
            gait: name of a gait of the library, or of a family made by hand.
            step: of an optimised gait, m.
            version: of a gait made by hand; None for an optimised one.
            model: for the height of the centre of mass, and the modules' centres.

        Raises:
            InputError: a file is missing or is no such table.
        """
        path, planned_path = self.run_paths(gait, step, version)
        body, feet = _positions(path, _RUN_ROWS)
        if version is None:
            wanted_body, wanted_feet = _positions(planned_path, _TRAJECTORY_ROWS, header=1)
            body = body + [0.0, 0.0, model.com_height]
        else:
            still = np.array([0.0, 0.0, MANUAL_HEIGHT])
            planned_body, planned = _positions(planned_path, _RUN_ROWS)
            wanted_body = np.tile(still, (len(planned_body), 1))
            wanted_feet = planned + model.module_centres_robot + still
        if len(body) != len(wanted_body):
            raise InputError(
                f"{path} has {len(body)} columns, and its plan {planned_path.name} has {len(wanted_body)}; "
                "they must be of one run. Take both files from the published data.",
                str(path),
            )
        return PublishedRun(body, feet, wanted_body, wanted_feet)


def open_reference(folder: str | Path) -> Reference:
    """The published data in a folder that a person names (see `find_folder`).

    Raises:
        InputError: the folder is not there, cannot be read, or lacks the data.
    """
    return Reference(find_folder(folder))


def find_folder(folder: str | Path) -> Path:
    """The whole path of a folder that a person names; `~` is the home folder.

    Raises:
        InputError: the folder is not there, or cannot be read.
    """
    try:
        path = Path(folder).expanduser().absolute()
        str(path).encode()
        is_there = path.is_dir()
    except (OSError, RuntimeError, ValueError) as error:
        raise _unreadable(folder, error) from error
    if not is_there:
        raise InputError(f"There is no folder {path}. Correct its name.", "reference")
    return path


def is_missing(path: Path) -> bool:
    """True if nothing stands at a path; false of a file that cannot be read."""
    try:
        path.lstat()
    except (FileNotFoundError, NotADirectoryError):
        return True
    except OSError:
        return False
    return False


def read_published(path: Path) -> str:
    """The text of a published file.

    Raises:
        InputError: it is missing, no plain file, not readable, too large or no text in UTF-8.
    """
    return without_mark(text_of(read_bytes(path), str(path)))


def _unreadable(folder: str | Path, error: Exception) -> InputError:
    reason = "its name is no text in UTF-8" if isinstance(error, UnicodeError) else str(error)
    name = shortened(str(folder).encode("utf-8", "backslashreplace").decode())
    if isinstance(error, OSError):
        reason = error.strerror or reason
    return InputError(
        f"The folder {name} cannot be read: {reason.rstrip('.')}. Correct its name or its rights.",
        "reference",
    )


def _positions(path: Path, counts: tuple[int, ...], header: int = 0) -> tuple[Floats, Floats]:
    """Body (n, 3) and feet (n, 4, 3) of a file, m.

    Args:
        path: of the file; lines that begin with # are left out.
        counts: how many rows it may have; positions are 15 of them, the last where there is an odd one more.
        header: lines before the numbers.

    Raises:
        InputError: it is missing, or is no such table.
    """
    table = read_table(read_published(path), str(path))
    rows = [index for index, row in enumerate(table.rows) if index >= header and not row[0].startswith("#")]
    kept = replace(table, rows=[table.rows[i] for i in rows], lines=[table.lines[i] for i in rows])
    numbers = kept.numbers(0)
    count, width = numbers.shape
    if count not in counts or width < 2:
        raise InputError(
            f"{path} has {count} rows and {width} columns of numbers; "
            f"{' or '.join(map(str, counts))} rows with a column a waypoint are expected. Take the file from "
            "the published data.",
            str(path),
        )
    if np.abs(numbers).max() > FARTHEST:
        raise InputError(f"{path} has a number beyond {FARTHEST:g}, which is no position in m.", str(path))
    positions = numbers[len(numbers) % _POSITIONS :][:_POSITIONS].T
    return positions[:, :3], positions[:, 3:].reshape(len(positions), 4, 3)
