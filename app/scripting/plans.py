"""Plans for scripts: the motion of a gait, what would be sent of it, and how they were found."""

from __future__ import annotations

from argparse import Namespace
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from app.cli.commands_fastest import fastest_document, fastest_walk, walk_content
from app.cli.commands_files import planned_gait
from app.cli.commands_frontier import frontier_content, frontier_search
from app.cli.commands_gait import optimise as solve
from app.cli.gait_options import Method, gait_with_options, named_gait
from app.documents.trajectory_json import trajectory_content
from app.export.formats import ExportFormat, export
from app.export.gait_diagram import gait_diagram
from app.export.source import exportable_plan
from app.export.svg import svg
from app.export.trajectory_files import companion_path, write_trajectory
from app.export.way_files import is_way_file, read_way_file
from app.gaits.live_plans import is_drawing
from app.plans.plan import Plan as Made
from app.plans.plan import PlanSource, make_plan
from app.scripting.arrays import array_of
from app.scripting.gaits import Gait, gait
from app.scripting.html import Cell, paragraph, table
from app.scripting.options import command_options
from app.scripting.plots import motion_figure
from app.scripting.robots import Robot
from app.store.plain_file import write_atomically
from core.arrays import Bools, Floats
from core.errors import CheckError, InfeasibleError, InputError
from core.gait.gait import Gait as Document
from core.motion.trajectory import Trajectory
from core.pose_gaits.gait_poses import pose_problem, with_poses
from core.recorded.waypoint_motion import motion_of_waypoints
from core.robot.model import load_robot
from core.wire.robot_time import estimate_seconds, move_estimates, stop_time
from core.wire.waypoint_companion import WaypointCompanion, format_waypoint_companion
from core.wire.waypoint_merging import WaypointPlan, plan_of_knots
from core.wire.waypoints import Waypoints, format_waypoint_csv
from solver_jobs import SolveStatus, solve_live

if TYPE_CHECKING:
    from matplotlib.figure import Figure  # type: ignore[import-not-found, unused-ignore]

LEAST_SECONDS = 0.1
"""Planned time of a row of strokes that is no move for the robot, s."""

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
        explanation: sentences on why there is no motion; empty where there is one.
        figures: what the command of that name prints with `--json`, in SI.
        trajectory: the motion in full; None where there is none.
        way: what would be sent; None where there is no motion.

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
            raise CheckError("This plan has no waypoints: a foot is out of reach.", "plan")
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
        file = Path(path)
        if file.name.endswith(".waypoints.csv"):
            self._save_waypoints(file)
        elif file.suffix == ".csv":
            write_trajectory(file, self.need_motion(), self.robot.name)
        elif file.suffix in _FORMS and self.gait is not None:
            made = Made(PlanSource.OPTIMISED, "", self.robot.model, self.need_motion(), self.need_way(), None)
            source = exportable_plan(file.stem, self.gait.document, made)
            write_atomically(file, export(source, _FORMS[file.suffix]).content)
        else:
            known = ", ".join((".csv", ".waypoints.csv", *_FORMS))
            raise InputError(f"{file.name}: a plan is written as {known}.", "path")
        return file

    def _save_waypoints(self, file: Path) -> None:
        way = self.need_way()
        text = format_waypoint_csv(way.waypoints)
        origin = {} if self.gait is None else {"gait": self.gait.name}
        companion = WaypointCompanion(self.robot.name, way.stop_bound, origin, None)
        write_atomically(file, text)
        write_atomically(companion_path(file), format_waypoint_companion(companion, text))

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


def optimise(source: str | Path | Gait, **options: Any) -> Plan:
    """The optimised motion of a gait, believed only through the independent checker.

    Args:
        source: `walk`, `amble`, `s-gait`, `c-gait` or `rotate`, a gait file, or a gait.
        options: those of `footfall optimise`, in SI: step (m an iteration), goal, yaw (rad), margin (m),
            clearance (m), iterations, method (`nlp` or `live`) and others.

    Returns:
        The plan; `status` is `solved`, `infeasible` or `failed`, and `explanation` says why.

    Raises:
        InputError: there is no such gait or option, or a value does not fit.

    Example:
        >>> import footfall as ff
        >>> plan = ff.optimise("walk", step=0.010, margin=0.006, method="live")
        >>> plan.status, plan.waypoints.shape[1:]
        ('solved', (4, 3))
    """
    document, asked = drawn_document("optimise", source, ("remedy",), options)
    return _optimised(Gait(document), asked.method, asked.gait)


def drawn_document(
    command: str, source: str | Path | Gait, without: tuple[str, ...], options: dict[str, Any]
) -> tuple[Document, Namespace]:
    """A gait that a solver can be asked for, with what is changed of it, and the options of its command.

    Raises:
        InputError: it is made by hand, for the robot's clock, or a sequence.
    """
    name = source.name if isinstance(source, Gait) else str(source)
    asked = command_options(command, [name], without, **options)
    document = source.document if isinstance(source, Gait) else named_gait(name)
    if not is_drawing(replace(document, recorded=None)) or document.sequence:
        raise InputError(
            f"“{document.name}” is made by hand, for the robot's clock, or a sequence; there is nothing to "
            "optimise. footfall.plan(…) gives its plan.",
            "source",
        )
    return gait_with_options(replace(document, recorded=None), asked), asked


def _optimised(of: Gait, method: Method, name: str) -> Plan:
    verified = solve(of.document, method)
    figures = {
        "gait": name,
        "method": method.value,
        "knots": of.document.timeline.sample_count,
        "knot_time": of.sample_time,
        "robot": of.robot,
        **verified.content,
    }
    if verified.status is not SolveStatus.SOLVED:
        robot = Robot(load_robot(of.robot))
        return Plan(verified.status.value, robot, of, tuple(verified.explanation), figures)
    result = {**verified.content, "trajectory": trajectory_content(verified.trajectory)}
    return _of_made(of, make_plan(of.document, result, solve_live), verified.status.value, figures)


def _of_made(of: Gait, made: Made, status: str, figures: dict[str, Any]) -> Plan:
    robot = Robot(made.model)
    if made.trajectory is None or made.is_draft:
        why = made.note if made.refusal is None else made.refusal.sentence
        return Plan(_failure(made).value, robot, of, (why,), figures)
    return Plan(status, robot, of, (), figures, made.trajectory, made.way)


def _failure(made: Made) -> SolveStatus:
    """Whether a plan without a motion is proven to have none, or nothing was found."""
    if isinstance(made.refusal, InputError):
        raise made.refusal
    if made.live is not None:
        return made.live.status
    return SolveStatus.FAILED if isinstance(made.refusal, CheckError) else SolveStatus.INFEASIBLE


def fastest(source: str | Path | Gait | None = None, **options: Any) -> Plan:
    """The walk with the most millimetres a robot second under the firmware's law of time.

    Args:
        source: a gait as for `footfall.optimise`, for foot order and direction; None for the walk, or for
            the one whose order is given.
        options: those of `footfall fastest`, in SI: order, step (m a cycle or `free`), cycles, margin (m),
            stop_bound (s), turn (rad a cycle, `left` or `right`), search and others.

    Returns:
        The plan from the standard stance to rest; its `figures` describe the cycle in mid-walk.

    Raises:
        InputError: there is no such gait or option, or a value does not fit.

    Example:
        >>> import footfall as ff
        >>> plan = ff.fastest("c-gait", step=0.010)
        >>> plan.status, plan.figures["speed"] > 0.0005
        ('solved', True)
    """
    of = source if isinstance(source, Gait) else None
    words = [] if source is None else [of.name if of is not None else str(source)]
    asked = command_options("fastest", words, ("front",), **options)
    name, document = fastest_document(asked, None if of is None else of.document)
    document, walk, _ = fastest_walk(asked, name, document)
    model = load_robot(document.robot)
    figures = walk_content(walk, pose_problem(document, model), None)
    found = walk.walk.gait
    if found is None or walk.status is not SolveStatus.SOLVED:
        return Plan(walk.status.value, Robot(model), Gait(document), tuple(walk.explanation), figures)
    document = with_poses(document, found)
    return _of_made(Gait(document), make_plan(document, None, solve_live), walk.status.value, figures)


def frontier(source: str | Path | Gait, **options: Any) -> dict[str, Any]:
    """The largest step of a gait that has a motion, and what limits it.

    Args:
        source: a gait as for `footfall.optimise`.
        options: those of `footfall frontier`, in SI; step and goal say only which way.

    Returns:
        What `footfall frontier --json` prints: `max_step` in m an iteration (`max_yaw` in rad for a turn),
        `limited_by`, and the height and phases at which it was found.

    Raises:
        InputError: there is no such gait or option, or a value does not fit.

    Example:
        >>> import footfall as ff
        >>> ff.frontier("walk", method="live")["max_step"] > 0.01
        True
    """
    document, asked = drawn_document("frontier", source, (), options)
    return frontier_content(asked.gait, frontier_search(document, asked).run())


def plan(
    source: str | Path | Gait | Plan | ArrayLike, *, method: str = "nlp", robot: str | None = None
) -> Plan:
    """The plan of anything: a gait, a table, a sequence, a recorded motion, a file, or strokes of your own.

    Args:
        source: a gait as for `footfall.gait`, a waypoint file, a plan, or an array (lines, legs, 3) of
            strokes in m.
        method: what makes the motion of a drawn gait: `nlp` or `live`.
        robot: of waypoints without a companion, and of an array (the DeltaWalker where None).

    Returns:
        The plan; `status` is `given` where nothing had to be solved.

    Raises:
        InputError: there is no such gait, a file cannot be read, or an array has another shape.

    Example:
        >>> import footfall as ff
        >>> import numpy as np
        >>> strokes = np.full((5, 4, 3), 0.0055)
        >>> ff.plan(strokes).waypoints.shape
        (5, 4, 3)
    """
    if isinstance(source, Plan):
        if robot is not None or method != Method.NLP:
            raise InputError("A plan is made already; robot and method are for gaits.", "source")
        return source
    if not isinstance(source, str | Path | Gait):
        return _of_strokes(array_of(source, _shape(robot), "strokes", "m"), robot)
    if not isinstance(source, Gait) and Path(source).suffix == ".csv" and is_way_file(Path(source)):
        read = read_way_file(Path(source), robot)
        return _of_waypoints(Robot(read.model), read.waypoints, read.motion)
    of = gait(source)
    if robot is not None:
        of = of.changed(robot=robot)
    chosen = Method(command_options("optimise", [of.name], method=method).method)
    if is_drawing(of.document) and not of.document.sequence:
        return _optimised(of, chosen, of.id or of.name)
    made = planned_gait(of.document, chosen)
    given = (PlanSource.MANUAL, PlanSource.RECORDED)
    return _of_made(of, made, "given" if made.source in given else SolveStatus.SOLVED.value, {})


def _shape(robot: str | None) -> tuple[int, int]:
    return load_robot(robot or "deltawalker").leg_count, 3


def _of_strokes(strokes: Floats, robot: str | None) -> Plan:
    rows = strokes.reshape(-1, *strokes.shape[-2:])
    return _of_waypoints(Robot(load_robot(robot or "deltawalker")), _timed(rows), None)


def _timed(rows: Floats) -> Waypoints:
    """Strokes as waypoints, each planned for as long as the robot takes."""
    still = Waypoints(rows, np.zeros(len(rows)))
    return replace(still, durations=np.maximum(move_estimates(still), LEAST_SECONDS))


def _of_waypoints(robot: Robot, waypoints: Waypoints, motion: Trajectory | None) -> Plan:
    """Waypoints with their motion: a companion's, else what forward kinematics finds."""
    trajectory = motion or motion_of_waypoints(robot.model, waypoints).trajectory
    way = plan_of_knots(robot.model, trajectory, waypoints)
    return replace(Plan("given", robot), trajectory=trajectory, way=way)
