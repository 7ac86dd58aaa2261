"""Gaits with feet held up, for tests of core, the solvers and the studio."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from core.gait.gait import Gait, Orientation, drawn_timeline
from core.gait.held_feet import HeldFeet
from core.gait.options import GaitOptions
from core.motion.contact_timeline import timeline_from_rows
from core.robot.model import load_robot

DOWN, UP = "1" * 12, "1" * 5 + "0" * 7


def drawn(
    robot: str, rows: Sequence[str], held: HeldFeet, step: float = 0.0, margin: float = 0.003, **options: Any
) -> Gait:
    """A gait of rows of 1 and 0 along x."""
    timeline = timeline_from_rows(rows, 0.4)
    return Gait(
        name=f"{robot}, {held.start} to {held.end}",
        robot=robot,
        orientation=Orientation.FBS,
        direction=1,
        order=tuple(range(1, timeline.leg_count + 1)),
        step=(step, 0.0, 0.0),
        iterations=1,
        timeline=timeline,
        options=GaitOptions(margin=margin, **options),
        held=held,
    )


def wave(robot: str, held: Sequence[int], step: float = 0.010, margin: float = 0.003, **options: Any) -> Gait:
    """Feet step one after the other, but those that are held up throughout."""
    legs = load_robot(robot).leg_count
    rows = ["00" if foot + 1 in held else "11" for foot in range(legs)]
    both = HeldFeet(tuple(held), tuple(held))
    gait = drawn(robot, rows, both, step, margin, **options)
    return replace(gait, timeline=drawn_timeline(gait))


def lifting(robot: str, feet: Sequence[int], margin: float = 0.003, **options: Any) -> Gait:
    """From standing on every foot to some held up."""
    legs = load_robot(robot).leg_count
    rows = [UP if foot + 1 in feet else DOWN for foot in range(legs)]
    return drawn(robot, rows, HeldFeet(end=tuple(feet)), margin=margin, **options)


def lowering(robot: str, feet: Sequence[int], margin: float = 0.003, **options: Any) -> Gait:
    """The way back."""
    legs = load_robot(robot).leg_count
    rows = [UP[::-1] if foot + 1 in feet else DOWN for foot in range(legs)]
    return drawn(robot, rows, HeldFeet(start=tuple(feet)), margin=margin, **options)
