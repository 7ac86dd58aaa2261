"""Undo as state machines: one author has a plain stack; two never lose or tear what the other draws."""

from __future__ import annotations

import re
import tempfile
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, invariant, precondition, rule

from app.gaits.live_plans import LivePlans
from app.gaits.service import GaitService
from app.store.database import Database
from app.store.gait_files import GaitFiles
from app.undo.history import Author
from core.errors import StateError
from core.gait.gait import Gait
from solver_jobs import SolveStatus
from tests.support.live_tiers import FixedTier

GAIT = "walk"
FEET, SAMPLES = 4, 45
MEMORY = Path("/dev/shm") if Path("/dev/shm").is_dir() else None
AUTHORS = ("ada", "bob")
A_FEW = settings(
    max_examples=25, stateful_step_count=50, deadline=None, suppress_health_check=[HealthCheck.too_slow]
)

FOOT, FIRST = 1, "Two swings"


def painted(gait: Gait, foot: int, first: int, last: int, stance: bool) -> Gait:
    cells = gait.timeline.stance.copy()
    cells[foot, first : last + 1] = stance
    return replace(gait, timeline=replace(gait.timeline, stance=cells))


class ServiceMachine(RuleBasedStateMachine):
    """A service on its own folder that can be opened anew at any time."""

    def __init__(self) -> None:
        super().__init__()
        self.folder = tempfile.TemporaryDirectory(dir=MEMORY)
        self.database = Database(Path(self.folder.name) / "studio.sqlite3")
        self.pages = frozenset(AUTHORS)
        self.open_service()

    def open_service(self) -> None:
        tier = FixedTier(SolveStatus.INFEASIBLE)
        self.service = GaitService(
            GaitFiles(Path(self.folder.name)), self.database, LivePlans(tier).solve_for, lambda: self.pages
        )

    @property
    def gait(self) -> Gait:
        return self.service.open_gait(GAIT).gait

    @rule()
    def restart(self) -> None:
        self.database.close()
        self.database = Database(Path(self.folder.name) / "studio.sqlite3")
        self.open_service()

    def teardown(self) -> None:
        self.database.close()
        self.folder.cleanup()


class OneAuthor(ServiceMachine):
    """One person, whose tab may be closed and opened anew, against a list and a cursor."""

    def __init__(self) -> None:
        super().__init__()
        self.stack = [self.gait]
        self.at = 0
        self.tab = 0

    @property
    def author(self) -> Author:
        return Author(f"tab-{self.tab}", "Ada")

    def edit(self, gait: Gait) -> None:
        before = self.gait
        self.service.edit(GAIT, gait, f"Edit {len(self.stack)}", None, self.author)
        if gait != before:
            self.stack = [*self.stack[: self.at + 1], gait]
            self.at += 1

    @rule(foot=st.integers(0, FEET - 1), first=st.integers(1, SAMPLES - 8), stance=st.booleans())
    def paint(self, foot: int, first: int, stance: bool) -> None:
        self.edit(painted(self.gait, foot, first, first + 3, stance))

    @rule(margin_mm=st.integers(0, 3))
    def change_an_option(self, margin_mm: int) -> None:
        self.edit(self.gait.with_options(margin=margin_mm / 1000))

    @rule(name=st.sampled_from(["Walk", "Stroll"]))
    def rename(self, name: str) -> None:
        self.edit(replace(self.gait, name=name))

    @rule(iterations=st.integers(1, 2))
    def repeat(self, iterations: int) -> None:
        self.service.edit(GAIT, replace(self.gait, iterations=iterations), "Repeat", None, self.author)
        if self.gait != self.stack[self.at]:
            self.stack = [*self.stack[: self.at + 1], self.gait]
            self.at += 1

    @rule()
    def undo(self) -> None:
        if self.at == 0:
            with pytest.raises(StateError, match="nothing to undo"):
                self.service.undo(GAIT, self.author)
            return
        self.service.undo(GAIT, self.author)
        self.at -= 1

    @rule()
    def redo(self) -> None:
        if self.at == len(self.stack) - 1:
            with pytest.raises(StateError, match="nothing to redo"):
                self.service.redo(GAIT, self.author)
            return
        self.service.redo(GAIT, self.author)
        self.at += 1

    @rule()
    def close_the_tab_and_open_another(self) -> None:
        self.tab += 1
        self.pages = frozenset({self.author.page})

    @rule()
    def save(self) -> None:
        self.service.save(GAIT, self.author)

    @invariant()
    def the_document_is_the_models(self) -> None:
        assert self.gait == self.stack[self.at]
        opened = self.service.open_gait(GAIT)
        assert (opened.undo_label() is None) == (self.at == 0)
        assert (opened.redo_label() is None) == (self.at == len(self.stack) - 1)


@dataclass
class Painting:
    """An edit of the model: whose, of which foot's row from what to what, and when it was done."""

    author: str
    foot: int
    before: tuple[bool, ...]
    after: tuple[bool, ...]
    born: int
    since: int = field(default=0)

    @property
    def altered(self) -> list[int]:
        return [s for s in range(SAMPLES) if self.before[s] != self.after[s]]

    @property
    def span(self) -> range:
        return range(max(self.altered[0] - 1, 0), min(self.altered[-1] + 2, SAMPLES))


class TwoAuthors(ServiceMachine):
    """Two connected pages that paint over each other."""

    def __init__(self) -> None:
        super().__init__()
        self.rows = [tuple(map(bool, row)) for row in self.gait.timeline.stance]
        self.done: list[Painting] = []
        self.undone: list[Painting] = []
        self.clock = 0

    @rule(
        author=st.sampled_from(AUTHORS),
        foot=st.integers(0, 1),
        first=st.integers(10, 16),
        length=st.integers(0, 3),
        stance=st.booleans(),
    )
    def paint(self, author: str, foot: int, first: int, length: int, stance: bool) -> None:
        self.service.edit(
            GAIT, painted(self.gait, foot, first, first + length, stance), "Paint", None, Author(author)
        )
        before = self.rows[foot]
        after = (*before[:first], *[stance] * (length + 1), *before[first + length + 1 :])
        if before != after:
            self.clock += 1
            self.done.append(Painting(author, foot, before, after, self.clock, self.clock))
            self.undone = [painting for painting in self.undone if painting.author != author]
            self.rows[foot] = after

    def is_others(self, painting: Painting, old: tuple[bool, ...], new: tuple[bool, ...]) -> bool:
        """Whether the span of a painting is the other one's by now, who drew in it or took something away."""
        claimed = any(
            other.author != painting.author
            and other.foot == painting.foot
            and other.since > painting.born
            and set(other.altered) & set(painting.span)
            for other in self.done
        )
        now = self.rows[painting.foot]
        return claimed or (now != new and any(now[s] != old[s] for s in painting.span))

    def step(self, act: Callable[[str, Author], object], painting: Painting, redo: bool) -> bool:
        """Undoes or redoes; true where that was not refused, which it is just where the span is taken."""
        old, new = painting.after, painting.before
        if redo:
            old, new = new, old
        if self.is_others(painting, old, new):
            with pytest.raises(StateError, match=f"another tab changed foot {painting.foot + 1}, sample"):
                act(GAIT, Author(painting.author))
            return False
        act(GAIT, Author(painting.author))
        now = self.rows[painting.foot]
        self.rows[painting.foot] = tuple(new[s] if s in painting.altered else now[s] for s in range(SAMPLES))
        self.clock += 1
        painting.since = self.clock
        return True

    @precondition(lambda self: self.done)
    @rule(author=st.sampled_from(AUTHORS))
    def undo(self, author: str) -> None:
        mine = [painting for painting in self.done if painting.author == author]
        if mine and self.step(self.service.undo, mine[-1], redo=False):
            self.done.remove(mine[-1])
            self.undone.append(mine[-1])

    @precondition(lambda self: self.undone)
    @rule(author=st.sampled_from(AUTHORS))
    def redo(self, author: str) -> None:
        mine = [painting for painting in self.undone if painting.author == author]
        if mine and self.step(self.service.redo, mine[-1], redo=True):
            self.undone.remove(mine[-1])
            self.done.append(mine[-1])

    @invariant()
    def every_row_is_the_models(self) -> None:
        assert [tuple(map(bool, row)) for row in self.gait.timeline.stance] == self.rows


class TwoMovers(ServiceMachine):
    """Two connected pages that move the swings of one foot: none is ever torn, joined or lost."""

    def __init__(self) -> None:
        super().__init__()
        drawn = painted(painted(self.gait, FOOT, 1, SAMPLES - 2, True), FOOT, 10, 13, False)
        self.service.edit(GAIT, painted(drawn, FOOT, 20, 22, False), FIRST, None, Author("ada"))

    def swings(self) -> list[tuple[int, int]]:
        row = "".join("1" if stance else "0" for stance in self.gait.timeline.stance[FOOT])
        return [match.span() for match in re.finditer("0+", row)]

    @rule(author=st.sampled_from(AUTHORS), which=st.integers(0, 1), to=st.integers(5, 28))
    def move(self, author: str, which: int, to: int) -> None:
        first, end = self.swings()[which]
        moved = painted(painted(self.gait, FOOT, first, end - 1, True), FOOT, to, to + end - first - 1, False)
        other = self.swings()[1 - which]
        if to > other[1] or to + end - first < other[0]:
            self.service.edit(GAIT, moved, "Move", None, Author(author))

    @rule(author=st.sampled_from(AUTHORS))
    def undo(self, author: str) -> None:
        if self.service.open_gait(GAIT).undo_label(self.pages - {author}) != FIRST:
            self.take(self.service.undo, author)

    @rule(author=st.sampled_from(AUTHORS))
    def redo(self, author: str) -> None:
        self.take(self.service.redo, author)

    def take(self, act: Callable[[str, Author], object], author: str) -> None:
        before, refusal = self.gait, None
        try:
            act(GAIT, Author(author))
        except StateError as error:
            refusal = error.sentence
        if refusal is not None:
            assert re.search(f"another tab changed foot {FOOT + 1}, sample|nothing to", refusal)
            assert self.gait == before

    @invariant()
    def the_swings_are_whole(self) -> None:
        assert sorted(end - first for first, end in self.swings()) == [3, 4]


TestOneAuthor = OneAuthor.TestCase
TestOneAuthor.settings = A_FEW
TestTwoAuthors = TwoAuthors.TestCase
TestTwoAuthors.settings = A_FEW
TestTwoMovers = TwoMovers.TestCase
TestTwoMovers.settings = A_FEW
