"""Remedies as JSON content."""

from dataclasses import dataclass
from typing import Protocol

from app.common.json import Json, finite
from app.documents.gait_json import gait_content
from app.plans.plan import Plan
from app.plans.robot_times import robot_times
from core.gait.gait import Gait


class Change(Protocol):
    """A changed gait with what is said of it; a `Remedy`, or a way to keep a recorded motion."""

    @property
    def kind(self) -> str:
        """What is changed."""

    @property
    def label(self) -> str:
        """Text of its button."""

    @property
    def sentence(self) -> str:
        """What it does, and what it costs."""

    @property
    def gait(self) -> Gait:
        """The changed gait."""

    @property
    def caution(self) -> str:
        """What is to be said against it; empty where nothing is."""


@dataclass(frozen=True)
class Tried:
    """Result of trying a remedy in physics.

    Args:
        walks: None where the simulation gave no result.
        sentence: why it does not walk, or why there is no result.
    """

    walks: bool | None
    sentence: str = ""


def remedy_view(remedy: Change, plan: Plan, tried: Tried | None) -> Json:
    """A change that makes a gait walk, SI.

    Args:
        remedy: the change.
        plan: of the changed gait.
        tried: what physics says; None where that is not known yet.
    """
    times = robot_times(plan)
    content: Json = {
        "kind": str(remedy.kind),
        "label": remedy.label,
        "sentence": remedy.sentence,
        "caution": remedy.caution,
        "document": gait_content(remedy.gait),
        "margin": remedy.gait.options.margin,
        "balance": plan.balance,
        "plan_seconds": None if plan.trajectory is None else float(plan.trajectory.times[-1]),
        "robot_seconds": None if times is None else times.robot_seconds,
        "physics": None if tried is None else {"walks": tried.walks, "sentence": tried.sentence},
    }
    whole: Json = finite(content)
    return whole
