"""Seeded random edits of the built-in gaits, such as a person makes on the page."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from core.gait.gait import Gait, drawn_timeline, heading_step, with_return
from core.library.library import Group, group_ids, library
from core.motion.contact_timeline import ContactTimeline
from core.problem.motion_problem import Workspace
from core.robot.model import load_robot

MOST_EDITS = 5
"""Edits of one gait."""


@dataclass(frozen=True, eq=False)
class EditedGait:
    """A built-in gait after some edits.

    Args:
        number: of the edit, which with the seed makes it again.
        words: what was done.
        gait: the outcome.
    """

    number: int
    words: str
    gait: Gait


def edited_gait(seed: int, number: int) -> EditedGait:
    """Edits a built-in gait; the same seed and number give the same gait."""
    random = np.random.default_rng([seed, number])
    entries = [library()[gait_id] for gait_id in group_ids(Group.OPTIMISED)]
    entry = entries[int(random.integers(len(entries)))]
    gait, words = entry.gait, [entry.id]
    # Edits of cells come last, because a redrawn timeline forgets them.
    chosen = np.sort(random.choice(len(_EDITS), size=int(random.integers(1, MOST_EDITS + 1)), replace=False))
    for index in chosen:
        gait, word = _EDITS[index](gait, random)
        words.append(word)
    return EditedGait(number, ", ".join(words), gait)


def _redrawn(gait: Gait) -> Gait:
    """The timeline drawn anew; one whose body turns back keeps time for that."""
    return with_return(replace(gait, timeline=drawn_timeline(gait)), load_robot(gait.robot))


def _order(gait: Gait, random: np.random.Generator) -> tuple[Gait, str]:
    order = tuple(int(foot) for foot in random.permutation(len(gait.order)) + 1)
    return _redrawn(replace(gait, order=order)), f"order {'-'.join(map(str, order))}"


def _phases(gait: Gait, random: np.random.Generator) -> tuple[Gait, str]:
    knots = int(random.integers(3, 9))
    return _redrawn(gait.with_options(phase_knots=knots)), f"phases of {knots} knots"


def _closing(gait: Gait, random: np.random.Generator) -> tuple[Gait, str]:
    knots = int(random.integers(0, 9))
    return _redrawn(gait.with_options(closing_knots=knots)), f"closing stance of {knots} knots"


def _direction(gait: Gait, random: np.random.Generator) -> tuple[Gait, str]:
    direction = int(random.integers(1, 5))
    return _redrawn(replace(gait, direction=direction)), f"direction {direction}"


def _step(gait: Gait, random: np.random.Generator) -> tuple[Gait, str]:
    if gait.step[2]:
        degrees = float(random.uniform(-45.0, 45.0))
        return _redrawn(replace(gait, step=(0.0, 0.0, float(np.radians(degrees))))), f"turn {degrees:.1f}°"
    length = float(random.uniform(0.0, 0.03))
    dx, dy, _ = heading_step(gait.orientation, length)
    return replace(gait, step=(float(dx), float(dy), 0.0)), f"step {length * 1000:.1f} mm"


def _heights(gait: Gait, random: np.random.Generator) -> tuple[Gait, str]:
    start, end = (float(h) for h in random.uniform(0.053, 0.0605, 2))
    goal = end if random.random() < 0.5 else None
    words = f"height {start * 1000:.1f} mm" + ("" if goal is None else f" to {goal * 1000:.1f} mm")
    return gait.with_options(plane_height=start, end_plane_height=goal), words


def _clearance(gait: Gait, random: np.random.Generator) -> tuple[Gait, str]:
    clearance = float(random.uniform(0.0, 0.009))
    return gait.with_options(clearance=clearance), f"clearance {clearance * 1000:.1f} mm"


def _margin(gait: Gait, random: np.random.Generator) -> tuple[Gait, str]:
    margin = float(random.uniform(0.0, 0.009))
    return gait.with_options(margin=margin), f"margin {margin * 1000:.1f} mm"


def _workspace(gait: Gait, random: np.random.Generator) -> tuple[Gait, str]:
    workspace = list(Workspace)[int(random.integers(2))]
    return gait.with_options(workspace=workspace), f"workspace {workspace.value}"


def _move(gait: Gait, random: np.random.Generator) -> tuple[Gait, str]:
    shift = int(random.integers(1, 5)) * (1 if random.random() < 0.5 else -1)
    return _with_swing(gait, random, shift, shift, f"moved by {shift:+d}")


def _lengthen(gait: Gait, random: np.random.Generator) -> tuple[Gait, str]:
    more = int(random.integers(1, 4))
    return _with_swing(gait, random, -more, more, f"longer by {2 * more}")


def _shorten(gait: Gait, random: np.random.Generator) -> tuple[Gait, str]:
    late = random.random() < 0.5
    less = int(random.integers(1, 4))
    return _with_swing(gait, random, less * late, -less * (not late), f"shorter by {less}")


def _with_swing(
    gait: Gait, random: np.random.Generator, first: int, last: int, word: str
) -> tuple[Gait, str]:
    """One swing with other ends; the last sample stays stance, as the page's locked column does."""
    swings = gait.timeline.swings()
    swing = swings[int(random.integers(len(swings)))]
    stance = gait.timeline.stance.copy()
    stance[swing.foot, swing.first : swing.last + 1] = True
    stance[swing.foot, max(swing.first + first, 0) : max(swing.last + last + 1, 0)] = False
    stance[:, -1] = True
    timeline = ContactTimeline(stance, gait.timeline.locked, gait.timeline.sample_time)
    return replace(gait, timeline=timeline), f"swing of foot {swing.foot + 1} {word}"


Edit = Callable[[Gait, np.random.Generator], tuple[Gait, str]]

_EDITS: tuple[Edit, ...] = (
    _order,
    _direction,
    _phases,
    _closing,
    _step,
    _heights,
    _clearance,
    _margin,
    _workspace,
    _move,
    _lengthen,
    _shorten,
)
