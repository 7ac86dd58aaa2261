"""A motion as a figure of matplotlib, which is loaded here alone."""

from __future__ import annotations

from io import BytesIO
from typing import TYPE_CHECKING

import numpy as np

from core.errors import InputError
from core.motion.support_polygon import stability_margins
from core.motion.trajectory import Trajectory
from core.robot.model import RobotModel

if TYPE_CHECKING:
    from matplotlib.figure import Figure  # type: ignore[import-not-found, unused-ignore]

DOTS = 80
"""Of a figure in a notebook, an inch."""


def motion_figure(motion: Trajectory, model: RobotModel) -> Figure:
    """Foot heights, stability margin and strokes over the plan's time, mm over s.

    Raises:
        InputError: matplotlib is not installed.
    """
    try:
        from matplotlib.figure import Figure
    except ImportError as error:
        raise InputError(
            "plot() needs matplotlib; install the program with the extra [notebook], or matplotlib itself.",
            "matplotlib",
        ) from error

    class PlanFigure(Figure):  # type: ignore[misc, unused-ignore]
        """A figure that a notebook shows without pyplot."""

        def _repr_png_(self) -> bytes:
            picture = BytesIO()
            self.savefig(picture, format="png", dpi=DOTS, metadata={"Software": None})
            return picture.getvalue()

    figure = PlanFigure(figsize=(9, 6), layout="constrained")
    lift, margin, strokes = figure.subplots(3, 1, sharex=True)
    times, names = motion.times, [f"foot {foot + 1}" for foot in range(model.leg_count)]
    heights = (motion.feet_world[..., 2] - motion.feet_world[..., 2].min()) * 1000
    for foot, colour in enumerate(model.colours):
        lift.plot(times, heights[:, foot], color=colour, label=names[foot])
        for motor in range(3):
            strokes.plot(times, motion.strokes(model)[:, foot, motor] * 1000, color=colour, lw=0.8)
    margins = stability_margins(motion.body_world[:, :2], motion.feet_world, motion.contact)
    margin.plot(times, np.asarray(margins) * 1000, color="black")
    margin.axhline(0.0, color="0.7", lw=0.8)
    lift.set_ylabel("lift, mm")
    lift.legend(ncols=model.leg_count, fontsize="small", loc="upper right")
    margin.set_ylabel("stability margin, mm")
    strokes.set_ylabel("strokes, mm")
    strokes.set_xlabel("time of the plan, s")
    return figure
