"""Plans for scripts: the motion of a gait, what would be sent of it, and how they were found."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from app.export.formats import ExportFormat, export
from app.export.gait_diagram import gait_diagram
from app.export.source import exportable_plan
from app.export.svg import svg
from app.export.trajectory_files import write_trajectory, write_with_companion
from app.plans.plan import Plan as Made
from app.plans.plan import PlanSource
from app.scripting.gaits import Gait
from app.scripting.html import Cell, paragraph, table
from app.scripting.plots import motion_figure
from app.scripting.robots import Robot
from app.store.named_file import file_path, write_named
from core.arrays import Bools, Floats
from core.errors import CheckError, InfeasibleError, InputError
from core.motion.trajectory import Trajectory
from core.wire.robot_time import estimate_seconds, stop_time
from core.wire.waypoint_companion import WaypointCompanion, format_waypoint_companion
from core.wire.waypoint_merging import WaypointPlan
from core.wire.waypoints import format_waypoint_csv
from solver_jobs import SolveStatus

if TYPE_CHECKING:
    from matplotlib.figure import Figure  # type: ignore[import-not-found, unused-ignore]

_FORMS = {
    ".json": ExportFormat.JSON,
    ".npz": ExportFormat.NPZ,
    ".html": ExportFormat.HTML,
    ".svg": ExportFormat.SVG,
    ".png": ExportFormat.PNG,
}


@dataclass(frozen=True, eq=False, repr=False)
class Plan:
    """A motion, and what would be sent of it. `footfall.optimise`, `fastest` and `plan` give one.

    Args:
        status: `solved`, `infeasible` or `failed`; `given` of a table, a recording or waypoints.
        robot: whose motion it is.
        gait: the document; None of waypoints.
        explanation: sentences on why there is no motion, or why the robot makes another one; else empty.
        figures: what the command of that name prints with `--json`, in SI.
        trajectory: the motion in full; None where there is none.
        way: what would be sent; None where there is no motion, or the motors cannot make it.
        clipped: (n, legs, 3) how far each stroke was beyond the motors' range and was clipped, m; None where
            strokes are left as they are.

    Raises:
        InfeasibleError: its arrays, where the robot cannot do what is asked.
        CheckError: its arrays, where no motion was confirmed.

    Example:
        >>> import footfall as ff
        >>> plan = ff.plan("walk-manual-0")
        >>> plan.status, plan.body.shape, plan.feet.shape
        ('given', (55, 3), (55, 4, 3))
    """

    status: str
    robot: Robot
    gait: Gait | None = None
    explanation: tuple[str, ...] = ()
    figures: dict[str, Any] = field(default_factory=dict)
    trajectory: Trajectory | None = None
    way: WaypointPlan | None = None
    clipped: Floats | None = None

    def need_motion(self) -> Trajectory:
        """The motion.

        Raises:
            InfeasibleError: the robot cannot do what is asked.
            CheckError: no motion was confirmed.
        """
        if self.trajectory is None:
            sentence = " ".join(self.explanation) or "The solver gave no motion that the checker confirms."
            kind = InfeasibleError if self.status == SolveStatus.INFEASIBLE else CheckError
            raise kind(f"This plan has no motion: {sentence}", "plan")
        return self.trajectory

    def need_way(self) -> WaypointPlan:
        """What would be sent (see `need_motion`)."""
        self.need_motion()
        if self.way is None:
            why = " ".join(self.explanation) or "A foot is out of reach."
            raise CheckError(
                f'This plan has no waypoints. {why} footfall.plan(…, within_stroke="clip") keeps its strokes '
                "within the motors' range.",
                "plan",
            )
        return self.way

    @property
    def times(self) -> Floats:
        """(n,) time of each sample of the motion, s."""
        return self.need_motion().times

    @property
    def body(self) -> Floats:
        """(n, 3) centre of mass in the world, m."""
        return self.need_motion().body_world

    @property
    def heading(self) -> Floats:
        """(n,) turn of the body about z, rad."""
        return self.need_motion().heading

    @property
    def feet(self) -> Floats:
        """(n, legs, 3) feet in the world, m."""
        return self.need_motion().feet_world

    @property
    def contact(self) -> Bools:
        """(n, legs) which feet stand."""
        return self.need_motion().contact

    @property
    def waypoints(self) -> Floats:
        """(lines, legs, 3) strokes that would be sent, merged and cut, m."""
        return self.need_way().waypoints.strokes

    @property
    def robot_seconds(self) -> float:
        """How long the robot takes for the waypoints, s."""
        return estimate_seconds(self.need_way().waypoints)

    @property
    def stop_seconds(self) -> float:
        """Longest time until Stop takes effect, s."""
        return stop_time(self.need_way().waypoints)

    @property
    def speed(self) -> float:
        """Way of the body from first to last, a robot second, m/s."""
        return float(np.linalg.norm(self.body[-1, :2] - self.body[0, :2])) / self.robot_seconds

    def save(self, path: str | Path) -> Path:
        """Writes the motion, the waypoints, the gait or a picture.

        Args:
            path: `X.csv` for the trajectory in SI, `X.waypoints.csv` for the waypoints in mm, both with
                their companions, `.npz` for arrays, `.html` for a page that plays it, `.json` for the gait,
                `.svg` or `.png` for a picture.

        Returns:
            The path.

        Raises:
            InputError: the suffix is another one, or there is nothing of that kind.
            InfeasibleError, CheckError: there is no motion.

        Example:
            >>> import footfall as ff, tempfile
            >>> ff.plan("walk-manual-0").save(f"{tempfile.mkdtemp()}/walk.waypoints.csv").name
            'walk.waypoints.csv'
        """
        file = file_path(path)
        if file.name.endswith(".waypoints.csv"):
            self._save_waypoints(file)
        elif file.suffix == ".csv":
            write_trajectory(file, self.need_motion(), self.robot.name)
        elif file.suffix in _FORMS and self.gait is not None:
            made = Made(PlanSource.OPTIMISED, "", self.robot.model, self.need_motion(), self.need_way(), None)
            source = exportable_plan(file.stem, self.gait.document, made)
            write_named(file, export(source, _FORMS[file.suffix]).content)
        else:
            known = ", ".join((".csv", ".waypoints.csv", *_FORMS))
            raise InputError(f"{file.name}: a plan is written as {known}.", "path")
        return file

    def _save_waypoints(self, file: Path) -> None:
        way = self.need_way()
        text = format_waypoint_csv(way.waypoints)
        origin = {} if self.gait is None else {"gait": self.gait.name}
        companion = WaypointCompanion(self.robot.name, way.stop_bound, origin, None)
        write_with_companion(file, text, format_waypoint_companion(companion, text))

    def plot(self) -> Figure:
        """Draws foot heights, stability margin and strokes over time, by matplotlib.

        Returns:
            A matplotlib figure; heights, margins and strokes in mm over seconds of the plan.

        Raises:
            InputError: matplotlib is not installed; the sentence says how to install it.
            InfeasibleError, CheckError: there is no motion.

        Example:
            >>> import footfall as ff
            >>> figure = ff.plan("walk-manual-0").plot()  # doctest: +SKIP
        """
        return motion_figure(self.need_motion(), self.robot.model)

    def __repr__(self) -> str:
        what = "waypoints" if self.gait is None else f"“{self.gait.name}”"
        if self.trajectory is None:
            return f"Plan of {what}: {self.status}. {' '.join(self.explanation)}".rstrip()
        way = "" if self.way is None else f", {self.robot_seconds:.1f} s on the robot"
        return f"Plan of {what}: {self.status}, {self.times[-1]:.1f} s{way}"

    def _repr_html_(self) -> str:
        picture = "" if self.gait is None else svg(gait_diagram(self.gait.document, self.robot.model))
        if self.trajectory is None:
            return picture + paragraph([f"{self.status.capitalize()}.", *self.explanation])
        dx, dy = (self.body[-1, :2] - self.body[0, :2]) * 1000
        rows: list[list[Cell]] = [
            ["status", self.status],
            ["travel x, y, mm", f"{dx:.1f}, {dy:.1f}"],
            ["plan, s", float(self.times[-1])],
        ]
        if self.way is not None:
            rows += [
                ["on the robot, s", self.robot_seconds],
                ["speed, mm/s", self.speed * 1000],
                ["waypoints", self.way.waypoints.count],
                ["Stop takes effect within, s", self.stop_seconds],
            ]
        return picture + table(["", ""], rows)
