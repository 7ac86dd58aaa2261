"""Random drawings that cannot walk: painted with a few strokes, as a person does on the page."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from enum import StrEnum

import numpy as np

from app.bench.common.edited_gaits import EditedGait
from core.errors import FootfallError
from core.gait.gait import Gait, drawn_timeline, heading_step, motion_problem, with_iterations
from core.gait.held_feet import HeldFeet, held_sentence
from core.library.library import library
from core.motion.contact_timeline import ContactTimeline
from core.robot.model import load_robot
from solver_jobs import SolveStatus, solve_live

FOUR_LEGGED = ("walk", "amble", "s-gait", "c-gait")
SIX_LEGGED = ("hexapod-ripple", "hexapod-wave", "hexapod-tripod")
"""Gaits that are painted on."""

SIX_SHARE, SIX_SHARE_HELD, TWICE_SHARE = 0.25, 0.5, 0.12
"""Shares of drawings with six legs, also of those with held feet, and with two iterations."""

MOST_TRIES = 400
"""Drawings that are made until one cannot walk."""


class Family(StrEnum):
    """Kinds of drawings, each with its own random numbers."""

    PLAIN = "plain"
    """Strokes, steps and margins alone."""
    SPECIAL = "special"
    """The same with locked cells, feet that are held up, another direction or a turn."""


@dataclass(frozen=True, eq=False)
class Drawing(EditedGait):
    """A drawing without a motion.

    Args:
        refused: it makes no problem at all, such as one that ends in the air.
    """

    refused: bool


def random_drawing(seed: int, number: int, family: Family = Family.PLAIN) -> Drawing:
    """A drawing of which the live tier says that it cannot walk; the same arguments give the same.

    Raises:
        RuntimeError: none was found.
    """
    random = np.random.default_rng([seed, number, *_STREAMS[family]])
    kind = _KINDS[family][number % len(_KINDS[family])]
    six_share = SIX_SHARE_HELD if _held in kind else SIX_SHARE
    for _ in range(MOST_TRIES):
        names = SIX_LEGGED if random.random() < six_share else FOUR_LEGGED
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
    dx, dy, _ = heading_step(gait.orientation, step)
    return replace(gait, step=(dx, dy, gait.step[2])), f"step {step * 1000:.1f} mm"


def _short_swings(gait: Gait, random: np.random.Generator) -> tuple[Gait, str]:
    """Swings cut short at their end, but those of feet that are held up."""
    held = {*gait.held.start, *gait.held.end}
    swings = [swing for swing in gait.timeline.swings() if swing.foot + 1 not in held]
    count = int(random.integers(1, 4))
    for index in random.choice(len(swings), size=min(count, len(swings)), replace=False):
        swing = swings[int(index)]
        kept = int(random.integers(1, 3))
        gait = _painted(gait, swing.foot, swing.first, swing.last - kept, swing=False)
    return gait, f"{count} swings cut short"


def _large_margin(gait: Gait, random: np.random.Generator) -> tuple[Gait, str]:
    margin = float(random.uniform(0.008, 0.025))
    return gait.with_options(margin=margin), f"margin {margin * 1000:.1f} mm"


def _held(gait: Gait, random: np.random.Generator) -> tuple[Gait, str]:
    """The first foot that swings begins in the air, or the last one ends there; or one of six never lands."""
    swings = sorted(gait.timeline.swings(), key=lambda swing: swing.first)
    last = gait.timeline.sample_count - 1
    legs = gait.timeline.leg_count
    match int(random.integers(4 if legs > 4 else 2)):
        case 0:
            foot = swings[0].foot + 1
            held = HeldFeet(start=(foot,))
            gait = _painted(gait, foot - 1, 0, swings[0].last, swing=True)
        case 1:
            foot = swings[-1].foot + 1
            held = HeldFeet(end=(foot,))
            gait = _painted(gait, foot - 1, swings[-1].first, last, swing=True)
        case _:
            foot = int(random.integers(legs)) + 1
            held = HeldFeet((foot,), (foot,))
            gait = _painted(gait, foot - 1, 0, last, swing=True)
    return replace(gait, held=held), held_sentence(held).rstrip(".").lower()


def _direction(gait: Gait, random: np.random.Generator) -> tuple[Gait, str]:
    direction = int(random.integers(2, 5))
    turned = gait.timeline.turned(direction - gait.direction)
    return replace(gait, direction=direction, timeline=turned), f"direction {direction}"


def _turn(gait: Gait, random: np.random.Generator) -> tuple[Gait, str]:
    """A turn either way, beside the step."""
    degrees = float(random.uniform(5.0, 25.0)) * (1 if random.random() < 0.5 else -1)
    dx, dy, _ = gait.step
    return replace(gait, step=(dx, dy, float(np.radians(degrees)))), f"turn {degrees:.1f}°"


def _turn_on_the_spot(gait: Gait, random: np.random.Generator) -> tuple[Gait, str]:
    turned, word = _turn(gait, random)
    return replace(turned, step=(0.0, 0.0, turned.step[2])), f"{word} on the spot"


def _locks(gait: Gait, random: np.random.Generator) -> tuple[Gait, str]:
    """One or two swings, or stretches of a foot's stance, that must stay."""
    timeline, words = gait.timeline, []
    locked = timeline.locked.copy()
    for _ in range(int(random.integers(1, 3))):
        if random.random() < 0.5:
            swings = timeline.swings()
            swing = swings[int(random.integers(len(swings)))]
            locked[swing.foot, swing.samples] = True
            words.append(f"locked swing of foot {swing.foot + 1}")
        else:
            foot = int(random.integers(timeline.leg_count))
            first = int(random.choice(np.flatnonzero(timeline.stance[foot])))
            stretch = slice(first, first + int(random.integers(3, 9)))
            locked[foot, stretch] |= timeline.stance[foot, stretch]
            words.append(f"locked stance of foot {foot + 1} from sample {first + 1}")
    return replace(gait, timeline=replace(timeline, locked=locked)), ", ".join(words)


Paint = Callable[[Gait, np.random.Generator], tuple[Gait, str]]

_PLAIN_KINDS: tuple[tuple[Paint, ...], ...] = (
    (_overlap,),
    (_overlap,),
    (_long_step,),
    (_short_swings,),
    (_large_margin,),
    (_overlap, _long_step),
)

_TURNS = (_turn, _turn_on_the_spot, _turn, _turn_on_the_spot, _turn_on_the_spot, _turn)
"""Which turn goes with each kind; where the step is long, it stays."""

_KINDS: dict[Family, tuple[tuple[Paint, ...], ...]] = {
    Family.PLAIN: _PLAIN_KINDS,
    # Cells are locked as they were painted, so last.
    Family.SPECIAL: tuple(
        paints
        for kind, turn in zip(_PLAIN_KINDS, _TURNS, strict=True)
        for paints in ((*kind, _locks), (_held, *kind), (_direction, *kind), (turn, *kind))
    ),
}
_STREAMS: dict[Family, tuple[int, ...]] = {Family.PLAIN: (), Family.SPECIAL: (1,)}
"""What tells the families' random numbers apart."""
