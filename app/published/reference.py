"""The published data: simulated runs, trajectories and foot tracks, read from a folder of theirs."""

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from app.export.trajectory_files import read_text
from core.arrays import Floats
from core.errors import InputError
from core.physics.metrics import tilts
from core.robot.model import RobotModel
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


@dataclass(frozen=True, eq=False)
class PublishedRun:
    """Positions of a simulated run, and where they were wanted, at each waypoint; m.

    Args:
        body: (n, 3) the body's point, simulated.
        feet: (n, legs, 3) simulated.
        wanted_body: (n, 3).
        wanted_feet: (n, legs, 3).
        printed: what the published file of errors says, as it stands there.
    """

    body: Floats
    feet: Floats
    wanted_body: Floats
    wanted_feet: Floats
    printed: tuple[float, ...]

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
        InputError: it does not hold them.
    """

    folder: Path

    def __post_init__(self) -> None:
        missing = [name for name in _FOLDERS if not (self.folder / name).is_dir()]
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

    def run_paths(self, gait: str, step: float, version: int | None) -> list[Path]:
        """Files of a gait's simulated run, and of its plan where it was made by hand."""
        if version is None:
            return [self._optimised_path(gait, step)]
        name = f"traj{_BY_HAND[gait]}{version}_o1.csv"
        return [self.folder / "simulation_manual" / part / name for part in ("simulated", "planned")]

    def run(self, gait: str, step: float, version: int | None, model: RobotModel) -> PublishedRun | None:
        """The simulated run of a gait; None where it was not published.

        Raises:
            InputError: a file is missing or is no such table.
        """
        if version is None:
            return self.optimised_run(gait, step, model)
        return self.manual_run(gait, version, model)

    def _optimised_path(self, gait: str, step: float) -> Path:
        name = f"traj{_OPTIMISED[gait][0]}{_STEPS[step]}_o1.csv"
        return self.folder / "simulation_optimised" / "simulated" / name

    def track_paths(self, gait: str, step: float) -> tuple[Path, ...]:
        """Files of the foot tracks of an optimised gait's trials, three iterations each."""
        name = f"traj{_OPTIMISED[gait][0]}{_STEPS[step]}_t*_o1_3x.csv"
        return tuple(sorted((self.folder / "robot_trials" / "tracks_cm").glob(name)))

    def _table(self, path: Path, header: int = 0) -> Floats:
        return _numbers(path, read_text(path), header)

    def optimised_run(self, gait: str, step: float, model: RobotModel) -> PublishedRun:
        """Simulated run of an optimised gait; its body is the actuator plane, the plan's the mass centre.

        Args:
            gait: name of a gait of the library.
            step: m.
            model: for the height of the centre of mass.

        Raises:
            InputError: a file is missing or is no such table.
        """
        name = f"traj{_OPTIMISED[gait][0]}{_STEPS[step]}_o1"
        body, feet = _positions(self._table(self._optimised_path(gait, step)), 1)
        wanted = _positions(self._table(self.trajectory_path(gait, step), header=1), 0)
        printed = self._table(self.folder / "simulation_optimised" / "errors" / f"{name}_mse.csv")[0]
        return PublishedRun(body + [0.0, 0.0, model.com_height], feet, *wanted, tuple(printed / 100))

    def manual_run(self, family: str, version: int, model: RobotModel) -> PublishedRun | None:
        """Simulated run of a gait made by hand, or None where it was not published.

        Table 4.1 wants each foot at its place in the robot's frame as though the robot stood still at the
        origin, 53 mm high: the way that the robot goes counts as error.

        Args:
            family: name of the gait.
            version: 0, 1 or 2.
            model: for the modules' centres.

        Raises:
            InputError: a file is no such table.
        """
        name, root = f"traj{_BY_HAND[family]}{version}_o1", self.folder / "simulation_manual"
        if not (root / "simulated" / f"{name}.csv").exists():
            return None
        body, feet = _positions(self._table(root / "simulated" / f"{name}.csv"), 1)
        _, planned = _positions(self._table(root / "planned" / f"{name}.csv"), 1)
        still = np.array([0.0, 0.0, MANUAL_HEIGHT])
        printed = self._table(root / "errors" / f"{name}_mse.csv")[0]
        wanted_feet = planned + model.module_centres_robot + still
        return PublishedRun(body, feet, np.tile(still, (len(body), 1)), wanted_feet, tuple(printed / 1000))


def _positions(table: Floats, first: int) -> tuple[Floats, Floats]:
    """Body (n, 3) and feet (n, 4, 3) of a table whose rows are body and feet xyz from a row on."""
    rows = table[first : first + 15].T
    return rows[:, :3], rows[:, 3:].reshape(len(rows), 4, 3)


def _numbers(path: Path, text: str, header: int = 0) -> Floats:
    """Numbers of a CSV; lines that begin with # are left out."""
    table = read_table(text, str(path))
    rows = [index for index, row in enumerate(table.rows) if index >= header and not row[0].startswith("#")]
    kept = replace(table, rows=[table.rows[i] for i in rows], lines=[table.lines[i] for i in rows])
    return kept.numbers(0)
