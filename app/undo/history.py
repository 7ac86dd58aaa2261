"""A gait's log: every document that it ever was, by whom, and what of it can be undone by whom.

The log only grows. Undo is a new entry in which one edit is taken back and everybody else's edits stay; redo
likewise. A page undoes its own edits, and those of pages that are gone.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from types import MappingProxyType
from typing import Any

from app.undo.merge import RESULT, Path, merge, place_words, say_the_same, value_at
from core.errors import StateError

MOST_STEPS = 300
"""Edits that can be undone."""

MOST_ENTRIES = 1000
"""Entries that are kept; of older ones those that undo and redo need."""

MOST_CHARACTERS, LEAST_STEPS = 100_000_000, 100
"""A log of more characters keeps what this many edits need; a recorded motion has up to 2 million."""

NEWEST_EDITS = 20
"""Edits whose numbers pages are told with a gait, so that none is shown twice."""

SCRIPT = "api"
"""The page of whoever names none: scripts, and the program itself."""


@dataclass(frozen=True)
class Author:
    """Who edits: the page, which is one tab of a browser, and the person's name where it is known."""

    page: str = SCRIPT
    name: str = ""


@dataclass(frozen=True)
class LogEntry:
    """The document after a change, as JSON text, what the change was called, and whose it was.

    `edit` is the number that its page gave it, and sends again where it had no answer; empty where none did.
    """

    label: str
    document: str
    author: Author = field(default_factory=Author)
    edit: str = ""

    @cached_property
    def content(self) -> Any:
        """The document's JSON content, or its text where that is no JSON; not to be changed."""
        try:
            return json.loads(self.document)
        except (RecursionError, ValueError):
            return self.document


@dataclass(frozen=True)
class Action:
    """An edit that was done or undone.

    Args:
        position: of the edit in the log.
        since: position of the entry that did or undid it last.
        page: which did so.
    """

    position: int
    since: int
    page: str


@dataclass(frozen=True)
class UndoResult:
    """An undo or redo as it comes out.

    Args:
        position: of the edit in the log.
        label: what the edit is called.
        again: whether it is done again, not taken back.
        content: the document that it comes to.
        alone: the document that it would come to, had nobody else edited since.
        exact: whether nobody else's edit stands in between.
    """

    position: int
    label: str
    again: bool
    content: Any
    alone: Any
    exact: bool


@dataclass(frozen=True)
class History:
    """The log and its two stacks.

    Args:
        entries: by position; the document before an edit stands at the position before it.
        last: position of the present document.
        done: edits that can be undone, the newest last.
        undone: edits that can be done again, the newest last.
    """

    entries: Mapping[int, LogEntry]
    last: int
    done: tuple[Action, ...] = ()
    undone: tuple[Action, ...] = ()

    def __post_init__(self) -> None:
        object.__setattr__(self, "entries", MappingProxyType(dict(self.entries)))

    @property
    def present(self) -> LogEntry:
        """The newest entry."""
        return self.entries[self.last]

    @property
    def before(self) -> LogEntry | None:
        """The entry before it."""
        return self.entries.get(self.last - 1)

    @property
    def pages(self) -> frozenset[str]:
        """Pages that something in the log is of."""
        return frozenset(entry.author.page for entry in self.entries.values())

    @property
    def newest_edits(self) -> tuple[str, ...]:
        """Numbers that pages gave to the newest edits."""
        newest = (self.entries.get(at) for at in range(self.last, self.last - NEWEST_EDITS, -1))
        return tuple(entry.edit for entry in newest if entry is not None and entry.edit)

    def has_edit(self, number: str) -> bool:
        """Whether an edit of this number is in the log; never of one without a number."""
        return bool(number) and any(entry.edit == number for entry in self.entries.values())

    def edited(
        self, document: str, label: str, author: Author, others: frozenset[str], edit: str = ""
    ) -> History:
        """The log with one more edit; what its author could do again is gone.

        Args:
            document: after the edit, JSON text.
            label: what the edit is called.
            author: whose it is.
            others: the other pages that are connected.
            edit: the number that its page gave it.
        """
        undone = tuple(action for action in self.undone if action.page in others)
        added = self._added(LogEntry(label, document, author, edit))
        done = (*self.done, Action(added.last, added.last, author.page))
        return replace(added, done=done[-MOST_STEPS:], undone=undone)

    def gone_back(self, document: str, label: str, author: Author, to: int | None) -> History:
        """The log with an earlier document as its newest; edits after that one cannot be undone any more.

        Args:
            document: the earlier document, JSON text.
            label: what going back is called.
            author: who does so.
            to: position of the earlier document; None where the log does not have it.
        """
        done = () if to is None else tuple(action for action in self.done if action.since <= to)
        return replace(self._added(LogEntry(label, document, author)), done=done, undone=())

    def can_skip(self, action: Action, others: frozenset[str], *, again: bool) -> bool:
        """Whether the action after this one is the very next in the log, so that it can step over a document.

        Args:
            action: the newest that can be undone, or done again.
            others: the other pages that are connected.
            again: whether it was to be done again.
        """
        without = self.skipping(action, again=again)
        following = without.redoable(others) if again else without.undoable(others)
        if following is None:
            return True
        step = 1 if again else -1
        untouched = again or (action.since == action.position and following.since == following.position)
        return untouched and following.position == action.position + step

    def skipping(self, action: Action, *, again: bool) -> History:
        """The log without an action whose result cannot be read; the next one steps over that document.

        Args:
            action: the newest that can be undone, or done again.
            again: whether it was to be done again.
        """
        unread, kept = (
            (action.position, action.position - 1) if again else (action.position - 1, action.position)
        )
        entry = replace(self.entries[unread], document=self.entries[kept].document)
        done, undone = (_without(actions, action.position) for actions in (self.done, self.undone))
        return replace(self, entries={**self.entries, unread: entry}, done=done, undone=undone)

    def restated(self, document: str) -> History:
        """The log with its newest document said anew: with a result that belongs to the newest edit."""
        entry = replace(self.present, document=document)
        return replace(self, entries={**self.entries, self.last: entry})

    def undoable(self, others: frozenset[str]) -> Action | None:
        """What undo takes back: the newest edit that is of none of the other pages."""
        return next((action for action in reversed(self.done) if action.page not in others), None)

    def redoable(self, others: frozenset[str]) -> Action | None:
        """What redo does again."""
        return next((action for action in reversed(self.undone) if action.page not in others), None)

    def label_of(self, action: Action | None) -> str | None:
        """What an edit is called."""
        return None if action is None else self.entries[action.position].label

    def undo(self, author: Author, others: frozenset[str]) -> UndoResult:
        """What taking the author's newest edit back comes to.

        Raises:
            StateError: there is none, or somebody else changed the same since.
        """
        action = self.undoable(others)
        if action is None:
            raise StateError("There is nothing to undo.", "undo")
        return self._step(action, author, others, again=False)

    def redo(self, author: Author, others: frozenset[str]) -> UndoResult:
        """What doing the author's newest undone edit again comes to.

        Raises:
            StateError: there is none, or somebody else changed the same since.
        """
        action = self.redoable(others)
        if action is None:
            raise StateError("There is nothing to redo.", "redo")
        return self._step(action, author, others, again=True)

    def _step(self, action: Action, author: Author, others: frozenset[str], *, again: bool) -> UndoResult:
        before, after = action.position - 1, action.position
        base, want = (before, after) if again else (after, before)
        old, new, present = (self.entries[at].content for at in (base, want, self.last))
        merged = merge(old, new, present)
        touched = tuple(dict.fromkeys((*merged.conflicts, *merged.changed, *merged.spans)))
        claims = self._claims(action, touched, others)
        label = self.entries[action.position].label
        places = merged.conflicts or tuple(place for place in touched if place in claims)
        if places:
            who = claims.get(places[0]) or self._changer(places[0], action.position, others)
            raise StateError(
                f"“{label}” cannot be {'done again' if again else 'undone'}: {_called(who, author)} changed "
                f"{place_words(places)} since. Change it by hand, or restore an earlier version.",
                "history",
            )
        exact = say_the_same(present, old)
        content = merged.content
        if exact:  # but for a result that came since, which stays
            (key,) = RESULT
            content = new | {key: content[key]} if key in content else new
        return UndoResult(action.position, label, again, content, new, exact)

    def _claims(self, action: Action, places: tuple[Path, ...], others: frozenset[str]) -> dict[Path, Author]:
        """Places that others changed after an edit, and who did; also where they changed them back."""
        claims: dict[Path, Author] = {}
        for later in self.done:
            if later.since <= action.position or later.page not in others:
                continue
            entry, before = self.entries[later.position], self.entries[later.position - 1]
            claims |= {
                place: replace(entry.author, page=later.page)
                for place in places
                if value_at(entry.content, place) != value_at(before.content, place)
            }
        return claims

    def _changer(self, place: Path, since: int, others: frozenset[str]) -> Author | None:
        """Who of the others changed a place last, also by undoing; None where the log no longer says."""
        for at in range(self.last, since, -1):
            entry, before = self.entries.get(at), self.entries.get(at - 1)
            if entry is None or before is None or entry.author.page not in others:
                continue
            if value_at(entry.content, place) != value_at(before.content, place):
                return entry.author
        return None

    def stepped(self, step: UndoResult, document: str, author: Author) -> History:
        """The log with one edit taken back, or done again.

        Args:
            step: of `undo` or `redo`.
            document: what it comes to, JSON text.
            author: who does so.
        """
        word = "Redo" if step.again else "Undo"
        added = self._added(LogEntry(f"{word}: {step.label}", document, author))
        action = Action(step.position, added.last, author.page)
        done, undone = (_without(actions, step.position) for actions in (self.done, self.undone))
        if step.again:
            return replace(added, done=(*done, action), undone=undone)
        return replace(added, done=done, undone=(*undone, action))

    def _added(self, entry: LogEntry) -> History:
        entries = {**self.entries, self.last + 1: entry}
        return replace(self, entries=entries, last=self.last + 1)

    def pruned(self) -> History:
        """The log without old entries that nothing needs, where it has grown long or large.

        Where it is large all the same, as with recorded motions, fewer edits can be undone.
        """
        size = sum(len(entry.document) for entry in self.entries.values())
        if len(self.entries) <= MOST_ENTRIES and size <= MOST_CHARACTERS:
            return self
        done = self.done if size <= MOST_CHARACTERS else self.done[-LEAST_STEPS:]
        edits = {self.last, *(action.position for action in (*done, *self.undone))}
        needed = {at for edit in edits for at in (edit - 1, edit)}
        entries = {at: entry for at, entry in self.entries.items() if at in needed}
        return replace(self, entries=entries, done=done)


def _without(actions: tuple[Action, ...], position: int) -> tuple[Action, ...]:
    return tuple(action for action in actions if action.position != position)


def _called(other: Author | None, author: Author) -> str:
    """Somebody as an author would call them."""
    if other is None:
        return "somebody"
    if other.name and other.name != author.name:
        return other.name
    return "a script" if other.page == SCRIPT else "another tab"


def fresh_history(document: str) -> History:
    """The log of a gait that was just opened."""
    return History({0: LogEntry("Open", document)}, 0)
