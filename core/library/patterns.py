"""Patterns that come with the program: what was asked of the solver, and what it found."""

from dataclasses import dataclass
from typing import Any

from core.arrays import Bools
from core.gait.gait import Gait, Orientation, heading_step
from core.gait.options import GaitOptions
from core.motion.contact_timeline import bits_from_rows
from core.patterns.limits import own_balance
from core.patterns.problem import PatternProblem, PatternRules, PatternWeights
from core.patterns.sources import LimbState, hint_of_groups, periodic_problem
from core.patterns.to_gait import CycleUse, periodic_gait
from core.robot.model import RobotModel, load_robot


@dataclass(frozen=True, eq=False)
class LibraryPattern:
    """A periodic pattern of the library.

    Args:
        id: of the built-in gait that it becomes.
        model: its robot.
        problem: what was asked; its drawing is the order that limbs were to swing in.
        stance: (legs, samples) what the solver found, one cycle.
        use: how it is walked.
        walks: whether a motion of it keeps every limit of its robot.
    """

    id: str
    model: RobotModel
    problem: PatternProblem
    stance: Bools
    use: CycleUse
    walks: bool = True

    @property
    def gait(self) -> Gait:
        """One iteration, from standing to standing."""
        return self.used(1)

    def used(self, iterations: int) -> Gait:
        """The gait with another number of iterations."""
        whole = CycleUse(**{**vars(self.use), "iterations": iterations})
        return periodic_gait(self.stance, self.model, whole)


def library_pattern(item: dict[str, Any]) -> LibraryPattern:
    """A pattern from its table in the library's data.

    Args:
        item: id, name, note, robot, orientation, feet that are up, samples, groups of feet that swing
            together in the order that is asked for, rules and weights that differ from F's, step in m, rows,
            and `walks` where it is false.

    Raises:
        InputError: a part does not fit.
    """
    model = load_robot(item["robot"])
    orientation = Orientation(item["orientation"])
    limbs = [
        LimbState.HELD if foot in item["up"] else LimbState.WALKS for foot in range(1, model.leg_count + 1)
    ]
    rules = PatternRules(**item["rules"])
    hint = hint_of_groups(model, item["groups"], item["samples"])
    hint[[foot - 1 for foot in item["up"]]] = False
    problem = periodic_problem(
        model,
        limbs,
        item["samples"],
        orientation=orientation,
        rules=rules,
        weights=PatternWeights(**item.get("weights", {})),
        drawing=hint,
        balance=own_balance(model, item["step"]),
    )
    use = CycleUse(
        name=item["name"],
        orientation=orientation,
        step=heading_step(orientation, item["step"]),
        sample_time=problem.sample_time,
        options=GaitOptions(margin=item["margin"]),
        notes=item["note"],
    )
    return LibraryPattern(
        item["id"], model, problem, bits_from_rows(item["rows"], "rows"), use, item.get("walks", True)
    )
