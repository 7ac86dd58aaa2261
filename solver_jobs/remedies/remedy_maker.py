"""Makes remedies of changed gaits: tries each with its best margin, and gives it label and words."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from core.gait.gait import Gait
from core.robot.model import RobotModel
from solver_jobs.remedies.arms import arm_caution
from solver_jobs.remedies.layout import with_ends, with_forgotten_feet
from solver_jobs.remedies.remedy import Remedy, RemedyKind, step_length
from solver_jobs.remedies.trial import Trial

MM = 1000.0


class RemedyMaker:
    """Makes the remedies of one gait.

    Args:
        asked: a gait without a motion, or one that tips in physics.
        model: its robot.
        trial: tries the changed gaits.

    Attributes:
        mended: the gait with repaired ends, and a swing for each forgotten foot; `asked` if nothing changes.
        raised: the requested margin, but at least the robot's own, m.
    """

    def __init__(self, asked: Gait, model: RobotModel, trial: Trial) -> None:
        self.asked = asked
        self.mended = with_forgotten_feet(with_ends(asked))
        self.raised = max(asked.options.margin, model.margin)
        self._model = model
        self._trial = trial

    @property
    def turns(self) -> bool:
        """Whether the gait only turns, without a step."""
        return step_length(self.asked) == 0 and self.asked.step[2] != 0

    def size(self, gait: Gait) -> float:
        """Length of the step, m; for a gait that only turns, the angle of its turn, rad."""
        return abs(gait.step[2]) if self.turns else step_length(gait)

    def scaled(self, gait: Gait, value: float) -> Gait:
        """The gait with its step or turn scaled to another size, m or rad (see `size`)."""
        size = self.size(gait)
        if size in (0.0, value):
            return gait
        dx, dy, yaw = (part * value / size for part in gait.step)
        return replace(gait, step=(dx, dy, yaw))

    def at_best_margin(self, gait: Gait) -> Gait | None:
        """The gait with the robot's own margin if that works, else with the requested one, or None."""
        return self.first_at_best_margin([gait])

    def first_at_best_margin(self, gaits: Sequence[Gait | None]) -> Gait | None:
        """The first gait that works with the robot's own margin, else the first with the requested one."""
        for margin in dict.fromkeys((self.raised, self.asked.options.margin)):
            found = self._trial.first(None if gait is None else with_margin(gait, margin) for gait in gaits)
            if found is not None:
                return found
        return None

    def remedy(
        self, kind: RemedyKind, label: str, words: str, gait: Gait, caution: str = ""
    ) -> Remedy | None:
        """The remedy for a changed gait; None if the full live tier finds no confirmed motion."""
        motion = self._trial.solved(gait)
        if motion is None:
            return None
        margin, asked = gait.options.margin, self.asked.options.margin
        others = []
        if margin != asked and kind not in (RemedyKind.MARGIN, RemedyKind.NO_MARGIN):
            others.append(f"Margin {margin * MM:g} mm.")
        if self.mended is not self.asked and kind is not RemedyKind.MENDED:
            others.append("The ends are repaired too.")
        cautions = " ".join(filter(None, [caution, arm_caution(gait, self._model, motion)]))
        return Remedy(kind, label, " ".join([words, *others]), gait, motion, cautions)

    def step_remedy(self, gait: Gait, words: str) -> Remedy | None:
        """The remedy for a gait with another step or turn (see `remedy`)."""
        return self.remedy(RemedyKind.STEP, self.step_words(gait), words, gait)

    def step_words(self, gait: Gait) -> str:
        """The step or turn as a label, in mm or degrees."""
        size = self.size(gait)
        return f"Turn {np.degrees(size):.1f}°" if self.turns else f"Step {size * MM:.1f} mm"


def with_margin(gait: Gait, margin: float) -> Gait:
    """The gait with another margin, m."""
    return gait.with_options(margin=margin)
