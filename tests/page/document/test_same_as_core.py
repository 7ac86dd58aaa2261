"""The page's own mathematics of documents gives what `core` gives, on random documents."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import pytest
from playwright.sync_api import Browser

from app.gaits.normalise import require_locks
from core.arrays import Bools
from core.errors import InputError, StateError
from core.gait.gait import Gait, Orientation, drawn_timeline, heading_step, is_drawn, with_iterations
from core.gait.held_feet import HeldFeet
from core.gait.options import GaitOptions
from core.gait.poses import MOST_PINNED
from core.motion.contact_timeline import ContactTimeline
from tests.repository.source_tree import listed
from tests.support.page.opened import opened_page
from tests.support.studio_process import StudioProcess

SHARES_STUDIO = True

DOCUMENTS = 200
LEGS = (4, 5, 6, 8, 9, 12)
PAGE = """async (cases) => {
  const names = ["drawn_timeline", "held_feet", "pinned_poses", "step", "swings", "timeline_operators"];
  const modules = await Promise.all(names.map((name) => import(`/static/document/${name}.js`)));
  const [drawn, held, pins, step, swings, operators] = modules;
  const pinned = (document, offset) => {
    const { along, sideways } = pins.pinOf(pins.withPinned(document, 2, offset), 2);
    return [along, sideways];
  };
  const locked = (before, after) =>
    /foot \\d+, sample \\d+(?=, which is locked)/.exec(operators.heldBack(before, after) ?? "")?.[0] ?? null;
  const answer = ({ document, repeated, turns, changed, offset, bodies }) => ({
    rows: drawn.drawnRows(document),
    isDrawn: drawn.isDrawn(document),
    again: drawn.isDrawn(document)
      ? drawn.drawnRows({ ...document, iterations: repeated })
      : drawn.repeatedRows(document, repeated),
    turned: operators.turnedRows(document.timeline.feet, turns),
    held: held.heldOf(held.heldTurned(document, turns)),
    heldBoth: held.heldBoth(document),
    step: step.worldStep(document),
    stepBack: step.withWorldStep(document, step.worldStep(document)).step,
    heading: step.withStepLength({ ...document, step: [0, 0, 0] }, 0.01).step,
    swings: document.timeline.feet.flatMap((row, foot) =>
      [...row].flatMap((_, sample) => ["first", "only"].includes(swings.partOf(row, sample))
        ? [[foot, ...Object.values(swings.swingAt(row, sample))]] : [])),
    locked: locked(document, changed),
    pin: pinned(document, pins.evenTravel(bodies).toOffset(offset)),
  });
  return cases.map(answer);
}"""


def text(cells: Bools) -> list[str]:
    """Rows of 1 and 0."""
    return ["".join("1" if cell else "0" for cell in row) for row in cells]


def random_gait(random: np.random.Generator) -> Gait:
    """A gait of its order, phases and iterations, in every second case with strokes of paint over it."""
    legs = int(random.choice(LEGS))
    iterations = int(random.integers(1, 4))
    stance = np.ones((legs, 8), dtype=np.bool_)
    up = int(random.integers(1, legs + 1))
    held = HeldFeet((up,), (up,)) if legs > 4 and random.random() < 0.3 else HeldFeet()
    gait = Gait(
        name="Random",
        robot="deltawalker",
        orientation=Orientation.FB if random.random() < 0.5 else Orientation.FBS,
        direction=int(random.integers(1, 5)),
        order=tuple(int(foot) + 1 for foot in random.permutation(legs)),
        step=(float(random.uniform(-0.02, 0.02)), float(random.uniform(-0.02, 0.02)), 0.1),
        iterations=iterations,
        timeline=ContactTimeline(stance, np.zeros_like(stance), 0.4),
        options=GaitOptions(phase_knots=int(random.integers(2, 8)), closing_knots=int(random.integers(1, 9))),
        held=held,
    )
    drawn = drawn_timeline(gait)
    locked = random.random(drawn.stance.shape) < (0.05 if random.random() < 0.5 else 0.0)
    painted = drawn.stance.copy()
    if random.random() < 0.5:
        for _ in range(int(random.integers(1, 4))):
            foot, first = int(random.integers(legs)), int(random.integers(drawn.sample_count - 2))
            painted[foot, first : first + 4] = random.random() < 0.4
        painted[:, -1] = drawn.stance[:, -1]
        shorter = int(random.integers(3))
        painted, locked = painted[:, shorter:], locked[:, shorter:]
    return replace(gait, timeline=ContactTimeline(painted, locked, 0.4))


def document_of(gait: Gait) -> dict[str, Any]:
    """What the page has of it."""
    timeline, options = gait.timeline, gait.options
    return {
        "orientation": gait.orientation.value,
        "direction": gait.direction,
        "order": gait.order,
        "step": gait.step,
        "iterations": gait.iterations,
        "held": {"start": gait.held.start, "end": gait.held.end},
        "timeline": {"feet": text(timeline.stance), "locked": text(timeline.locked)},
        "options": {"phase_knots": options.phase_knots, "closing_knots": options.closing_knots},
        "poses": {"pinned": []},
    }


def repeated_rows(gait: Gait, iterations: int) -> list[str] | None:
    """The rows of another number of iterations; None where there are none."""
    try:
        return text(with_iterations(gait, iterations).timeline.stance)
    except InputError:
        return None


def locked_cell(before: Gait, after: Gait) -> str | None:
    """The words of the first locked cell that would change."""
    try:
        require_locks(before, after)
    except StateError as error:
        return str(error).split(" is locked")[0].lower()
    return None


@dataclass(frozen=True, eq=False)
class Case:
    """A document and what is done to it.

    Args:
        gait: the document.
        changed: three of its cells are others.
        repeated: iterations that it is given.
        turns: quarter turns of its rows, and places by which its held feet are handed on.
        heading: of an even travel, rad.
        offset: of a pinned pose along it and to its left, m.
    """

    gait: Gait
    changed: Gait
    repeated: int
    turns: int
    heading: float
    offset: tuple[float, float]

    def page_input(self) -> dict[str, Any]:
        """The case as the page takes it."""
        ahead = np.array([np.cos(self.heading), np.sin(self.heading)])
        along, sideways = self.offset
        away = along * ahead + sideways * np.array([-ahead[1], ahead[0]])  # as `PoseProblem.pinned_offset`
        return {
            "document": document_of(self.gait),
            "changed": document_of(self.changed),
            "repeated": self.repeated,
            "turns": self.turns,
            "offset": away.tolist(),
            "bodies": [[0.0, 0.0], (0.01 * ahead).tolist()],
        }

    def expected(self) -> dict[str, Any]:
        """Values that core computes; of a locked cell that would change, its name."""
        gait, (along, sideways) = self.gait, self.offset
        turned = gait.held.turned(self.turns, gait.timeline.leg_count)
        return {
            "rows": text(drawn_timeline(gait).stance),
            "isDrawn": is_drawn(gait),
            "again": repeated_rows(gait, self.repeated),
            "turned": text(gait.timeline.turned(self.turns).stance),
            "held": {"start": list(turned.start), "end": list(turned.end)},
            "heldBoth": list(gait.held.both),
            "step": pytest.approx(gait.step_world.tolist(), abs=1e-15),
            "stepBack": pytest.approx(list(gait.step), abs=1e-15),
            "heading": pytest.approx(list(heading_step(gait.orientation, 0.01)), abs=1e-12),
            "swings": [[one.foot, one.first, one.last] for one in gait.timeline.swings()],
            "locked": locked_cell(gait, self.changed),
            "pin": [pytest.approx(along, abs=1e-12), pytest.approx(sideways, abs=1e-12)],
        }


def random_case(random: np.random.Generator) -> Case:
    """One of the cases."""
    gait = random_gait(random)
    stance = gait.timeline.stance.copy()
    foot, sample = int(random.integers(stance.shape[0])), int(random.integers(stance.shape[1] - 3))
    stance[foot, sample : sample + 3] ^= True
    along, sideways = (float(part) for part in random.uniform(-MOST_PINNED, MOST_PINNED, 2))
    return Case(
        gait,
        replace(gait, timeline=replace(gait.timeline, stance=stance)),
        repeated=int(random.integers(1, 4)),
        turns=int(random.integers(-3, 4)),
        heading=float(random.uniform(-np.pi, np.pi)),
        offset=(along, sideways),
    )


@pytest.mark.heavy
def test_the_page_and_core_agree_on_random_documents(browser: Browser, studio: StudioProcess) -> None:
    random = np.random.default_rng(20261128)
    cases = [random_case(random) for _ in range(DOCUMENTS)]
    with opened_page(browser, studio.url, 1280, 800) as page:
        answers = page.evaluate(PAGE, [case.page_input() for case in cases])
    assert 50 < sum(answer["isDrawn"] for answer in answers) < 150
    assert sum(answer["again"] is None for answer in answers) > 10
    assert sum(answer["locked"] is not None for answer in answers) > 10
    differing = {
        name: f"document {number}: {answer[name]}, core has {wanted}"
        for number, (case, answer) in enumerate(zip(cases, answers, strict=True))
        for name, wanted in case.expected().items()
        if answer[name] != wanted
    }
    assert not differing, listed([f"{name} of {words}" for name, words in differing.items()])
