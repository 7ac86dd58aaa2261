"""Random gaits of robots with four to twelve legs: orders, steps, overlaps, margins, heights."""

from dataclasses import replace

import numpy as np

from app.bench.common.edited_gaits import EditedGait, edited_gait
from core.gait.gait import Gait, Orientation, heading_step
from core.motion.contact_timeline import ContactTimeline
from core.robot.model import load_robot

SAMPLE_TIME = 0.4

MANY_LEGGED = {"hexapod": (1, 2, 3), "dodecapod": (2, 3, 4, 6)}
"""Feet that swing together, by robot."""

MARGINS = (0.0, 0.003, 0.006, 0.010)

MOVED_SHARE = 0.3
"""Share of the swings whose ends are moved, so that they overlap others or are short."""


def random_gait(seed: int, number: int) -> EditedGait:
    """A gait that the same seed and number give again; two of three are edited built-in ones of four legs."""
    return _many_legged(seed, number) if number % 3 == 2 else edited_gait(seed, number)


def _many_legged(seed: int, number: int) -> EditedGait:
    random = np.random.default_rng([seed, number])
    robot = tuple(MANY_LEGGED)[int(random.integers(2))]
    group, knots = int(random.choice(MANY_LEGGED[robot])), int(random.integers(3, 8))
    step, margin = float(random.uniform(0.0, 0.03)), float(random.choice(MARGINS))
    clearance, height = float(random.uniform(0.0, 0.008)), float(random.uniform(0.053, 0.0605))
    gait = grouped_gait(robot, group, knots, step)
    gait = replace(gait, timeline=_moved(gait.timeline, random))
    words = (
        f"{robot}, {group} feet at a time for {knots} knots, step {step * 1000:.1f} mm, margin "
        f"{margin * 1000:g} mm, clearance {clearance * 1000:.1f} mm, height {height * 1000:.1f} mm"
    )
    gait = gait.with_options(margin=margin, clearance=clearance, plane_height=height)
    return EditedGait(number, words, gait)


def _moved(timeline: ContactTimeline, random: np.random.Generator) -> ContactTimeline:
    """Some swings begin and end up to three samples elsewhere; all feet stand at both ends."""
    stance = timeline.stance.copy()
    for swing in timeline.swings():
        if random.random() < MOVED_SHARE:
            first, last = swing.first + int(random.integers(-3, 3)), swing.last + int(random.integers(-2, 4))
            stance[swing.foot, swing.first : swing.last + 1] = True
            stance[swing.foot, max(first, 1) : max(last + 1, 1)] = False
    stance[:, -1] = True
    return replace(timeline, stance=stance)


def grouped_gait(robot: str, group: int, phase_knots: int, step: float = 0.010) -> Gait:
    """A gait of any robot whose feet swing in groups spread round the ring.

    Args:
        robot: name of its parameters file.
        group: feet that swing together.
        phase_knots: of each stance and of each swing.
        step: m.
    """
    legs = load_robot(robot).leg_count
    turns = legs // group
    stance = np.ones((legs, turns * 2 * phase_knots), dtype=np.bool_)
    order = [foot for turn in range(turns) for foot in range(turn, legs, turns)]
    for number, foot in enumerate(order):
        first = (2 * (number // group) + 1) * phase_knots
        stance[foot, first : first + phase_knots] = False
    stance[:, -1] = True
    return Gait(
        name=robot,
        robot=robot,
        orientation=Orientation.FBS,
        direction=1,
        order=tuple(foot + 1 for foot in order),
        step=heading_step(Orientation.FBS, step),
        iterations=1,
        timeline=ContactTimeline(stance, np.zeros_like(stance), SAMPLE_TIME),
    )
