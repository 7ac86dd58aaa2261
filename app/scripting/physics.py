"""Physics for scripts: exactly the waypoints that would be sent, and variations of robot and ground."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from numpy.typing import ArrayLike

from app.cli.commands_simulate import physics_set, simulation_content
from app.scripting.gaits import Gait
from app.scripting.html import Cell, paragraph, table
from app.scripting.options import command_options
from app.scripting.planning import plan
from app.scripting.plans import Plan
from app.scripting.progress import progress_bar
from app.simulation.problem import way_problem
from core.arrays import Floats
from core.findings import Finding
from core.physics.findings import physics_outcomes
from core.physics.metrics import report
from core.physics.motion import SimulatedMotion
from core.physics.variations import VariedRun
from solver_jobs import simulate as run_physics
from solver_jobs import simulate_variations


@dataclass(frozen=True, eq=False, repr=False)
class Simulation:
    """What a plan does in physics. `footfall.simulate` gives one.

    Args:
        figures: what `footfall simulate --json` prints, in SI: `mean_error`, `max_tilt`, `fell`, `slip` and
            others.
        motion: the simulated robot over time.

    Raises:
        FootfallError: never.

    Example:
        >>> import footfall as ff
        >>> result = ff.simulate("fast-c-gait")
        >>> result.walks, result.body.shape[1]
        (True, 3)
    """

    figures: dict[str, Any]
    motion: SimulatedMotion

    @property
    def walks(self) -> bool:
        """Whether it does not fall, and no rule of the physics is broken."""
        return bool(self.figures["passed"])

    @property
    def fell(self) -> bool:
        """Whether it falls over."""
        return bool(self.figures["fell"])

    @property
    def times(self) -> Floats:
        """(n,) robot seconds of each state, s."""
        return self.motion.times

    @property
    def body(self) -> Floats:
        """(n, 3) centre of mass of the body in the world over time, m."""
        return self.motion.body_world

    @property
    def feet(self) -> Floats:
        """(n, legs, 3) feet in the world over time, m."""
        return self.motion.feet_world

    @property
    def findings(self) -> list[dict[str, Any]]:
        """What the physics found: rule, severity, sentence, value and limit in SI."""
        return list(self.figures["findings"])

    @property
    def share(self) -> float | None:
        """Share of the variations that walk, 0 to 1; None where none was tried."""
        variations = self.figures["variations"]
        return None if variations is None else float(variations["share"])

    def __repr__(self) -> str:
        tried = "" if self.share is None else f"; {self.share * 100:.0f} % of the variations walk"
        said = "falls over" if self.fell else "walks" if self.walks else "is not fit"
        shares = {"way": self.figures["way_share"], "turn": self.figures["turn_share"]}
        made = [f"{share * 100:.0f} % of its {what}" for what, share in shares.items() if share is not None]
        return f"Simulation: {', '.join([said, *made])}{tried}"

    def _repr_html_(self) -> str:
        figures, error = self.figures, self.figures["mean_error"]
        rows: list[list[Cell]] = [
            ["distance, mm", figures["distance"] * 1000],
            ["planned, mm", figures["planned_distance"] * 1000],
            ["mean error of the feet, mm", error["feet_mean"] * 1000],
            ["largest tilt, rad", figures["max_tilt"]],
        ]
        if self.share is not None:
            rows.append(["variations that walk, %", self.share * 100])
        sentences = [one["sentence"] for one in self.findings]
        return table(["", ""], rows, repr(self)) + paragraph(sentences)


def simulate(source: Plan | Gait | str | Path | ArrayLike, **options: Any) -> Simulation:
    """Runs what would be sent of a plan through the physics.

    Args:
        source: a plan, or anything that `footfall.plan` takes, such as an array (lines, legs, 3) of strokes
            in m.
        options: those of `footfall simulate`: physics, rig, variations, seed, within_stroke.

    Returns:
        The simulation; lengths in m, angles in rad, times in the robot's seconds.

    Raises:
        InputError: there is no such gait or option, or a value does not fit.
        InfeasibleError, CheckError: the plan has no motion, or the physics diverged.

    Example:
        >>> import footfall as ff
        >>> ff.simulate("fast-c-gait").fell
        False
    """
    of = plan(source, within_stroke=options.pop("within_stroke", None))
    asked = command_options(
        "simulate", ["plan"], ("robot", "merge", "stop_bound", "within_stroke"), **options
    )
    model = of.robot.model
    problem = way_problem(model, of.need_motion(), of.need_way(), physics_set(asked, model), asked.rig)
    with progress_bar("Physics") as tell:
        motion = run_physics(problem, tell)
    figures = report(problem, motion)
    findings: tuple[Finding, ...] = tuple(
        found for one in physics_outcomes(figures, problem) for found in one.findings
    )
    runs: Sequence[VariedRun] = ()
    if asked.variations:
        with progress_bar("Variations") as tell:
            runs = simulate_variations(problem, asked.variations, asked.seed, tell)
    return Simulation(simulation_content(problem, figures, findings, runs, asked.seed), motion)
