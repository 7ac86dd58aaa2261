"""Random drawings that cannot walk: painted with a few strokes, as a person does on the page."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from core.errors import FootfallError
from core.gait.gait import Gait, drawn_timeline, heading_step, motion_problem, with_iterations
from core.library.library import library
from core.motion.contact_timeline import ContactTimeline
from core.robot.model import load_robot
from solver_jobs import SolveStatus, solve_live

FOUR_LEGGED = ("walk", "amble", "s-gait", "c-gait")
SIX_LEGGED = ("hexapod-ripple", "hexapod-wave", "hexapod-tripod")
"""Gaits that are painted on."""

SIX_SHARE, TWICE_SHARE = 0.25, 0.12
"""Shares of drawings with six legs, and with two iterations."""

MOST_TRIES = 400
"""Drawings that are made until one cannot walk."""


@dataclass(frozen=True, eq=False)
class Drawing:
    """A drawing without a motion.

    Args:
        number: of the drawing, which with the seed makes it again.
        words: what was done.
        gait: the outcome.
        refused: it makes no problem at all, such as one that ends in the air.
    """

    number: int
    words: str
    gait: Gait
    refused: bool


def random_drawing(seed: int, number: int) -> Drawing:
    """A drawing of which the live tier says that it cannot walk; the same seed and number give the same.

    Raises:
        RuntimeError: none was found.
    """
    random = np.random.default_rng([seed, number])
    kind = _KINDS[number % len(_KINDS)]
    for _ in range(MOST_TRIES):
        names = SIX_LEGGED if random.random() < SIX_SHARE else FOUR_LEGGED
        name = names[int(random.integers(len(names)))]
        gait = _plain(library()[name].gait)
        words = [name]
        if random.random() < TWICE_SHARE:
            gait, words = with_iterations(gait, 2), [*words, "two iterations"]
        for paint in kind:
            gait, word = paint(gait, random)
            words.append(word)
        refused = is_refused(gait)
        if refused is not None:
            return Drawing(number, ", ".join(words), gait, refused)
    raise RuntimeError("No drawing was found that cannot walk.")


def is_refused(gait: Gait) -> bool | None:
    """Whether a drawing that cannot walk makes no problem at all; None where it has a motion."""
    try:
        problem = motion_problem(gait, load_robot(gait.robot))
    except FootfallError:
        return True
    return None if solve_live(problem).status is SolveStatus.SOLVED else False


def _plain(gait: Gait) -> Gait:
    """A gait as a person begins: the robot's own margin, a step of 10 mm."""
    margin = load_robot(gait.robot).margin
    begun = replace(gait.with_options(margin=margin), step=heading_step(gait.orientation, 0.010))
    return replace(begun, timeline=drawn_timeline(begun)) if len(gait.order) == 4 else begun


def _painted(gait: Gait, foot: int, first: int, last: int, *, swing: bool) -> Gait:
    stance = gait.timeline.stance.copy()
    stance[foot, max(first, 0) : last + 1] = not swing
    return replace(gait, timeline=ContactTimeline(stance, gait.timeline.locked, gait.timeline.sample_time))


def _overlap(gait: Gait, random: np.random.Generator) -> tuple[Gait, str]:
    """Several strokes of swing over the stance of feet, so that two are in the air."""
    count = int(random.integers(1, 5))
    for _ in range(count):
        foot = int(random.integers(gait.timeline.leg_count))
        first = int(random.integers(gait.timeline.sample_count - 4))
        gait = _painted(gait, foot, first, first + int(random.integers(3, 9)), swing=True)
    return gait, f"{count} strokes of swing"


def _long_step(gait: Gait, random: np.random.Generator) -> tuple[Gait, str]:
    step = float(random.uniform(0.018, 0.035))
    return replace(gait, step=heading_step(gait.orientation, step)), f"step {step * 1000:.1f} mm"


def _short_swings(gait: Gait, random: np.random.Generator) -> tuple[Gait, str]:
    swings = gait.timeline.swings()
    count = int(random.integers(1, 4))
    for index in random.choice(len(swings), size=min(count, len(swings)), replace=False):
        swing = swings[int(index)]
        kept = int(random.integers(1, 3))
        gait = _painted(gait, swing.foot, swing.first, swing.last - kept, swing=False)
    return gait, f"{count} swings cut short"


def _large_margin(gait: Gait, random: np.random.Generator) -> tuple[Gait, str]:
    margin = float(random.uniform(0.008, 0.025))
    return gait.with_options(margin=margin), f"margin {margin * 1000:.1f} mm"


Paint = Callable[[Gait, np.random.Generator], tuple[Gait, str]]

_KINDS: tuple[tuple[Paint, ...], ...] = (
    (_overlap,),
    (_overlap,),
    (_long_step,),
    (_short_swings,),
    (_large_margin,),
    (_overlap, _long_step),
)
