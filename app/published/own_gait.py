"""Our gait of a published row: the document that opens, with the largest margin that it can have."""

from dataclasses import dataclass

from app.plans.make_plan import Solve, make_plan
from app.plans.plan import Plan
from core.errors import CheckError, StateError
from core.gait.gait import Gait
from core.robot.model import load_robot

SMALLER_MARGINS = (0.003, 0.0025, 0.002, 0.001, 0.0)
"""Margins that are asked for where the robot's own has no motion, m; the first that has one counts."""


@dataclass(frozen=True, eq=False)
class OwnGait:
    """A gait with the plan that the page shows of it once it is opened.

    Args:
        gait: the document.
        plan: of it.
        sentence: on its margin, where that is not the robot's own; else empty.
    """

    gait: Gait
    plan: Plan
    sentence: str

    @property
    def margin(self) -> float | None:
        """The margin that is asked of the plan, m; None of a gait made by hand."""
        return None if self.gait.segment_table is not None else self.gait.options.margin


def own_gait(gait: Gait, solve: Solve) -> OwnGait:
    """The gait with the robot's own margin if that has a motion, else with the largest that has one.

    Args:
        gait: of the row, see `core.published.gaits`.
        solve: asks the live tier.

    Raises:
        CheckError: none of the margins has a motion, or no foot reaches its places.
        StateError: the solver gave no answer.
    """
    if gait.segment_table is not None:
        return OwnGait(gait, _sendable(make_plan(gait, None, solve)), "")
    own = load_robot(gait.robot).margin
    for margin in (own, *(one for one in SMALLER_MARGINS if one < own)):
        asked = gait.with_options(margin=margin)
        plan = make_plan(asked, None, solve)
        if plan.broke_off:
            raise StateError(f"The solver gave no answer. {_why_not(plan)}", "plan")
        if not plan.is_draft and plan.way is not None:
            words = "" if margin == own else _margin_words(own, margin)
            return OwnGait(asked, plan, words)
    raise CheckError(f"None of the margins down to 0 mm has a motion. {_why_not(plan)}", "margin")


def _sendable(plan: Plan) -> Plan:
    if plan.is_draft or plan.way is None:
        raise CheckError(_why_not(plan), "plan")
    return plan


def _why_not(plan: Plan) -> str:
    return plan.note if plan.refusal is None else plan.refusal.sentence


def _margin_words(own: float, margin: float) -> str:
    asked = f"{margin * 1000:g} mm are asked"
    return f"Our gait has no motion with the robot's own margin of {own * 1000:g} mm; {asked}."
