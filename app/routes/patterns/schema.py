"""What is asked of the pattern search, as it comes over the wire; limbs and samples count from 0."""

from typing import Annotated, Any, Literal

from pydantic import Field

from app.web.dependencies import FiniteBody
from core.gait.gait import MOST_NAME
from core.patterns.problem import MOST_LEGS, MOST_SAMPLES
from core.patterns.sources import F_RULES, F_WEIGHTS

MOST_COUNT, MOST_SECONDS = 20, 120.0
"""Patterns and s that may be asked for."""

Number = Annotated[int | None, Field(ge=0, le=MOST_SAMPLES)]
Limb = Annotated[int, Field(ge=0, lt=MOST_LEGS)]
Sample = Annotated[int, Field(ge=0, lt=MOST_SAMPLES)]
Rows = Annotated[list[Annotated[str, Field(max_length=MOST_SAMPLES)]], Field(max_length=MOST_LEGS)]


class RulesBody(FiniteBody):
    """The rules' numbers, the thesis's by default; null switches a rule off. `balance` is a margin in m."""

    shortest_swing: Number = F_RULES.shortest_swing
    feet_down: Number = F_RULES.feet_down
    feet_down_each_side: Number = F_RULES.feet_down_each_side
    workload: Number = F_RULES.workload
    limb_changes: Number = F_RULES.limb_changes
    shortest_stance: Number = F_RULES.shortest_stance
    least_swing: Number = F_RULES.least_swing
    balance: float | None = F_RULES.balance


class WeightsBody(FiniteBody):
    """What a change costs; whole numbers."""

    sample_changes: int = F_WEIGHTS.sample_changes
    limb_changes: int = F_WEIGHTS.limb_changes
    drawing: int = F_WEIGHTS.drawing


class _ProblemBody(FiniteBody):
    gait: str = Field(max_length=80)
    rules: RulesBody = RulesBody()
    weights: WeightsBody = WeightsBody()
    cells: list[tuple[Limb, Sample, Literal[0, 1]]] = Field(default=[], max_length=MOST_LEGS * MOST_SAMPLES)
    """Cells that were drawn, with 1 for stance and 0 for swing: they are fixed."""
    freed: list[tuple[Limb, Sample]] = Field(default=[], max_length=MOST_LEGS * MOST_SAMPLES)
    """Cells that are free although the gaits or the drawing would fix them."""
    drawing: Rows | None = None
    """Rows of 1 and 0 that are kept where that can be."""
    count: int = Field(default=1, ge=1, le=MOST_COUNT)
    seconds: float = Field(default=30.0, gt=0, le=MOST_SECONDS)
    once_an_order: bool = False
    """Whether patterns whose feet change in the same order, only at other samples, count as one."""


class TransitionBody(_ProblemBody):
    """From a sample of one gait to a sample of another; without a length the shortest that works."""

    kind: Literal["transition"]
    sample: int = Field(ge=0)
    to: str = Field(max_length=80)
    to_sample: int = Field(ge=0)
    samples: int | None = None
    locked: list[Limb] = Field(default=[], max_length=MOST_LEGS)
    """Limbs that keep their value, beside those that both gaits leave as they are."""
    walkable: bool = False
    """Whether swings are long enough for the gaits' steps, also those that a cursor cuts."""


class LimbsBody(_ProblemBody):
    """A gait of some limbs of an open gait's robot, going its way."""

    kind: Literal["limbs"]
    samples: int
    limbs: list[Literal["walks", "held", "broken", "stands"]] = Field(max_length=MOST_LEGS)


class DrawingBody(_ProblemBody):
    """The rest of a gait's drawing; a document stands for the gait where an edit is under way."""

    kind: Literal["drawing"]
    painted: bool = False
    """Whether painted swings stay, beside the locked cells."""
    document: dict[str, Any] | None = None


Question = Annotated[TransitionBody | LimbsBody | DrawingBody, Field(discriminator="kind")]


class PatternUse(FiniteBody):
    """A question and the pattern, among its answers, that is to be used."""

    question: Question
    feet: Rows
    name: str | None = Field(default=None, max_length=MOST_NAME)
